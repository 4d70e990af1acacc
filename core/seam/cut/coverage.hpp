// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/geometry.hpp"

namespace seam::cutting {

/// Winding numbers of bodies about the vertices of the outline: spread along the mesh's edges from one exact
/// query per connected part, changing where facets cross an edge.
class Coverage {
 public:
  /// @param united whether no facet lies in a body, so that one count does for all bodies
  /// @throws Error when two ways to a vertex disagree: an open surface ends inside the mesh
  Coverage(const Mesh& mesh, const Outline& outline, const std::vector<LatticePoint>& vertex,
           const Facets& facets, const std::vector<CutCell>& cells, bool united);

  /// [vertex]: how many bodies cover it, 0 in the wet part.
  [[nodiscard]] const std::vector<int>& count() const { return count_; }
  /// Whether a cut cell's wet part is more than the outside of one body whose own parts do not overlap.
  [[nodiscard]] bool overlap_in(const Outline& outline, const CutCell& cell) const;
  /// [body][vertex]; a single entry when the facets were united before.
  [[nodiscard]] const std::vector<std::vector<int>>& windings() const { return windings_; }

 private:
  std::vector<int> count_;
  std::vector<std::vector<int>> windings_;
};

}  // namespace seam::cutting
