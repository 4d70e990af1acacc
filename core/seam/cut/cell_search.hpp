// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "seam/cut/outline.hpp"

namespace seam::cutting {

/// Finds the cells whose boxes meet a box, in logarithmic time.
class CellSearch {
 public:
  CellSearch(const Outline& outline, int cells);
  ~CellSearch();
  /// Appends the cells in no particular order.
  void find(const Vector& low, const Vector& high, std::vector<int>& cells) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace seam::cutting
