// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "seam/state/entities.hpp"

namespace seam {

/// What entities start from that a moving body has uncovered.
enum class WhenUncovered {
  extended,  ///< smoothly, from those around them (thesis 3.2): nodes only
  initial,   ///< from what all of them started with: cells and their points
  refused,   ///< from nothing: the run ends there
  kept,      ///< from what they had: whoever added the state takes care of it
};

/// What is declared of a state.
struct StateDeclaration {
  std::string name;  ///< "water/order 1/value": what restart points and messages call it
  std::shared_ptr<const Entities> on;
  int size = 1;  ///< numbers of an entity
  /// 1: at present; 2: at the start of the step, too; 3: at the start of the one before, too.
  int levels = 1;
  WhenUncovered when_uncovered = WhenUncovered::kept;
  /// It ends with the step: no restart point has it.
  bool lasts_a_step = false;
};

/// A state of whatever type its numbers are.
class AnyState {
 public:
  explicit AnyState(StateDeclaration declaration) : declaration_(std::move(declaration)) {}
  virtual ~AnyState() = default;
  AnyState(const AnyState&) = delete;
  AnyState& operator=(const AnyState&) = delete;
  [[nodiscard]] const std::string& name() const { return declaration_.name; }
  [[nodiscard]] const Entities& on() const { return *declaration_.on; }
  [[nodiscard]] int size() const { return declaration_.size; }
  [[nodiscard]] WhenUncovered when_uncovered() const { return declaration_.when_uncovered; }
  [[nodiscard]] bool lasts_a_step() const { return declaration_.lasts_a_step; }

  /// What it holds at an instant: of all levels, or of the present one.
  class Saved {
   public:
    virtual ~Saved() = default;
    [[nodiscard]] virtual bool same_bits(const Saved& other) const = 0;
    /// Largest magnitude of the difference from another one in the present level, and of this.
    [[nodiscard]] virtual double difference(const Saved& other) const = 0;
    [[nodiscard]] virtual double largest() const = 0;
  };
  [[nodiscard]] virtual std::unique_ptr<Saved> save(bool all_levels) const = 0;
  /// Levels that were not saved stay.
  virtual void restore(const Saved& saved) = 0;
  /// Each level takes over from the one after it.
  virtual void advance() = 0;
  /// Gives entities that have come since a place, with the initial number.
  virtual void resize() = 0;
  /// Sets an entity to the initial number, in all levels.
  virtual void begin_anew(int entity) = 0;

  /// The present numbers of this rank's own entities.
  [[nodiscard]] virtual std::vector<double> numbers() const = 0;
  /// Takes those of entities [global number][component], in all levels.
  virtual void take(const std::vector<double>& by_global_number) = 0;

 protected:
  [[nodiscard]] int levels() const { return declaration_.levels; }

 private:
  StateDeclaration declaration_;
};

/// Numbers on entities, [entity][component], at present and at the start of steps.
/// @tparam T double, or char for what is decided
template <class T>
class StateArray final : public AnyState {
 public:
  StateArray(StateDeclaration declaration, T initial);
  [[nodiscard]] std::vector<T>& now() { return level_[0]; }
  [[nodiscard]] const std::vector<T>& now() const { return level_[0]; }
  /// At the start of the step. @pre it was declared with two levels at least
  [[nodiscard]] std::vector<T>& old() { return level_.at(1); }
  [[nodiscard]] const std::vector<T>& old() const { return level_.at(1); }
  [[nodiscard]] std::vector<std::vector<T>>& all_levels() { return level_; }

  [[nodiscard]] std::unique_ptr<Saved> save(bool all_levels) const override;
  void restore(const Saved& saved) override;
  void advance() override;
  void resize() override;
  void begin_anew(int entity) override;
  [[nodiscard]] std::vector<double> numbers() const override;
  void take(const std::vector<double>& by_global_number) override;

 private:
  struct SavedLevels;
  T initial_;
  std::vector<std::vector<T>> level_;
};

extern template class StateArray<double>;
extern template class StateArray<char>;

/// The one owner of all that a step depends on and leaves behind. A step that fails is rewound by it, a run
/// that is resumed gets it back on any number of ranks, and what nodes start from that a body has uncovered
/// is declared with it. Whoever remembers anything else from one step to the next breaks all of these; the
/// conformance kit looks for that.
class StateStore {
 public:
  /// @param initial number of all entities @return what the store keeps: it stays where it is
  /// @throws std::logic_error where the name is taken
  template <class T>
  StateArray<T>& add(StateDeclaration declaration, T initial = T());
  /// The same, for what several may add: those after the first get what that one has added.
  template <class T>
  StateArray<T>& share(StateDeclaration declaration, T initial = T());
  /// All that another store keeps belongs to this one as well. It must outlive this.
  void include(StateStore& part) { parts_.push_back(&part); }
  /// Keeps what is no numbers but goes back with them; a resumed run finds it anew, from nothing.
  template <class T>
  void keep(std::shared_ptr<const T>& value) {
    kept_.push_back({[&value] { return std::shared_ptr<const void>(value); },
                     [&value](const std::shared_ptr<const void>& saved) {
                       value = std::static_pointer_cast<const T>(saved);
                     }});
  }
  /// Called when all states have been set to those of another time, s: what has been made of others is void.
  void on_return(std::function<void(double)> call) { on_return_.push_back(std::move(call)); }

  /// Those at an instant.
  struct Snapshot {
    std::vector<std::unique_ptr<AnyState::Saved>> states;
    std::vector<std::shared_ptr<const void>> kept;
    double time = 0;
  };
  /// @param time of the states, s
  /// @param all_levels with those at the start of the step
  [[nodiscard]] Snapshot snapshot(double time, bool all_levels = true) const;
  void restore(const Snapshot& snapshot);
  /// The present states are those at the start of the step from now on.
  void advance();
  /// Cells that a body has uncovered begin as was declared. Collective.
  /// @param cells local ones of this mesh @throws Error on all ranks, naming the state that refuses
  void uncover(const Mesh& mesh, const std::vector<int>& cells);
  /// After states have been taken from a restart point.
  void resumed(double time);

  /// With those of included stores, in the order in which they were added.
  [[nodiscard]] std::vector<AnyState*> states() const;
  /// Those on the nodes of a space that are extended to nodes which a body uncovers.
  [[nodiscard]] std::vector<StateArray<double>*> extended_on(const Space& space) const;

 private:
  struct Kept {
    std::function<std::shared_ptr<const void>()> get;
    std::function<void(const std::shared_ptr<const void>&)> set;
  };
  void each(const std::function<void(const StateStore&)>& visit) const;
  [[nodiscard]] AnyState* find(const std::string& name) const;
  std::vector<std::unique_ptr<AnyState>> own_;
  std::vector<StateStore*> parts_;
  std::vector<Kept> kept_;
  std::vector<std::function<void(double)>> on_return_;
};

/// Names of the states in which two snapshots of a store differ.
[[nodiscard]] std::vector<std::string> differences(const StateStore& store, const StateStore::Snapshot& a,
                                                   const StateStore::Snapshot& b);
/// Largest difference of present numbers, over the largest of them in the same state.
[[nodiscard]] double relative_difference(const StateStore::Snapshot& a, const StateStore::Snapshot& b);

}  // namespace seam
