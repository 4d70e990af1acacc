// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/slivers.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace seam::cutting {
namespace {

double length(const Vector& a) { return std::sqrt(dot(a, a)); }

CutCell whole_cell(const Outline& outline, int cell) {
  CutCell whole;
  whole.cell = cell;
  for (int s = outline.first_side[cell]; s < outline.first_side[cell + 1]; ++s) {
    const Side& side = outline.sides[s];
    WetPart part{side.face, {}};
    for (int k = 0; k < 3; ++k)
      part.corner[k] = outline.position[side.vertex[std::min(k, outline.dimension - 1)]];
    whole.wet.push_back(part);
  }
  measure(outline, whole);
  return whole;
}

int face_towards(const Outline& outline, int cell, int other) {
  for (int f = 0; f < 8; ++f)
    if (outline.neighbour[cell][f] == other) return f;
  return -1;
}

/// For a face that no piece of the sliver is opposite to: the face itself closes the receiver.
void lay_face(int dimension, const CutCell& sliver, int face, const Vector& normal, CutCell& receiver) {
  for (const WetPart& w : sliver.wet) {
    if (w.face != face) continue;
    receiver.pieces.push_back({sliver.pieces[0].body, sliver.pieces[0].facet,
                               static_cast<int>(receiver.points.size()), dimension, normal, 1.0, true});
    // Seen from the receiver the face runs the other way, and so does a piece compared with a side.
    receiver.points.insert(receiver.points.end(), w.corner.begin(), w.corner.begin() + dimension);
  }
}

/// Lays the pieces of a sliver onto one of its fluid faces.
/// @param outward vector area of that face out of the receiving cell: along the receiver's normal
void hand_over(int dimension, const CutCell& sliver, int face, const Vector& outward, CutCell& receiver) {
  const double area = length(outward);
  const Vector normal = 1 / area * outward;
  Vector anchor{};
  for (const WetPart& w : sliver.wet)
    if (w.face == face) anchor = w.corner[0];
  double sum = 0;
  std::vector<double> share;
  for (const Piece& p : sliver.pieces)
    sum += share.emplace_back(std::max(0.0, dot(vector_area(dimension, sliver, p), normal)));
  double laid = 0;
  for (std::size_t k = 0; k < share.size(); ++k) {
    Piece piece = sliver.pieces[k];
    piece.handed_over = true;
    piece.normal = normal;
    const int first = piece.first;
    piece.first = static_cast<int>(receiver.points.size());
    for (int i = 0; i < piece.count; ++i) {
      const Vector& x = sliver.points[first + i];
      receiver.points.push_back(x - dot(x - anchor, normal) * normal);
    }
    const double own = length(vector_area(dimension, receiver, piece));
    if (share[k] == 0 || own == 0) continue;
    piece.scale = area * share[k] / sum / own;
    laid += area * share[k] / sum;
    receiver.pieces.push_back(piece);
  }
  if (laid == 0) lay_face(dimension, sliver, face, normal, receiver);
}

class Settlement {
 public:
  Settlement(const Outline& outline, std::vector<CutCell>& cells, std::vector<CellState>& state)
      : outline_(outline), cells_(cells), state_(state) {
    for (std::size_t k = 0; k < cells.size(); ++k) index_[cells[k].cell] = k;
  }

  void run() {
    const std::size_t original = cells_.size();
    for (std::size_t k = 0; k < original; ++k) state_[cells_[k].cell] = decide(cells_[k]);
    for (std::size_t k = 0; k < original; ++k)
      if (state_[cells_[k].cell] == CellState::body) clear(k);
    std::erase_if(cells_, [&](const CutCell& c) { return state_[c.cell] != CellState::cut; });
    std::sort(cells_.begin(), cells_.end(),
              [](const CutCell& a, const CutCell& b) { return a.cell < b.cell; });
    for (CutCell& c : cells_)
      if (std::any_of(c.pieces.begin(), c.pieces.end(), [](const Piece& p) { return p.handed_over; }))
        measure(outline_, c);
  }

 private:
  [[nodiscard]] CellState decide(const CutCell& c) const {
    if (c.fluid_volume < smallest_part * c.volume) return CellState::body;
    const double size = std::pow(c.volume, (outline_.dimension - 1.0) / outline_.dimension);
    return c.interface_area < smallest_part * size ? CellState::fluid : CellState::cut;
  }

  void clear(std::size_t sliver) {
    const int cell = cells_[sliver].cell;
    for (int f = 0; f < 8; ++f) {
      const int other = outline_.neighbour[cell][f];
      if (other < 0 || state_[other] == CellState::body) continue;
      Vector out{};
      for (const WetPart& w : cells_[sliver].wet)
        if (w.face == f)
          out = out + w.sign * vector_area(outline_.dimension, w.corner[0], w.corner[1], w.corner[2]);
      if (length(out) == 0) continue;
      if (!index_.contains(other)) {
        index_[other] = cells_.size();
        cells_.push_back(whole_cell(outline_, other));
      }
      state_[other] = CellState::cut;
      CutCell& receiver = cells_[index_[other]];
      receiver.dry_faces |= 1U << face_towards(outline_, other, cell);
      hand_over(outline_.dimension, cells_[sliver], f, -1 * out, receiver);
    }
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

Vector vector_area(int dimension, const CutCell& cell, const Piece& piece) {
  const Vector* x = &cell.points[piece.first];
  Vector sum{};
  for (int k = 1; k + (dimension == 3 ? 1 : 0) < piece.count; ++k)
    sum = sum - vector_area(dimension, x[0], x[k], x[dimension == 3 ? k + 1 : k]);
  return piece.scale * sum;
}

void measure(const Outline& outline, CutCell& cell) {
  const int dim = outline.dimension;
  const Vector centre = outline.centre(cell.cell);
  cell.volume = outline.volume(cell.cell);
  cell.fluid_volume = 0;
  cell.interface_area = 0;
  visit_boundary(dim, cell, [&](const std::array<Vector, 3>& x, double sign) {
    cell.fluid_volume += sign / dim * dot(x[0] - centre, vector_area(dim, x[0], x[1], x[2]));
  });
  for (const Piece& p : cell.pieces) cell.interface_area += length(vector_area(dim, cell, p));
}

void settle_slivers(const Outline& outline, std::vector<CutCell>& cells, std::vector<CellState>& state) {
  Settlement(outline, cells, state).run();
}

}  // namespace seam::cutting
