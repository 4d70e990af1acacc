// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace seam {

class Field;
struct ElementSide;

/// A cell that may be owned by any rank: what an interface needs to evaluate it here.
struct RemoteCell {
  int global_cell = -1;
  double diameter = 0;
  std::vector<double> geometry;         ///< [geometry node][dimension]
  std::vector<std::vector<int>> nodes;  ///< local nodes per block of the field

  void attach(ElementSide& side, const Field& field) const;
};

/// Fetches cells from their owners and makes their nodes known here. Collective.
/// @param global_cells cells of the field's mesh by global number; repetitions are allowed
/// @return one entry per requested cell, in the same order
std::vector<RemoteCell> fetch_cells(Field& field, const std::vector<int>& global_cells);

}  // namespace seam
