// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/piece_motion.hpp"

#include <algorithm>
#include <cmath>

namespace seam::cutting {
namespace {

/// Of the facet's or the cell's size. Decides only on how a corner moves, never on where it is: a corner that
/// is close to two borders stays close to both.
constexpr double close = 1e-9;
/// Sine of the smallest angle between facet and border along which a corner slides. At smaller ones it would
/// pass the whole cell with hardly any motion, and the derivative would hold nowhere.
constexpr double grazing = 1e-3;

/// Whether a point in the plane of a triangular side lies in that triangle.
bool contains(const Outline& outline, const Side& side, const Vector& normal, const Vector& x) {
  for (int k = 0; k < 3; ++k) {
    const Vector &a = outline.position[side.vertex[k]], &b = outline.position[side.vertex[(k + 1) % 3]];
    if (dot(cross(b - a, x - a), normal) < -close * dot(b - a, b - a)) return false;
  }
  return true;
}

}  // namespace

PieceMotion::PieceMotion(const Outline& outline, const CutCell& cell, const FacetPiece& piece,
                         const Surface& surface)
    : dim_(surface.dimension), outline_(&outline), cell_(cell.cell), normal_(piece.normal) {
  find_frame(surface, piece.facet);
  corner_.assign(&cell.points[piece.first], &cell.points[piece.first] + piece.count);
  slide_.resize(corner_.size());
  // What stems from a neighbour is bounded by that one's borders, and too small to matter.
  if (!piece.handed_over) find_slides(corner_.data());
}

void PieceMotion::find_frame(const Surface& surface, int facet) {
  for (int k = 0; k < dim_; ++k)
    for (int i = 0; i < dim_; ++i)
      vertex_[k][i] = surface.points[static_cast<std::size_t>(surface.facets[facet * dim_ + k]) * dim_ + i];
  const Vector a = vertex_[1] - vertex_[0];
  if (dim_ == 2) {
    gradient_[1] = 1 / dot(a, a) * a;
    gradient_[0] = -1.0 * gradient_[1];
    size_ = std::sqrt(dot(a, a));
    return;
  }
  const Vector b = vertex_[2] - vertex_[0], area = cross(a, b);
  const double square = dot(area, area);
  gradient_[1] = 1 / square * cross(b, area);
  gradient_[2] = 1 / square * cross(area, a);
  gradient_[0] = -1.0 * (gradient_[1] + gradient_[2]);
  size_ = std::sqrt(std::max(dot(a, a), dot(b, b)));
}

std::array<double, 3> PieceMotion::barycentric(const Vector& x) const {
  const Vector r = x - vertex_[0];
  const double first = dot(gradient_[1], r), second = dim_ == 3 ? dot(gradient_[2], r) : 0.0;
  return {1 - first - second, first, second};
}

/// What holds the border between corners a and b; in the plane a = b.
PieceMotion::Constraint PieceMotion::constraint(const Vector& a, const Vector& b) const {
  const auto share_a = barycentric(a), share_b = barycentric(b);
  for (int k = 0; k < dim_; ++k)
    if (std::abs(share_a[k]) < close && std::abs(share_b[k]) < close) return {gradient_[k], -1};
  for (int s = outline_->first_side[cell_]; s < outline_->first_side[cell_ + 1]; ++s) {
    const Side& side = outline_->sides[s];
    const Vector normal = side_normal(*outline_, side), &x = outline_->position[side.vertex[0]];
    const double reach = close * size_;
    if (std::abs(dot(normal, a - x)) < reach && std::abs(dot(normal, b - x)) < reach &&
        (dim_ == 2 || contains(*outline_, side, normal, 0.5 * (a + b))))
      return {normal, s};
  }
  // Another body's border: taken as if it went along.
  return {cross(b - a, normal_), -1};
}

void PieceMotion::find_slides(const Vector* corner) {
  const auto count = static_cast<int>(corner_.size());
  for (int k = 0; k < count; ++k) {
    const Vector &before = corner[(k + count - 1) % count], &after = corner[(k + 1) % count];
    slide_[k] = dim_ == 2 ? slide(constraint(corner[k], corner[k]), {})
                          : slide(constraint(before, corner[k]), constraint(corner[k], after));
  }
}

/// Solves, for motions along the facet, n . (facet's motion + slide) = 0 on borders at rest and n . slide = 0
/// on those of the facet.
PieceMotion::Matrix PieceMotion::slide(const Constraint& before, const Constraint& after) const {
  Matrix result{};
  const auto along = [&](const Constraint& c) { return c.normal - dot(c.normal, normal_) * normal_; };
  const auto add = [&](const Constraint& c, const Vector& direction) {
    if (!c.at_rest()) return;
    for (int i = 0; i < dim_; ++i) result[i] = result[i] - direction[i] * c.normal;
  };
  const Vector p = along(before);
  const double pp = dot(p, p);
  if (dim_ == 2) {
    if (pp > grazing * grazing) add(before, 1 / pp * p);
    return result;
  }
  const Vector q = along(after);
  const double qq = dot(q, q), area = dot(cross(p, q), normal_);
  const auto grazes = [&](const Constraint& c, double square) {
    return c.at_rest() && square < grazing * grazing;
  };
  if (pp == 0 || qq == 0 || grazes(before, pp) || grazes(after, qq)) return result;
  if (std::abs(area) < grazing * std::sqrt(pp * qq)) {
    if (before.at_rest() && after.at_rest()) return slide_along_edge(before.side, after.side);
    // Both borders run alike: the one at rest decides.
    add(before.at_rest() ? before : after, before.at_rest() ? 1 / pp * p : 1 / qq * q);
    return result;
  }
  add(before, 1 / area * cross(q, normal_));
  add(after, 1 / area * cross(normal_, p));
  return result;
}

/// Of a corner between two sides in one plane, the halves of a quadrilateral: it stays on their common edge.
PieceMotion::Matrix PieceMotion::slide_along_edge(int first, int second) const {
  Matrix result{};
  const auto &a = outline_->sides[first].edge, &b = outline_->sides[second].edge;
  const auto* common = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
  if (first == second || common == a.end()) return result;
  const auto& ends = outline_->edges[*common];
  const Vector t = outline_->position[ends[1]] - outline_->position[ends[0]];
  const double across = dot(t, normal_);
  if (std::abs(across) < grazing * std::sqrt(dot(t, t))) return result;
  for (int i = 0; i < dim_; ++i) {
    result[i] = t[i] / across * normal_;
    result[i][i] -= 1;
  }
  return result;
}

void PieceMotion::append(const std::array<int, 3>& corners, const std::array<double, 3>& share,
                         InterfaceMotion& motion) const {
  const int moves = dim_ * dim_;
  const auto block = [&](std::vector<double>& values, int rows) {
    values.resize(values.size() + static_cast<std::size_t>(rows) * moves, 0.0);
    return values.data() + values.size() - static_cast<std::size_t>(rows) * moves;
  };
  double* position = block(motion.position, dim_);
  double* normal = block(motion.normal, dim_);
  double* weight = block(motion.relative_weight, 1);
  double* facet = block(motion.facet_reference, dim_ - 1);
  // Gradients of the corners' shares in the points of the simplex: the divergence of its motion is the growth
  // of its area.
  const Vector &x0 = corner_[corners[0]], a = corner_[corners[1]] - x0, b = corner_[corners[2]] - x0;
  std::array<Vector, 3> growth{};
  if (dim_ == 2) {
    growth[1] = 1 / dot(a, a) * a;
    growth[0] = -1.0 * growth[1];
  } else {
    const Vector area = cross(a, b);
    growth[1] = 1 / dot(area, area) * cross(b, area);
    growth[2] = 1 / dot(area, area) * cross(area, a);
    growth[0] = -1.0 * (growth[1] + growth[2]);
  }
  for (int j = 0; j < dim_; ++j) {
    const auto at_corner = barycentric(corner_[corners[j]]);
    const Matrix& slide = slide_[corners[j]];
    for (int k = 0; k < dim_; ++k)
      for (int c = 0; c < dim_; ++c) {
        const int move = k * dim_ + c;
        const Vector slid{at_corner[k] * slide[0][c], at_corner[k] * slide[1][c], at_corner[k] * slide[2][c]};
        Vector moved = slid;
        moved[c] += at_corner[k];
        for (int i = 0; i < dim_; ++i) position[i * moves + move] += share[j] * moved[i];
        weight[move] += dot(growth[j], moved);
        for (int i = 0; i + 1 < dim_; ++i) facet[i * moves + move] += share[j] * dot(gradient_[i + 1], slid);
      }
  }
  for (int k = 0; k < dim_; ++k)
    for (int c = 0; c < dim_; ++c)
      for (int i = 0; i < dim_; ++i) normal[i * moves + k * dim_ + c] = -gradient_[k][i] * normal_[c];
}

void PieceMotion::append_share(double share, std::vector<double>& values) const {
  std::array<double, 4> sum{};
  for (int j = 0; j < 2; ++j) {
    const auto at_corner = barycentric(corner_[j]);
    for (int k = 0; k < 2; ++k)
      for (int c = 0; c < 2; ++c)
        sum[k * 2 + c] += (j == 0 ? 1 - share : share) * at_corner[k] *
                          (gradient_[1][0] * slide_[j][0][c] + gradient_[1][1] * slide_[j][1][c]);
  }
  values.insert(values.end(), sum.begin(), sum.end());
}

}  // namespace seam::cutting
