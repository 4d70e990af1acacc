// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/cut/cell_map.hpp"
#include "seam/cut/cell_parts.hpp"
#include "seam/cut/geometry.hpp"

namespace seam {
namespace {

using namespace cutting;

/// Of the area of a face: openings smaller than that join nothing.
constexpr double smallest_opening = 1e-12;

double wet_area(const CutCell& cell, int face) {
  if ((cell.dry_faces >> face & 1U) != 0) return 0;
  double area = 0;
  for (const SideSimplex& w : cell.wet)
    if (w.face == face) area += w.area;
  return area;
}

/// Moves the marked parts to the largest of the others.
void merge_marked(const Outline& outline, unsigned marked, std::vector<CellPart>& parts) {
  for (int p = static_cast<int>(parts.size()) - 1; p >= 0 && parts.size() > 1; --p) {
    if ((marked >> p & 1U) == 0) continue;
    int largest = -1;
    for (int q = 0; q < static_cast<int>(parts.size()); ++q)
      if (q != p && (largest < 0 || parts[q].cut.wet_volume > parts[largest].cut.wet_volume)) largest = q;
    merge_parts(outline, parts, p, largest);
  }
  if (parts.size() == 1) parts.clear();
}

}  // namespace

void CutMesh::separate_parts() {
  Geometry& g = *geometry_;
  constexpr std::size_t most = 31;
  g.parts.clear();
  for (const CutCell& cell : g.cells) {
    g.parts.push_back(connected_parts(g.outline, cell, CellMap(*mesh_, cell.cell).affine()));
    if (g.parts.back().size() > most) g.parts.back().clear();
  }
  // Marked at once and by the owner, so that all ranks find the same whatever they see of the neighbourhood.
  const int faces = static_cast<int>(topology(mesh_->type()).faces.size());
  std::vector<int> marked(mesh_->cells(), 0);
  for (int c = 0; c < mesh_->owned_cells(); ++c) {
    if (parts(c) < 2) continue;
    marked[c] = (1 << parts(c)) - 1;
    for (int f = 0; f < faces; ++f)
      for (const auto& [own, other] : joined(c, f)) marked[c] &= ~(1 << own);
  }
  g.ghosts.update([&](int c) { return marked[c]; }, [&](int c, int value) { marked[c] = value; });
  for (std::size_t k = 0; k < g.cells.size(); ++k)
    merge_marked(g.outline, static_cast<unsigned>(marked[g.cells[k].cell]), g.parts[k]);
}

int CutMesh::parts(int cell) const { return std::max(1, static_cast<int>(geometry_->parts_of(cell).size())); }

std::array<double, 3> CutMesh::part_centre(int cell, int part) const {
  if (parts(cell) > 1) return geometry_->parts_of(cell)[part].centre;
  const Vector middle = geometry_->outline.centre(cell);
  return state_[cell] == CellState::cut ? wet_centre(mesh_->dimension(), geometry_->at(cell), middle)
                                        : middle;
}

std::array<double, 3> CutMesh::cell_centre(int cell) const { return geometry_->outline.centre(cell); }

bool CutMesh::holds(int cell, int part, const std::array<double, 3>& position) const {
  if (state_[cell] != CellState::cut) return state_[cell] == CellState::wet;
  return contains(mesh_->dimension(), geometry_->at(cell, part), position);
}

int CutMesh::part_at(int cell, const std::array<double, 3>& position) const {
  int nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (int p = 0; p < parts(cell); ++p) {
    if (holds(cell, p, position)) return p;
    const Vector way = part_centre(cell, p) - position;
    if (dot(way, way) < least) nearest = p;
    least = std::min(least, dot(way, way));
  }
  return nearest;
}

int CutMesh::neighbour(int cell, int face) const { return geometry_->outline.neighbour[cell][face]; }

std::vector<std::pair<int, int>> CutMesh::joined(int cell, int face) const {
  std::vector<std::pair<int, int>> result;
  const int other = neighbour(cell, face);
  if (other < 0 || state_[cell] == CellState::body || state_[other] == CellState::body) return result;
  int other_face = 0;
  while (neighbour(other, other_face) != cell) ++other_face;
  for (int p = 0; p < parts(cell); ++p)
    for (int q = 0; q < parts(other); ++q)
      if (are_joined(cell, p, face, other, q, other_face)) result.emplace_back(p, q);
  return result;
}

bool CutMesh::are_joined(int cell, int part, int face, int other, int other_part, int other_face) const {
  const int dim = mesh_->dimension();
  const double size = std::pow(geometry_->outline.volume(cell), 1.0 / dim);
  const double least = smallest_opening * std::pow(size, dim - 1);
  // Of a part, or of all that is wet in the cell.
  const auto is_wet = [&](int c, int p, int f) {
    return state_[c] == CellState::wet || wet_area(geometry_->at(c, p), f) > least;
  };
  if (!is_wet(cell, part, face) || !is_wet(other, other_part, other_face)) return false;
  if (parts(cell) == 1 || parts(other) == 1) return true;
  return touch(dim, geometry_->at(cell, part), face, geometry_->at(other, other_part), other_face, size);
}

}  // namespace seam
