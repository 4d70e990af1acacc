// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/passage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/cut/facet_vertices.hpp"
#include "seam/field/field.hpp"
#include "seam/state/state_store.hpp"

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

Vector point_of(const Surface& surface, int facet, const std::array<double, 2>& on_facet) {
  return point_on_facet(surface.dimension, facet_vertices(surface, facet), on_facet.data());
}

Vector unit_normal(int dim, const std::array<Vector, 3>& corner) {
  const Vector n = facet_normal(dim, corner);
  return 1 / std::sqrt(dot(n, n)) * n;
}

/// Whether the foot of a point on a facet's plane lies on the facet.
bool is_over(int dim, const std::array<Vector, 3>& corner, const Vector& x) {
  constexpr double slack = 1e-9;
  const Vector first = corner[1] - corner[0], way = x - corner[0];
  if (dim == 2) {
    const double share = dot(way, first) / dot(first, first);
    return share > -slack && share < 1 + slack;
  }
  const Vector second = corner[2] - corner[0], area = cross(first, second);
  const double b = dot(cross(way, second), area) / dot(area, area),
               c = dot(cross(first, way), area) / dot(area, area);
  return b > -slack && c > -slack && b + c < 1 + slack;
}

/// A point and the surface that it must not pass, on straight ways through a step: time 0 to 1.
struct Ways {
  const Surface &from, &to;
  Vector start, end;

  [[nodiscard]] Vector at(double time) const { return start + time * (end - start); }
  [[nodiscard]] std::array<Vector, 3> facet(int number, double time) const {
    const std::array<Vector, 3> a = facet_vertices(from, number), b = facet_vertices(to, number);
    std::array<Vector, 3> result{};
    for (int k = 0; k < 3; ++k) result[k] = a[k] + time * (b[k] - a[k]);
    return result;
  }
  /// How far the point is in front of a facet's plane, m.
  [[nodiscard]] double height(int number, double time) const {
    const std::array<Vector, 3> corner = facet(number, time);
    return dot(at(time) - corner[0], unit_normal(from.dimension, corner));
  }
  [[nodiscard]] Surface surface(double time) const {
    Surface result = from;
    for (std::size_t k = 0; k < result.points.size(); ++k)
      result.points[k] += time * (to.points[k] - from.points[k]);
    return result;
  }
  struct Crossing {
    double time = 2;  ///< above 1: there is none
    Vector normal{};
  };
  /// The first crossing of a facet after a time: from its front to its back, or the other way.
  [[nodiscard]] Crossing first_crossing(double after, bool inwards) const {
    Crossing first;
    for (int f = 0; f < from.facet_count(); ++f) {
      double low = after, high = 1;
      // What lies on a facet is still in front of it before it goes in, and no longer behind it before it
      // comes out.
      const auto in_front = [&](double time) {
        const double h = height(f, time);
        return inwards ? h >= 0 : h > 0;
      };
      if (in_front(low) != inwards || in_front(high) == inwards) continue;
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (in_front(middle) == inwards ? low : high) = middle;
      }
      const std::array<Vector, 3> corner = facet(f, high);
      if (high < first.time && is_over(from.dimension, corner, at(high)))
        first = {high, unit_normal(from.dimension, corner)};
    }
    return first;
  }
};

/// Points of a facet that are looked at: its middle, and its vertices a little inside of it.
const std::vector<std::array<double, 2>>& places(int dimension) {
  static const std::vector<std::array<double, 2>> of_segment{{0.5, 0}, {0.01, 0}, {0.99, 0}};
  static const std::vector<std::array<double, 2>> of_triangle{
      {1.0 / 3, 1.0 / 3}, {0.01, 0.01}, {0.98, 0.01}, {0.01, 0.98}};
  return dimension == 2 ? of_segment : of_triangle;
}

/// Of a state of these two: interfaces may look at them several times.
std::string free_name(const BodySurface& own, const BodySurface* other) {
  const std::string name =
      fmt::format("{}/passage/{}", own.body().name(), other != nullptr ? other->body().name() : "obstacle");
  std::string free = name;
  const std::vector<AnyState*> states = own.body().state().states();
  for (int number = 2; std::ranges::any_of(states, [&](const AnyState* s) { return s->name() == free; });
       ++number)
    free = fmt::format("{} {}", name, number);
  return free;
}

}  // namespace

Passage::Passage(std::shared_ptr<const BodySurface> own, std::shared_ptr<const BodySurface> other,
                 ContactWindow window)
    : own_(std::move(own)),
      other_(std::move(other)),
      window_(window),
      overlap_(own_->body().state().add<double>(
          {free_name(*own_, other_.get()), the_run(own_->body().mesh().communicator())})) {}

void Passage::begin_step(Surface opposite) {
  own_start_ = own_->now();
  opposite_start_ = std::move(opposite);
  deepest_ = overlap_.now()[0];
  has_begun_ = true;
}

/// Surfaces that overlap by less than half the depth get out of each other's sight only on a way of the other
/// half.
bool Passage::is_needed(double way, double least_gap) {
  double& overlap = overlap_.now()[0];
  overlap = std::max(0.0, -least_gap);
  deepest_ = std::max(deepest_, overlap);
  return has_begun_ && (deepest_ > 0.5 * window_.depth || way > 0.25 * window_.depth);
}

/// Of a point that has a facet far behind it now. It has passed if it got in and did not get out again, or
/// was far inside in between, or got out on the other side; not where it slid off an edge.
/// @param overlaps it was inside when the step began
bool Passage::has_passed(const Vector& start, const Vector& end, const Vector& normal, bool overlaps,
                         const Surface& now) const {
  const Ways ways{opposite_start_, now, start, end};
  Ways::Crossing in{0, -1.0 * normal};
  if (!overlaps) in = ways.first_crossing(0, true);
  if (in.time > 1) return false;
  const Ways::Crossing out = ways.first_crossing(in.time, false);
  if (out.time > 1) return true;
  const double middle = 0.5 * (in.time + out.time);
  constexpr double opposite_sides = -0.5, thin = 0.05;
  const double margin = dot(in.normal, out.normal) < opposite_sides ? thin * window_.depth : window_.depth;
  return FacetSearch(ways.surface(middle)).encloses(ways.at(middle).data(), normal.data(), margin);
}

void Passage::check(const OppositePoints& opposite, double least_gap) {
  const Surface &own = opposite.own_surface(), &now = opposite.opposite_surface();
  if (now.facets != opposite_start_.facets) return;  // as a level set's, whose facets have no history
  const double way = longest_way(own_start_, own) + longest_way(opposite_start_, now);
  if (!is_needed(way, least_gap)) return;
  std::optional<FacetSearch> at_start;
  for (int facet = 0; facet < own.facet_count(); ++facet)
    for (const auto& place : places(own.dimension)) {
      const auto behind = opposite.facing(facet, place.data(), way + window_.depth, window_.reach);
      if (!behind || behind->gap >= -window_.depth) continue;
      const Vector start = point_of(own_start_, facet, place), end = point_of(own, facet, place),
                   start_normal = unit_normal(own.dimension, facet_vertices(own_start_, facet));
      if (Ways{opposite_start_, now, start, end}.height(behind->facet, 0) < -window_.depth) continue;
      if (!at_start) at_start.emplace(opposite_start_);
      const bool overlaps =
          at_start->encloses(start.data(), start_normal.data(), 0, opposite.neighbours(facet));
      if (!has_passed(start, end, opposite.normal(facet), overlaps, now)) continue;
      throw StepRefused(fmt::format(
          "the surface of '{}' has passed through {}: at ({:.6g}) it is {:.3g} m behind what it faced, more "
          "than the interface's `depth` of {:.3g} m; where bodies overlap so far bit by bit, as `gap` tells, "
          "a "
          "greater `surface_stiffness` of rigid ones, or `penalty` of others, keeps them apart",
          own_->body().name(),
          other_ ? fmt::format("that of '{}'", other_->body().name()) : std::string("an obstacle"),
          fmt::join(end.begin(), end.begin() + own.dimension, ", "), -behind->gap, window_.depth));
    }
}

}  // namespace seam
