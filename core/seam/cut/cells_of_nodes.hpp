// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "seam/space/space.hpp"

namespace seam {

struct CellNode {
  int cell;
  int node;  ///< of the cell
};

/// The local cells around some nodes of set 0.
class CellsOfNodes {
 public:
  /// @param wanted per local node of the space
  CellsOfNodes(const Space& space, const std::vector<char>& wanted) : first_(space.nodes() + 1, 0) {
    const int per_cell = space.nodes_per_cell(), cells = space.mesh().cells();
    const auto visit = [&](const auto& found) {
      for (int c = 0; c < cells; ++c)
        for (int a = 0; a < per_cell; ++a)
          if (const int n = space.cell_nodes(c)[a]; wanted[n] != 0) found(n, CellNode{c, a});
    };
    visit([&](int n, const CellNode&) { ++first_[n + 1]; });
    for (int n = 0; n < space.nodes(); ++n) {
      first_[n + 1] += first_[n];
      if (wanted[n] != 0) nodes_.push_back(n);
    }
    cells_.resize(first_.back());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    visit([&](int n, const CellNode& c) { cells_[next[n]++] = c; });
  }
  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }
  [[nodiscard]] std::span<const CellNode> around(int node) const {
    return {cells_.data() + first_[node], cells_.data() + first_[node + 1]};
  }

 private:
  std::vector<int> first_, nodes_;
  std::vector<CellNode> cells_;
};

}  // namespace seam
