// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cut_mesh.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

#include "seam/assembly/together.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/cut/agree_on_faces.hpp"
#include "seam/cut/cell_map.hpp"
#include "seam/cut/clip.hpp"
#include "seam/cut/coverage.hpp"
#include "seam/cut/geometry.hpp"
#include "seam/cut/slivers.hpp"
#include "seam/cut/unite.hpp"
#include "seam/cut/unite_in_cell.hpp"

namespace seam {
namespace {

using namespace cutting;

/// Facets that may meet each cell, [cell, facet] in ascending order.
std::vector<std::pair<int, int>> candidates(const CellSearch& search, const Facets& facets) {
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> cells;
  const double hair = 4 * facets.lattice.spacing();  // what rounding to the lattice moves
  for (int f = 0; f < static_cast<int>(facets.list.size()); ++f) {
    Vector low = facets.position[facets.list[f].vertex[0]], high = low;
    for (int k = 1; k < facets.dimension; ++k)
      for (int i = 0; i < 3; ++i) {
        const double x = facets.position[facets.list[f].vertex[k]][i];
        low[i] = std::min(low[i], x);
        high[i] = std::max(high[i], x);
      }
    const Vector margin{hair, hair, hair};
    cells.clear();
    search.find(low - margin, high + margin, cells);
    for (const int c : cells) pairs.emplace_back(c, f);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<CutCell> clip(const ClipInput& input, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<CutCell> cells;
  for (std::size_t k = 0; k < pairs.size();) {
    CutCell cell;
    cell.cell = pairs[k].first;
    for (; k < pairs.size() && pairs[k].first == cell.cell; ++k) cell.facets.push_back(pairs[k].second);
    if (input.outline.dimension == 2)
      clip_segments(input, cell.facets, cell);
    else
      clip_triangles(input, cell.facets, cell);
    if (!cell.pieces.empty()) cells.push_back(std::move(cell));
  }
  return cells;
}

/// Whether no two bodies meet because their boxes do not, and each lies in its box.
bool are_apart(const Facets& facets) {
  const std::size_t bodies = facets.far.size();
  if (bodies < 2) return false;  // a single one may overlap itself, and costs the same
  for (std::size_t b = 0; b < bodies; ++b)
    if (!facets.closed[b] || facets.far[b] != 0) return false;
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  std::vector<LatticePoint> low(bodies, {{most, most, most}}), high(bodies, {{-most, -most, -most}});
  for (const Facet& f : facets.list)
    for (const int v : f.vertex)
      for (int i = 0; i < 3; ++i) {
        low[f.body].x[i] = std::min(low[f.body].x[i], facets.point[v].x[i]);
        high[f.body].x[i] = std::max(high[f.body].x[i], facets.point[v].x[i]);
      }
  for (std::size_t a = 0; a < bodies; ++a)
    for (std::size_t b = a + 1; b < bodies; ++b) {
      bool apart = false;
      for (int i = 0; i < facets.dimension; ++i)
        apart = apart || high[a].x[i] < low[b].x[i] || high[b].x[i] < low[a].x[i];
      if (!apart) return false;
    }
  return true;
}

/// From now on pieces are those of the surfaces that were given, not of the solids that these make up.
void name_surfaces(const Facets& facets, std::vector<CutCell>& cells) {
  for (CutCell& c : cells)
    for (FacetPiece& p : c.pieces) {
      const auto& [body, facet] = facets.origin[p.body][p.facet];
      p.body = body;
      p.facet = facet;
    }
}

}  // namespace

CutMesh::CutMesh(const Mesh& mesh)
    : mesh_(&mesh), state_(mesh.cells(), CellState::wet), geometry_(std::make_unique<Geometry>(mesh)) {
  geometry_->index.assign(mesh.cells(), -1);
}

CutMesh::~CutMesh() = default;

void CutMesh::cut(std::span<const Surface> bodies) {
  Geometry& g = *geometry_;
  const int dim = g.outline.dimension;
  g.bodies.assign(bodies.begin(), bodies.end());
  const ClipInput input{g.outline, g.vertex, g.facets};
  std::optional<Coverage> found;
  together(mesh_->communicator(), [&] {
    const Lattice before = g.facets.lattice;
    g.facets = collect_facets(g.outline, g.border, bodies);
    if (dim == 2) unite_in_plane(g.facets, g.border);
    if (g.vertex.empty() || !(g.facets.lattice == before)) {
      g.vertex.clear();
      for (const Vector& x : g.outline.position) g.vertex.push_back(g.facets.lattice.round(x));
    }
    g.cells = clip(input, candidates(g.search, g.facets));
    found.emplace(*mesh_, g.outline, g.vertex, g.facets, g.cells, dim == 2 || are_apart(g.facets));
  });
  const Coverage& coverage = *found;
  for (int c = 0; c < mesh_->cells(); ++c) {
    const int vertex = g.outline.sides[g.outline.first_side[c]].vertex[0];
    state_[c] = coverage.count()[vertex] > 0 ? CellState::body : CellState::wet;
  }
  const auto convex = [&](int c) { return CellMap(*mesh_, c).affine(); };
  for (CutCell& c : g.cells) {
    if (dim == 2)
      find_wet_sides(input, coverage.count(), c);
    else if (coverage.overlap_in(g.outline, c))
      unite_in_cell(input, coverage.windings(), convex(c.cell), c);
    else
      find_wet_faces(input, coverage.count(), c);
    measure(g.outline, c);
  }
  agree_on_faces(input, coverage.windings(), convex, g.cells, state_);
  settle_slivers(g.outline, g.cells, state_);
  name_surfaces(g.facets, g.cells);
  g.coverage = coverage.count();
  adopt_ghost_states();
  number_cut_cells();
}

/// A ghost cell may have become cut by what a sliver handed over that only its owner sees, or have kept one
/// that its owner handed over: what is a body there is one here. Where one is wet and the other a body, the
/// surfaces are open in a way that neither rank sees by itself.
void CutMesh::adopt_ghost_states() {
  Geometry& g = *geometry_;
  std::vector<int> missed;
  std::vector<char> handed_over(mesh_->cells(), 0);
  int torn = -1;
  g.ghosts.update([&](int c) { return static_cast<int>(state_[c]); },
                  [&](int c, int value) {
                    const auto owners = static_cast<CellState>(value);
                    if (owners == state_[c]) return;
                    if (owners != CellState::cut && state_[c] != CellState::cut) torn = mesh_->global_cell(c);
                    if (owners == CellState::cut && state_[c] == CellState::wet) missed.push_back(c);
                    if (owners != CellState::body) return;
                    handed_over[c] = 1;
                    state_[c] = CellState::body;
                  });
  torn = mesh_->communicator().max(torn);
  if (torn >= 0)
    throw Error(
        fmt::format("the surfaces that cut mesh '{}' are not closed inside of it: cell {} lies inside and "
                    "outside; let open surfaces end outside the mesh or on its boundary",
                    mesh_->name(), torn));
  std::erase_if(g.cells, [&](const CutCell& cell) { return handed_over[cell.cell] != 0; });
  for (const int c : missed) {
    state_[c] = CellState::cut;
    g.cells.push_back(whole_cell(g.outline, c));
  }
  std::sort(g.cells.begin(), g.cells.end(),
            [](const CutCell& a, const CutCell& b) { return a.cell < b.cell; });
}

void CutMesh::number_cut_cells() {
  Geometry& g = *geometry_;
  g.index.assign(mesh_->cells(), -1);
  g.parts.clear();
  cut_cells_.clear();
  for (std::size_t k = 0; k < g.cells.size(); ++k) {
    g.index[g.cells[k].cell] = static_cast<int>(k);
    cut_cells_.push_back(g.cells[k].cell);
  }
}

const CutCell& CutMesh::Geometry::at(int cell, int part) const {
  if (index[cell] < 0) throw std::logic_error("CutMesh: the cell is not cut");
  if (part == all_parts || parts_of(cell).empty()) return cells[index[cell]];
  return parts_of(cell)[part].cut;
}

const std::vector<CellPart>& CutMesh::Geometry::parts_of(int cell) const {
  static const std::vector<CellPart> none;
  return parts.empty() || index[cell] < 0 ? none : parts[index[cell]];
}

std::vector<CutMesh::Doubt> CutMesh::doubts() const {
  std::vector<Doubt> result;
  const Border::Doubts found = geometry_->border.doubts(geometry_->facets);
  const auto at = [&](const Vector& place) {
    return fmt::format("({:.6g})", fmt::join(place.begin(), place.begin() + mesh_->dimension(), ", "));
  };
  if (const auto& gap = found.short_of_it)
    result.push_back(
        {"short of the border",
         fmt::format(
             "a body ends {:.3g} of a cell short of the border of mesh '{}', near {}: the border there is "
             "a border with the conditions that it has, and no interface; let the body end on it, to "
             "{:.0e} of a cell, or in the mesh",
             gap->width, mesh_->name(), at(gap->at), Border::flush_reach)});
  if (const auto& place = found.covered_partly)
    result.push_back(
        {"border covered partly",
         fmt::format("a body that stands on the border of mesh '{}' covers a cell's side only in part, "
                     "near {}: what it leaves of it is a border with the conditions that it has; let "
                     "the body end where a cell does if that is not meant",
                     mesh_->name(), at(*place))});
  return result;
}

std::vector<CellFace> CutMesh::covered_faces() const {
  const std::vector<double> covered = geometry_->border.doubts(geometry_->facets).covered;
  const std::vector<Border::Side>& sides = geometry_->border.sides();
  const Outline& outline = geometry_->outline;
  std::vector<CellFace> result;
  for (int c = 0; c < mesh_->owned_cells(); ++c)
    for (int s = outline.first_side[c]; s < outline.first_side[c + 1]; ++s) {
      const Side& side = outline.sides[s];
      if (outline.neighbour[c][side.face] >= 0) continue;
      std::array<Vector, 3> corner{};
      for (int k = 0; k < 3; ++k)
        corner[k] = outline.position[side.vertex[std::min(k, outline.dimension - 1)]];
      const auto at = std::ranges::lower_bound(sides, corner, {}, &Border::Side::corner);  // in this order
      if (at != sides.end() && at->corner == corner && covered[at - sides.begin()] > 0)
        result.push_back({c, side.face});
    }
  return result;
}

double CutMesh::wet_volume(int cell, int part) const { return geometry_->at(cell, part).wet_volume; }
double CutMesh::cell_volume(int cell) const { return geometry_->at(cell).volume; }
double CutMesh::interface_area(int cell, int part) const { return geometry_->at(cell, part).interface_area; }

}  // namespace seam
