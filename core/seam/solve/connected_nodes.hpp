// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/field/field.hpp"

namespace seam {

/// Labels connected nodes of a block by their lowest global number. Nodes of one active cell, and of one part
/// of it where it is divided, are connected, and nodes that the field has joined.
class ConnectedNodes {
 public:
  /// Collective.
  ConnectedNodes(const Field& field, int block);
  [[nodiscard]] int operator[](int node) const { return label_[node]; }
  /// Labels of all parts that have a cell, ascending, the same on every rank. Collective.
  [[nodiscard]] std::vector<int> parts() const;

 private:
  bool merge();
  bool merge_joined();
  const Field& field_;
  int block_;
  std::vector<int> label_;
};

}  // namespace seam
