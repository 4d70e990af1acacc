// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "seam/cut/outline.hpp"

namespace seam::cutting {

/// Finds the cells, or other things, whose boxes meet a box, in logarithmic time.
class CellSearch {
 public:
  CellSearch(const Outline& outline, int cells);
  /// @param boxes lowest and highest corners
  explicit CellSearch(const std::vector<std::pair<Vector, Vector>>& boxes);
  ~CellSearch();
  /// Appends the numbers of cells or boxes in no particular order.
  void find(const Vector& low, const Vector& high, std::vector<int>& cells) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace seam::cutting
