// SPDX-License-Identifier: BSD-3-Clause
#include "cut_stress/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace seam;

namespace {

using Interval = std::array<double, 2>;

Surface block(int dim, const std::array<Interval, 3>& x) {
  if (dim == 3) return box({x[0][0], x[1][0], x[2][0]}, {x[0][1], x[1][1], x[2][1]});
  return polygon(
      {{x[0][0], x[1][0], 0}, {x[0][1], x[1][0], 0}, {x[0][1], x[1][1], 0}, {x[0][0], x[1][1], 0}});
}

Interval ordered(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

/// Of some length.
Interval interval(Draw& draw) {
  for (;;) {
    const Interval x = ordered(draw.place(), draw.place());
    if (x[1] - x[0] > 1e-3) return x;
  }
}

std::array<Interval, 3> intervals(Draw& draw) { return {interval(draw), interval(draw), interval(draw)}; }

Surface random_box(int dim, Draw& draw) {
  std::array<Interval, 3> x{};
  for (Interval& i : x) {
    const double from = -0.2 + 1.2 * draw.unit();
    i = {from, from + draw.scale(1e-3, 1)};
  }
  return block(dim, x);
}

/// Beside a side of the border, on either side of it.
std::array<Interval, 3> beside_border(int dim, bool inside, Draw& draw) {
  std::array<Interval, 3> x = intervals(draw);
  const int axis = draw.below(dim);
  const bool high = draw.chance(0.5);
  const double border = high ? 1 : 0, at = border + draw.distance(), depth = draw.scale(0.01, 0.9);
  x[axis] = ordered(at, high == inside ? at - depth : at + depth);
  return x;
}

Surface in_corner(int dim, Draw& draw) {
  std::array<Interval, 3> x{};
  for (Interval& i : x) {
    const bool high = draw.chance(0.5);
    const double at = (high ? 1 : 0) + draw.distance(), depth = draw.chance(0.5) ? draw.cell() : draw.unit();
    i = ordered(at, (high ? 1 - depth : depth) + (draw.chance(0.5) ? draw.distance() : 0));
    if (i[1] - i[0] < 1e-6) i[1] = i[0] + 0.1;
  }
  return block(dim, x);
}

/// Thinner than 1e-10 of a cell, along the axes or not.
Surface slit(int dim, Draw& draw) {
  std::array<Interval, 3> x = intervals(draw);
  const int axis = draw.below(dim);
  const double at = draw.place();
  x[axis] = {at, at + draw.scale(1e-16, 1e-10) * draw.cell()};
  if (x[axis][1] <= x[axis][0]) x[axis][1] = std::nextafter(at, 2.0);
  Surface result = block(dim, x);
  if (draw.chance(0.5)) return result;
  return moved(result, rotated(dim, 6 * draw.unit(), {1, 1, 1},
                               {0.3 * draw.unit(), 0.3 * draw.unit(), 0.3 * draw.unit()}));
}

/// Where a ray from a centre meets a line of the mesh, as a share of its length; or as it was.
double onto_line(Draw& draw, const Point& centre, const Point& ray, double share, int dim) {
  const int axis = draw.below(dim);
  if (std::abs(ray[axis]) < 1e-3) return share;
  const double wanted = (draw.line() - centre[axis]) / ray[axis];
  return wanted > 0.3 && wanted < 1 ? wanted : share;
}

/// @param facets 3 to 300. @param depth of its notches: 0 is regular
/// @param aligned corners on lines of the mesh
Surface polygon_around(Draw& draw, int facets, double depth, bool aligned) {
  const double radius = draw.scale(0.02, 0.6);
  Point centre{draw.unit(), draw.unit(), 0};
  double phase = 2 * std::numbers::pi * draw.unit();
  if (aligned && depth == 0) {
    // One corner on a line, and at times a side along it.
    const double half = draw.chance(0.5) ? std::numbers::pi / facets : 0;
    const int quarter = draw.below(4), axis = quarter % 2;
    phase = quarter * std::numbers::pi / 2 + half;
    centre[axis] = draw.line() - (quarter < 2 ? 1 : -1) * radius * std::cos(half);
  }
  std::vector<Point> corners;
  for (int k = 0; k < facets; ++k) {
    const double t = phase + 2 * std::numbers::pi * k / facets;
    const Point ray{radius * std::cos(t), radius * std::sin(t), 0};
    double share = 1 - depth * draw.unit();
    if (aligned && depth > 0 && draw.chance(0.5)) share = onto_line(draw, centre, ray, share, 2);
    corners.push_back({centre[0] + share * ray[0], centre[1] + share * ray[1], 0});
  }
  return polygon(corners);
}

Surface polyhedron_around(Draw& draw, double depth, bool aligned) {
  Surface s = sphere({0, 0, 0}, 1, draw.chance(0.1) ? 2 : draw.below(2));
  const double radius = draw.scale(0.05, 0.6);
  Point centre{draw.unit(), draw.unit(), draw.unit()};
  if (aligned && depth == 0) {
    const int axis = draw.below(3);
    centre[axis] = draw.line() - (draw.chance(0.5) ? radius : -radius);
  }
  for (int v = 0; v < s.point_count(); ++v) {
    double* x = &s.points[3 * static_cast<std::size_t>(v)];
    const Point ray{radius * x[0], radius * x[1], radius * x[2]};
    double share = 1 - depth * draw.unit();
    if (aligned && depth > 0 && draw.chance(0.5)) share = onto_line(draw, centre, ray, share, 3);
    for (int i = 0; i < 3; ++i) x[i] = centre[i] + share * ray[i];
  }
  return s;
}

Surface around(int dim, Draw& draw, double depth, bool aligned) {
  if (dim == 3) return polyhedron_around(draw, depth, aligned);
  return polygon_around(draw, static_cast<int>(draw.scale(3, 301)), depth, aligned);
}

/// Two blocks that touch: along faces in `apart` = 1 directions, along edges in 2, in a corner in 3.
std::vector<Surface> touching(int dim, int apart, Draw& draw) {
  std::array<Interval, 3> a = intervals(draw), b = intervals(draw);
  const int first = draw.below(dim);
  for (int k = 0; k < dim; ++k) {
    const int axis = (first + k) % dim;
    if (k < apart) {
      const double at = draw.place();
      a[axis] = {at - draw.scale(0.01, 0.8), at};
      const double from = at + draw.distance();
      b[axis] = {from, from + draw.scale(0.2, 0.8)};
    } else if (draw.chance(0.5)) {
      b[axis] = a[axis];  // ends together
    }
  }
  return {block(dim, a), block(dim, b)};
}

/// Two blocks side by side on the border, in the mesh or behind it.
std::vector<Surface> both_on_border(int dim, Draw& draw) {
  std::array<Interval, 3> a = beside_border(dim, draw.chance(0.5), draw), b = a;
  const int axis = draw.below(dim);
  const double middle = 0.5 * (a[axis][0] + a[axis][1]);
  a[axis][1] = middle;
  b[axis][0] = middle + draw.distance();
  if (b[axis][1] - b[axis][0] < 1e-6) b[axis][1] = b[axis][0] + 0.1;
  return {block(dim, a), block(dim, b)};
}

}  // namespace

double Draw::distance() {
  if (chance(0.15)) return 0;
  double exponent = -16 + 15 * unit();
  while (exponent > -9.6 && exponent < -8.4) exponent = -16 + 15 * unit();
  const double size = std::pow(10.0, exponent) * cell();
  return chance(0.5) ? size : -size;
}

Scene draw_scene(int dimension, Draw& draw) {
  const int dim = dimension;
  const bool plane = dim == 2;
  switch (draw.below(15)) {
    case 0:
      return {"box, anywhere", {random_box(dim, draw)}};
    case 1:
      return {"box on lines", {block(dim, intervals(draw))}};
    case 2:
      return {"box in the mesh, on the border", {block(dim, beside_border(dim, true, draw))}};
    case 3:
      return {"box behind the border", {block(dim, beside_border(dim, false, draw))}};
    case 4:
      return {"box in a corner of the mesh", {in_corner(dim, draw)}};
    case 5:
      return {plane ? "regular polygon" : "regular polyhedron", {around(dim, draw, 0, false)}};
    case 6:
      return {plane ? "regular polygon on a line" : "regular polyhedron on a plane",
              {around(dim, draw, 0, true)}};
    case 7:
      return {"star", {around(dim, draw, 0.7, false)}};
    case 8:
      return {plane ? "star, corners on lines" : "star, corners on planes", {around(dim, draw, 0.7, true)}};
    case 9:
      return {"slit", {slit(dim, draw)}};
    case 10:
      return {"two touch along faces", touching(dim, 1, draw)};
    case 11:
      if (plane) return {"two touch in a corner", touching(dim, 2, draw)};
      return draw.chance(0.5) ? Scene{"two touch along edges", touching(dim, 2, draw)}
                              : Scene{"two touch in a corner", touching(dim, 3, draw)};
    case 12:
      return {"star and box overlap",
              {around(dim, draw, 0.7, draw.chance(0.5)), block(dim, intervals(draw))}};
    case 13:
      return {"box and slit overlap", {block(dim, intervals(draw)), slit(dim, draw)}};
    default:
      return {"two side by side on the border", both_on_border(dim, draw)};
  }
}
