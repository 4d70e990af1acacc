// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "seam/base/diagnostics.hpp"

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
};

/// What an unknown is tied to.
struct TiedTo {
  UnknownPlace unknown;
  double coefficient = 0;  ///< derivative of the tied unknown's value
  double handed = 0;       ///< part of the tied unknown's equation that is added to this one's
};

/// Relations u_i = sum_k c_ik u_k + g_i between unknowns. The equation of a tied unknown is handed on to the
/// equations of those it is tied to, d_ik of it; with d = c, as follows from virtual work, forces of the
/// relation do none. What it is tied to may be tied itself.
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
  /// That of the last tie the part handed to the equation of `row` changes with an unknown: the derivative.
  void add_change(const UnknownPlace& row, const UnknownPlace& with, double derivative);
  /// Ties added from now on are told in messages to come from there.
  void set_origin(const Location& where) { origin_ = where; }

  /// A tie whose chains have been followed: none of `to` is tied.
  struct Resolved {
    UnknownPlace unknown;
    std::vector<TiedTo> to;
    double constant = 0;
    struct Change {
      UnknownPlace row, with;
      double derivative;
    };
    std::vector<Change> changes;
  };
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
  std::map<UnknownPlace::Key, std::size_t> index_;  ///< of the ties of all ranks
};

}  // namespace seam
