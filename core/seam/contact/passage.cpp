// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/passage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seam {

using namespace cutting;

namespace {

/// The longest way of a point from one state of a surface to another, m; infinite when it has other points.
double longest_way(const Surface& from, const Surface& to) {
  if (from.points.size() != to.points.size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t k = 0; k < from.points.size(); k += from.dimension) {
    double square = 0;
    for (int d = 0; d < from.dimension; ++d) square += std::pow(to.points[k + d] - from.points[k + d], 2);
    most = std::max(most, square);
  }
  return std::sqrt(most);
}

Vector point_of(const Surface& surface, int facet, const double* on_facet) {
  const int dim = surface.dimension;
  Vector x{};
  double first = 1;
  for (int k = 1; k < dim; ++k) first -= on_facet[k - 1];
  for (int k = 0; k < dim; ++k) {
    const int p = surface.facets[static_cast<std::size_t>(facet) * dim + k];
    for (int d = 0; d < dim; ++d)
      x[d] += (k == 0 ? first : on_facet[k - 1]) * surface.points[static_cast<std::size_t>(p) * dim + d];
  }
  return x;
}

/// How far a point lies in front of the plane of a facet, m; negative behind it.
double height(const Surface& surface, int facet, const Vector& x) {
  const int dim = surface.dimension;
  std::array<Vector, 3> corner{};
  for (int k = 0; k < dim; ++k) {
    const double unit[3] = {k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, 0};
    corner[k] = point_of(surface, facet, unit);
  }
  const Vector n = facet_normal(dim, corner);
  return dot(x - corner[0], n) / std::sqrt(dot(n, n));
}

/// Points of a facet that are looked at: its middle, and its vertices a little inside of it.
const std::vector<std::array<double, 2>>& places(int dimension) {
  static const std::vector<std::array<double, 2>> of_segment{{0.5, 0}, {0.01, 0}, {0.99, 0}};
  static const std::vector<std::array<double, 2>> of_triangle{
      {1.0 / 3, 1.0 / 3}, {0.01, 0.01}, {0.98, 0.01}, {0.01, 0.98}};
  return dimension == 2 ? of_segment : of_triangle;
}

}  // namespace

Passage::Passage(std::shared_ptr<const BodySurface> own, std::shared_ptr<const BodySurface> other,
                 ContactWindow window)
    : own_(std::move(own)), other_(std::move(other)), window_(window) {}

void Passage::begin_step(Surface opposite) {
  own_start_ = own_->now();
  opposite_start_ = std::move(opposite);
  has_begun_ = true;
}

/// Surfaces that overlap by less than half the depth get out of each other's sight only on a way of the other
/// half.
bool Passage::is_needed(double way, double least_gap) {
  is_deep_ = is_deep_ || least_gap < -0.5 * window_.depth;
  return has_begun_ && (is_deep_ || way > 0.25 * window_.depth);
}

void Passage::check(const OppositePoints& opposite, double least_gap) {
  const Surface &own = opposite.own_surface(), &now = opposite.opposite_surface();
  if (now.facets != opposite_start_.facets) return;  // as a level set's, whose facets have no history
  const double way = longest_way(own_start_, own) + longest_way(opposite_start_, now);
  if (!is_needed(way, least_gap)) return;
  for (int facet = 0; facet < own.facet_count(); ++facet)
    for (const auto& place : places(own.dimension)) {
      const auto behind = opposite.facing(facet, place.data(), way + window_.depth, window_.reach);
      if (!behind || behind->gap >= -window_.depth) continue;
      if (height(opposite_start_, behind->facet, point_of(own_start_, facet, place.data())) < -window_.depth)
        continue;
      const Vector x = point_of(own, facet, place.data());
      throw StepRefused(fmt::format(
          "the surface of '{}' has passed through {}: at ({:.6g}) it is {:.3g} m behind what it faced, more "
          "than the interface's depth of {:.3g} m",
          own_->body().name(),
          other_ ? fmt::format("that of '{}'", other_->body().name()) : std::string("an obstacle"),
          fmt::join(x.begin(), x.begin() + own.dimension, ", "), -behind->gap, window_.depth));
    }
}

}  // namespace seam
