// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "seam/cut/cell_map.hpp"
#include "seam/cut/geometry.hpp"
#include "seam/cut/triangulate.hpp"
#include "seam/cut/wet_leaves.hpp"

namespace seam {
namespace {

using namespace cutting;

/// The tetrahedra between one corner and the faces it is not part of.
void append_tetrahedra(const Convex& part, std::vector<double>& corners) {
  const Vector apex = part.faces[0].corner[0];
  for (const Convex::Face& face : part.faces) {
    if (std::find(face.corner.begin(), face.corner.end(), apex) != face.corner.end()) continue;
    for (std::size_t k = 1; k + 1 < face.corner.size(); ++k)
      for (const Vector& x : {face.corner[0], face.corner[k + 1], face.corner[k], apex})
        corners.insert(corners.end(), x.begin(), x.end());
  }
}

}  // namespace

void CutMesh::wet_simplices(int cell, std::vector<double>& corners, int part) const {
  corners.clear();
  const CutCell& cut = geometry_->at(cell, part);
  if (mesh_->dimension() == 3) {
    for (const Convex& leaf : wet_leaves(geometry_->outline, cut, CellMap(*mesh_, cell).affine()))
      append_tetrahedra(leaf, corners);
    return;
  }
  WetShape shape;
  wet_shape(cell, shape, part);
  std::vector<std::vector<Vector>> outlines(shape.count());
  for (int p = 0; p < shape.count(); ++p)
    for (int k = shape.first[p]; k < shape.first[p + 1]; ++k)
      outlines[p].push_back({shape.points[2 * k], shape.points[2 * k + 1], 0});
  for (const Triangle& triangle : triangulate(outlines))
    for (const Vector& x : triangle) corners.insert(corners.end(), {x[0], x[1]});
}

}  // namespace seam
