// SPDX-License-Identifier: BSD-3-Clause
#include "seam/state/state_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "seam/base/diagnostics.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam {

template <class T>
struct StateArray<T>::SavedLevels final : Saved {
  std::vector<std::vector<T>> level;

  [[nodiscard]] bool same_bits(const Saved& other) const override {
    const auto& that = static_cast<const SavedLevels&>(other).level;
    return std::ranges::equal(level, that, [](const std::vector<T>& a, const std::vector<T>& b) {
      return a.size() == b.size() &&
             (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
    });
  }
  [[nodiscard]] double difference(const Saved& other) const override {
    const std::vector<T>&a = level[0], &b = static_cast<const SavedLevels&>(other).level[0];
    double most = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    return most;
  }
  [[nodiscard]] double largest() const override {
    double most = 0;
    for (const T x : level[0]) most = std::max(most, std::abs(static_cast<double>(x)));
    return most;
  }
};

template <class T>
StateArray<T>::StateArray(StateDeclaration declaration, T initial)
    : AnyState(std::move(declaration)), initial_(initial), level_(levels()) {
  StateArray::resize();
}

template <class T>
std::unique_ptr<AnyState::Saved> StateArray<T>::save(bool all_levels) const {
  auto saved = std::make_unique<SavedLevels>();
  saved->level.assign(level_.begin(), all_levels ? level_.end() : level_.begin() + 1);
  return saved;
}

template <class T>
void StateArray<T>::restore(const Saved& saved) {
  const auto& from = static_cast<const SavedLevels&>(saved).level;
  std::copy(from.begin(), from.end(), level_.begin());
  resize();  // entities that have come since stay
}

template <class T>
void StateArray<T>::advance() {
  for (std::size_t l = level_.size(); l-- > 1;) level_[l] = level_[l - 1];
}

template <class T>
void StateArray<T>::resize() {
  for (std::vector<T>& level : level_)
    level.resize(static_cast<std::size_t>(on().count()) * size(), initial_);
}

template <class T>
void StateArray<T>::begin_anew(int entity) {
  for (std::vector<T>& level : level_)
    std::fill_n(level.begin() + static_cast<std::ptrdiff_t>(entity) * size(), size(), initial_);
}

template <class T>
std::vector<double> StateArray<T>::numbers() const {
  return {now().begin(), now().begin() + static_cast<std::ptrdiff_t>(on().owned()) * size()};
}

template <class T>
void StateArray<T>::take(const std::vector<double>& by_global_number) {
  for (int e = 0; e < on().count(); ++e)
    for (int c = 0; c < size(); ++c)
      now()[static_cast<std::size_t>(e) * size() + c] =
          static_cast<T>(by_global_number[static_cast<std::size_t>(on().global(e)) * size() + c]);
  for (std::size_t l = 1; l < level_.size(); ++l) level_[l] = now();
}

template class StateArray<double>;
template class StateArray<char>;

template <class T>
StateArray<T>& StateStore::add(StateDeclaration declaration, T initial) {
  if (find(declaration.name) != nullptr)
    throw std::logic_error("two states are called '" + declaration.name + "'");
  auto state = std::make_unique<StateArray<T>>(std::move(declaration), initial);
  StateArray<T>& result = *state;
  own_.push_back(std::move(state));
  return result;
}

template <class T>
StateArray<T>& StateStore::share(StateDeclaration declaration, T initial) {
  AnyState* found = find(declaration.name);
  return found != nullptr ? dynamic_cast<StateArray<T>&>(*found) : add(std::move(declaration), initial);
}

template StateArray<double>& StateStore::add(StateDeclaration, double);
template StateArray<char>& StateStore::add(StateDeclaration, char);
template StateArray<double>& StateStore::share(StateDeclaration, double);
template StateArray<char>& StateStore::share(StateDeclaration, char);

AnyState* StateStore::find(const std::string& name) const {
  const auto found = std::ranges::find_if(own_, [&](const auto& state) { return state->name() == name; });
  return found == own_.end() ? nullptr : found->get();
}

void StateStore::each(const std::function<void(const StateStore&)>& visit) const {
  visit(*this);
  for (const StateStore* part : parts_) part->each(visit);
}

std::vector<AnyState*> StateStore::states() const {
  std::vector<AnyState*> all;
  each([&](const StateStore& store) {
    for (const auto& state : store.own_) all.push_back(state.get());
  });
  return all;
}

std::vector<StateArray<double>*> StateStore::extended_on(const Space& space) const {
  std::vector<StateArray<double>*> result;
  for (AnyState* state : states())
    if (state->when_uncovered() == WhenUncovered::extended && state->on().are_nodes_of(space))
      if (auto* numbers = dynamic_cast<StateArray<double>*>(state)) result.push_back(numbers);
  return result;
}

StateStore::Snapshot StateStore::snapshot(double time, bool all_levels) const {
  Snapshot snapshot;
  snapshot.time = time;
  each([&](const StateStore& store) {
    for (const auto& state : store.own_) snapshot.states.push_back(state->save(all_levels));
    for (const Kept& kept : store.kept_) snapshot.kept.push_back(kept.get());
  });
  return snapshot;
}

void StateStore::restore(const Snapshot& snapshot) {
  std::size_t s = 0, k = 0;
  each([&](const StateStore& store) {
    for (const auto& state : store.own_) state->restore(*snapshot.states.at(s++));
    for (const Kept& kept : store.kept_) kept.set(snapshot.kept.at(k++));
  });
  each([&](const StateStore& store) {
    for (const auto& call : store.on_return_) call(snapshot.time);
  });
}

void StateStore::resumed(double time) {
  each([&](const StateStore& store) {
    for (const Kept& kept : store.kept_) kept.set(nullptr);
  });
  each([&](const StateStore& store) {
    for (const auto& call : store.on_return_) call(time);
  });
}

void StateStore::uncover(const Mesh& mesh, const std::vector<int>& cells) {
  for (AnyState* state : states()) {
    const bool refuses = state->when_uncovered() == WhenUncovered::refused;
    if (!refuses && state->when_uncovered() != WhenUncovered::initial) continue;
    bool any = false;
    for (const int cell : cells) {
      const auto [first, last] = state->on().in_cell(mesh, cell);
      any = any || first < last;
      for (int e = first; e < last && !refuses; ++e) state->begin_anew(e);
    }
    // On all ranks or on none.
    if (refuses && state->on().communicator().any(any))
      throw Error(fmt::format(
          "'{}' has nothing to begin with in a cell that a body uncovers: it needs a mesh that no "
          "body cuts",
          state->name()));
  }
}

void StateStore::advance() {
  for (AnyState* state : states()) state->advance();
}

std::vector<std::string> differences(const StateStore& store, const StateStore::Snapshot& a,
                                     const StateStore::Snapshot& b) {
  std::vector<std::string> names;
  const std::vector<AnyState*> states = store.states();
  for (std::size_t s = 0; s < states.size(); ++s)
    if (!a.states.at(s)->same_bits(*b.states.at(s))) names.push_back(states[s]->name());
  return names;
}

double relative_difference(const StateStore::Snapshot& a, const StateStore::Snapshot& b) {
  double most = 0;
  for (std::size_t s = 0; s < std::min(a.states.size(), b.states.size()); ++s) {
    const double difference = a.states[s]->difference(*b.states[s]), largest = a.states[s]->largest();
    if (difference > 0) most = std::max(most, largest > 0 ? difference / largest : difference);
  }
  return most;
}

}  // namespace seam
