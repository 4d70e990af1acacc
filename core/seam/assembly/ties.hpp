// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/term/tensor.hpp"

namespace seam {

class Field;

/// An unknown by numbers that mean the same on all ranks.
struct UnknownPlace {
  int block = 0;  ///< of the blocks of all fields, one field after the other
  int node = 0;   ///< global number
  int component = 0;
  int owner = 0;            ///< rank
  double position[3] = {};  ///< reference position of the node, m
  using Key = std::tuple<int, int, int>;
  [[nodiscard]] Key key() const { return {block, node, component}; }
  /// Time as what is tied to it sees it: no unknown of the system, its rate is 1.
  [[nodiscard]] static UnknownPlace clock() { return {-1, 0, 0, 0, {}}; }
  [[nodiscard]] bool is_clock() const { return block < 0; }
};

/// What an unknown is tied to.
struct TiedTo {
  UnknownPlace unknown;
  double coefficient = 0;  ///< derivative of the tied unknown's value
  /// How the tied unknown moves with this one: the derivative of its rate by this one's rate, and hence,
  /// since forces of a relation do no work, the part of its equation that is added to this one's.
  double handed = 0;
};

/// Relations u_i = sum_k c_ik u_k + g_i between unknowns. Motions, real and virtual ones, are related by
/// d_ik: rates are v_i = sum_k d_ik v_k, and the equation of a tied unknown is handed on to the equations of
/// those it is tied to, d_ik of it. d = c but where the rate of an unknown is not the derivative of its
/// value, as the spin of a body in space. What it is tied to may be tied itself. A relation that changes with
/// time by itself is tied to UnknownPlace::clock(), too.
class Ties {
 public:
  explicit Ties(const std::vector<Field*>& fields);

  /// Number of a block among those of all fields.
  [[nodiscard]] int number_of(const Field& field, int block) const;
  /// @param node local, of a space of the field
  [[nodiscard]] UnknownPlace place(const Field& field, int block, int node, int component) const;
  /// Ties an unknown, on the rank that owns it; on others nothing happens. Where coefficients depend on the
  /// state they are the derivatives there, and the constant is what makes the value right.
  void tie(const UnknownPlace& unknown, std::vector<TiedTo> to, double constant);
  /// That of the last tie d of `row` changes with another unknown, or with the clock.
  /// @param derivative by its value
  /// @param by_motion by its motion: the rate of d is the sum of these times the rates
  void add_change(const UnknownPlace& row, const UnknownPlace& with, double derivative, double by_motion);
  void add_change(const UnknownPlace& row, const UnknownPlace& with, double derivative) {
    add_change(row, with, derivative, derivative);
  }
  /// Three motions that are turns about axes which turn themselves, as those of a body: momentum that is
  /// handed on to them changes as it does in axes that stay.
  /// @param first of three components @param axes [axis that stays][axis that turns], a rotation
  void set_axes(const UnknownPlace& first, const Mat<3, 3, double>& axes);
  /// Ties added from now on are told in messages to come from there.
  void set_origin(const Location& where) { origin_ = where; }

  /// A tie whose chains have been followed: none of `to` is tied.
  struct Resolved {
    UnknownPlace unknown;
    std::vector<TiedTo> to;
    double constant = 0;
    struct Change {
      UnknownPlace row, with;
      double derivative, by_motion;
    };
    std::vector<Change> changes;
  };
  struct Axes {
    UnknownPlace first;
    Mat<3, 3, double> turn;
  };
  /// As they were set on this rank.
  [[nodiscard]] const std::vector<Axes>& axes() const { return axes_; }
  /// Brings the ties of all ranks together, follows chains and lets nodes that are tied to become known where
  /// they are needed. Collective.
  /// @return those of unknowns that this rank holds
  /// @throws Error where an unknown is tied twice, is prescribed as well, or is tied to itself
  std::vector<Resolved> close();

 private:
  struct Added {
    Resolved tie;
    Location where;
  };
  void gather();
  void follow(Added& added, std::vector<const Added*>& under_way, std::map<UnknownPlace::Key, char>& done);
  void require_free(const Added& added) const;
  std::vector<Resolved> localise();
  struct FieldBlock {
    Field* field;
    int block;
  };
  std::vector<FieldBlock> blocks_;
  Location origin_;
  std::vector<Added> added_;
  std::vector<Axes> axes_;
  std::map<UnknownPlace::Key, std::size_t> index_;  ///< of the ties of all ranks
};

}  // namespace seam
