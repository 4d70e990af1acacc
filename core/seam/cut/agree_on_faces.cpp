// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/agree_on_faces.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "seam/cut/convex.hpp"
#include "seam/cut/slivers.hpp"
#include "seam/cut/unite_in_cell.hpp"

namespace seam::cutting {
namespace {

/// In squares of the cell's size: less of a face is rounding.
constexpr double negligible = 1e-13;
/// Of a cell's size: facets that close to a face lie in it.
constexpr double flush = 1e-9;

/// Appends what is left of a convex polygon outside of another one in its plane.
void append_rest(Polygon polygon, const Polygon& other, const Vector& normal, std::vector<Polygon>& rest) {
  Polygon front, back;
  for (std::size_t k = 0; k < other.size() && !polygon.empty(); ++k) {
    const Vector &a = other[k], &b = other[(k + 1) % other.size()];
    const Vector out = cross(b - a, normal);
    split(polygon, {out, dot(out, a)}, front, back);
    if (!front.empty()) rest.push_back(front);
    polygon = back;
  }
}

bool in_one_plane(const SideSimplex& a, const SideSimplex& b, double size) {
  return std::abs(dot(a.normal, b.normal)) > 1 - flush &&
         std::abs(dot(a.normal, b.corner[0] - a.corner[0])) < flush * size;
}

Polygon corners(const SideSimplex& w) { return {w.corner.begin(), w.corner.end()}; }

/// A part of a cell's face, counter-clockwise seen along its normal, out of the cell.
struct FacePolygon {
  Polygon polygon;
  Vector normal;
};

/// What the first has of a face and the second has not.
std::vector<FacePolygon> difference(const std::vector<SideSimplex>& first,
                                    const std::vector<SideSimplex>& second, double size) {
  std::vector<FacePolygon> result;
  for (const SideSimplex& a : first) {
    std::vector<Polygon> left{turned_to(a.normal, corners(a))};
    for (const SideSimplex& b : second) {
      if (!in_one_plane(a, b, size)) continue;
      std::vector<Polygon> next;
      for (Polygon& p : left) append_rest(std::move(p), turned_to(a.normal, corners(b)), a.normal, next);
      left = std::move(next);
    }
    for (Polygon& p : left) result.push_back({std::move(p), a.normal});
  }
  return result;
}

/// What both have of a face, as a part of the first cell's.
std::vector<FacePolygon> intersection(const std::vector<SideSimplex>& first,
                                      const std::vector<SideSimplex>& second, double size) {
  std::vector<FacePolygon> result;
  for (const SideSimplex& a : first)
    for (const SideSimplex& b : second)
      if (in_one_plane(a, b, size))
        result.push_back(
            {common_part(turned_to(a.normal, corners(a)), turned_to(a.normal, corners(b)), a.normal, 0),
             a.normal});
  return result;
}

class FaceAgreement {
 public:
  FaceAgreement(const ClipInput& input, const std::vector<std::vector<int>>& windings,
                const std::function<bool(int)>& convex, std::vector<CutCell>& cells,
                std::vector<CellState>& state)
      : input_(input), windings_(windings), convex_(convex), cells_(cells), state_(state) {
    for (std::size_t k = 0; k < cells.size(); ++k) index_[cells[k].cell] = k;
  }

  void run() {
    // A cell that is united here may leave its other neighbours behind: once more, then.
    bool changed = true;
    for (int pass = 0; pass < 3 && changed; ++pass) {
      changed = false;
      for (std::size_t k = 0; k < cells_.size(); ++k)
        for (int f = 0; f < 6 && cells_[k].united; ++f) changed = settle(k, f) || changed;
    }
    std::sort(cells_.begin(), cells_.end(),
              [](const CutCell& a, const CutCell& b) { return a.cell < b.cell; });
  }

 private:
  /// @return whether anything changed
  bool settle(std::size_t k, int face) {
    const int cell = cells_[k].cell, other = input_.outline.neighbour[cell][face];
    if (other < 0) return false;
    int back = 0;
    while (input_.outline.neighbour[other][back] != cell) ++back;
    const double size = std::cbrt(input_.outline.volume(cell));
    const double own = area_of(cell, face), theirs = area_of(other, back);
    if (std::abs(own - theirs) <= negligible * size * size) return false;
    for (const int c : {cell, other}) make_united(c);
    const std::vector<SideSimplex> here = wet_parts(cell, face), there = wet_parts(other, back);
    const std::vector<FacePolygon> both = intersection(here, there, size);
    const std::vector<int> facets = facets_at(cell, other);
    if (facets.empty()) return false;
    lay(cell, face, both, 1, difference(here, there, size), facets);
    lay(other, back, both, -1, difference(there, here, size), facets);
    return true;
  }

  [[nodiscard]] std::vector<SideSimplex> wet_parts(int cell, int face) const {
    const auto found = index_.find(cell);
    std::vector<SideSimplex> result;
    if (found == index_.end() && state_[cell] == CellState::body) return result;
    for (const SideSimplex& w :
         found == index_.end() ? whole_cell(input_.outline, cell).wet : cells_[found->second].wet)
      if (w.face == face) result.push_back(w);
    return result;
  }
  [[nodiscard]] double area_of(int cell, int face) const {
    double sum = 0;
    for (const SideSimplex& w : wet_parts(cell, face)) sum += w.area;
    return sum;
  }

  /// What is not cut, or by one body only, is described as where several meet: by polygons that do not
  /// overlap.
  void make_united(int cell) {
    const auto found = index_.find(cell);
    if (found == index_.end()) {
      if (state_[cell] == CellState::body) return;
      index_[cell] = cells_.size();
      cells_.push_back(whole_cell(input_.outline, cell));
      return;
    }
    CutCell& cut = cells_[found->second];
    if (cut.united) return;
    unite_in_cell(input_, windings_, convex_(cell), cut);
    measure(input_.outline, cut);
  }

  [[nodiscard]] std::vector<int> facets_at(int cell, int other) const {
    std::vector<int> facets;
    for (const int c : {cell, other})
      if (const auto found = index_.find(c); found != index_.end())
        facets.insert(facets.end(), cells_[found->second].facets.begin(), cells_[found->second].facets.end());
    return facets;
  }

  /// What a cell has of a face, and the one behind it has not, becomes interface of the cell.
  /// @param both what remains. @param turn -1 where that is seen from the other side
  void lay(int cell, int face, const std::vector<FacePolygon>& both, int turn,
           const std::vector<FacePolygon>& alone, const std::vector<int>& facets) {
    const auto found = index_.find(cell);
    if (found == index_.end()) return;  // all of it is in a body
    CutCell& receiver = cells_[found->second];
    std::erase_if(receiver.wet, [&](const SideSimplex& w) { return w.face == face; });
    for (const FacePolygon& p : both)
      append_wet(face, turn * p.normal, turned_to(turn * p.normal, p.polygon), receiver.wet);
    for (const FacePolygon& p : alone) add_pieces(p.polygon, p.normal, facets, receiver);
    measure(input_.outline, receiver);
  }

  /// @param normal out of the receiver
  void add_pieces(const Polygon& polygon, const Vector& normal, const std::vector<int>& facets,
                  CutCell& receiver) const {
    const double size = std::cbrt(input_.outline.volume(receiver.cell));
    const double area = dot(vector_area(polygon), normal);
    if (area <= 0) return;
    std::vector<std::pair<Polygon, const Facet*>> parts;
    double covered = 0, most = -2;
    const Facet* nearest = nullptr;  // by its direction, where none lies here
    for (const int f : facets) {
      const Facet& facet = input_.facets.list[f];
      if (dot(facet.normal, normal) > most) {
        most = dot(facet.normal, normal);
        nearest = &facet;
      }
      if (dot(facet.normal, normal) < 1 - flush) continue;
      Polygon triangle;
      for (const int v : facet.vertex) triangle.push_back(input_.facets.position[v]);
      if (std::abs(dot(normal, triangle[0] - polygon[0])) > flush * size) continue;
      Polygon common = common_part(polygon, turned_to(normal, triangle), normal, 0);
      const double part = dot(vector_area(common), normal);
      if (part <= 1e-14 * area) continue;
      covered += part;
      parts.emplace_back(std::move(common), &facet);
    }
    if (parts.empty()) {
      parts.emplace_back(polygon, nearest);
      covered = area;
    }
    for (const auto& [part, facet] : parts) {
      // Pieces are oriented as facets are, out of the body.
      receiver.pieces.push_back({facet->body, facet->facet, static_cast<int>(receiver.points.size()),
                                 static_cast<int>(part.size()), normal, area / covered});
      receiver.points.insert(receiver.points.end(), part.rbegin(), part.rend());
    }
  }

  const ClipInput& input_;
  const std::vector<std::vector<int>>& windings_;
  const std::function<bool(int)>& convex_;
  std::vector<CutCell>& cells_;
  std::vector<CellState>& state_;
  std::unordered_map<int, std::size_t> index_;
};

}  // namespace

void agree_on_faces(const ClipInput& input, const std::vector<std::vector<int>>& windings,
                    const std::function<bool(int)>& convex, std::vector<CutCell>& cells,
                    std::vector<CellState>& state) {
  FaceAgreement(input, windings, convex, cells, state).run();
}

}  // namespace seam::cutting
