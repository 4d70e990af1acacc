// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose sides lie in the border of the mesh, or beside it.
#include <catch2/catch.hpp>
#include <cmath>

#include "cut/cut_test.hpp"

using namespace seam;

namespace {

constexpr int n = 4;
constexpr double flush = 1e-9;  // of a cell

Surface block(int dim, const Point& from, const Point& to) {
  return dim == 3 ? box(from, to) : polygon({from, {to[0], from[1], 0}, to, {from[0], to[1], 0}});
}

double product(int dim, const Point& extent, int without = -1) {
  double result = 1;
  for (int d = 0; d < dim; ++d)
    if (d != without) result *= extent[d];
  return result;
}

/// Distances of both signs, in cells: 0, then 1e-16 to 1e-1, but none at which it is rounding that decides
/// what is flush.
std::vector<double> distances() {
  std::vector<double> result{0};
  for (int tenth = -160; tenth <= -10; tenth += 5) {
    if (tenth == -90) continue;
    result.push_back(std::pow(10.0, tenth / 10.0));
    result.push_back(-result.back());
  }
  return result;
}

/// The part of an interval within [0, 1], after ends that are flush with that were laid onto it.
double within(double from, double to) {
  const auto laid = [](double x) {
    for (const double end : {0.0, 1.0})
      if (std::abs(x - end) < flush / n) return end;
    return x;
  };
  return std::max(0.0, std::min(1.0, laid(to)) - std::max(0.0, laid(from)));
}

/// Whether there is anything wet before the end of an interval: then it is an interface.
bool is_wet_end(double x, bool high) {
  const double inward = flush / n;
  return high ? x < 1 - inward && x > -inward : x > inward && x < 1 + inward;
}

/// A box against the unit square or cube: volume and interface.
void check_box(CutMesh& cut, int dim, const Point& from, const Point& to) {
  cut.cut(std::array{block(dim, from, to)});
  check_closure(cut);
  Point extent{1, 1, 1};
  for (int d = 0; d < dim; ++d) extent[d] = within(from[d], to[d]);
  double interface = 0;
  for (int d = 0; d < dim; ++d)
    for (const bool high : {false, true})
      if (is_wet_end(high ? to[d] : from[d], high)) interface += product(dim, extent, d);
  INFO("from " << from[0] << " " << from[1] << " " << from[2] << " to " << to[0] << " " << to[1] << " "
               << to[2]);
  CHECK(std::abs(total_fluid(cut) - (1 - product(dim, extent))) < 1e-11 * std::pow(n, 1 - dim) * 10);
  // A part of 1e-11 of a cell that is not kept may have a side of up to 1e-5 along an edge of the body.
  CHECK(std::abs(total_interface(cut) - interface) < 1e-5);
}

std::vector<CellType> types() {
  return {CellType::quadrilateral, CellType::triangle, CellType::hexahedron, CellType::tetrahedron};
}

int dimension_of(CellType type) {
  return type == CellType::quadrilateral || type == CellType::triangle ? 2 : 3;
}

}  // namespace

TEST_CASE("A body whose side lies along the border, at any distance from it", "[cut][border]") {
  const CellType type = GENERATE(from_range(types()));
  const int dim = dimension_of(type);
  const Mesh mesh = grid(type, {n, n, dim == 3 ? n : 1}, unmoved());
  CutMesh cut(mesh);
  for (const double off : distances())
    for (int axis = 0; axis < dim; ++axis)
      for (const bool high : {false, true}) {
        // It covers whole cells along the border.
        Point from{0.13, 0.13, 0.13}, to{0.91, 0.91, 0.91};
        (high ? to : from)[axis] = high ? 1 - off / n : off / n;
        check_box(cut, dim, from, to);
      }
}

TEST_CASE("A body in a corner of the mesh, at any distance from its sides", "[cut][border]") {
  const CellType type = GENERATE(from_range(types()));
  const int dim = dimension_of(type);
  const Mesh mesh = grid(type, {n, n, dim == 3 ? n : 1}, unmoved());
  CutMesh cut(mesh);
  for (const double off : distances())
    for (int corner = 0; corner < 1 << dim; ++corner) {
      Point from{0.13, 0.13, 0.13}, to{0.91, 0.91, 0.91};
      for (int d = 0; d < dim; ++d)
        ((corner >> d & 1) != 0 ? to : from)[d] = (corner >> d & 1) != 0 ? 1 - off / n : off / n;
      check_box(cut, dim, from, to);
    }
}

TEST_CASE("A body that stands on the border from outside bounds what is wet", "[cut][border]") {
  const CellType type = GENERATE(from_range(types()));
  const int dim = dimension_of(type);
  const Mesh mesh = grid(type, {n, n, dim == 3 ? n : 1}, unmoved());
  CutMesh cut(mesh);
  // Wider than the mesh, as wide, narrower, and on a line of it.
  for (const auto& [low, wide] :
       {std::pair(-0.3, 1.2), std::pair(0.0, 1.0), std::pair(0.13, 0.91), std::pair(0.25, 0.75)})
    for (const double off : distances())
      for (int axis = 0; axis < dim; ++axis)
        for (const bool high : {false, true}) {
          Point from{low, low, low}, to{wide, wide, wide};
          from[axis] = high ? 1 + off / n : -0.7;
          to[axis] = high ? 1.7 : -off / n;
          check_box(cut, dim, from, to);
        }
}
