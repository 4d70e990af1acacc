// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/slivers.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace seam::cutting {
namespace {

double length(const Vector& a) { return std::sqrt(dot(a, a)); }

int face_towards(const Outline& outline, int cell, int other) {
  for (int f = 0; f < 8; ++f)
    if (outline.neighbour[cell][f] == other) return f;
  return -1;
}

/// For a face that no piece of the sliver is opposite to: its largest wet part, with the area of all,
/// closes the receiver.
void lay_face(int dimension, const CutCell& sliver, int face, const Vector& outward, CutCell& receiver) {
  const SideSimplex* largest = nullptr;
  for (const SideSimplex& w : sliver.wet)
    if (w.face == face && (largest == nullptr || w.area > largest->area)) largest = &w;
  if (largest == nullptr || largest->area <= 0) return;
  const double area = length(outward);
  const int first = static_cast<int>(receiver.points.size());
  receiver.points.insert(receiver.points.end(), largest->corner.begin(), largest->corner.begin() + dimension);
  // A piece is oriented against its normal; turned round where the part ran against the side.
  if (largest->sign < 0) std::swap(receiver.points[first], receiver.points[first + 1]);
  receiver.pieces.push_back({sliver.pieces[0].body, sliver.pieces[0].facet, first, dimension,
                             1 / area * outward, area / largest->area, true});
}

/// Lays the pieces of a sliver onto one of its wet faces.
/// @param outward vector area of that face out of the receiving cell: along the receiver's normal
void hand_over(int dimension, const CutCell& sliver, int face, const Vector& outward, CutCell& receiver) {
  const double area = length(outward);
  const Vector normal = 1 / area * outward;
  Vector anchor{};
  for (const SideSimplex& w : sliver.wet)
    if (w.face == face) anchor = w.corner[0];
  std::vector<std::pair<FacetPiece, double>> laid;  // and their shares
  double sum = 0;
  for (const FacetPiece& p : sliver.pieces) {
    const Vector a = vector_area(dimension, sliver, p);
    // Pieces at right angles to the face have no share but rounding.
    const double opposite = dot(a, normal);
    if (opposite <= 1e-12 * length(a)) continue;
    FacetPiece piece = p;
    piece.handed_over = true;
    piece.normal = normal;
    piece.scale = 1;
    piece.first = static_cast<int>(receiver.points.size());
    for (int i = 0; i < piece.count; ++i) {
      const Vector& x = sliver.points[p.first + i];
      receiver.points.push_back(x - dot(x - anchor, normal) * normal);
    }
    // As the rule on it measures it, so that rounding of its direction opens nothing.
    const double own = dot(vector_area(dimension, receiver, piece), normal);
    if (own <= 0) continue;
    piece.scale = area / own;
    laid.emplace_back(piece, opposite);
    sum += opposite;
  }
  for (auto& [piece, opposite] : laid) {
    piece.scale *= opposite / sum;
    receiver.pieces.push_back(piece);
  }
  if (laid.empty() && !sliver.pieces.empty()) lay_face(dimension, sliver, face, outward, receiver);
}

class Settlement {
 public:
  Settlement(const Outline& outline, std::vector<CutCell>& cells, std::vector<CellState>& state)
      : outline_(outline), cells_(cells), state_(state) {
    for (std::size_t k = 0; k < cells.size(); ++k) index_[cells[k].cell] = k;
  }

  void settle() {
    for (const CutCell& c : cells_) state_[c.cell] = decide(c);
    clear_bodies();
  }

  void drop(const std::vector<char>& dropped) {
    for (std::size_t c = 0; c < dropped.size(); ++c)
      if (dropped[c] != 0) state_[c] = CellState::body;
    clear_bodies();
  }

 private:
  void clear_bodies() {
    const std::size_t original = cells_.size();
    for (std::size_t k = 0; k < original; ++k)
      if (state_[cells_[k].cell] == CellState::body) clear(k);
    std::erase_if(cells_, [&](const CutCell& c) { return state_[c.cell] != CellState::cut; });
    std::sort(cells_.begin(), cells_.end(),
              [](const CutCell& a, const CutCell& b) { return a.cell < b.cell; });
    for (CutCell& c : cells_)
      if (std::any_of(c.pieces.begin(), c.pieces.end(), [](const FacetPiece& p) { return p.handed_over; }))
        measure(outline_, c);
  }

  [[nodiscard]] CellState decide(const CutCell& c) const {
    if (c.wet_volume < smallest_part * c.volume) return CellState::body;
    const double size = std::pow(c.volume, (outline_.dimension - 1.0) / outline_.dimension);
    return c.interface_area < smallest_part * size ? CellState::wet : CellState::cut;
  }

  void clear(std::size_t sliver) {
    const int cell = cells_[sliver].cell;
    for (int f = 0; f < 8; ++f) {
      const int other = outline_.neighbour[cell][f];
      if (other < 0 || state_[other] == CellState::body || length(wet_face_area(cells_[sliver], f)) == 0)
        continue;
      if (!index_.contains(other)) {
        index_[other] = cells_.size();
        cells_.push_back(whole_cell(outline_, other));
      }
      CutCell& receiver = cells_[index_[other]];
      // What the receiver loses, not what the sliver has: so its boundary stays closed to the last digit.
      const int face = face_towards(outline_, other, cell);
      const Vector lost = wet_face_area(receiver, face);
      if (length(lost) == 0) continue;
      state_[other] = CellState::cut;
      receiver.dry_faces |= 1U << face;
      hand_over(outline_.dimension, cells_[sliver], f, lost, receiver);
    }
  }

  static Vector wet_face_area(const CutCell& cell, int face) {
    Vector sum{};
    for (const SideSimplex& w : cell.wet)
      if (w.face == face) sum = sum + w.area * w.normal;
    return sum;
  }

  const Outline& outline_;
  std::vector<CutCell>& cells_;
  std::vector<CellState>& state_;
  std::unordered_map<int, std::size_t> index_;
};

}  // namespace

Vector vector_area(int dimension, const Vector& a, const Vector& b, const Vector& c) {
  return dimension == 2 ? Vector{b[1] - a[1], a[0] - b[0], 0} : 0.5 * cross(b - a, c - a);
}

Vector vector_area(int dimension, const CutCell& cell, const FacetPiece& piece) {
  const Vector* x = &cell.points[piece.first];
  Vector sum{};
  for (int k = 1; k + (dimension == 3 ? 1 : 0) < piece.count; ++k)
    sum = sum - vector_area(dimension, x[0], x[k], x[dimension == 3 ? k + 1 : k]);
  return piece.scale * sum;
}

void append_wet(int face, const Vector& normal, const std::vector<Vector>& polygon,
                std::vector<SideSimplex>& wet) {
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const double area = dot(vector_area(3, polygon[0], polygon[k], polygon[k + 1]), normal);
    if (area != 0) wet.push_back({face, normal, {polygon[0], polygon[k], polygon[k + 1]}, 1.0, area});
  }
}

void measure(const Outline& outline, CutCell& cell) {
  const int dim = outline.dimension;
  const Vector centre = outline.centre(cell.cell);
  cell.volume = outline.volume(cell.cell);
  cell.wet_volume = 0;
  cell.interface_area = 0;
  visit_boundary(dim, cell, [&](const std::array<Vector, 3>& x, double sign) {
    cell.wet_volume += sign / dim * dot(x[0] - centre, vector_area(dim, x[0], x[1], x[2]));
  });
  for (const FacetPiece& p : cell.pieces) cell.interface_area += length(vector_area(dim, cell, p));
}

void settle_slivers(const Outline& outline, std::vector<CutCell>& cells, std::vector<CellState>& state) {
  Settlement(outline, cells, state).settle();
}

void drop_cells(const Outline& outline, const std::vector<char>& dropped, std::vector<CutCell>& cells,
                std::vector<CellState>& state) {
  Settlement(outline, cells, state).drop(dropped);
}

CutCell whole_cell(const Outline& outline, int cell) {
  CutCell whole;
  whole.cell = cell;
  whole.united = true;
  for (int s = outline.first_side[cell]; s < outline.first_side[cell + 1]; ++s) {
    const Side& side = outline.sides[s];
    SideSimplex part{side.face, side_normal(outline, side), {}, 1.0, 0.0};
    for (int k = 0; k < 3; ++k)
      part.corner[k] = outline.position[side.vertex[std::min(k, outline.dimension - 1)]];
    part.area = length(vector_area(outline.dimension, part.corner[0], part.corner[1], part.corner[2]));
    whole.wet.push_back(part);
  }
  measure(outline, whole);
  return whole;
}

}  // namespace seam::cutting
