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
};

}  // namespace seam
