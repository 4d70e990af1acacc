// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

namespace seam {

/// Which sets of unknowns the parts of a field's cells use, where bodies divide a cell or what is around
/// a node (thesis Remark 3.2). The parts of cells around a node that are connected there through faces share
/// one set. The sets of a node are numbered from 0, by where they lie and by nothing of the past: set 0
/// is that of the wet part in which the node itself lies, or the only one.
struct PartLayout {
  /// A part of a cell that has several, or whose nodes are not all of set 0.
  struct Sets {
    std::array<double, 3> centre;          ///< m
    std::array<std::vector<int>, 2> set;   ///< [order - 1][node of the cell]; empty for orders not in use
    std::array<std::vector<int>, 2> node;  ///< the same as local nodes of the Space
  };
  std::vector<char> active;                      ///< [local cell]
  std::vector<std::vector<double>> body_points;  ///< [body]: of the surfaces that part the cells, m
  std::vector<int> first;  ///< [local cell + 1]: into parts; equal ones where the cell is one part of set 0
  std::vector<Sets> parts;

  /// Of a local cell: 1 where nothing is listed.
  [[nodiscard]] int count(int cell) const {
    return first[cell] == first[cell + 1] ? 1 : first[cell + 1] - first[cell];
  }
  /// Null where all nodes are of set 0.
  [[nodiscard]] const Sets* part(int cell, int number) const {
    return first[cell] == first[cell + 1] ? nullptr : &parts[first[cell] + number];
  }
  /// Whether all parts use the same sets.
  [[nodiscard]] bool same_sets(const PartLayout& other) const {
    bool same = first == other.first && active == other.active;
    for (std::size_t p = 0; p < parts.size() && same; ++p) same = parts[p].set == other.parts[p].set;
    return same;
  }
};

}  // namespace seam
