// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace seam {

/// The connected parts of a mesh out of which bodies are cut, over all ranks. Two cells belong together when
/// the face between them is wet; the wet part in one cell counts as connected.
struct WetParts {
  std::vector<int> part;       ///< [local cell]: the same number on all ranks; -1 in a body
  std::vector<double> volume;  ///< [part], m^d
  std::vector<double> cells;   ///< [part]: its volume in units of the largest whole cell in it

  /// Owned and ghost cells of the parts whose wet part is less than `cells` whole cells.
  [[nodiscard]] std::vector<int> smaller_than(double cell_count) const {
    std::vector<int> result;
    for (int c = 0; c < static_cast<int>(part.size()); ++c)
      if (part[c] >= 0 && cells[part[c]] < cell_count) result.push_back(c);
    return result;
  }
};

}  // namespace seam
