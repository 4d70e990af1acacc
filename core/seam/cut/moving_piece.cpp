// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/moving_piece.hpp"

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

template <int dim>
Vec<dim, double> vec(const Vector& x) {
  Vec<dim, double> result;
  std::copy_n(x.begin(), dim, result.c.begin());
  return result;
}

/// Whether a point in the plane of a triangular side lies in that triangle.
bool contains(const Outline& outline, const Side& side, const Vec<3, double>& normal,
              const Vec<3, double>& x) {
  for (int k = 0; k < 3; ++k) {
    const auto a = vec<3>(outline.position[side.vertex[k]]),
               b = vec<3>(outline.position[side.vertex[(k + 1) % 3]]);
    if (seam::dot(seam::cross(b - a, x - a), normal) < -close * seam::dot(b - a, b - a)) return false;
  }
  return true;
}

/// Beside the facet there is no body: what it knows there would be extrapolated.
template <int dim>
void keep_on_facet(Vec<dim - 1, double>& share) {
  double sum = 0;
  for (double& s : share.c) sum += s = std::max(s, 0.0);
  if (sum > 1) share = (1 / sum) * share;
}

}  // namespace

template <int dim>
MovingPiece<dim>::MovingPiece(const Outline& outline, const CutCell& cell, const FacetPiece& piece,
                              const Surface& surface)
    : outline_(&outline), cell_(cell.cell), normal_(vec<dim>(piece.normal)) {
  find_frame(surface, piece.facet);
  for (int k = 0; k < piece.count; ++k) {
    Corner& corner = corner_.emplace_back();
    corner.position = vec<dim>(cell.points[piece.first + k]);
    auto share = shares_of<dim>(vertex_, corner.position);
    if (piece.handed_over) keep_on_facet<dim>(share);
    for (int i = 0; i + 1 < dim; ++i) corner.on_facet[i] = share[i];
  }
  // What stems from a neighbour is bounded by that one's borders, and too small to matter.
  if (!piece.handed_over) find_slides();
  for (const Corner& corner : corner_) {
    position_.push_back(point_on<dim>(facet_, corner.on_facet));
    // Shares lose digits that the area of a needle needs.
    for (int i = 0; i < dim; ++i) position_.back()[i].v = corner.position[i];
  }
}

template <int dim>
void MovingPiece<dim>::find_frame(const Surface& surface, int facet) {
  std::array<Vector, 3> vertices{};
  for (int k = 0; k < dim; ++k)
    std::copy_n(&surface.points[static_cast<std::size_t>(surface.facets[facet * dim + k]) * dim], dim,
                vertices[k].begin());
  for (int k = 0; k < dim; ++k) vertex_[k] = vec<dim>(vertices[k]);
  facet_ = moving_facet<dim, 1>(vertices);
  const Vec<dim, Number> area = area_vector<dim>(facet_);
  into_body_ = (-1.0 / sqrt(seam::dot(area, area))) * area;
  Corners<dim, double> shape;  // about vertex 0, so that nothing is lost far from the origin
  for (int k = 1; k < dim; ++k) {
    shape[k] = vertex_[k] - vertex_[0];
    size_ = std::max(size_, std::sqrt(seam::dot(shape[k], shape[k])));
  }
  for (int i = 0; i < dim; ++i) {
    Plain step{};
    step[i] = 1;
    const auto share = shares_of<dim>(shape, step);
    for (int k = 1; k < dim; ++k) {
      gradient_[k][i] = share[k - 1];
      gradient_[0][i] -= share[k - 1];
    }
  }
}

/// What holds the border between corners a and b; in the plane a = b.
template <int dim>
typename MovingPiece<dim>::Border MovingPiece<dim>::border(const Plain& a, const Plain& b) const {
  for (int k = 0; k < dim; ++k) {
    // Away from the vertex opposite; from vertex 0 the other ones are.
    const Plain& on = vertex_[k == 0 ? 1 : 0];
    if (std::abs(seam::dot(gradient_[k], a - on)) < close &&
        std::abs(seam::dot(gradient_[k], b - on)) < close)
      return {gradient_[k], -1};
  }
  for (int s = outline_->first_side[cell_]; s < outline_->first_side[cell_ + 1]; ++s) {
    const Side& side = outline_->sides[s];
    const Plain normal = vec<dim>(side_normal(*outline_, side)),
                x = vec<dim>(outline_->position[side.vertex[0]]);
    const double reach = close * size_;
    if (std::abs(seam::dot(normal, a - x)) >= reach || std::abs(seam::dot(normal, b - x)) >= reach) continue;
    if constexpr (dim == 3)
      if (!contains(*outline_, side, normal, 0.5 * (a + b))) continue;
    return {normal, s};
  }
  // Another body's border: taken as if it went along.
  if constexpr (dim == 3) return {seam::cross(b - a, normal_), -1};
  return {};
}

template <int dim>
void MovingPiece<dim>::find_slides() {
  const auto count = static_cast<int>(corner_.size());
  for (int k = 0; k < count; ++k) {
    const Plain &here = corner_[k].position, &before = corner_[(k + count - 1) % count].position,
                &after = corner_[(k + 1) % count].position;
    if constexpr (dim == 2)
      slide(border(here, here), {}, corner_[k]);
    else
      slide(border(before, here), border(here, after), corner_[k]);
  }
}

template <int dim>
typename MovingPiece<dim>::Plain MovingPiece<dim>::along_facet(const Plain& vector) const {
  return vector - seam::dot(vector, normal_) * normal_;
}

/// A step of Newton's method in numbers that carry derivatives: the corner, which is on the border, stays on
/// it when the facet takes it along. @param direction in which it slides, along the facet; 1 along the
/// border's normal
template <int dim>
void MovingPiece<dim>::keep_on(const Border& border, const Plain& direction, Corner& corner) const {
  if (!border.at_rest()) return;
  Vec<dim - 1, double> share;
  for (int k = 0; k + 1 < dim; ++k) share[k] = corner.on_facet[k].v;
  const Vec<dim, Number> taken = point_on<dim>(facet_, share);
  Number off = seam::dot(taken, border.normal);
  off.v = 0;
  for (int k = 0; k + 1 < dim; ++k) corner.on_facet[k] -= seam::dot(gradient_[k + 1], direction) * off;
}

template <int dim>
void MovingPiece<dim>::slide(const Border& before, const Border& after, Corner& corner) const {
  const Plain p = along_facet(before.normal);
  const double pp = seam::dot(p, p);
  if constexpr (dim == 2) {
    if (pp > grazing * grazing) keep_on(before, 1 / pp * p, corner);
  } else {
    const Plain q = along_facet(after.normal);
    const double qq = seam::dot(q, q), area = seam::dot(seam::cross(p, q), normal_);
    const auto grazes = [&](const Border& b, double square) {
      return b.at_rest() && square < grazing * grazing;
    };
    if (pp == 0 || qq == 0 || grazes(before, pp) || grazes(after, qq)) return;
    if (std::abs(area) >= grazing * std::sqrt(pp * qq)) {
      keep_on(before, 1 / area * seam::cross(q, normal_), corner);
      keep_on(after, 1 / area * seam::cross(normal_, p), corner);
    } else if (before.at_rest() && after.at_rest()) {
      slide_along_edge(before.side, after.side, corner);
    } else if (before.at_rest()) {  // both borders run alike: the one at rest decides
      keep_on(before, 1 / pp * p, corner);
    } else {
      keep_on(after, 1 / qq * q, corner);
    }
  }
}

/// Of a corner between two sides in one plane, the halves of a quadrilateral: it stays on their common edge.
template <int dim>
void MovingPiece<dim>::slide_along_edge(int first, int second, Corner& corner) const {
  const auto &a = outline_->sides[first].edge, &b = outline_->sides[second].edge;
  const auto* common = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
  if (first == second || common == a.end()) return;
  const auto& ends = outline_->edges[*common];
  const auto start = vec<dim>(outline_->position[ends[0]]);
  const Plain edge = vec<dim>(outline_->position[ends[1]]) - start;
  if (std::abs(seam::dot(edge, normal_)) < grazing * std::sqrt(seam::dot(edge, edge))) return;
  const Vec<dim, Number> meeting = start + way_to<dim>(facet_, start, edge) * edge;
  corner.on_facet = shares_of<dim>(facet_, meeting);
}

template <int dim>
MovingPoint<dim, 1> MovingPiece<dim>::point(const std::array<int, dim>& corners,
                                            const std::array<double, dim>& share) const {
  MovingPoint<dim, 1> result;
  Corners<dim, Number> simplex;
  for (int j = 0; j < dim; ++j) {
    simplex[j] = position_[corners[j]];
    result.position += share[j] * simplex[j];
    result.on_facet += share[j] * corner_[corners[j]].on_facet;
  }
  const Vec<dim, Number> area = area_vector<dim>(simplex);
  const Number size = seam::dot(area, normal_);
  // The area that the rule gave a needle may be all rounding.
  result.relative_weight = size.v != 0 ? size / size.v : Number(1.0);
  result.normal = into_body_;
  return result;
}

template <int dim>
typename MovingPiece<dim>::Number MovingPiece<dim>::on_facet(double share) const {
  return (1 - share) * corner_[0].on_facet[0] + share * corner_[1].on_facet[0];
}

template class MovingPiece<2>;
template class MovingPiece<3>;

}  // namespace seam::cutting
