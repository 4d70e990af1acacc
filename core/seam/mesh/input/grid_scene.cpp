// SPDX-License-Identifier: BSD-3-Clause
// From a scene's `grid` to a mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seam/base/policy.hpp"
#include "seam/mesh/input/grid.hpp"

namespace seam {

namespace {

constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};
constexpr std::array<const char*, 6> side_names = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

CellType cell_type(const Parameters& p, int dimension) {
  if (!p.has("cell")) return dimension == 2 ? CellType::quadrilateral : CellType::hexahedron;
  for (const CellType type :
       {CellType::quadrilateral, CellType::triangle, CellType::hexahedron, CellType::tetrahedron})
    if (name(type) == p.text("cell")) {
      if (topology(type).dimension == dimension) return type;
      throw Error(p.where("cell"),
                  fmt::format("a {} has dimension {}, but the scene has dimension {}; use {}", name(type),
                              topology(type).dimension, dimension,
                              dimension == 2 ? "quadrilateral or triangle" : "hexahedron or tetrahedron"));
    }
  throw Error(p.where("cell"), fmt::format("'{}' is not a cell of a grid", p.text("cell")));
}

/// Entry i of a vector that must have one entry per dimension.
double entry(const Parameters& p, const char* key, int i) {
  const auto& v = p.vector(key);
  if (i >= static_cast<int>(v.size()))
    throw Error(p.where(key), fmt::format("'{}' has {} entries; expected one per direction", key, v.size()));
  return v[i];
}

int cells_along(const Parameters& p, int i) {
  const double n = entry(p, "cells", i);
  if (!(n >= 1 && n <= 1e8) || n != std::floor(n))
    throw Error(p.where("cells"),
                fmt::format("{} cells along {}; expected a whole number of at least 1", n, axis_names[i]));
  return static_cast<int>(n);
}

std::vector<double> explicit_lines(const Parameters& p, int i) {
  const char* axis = axis_names[i];
  const Parameters& object = p.object("lines");
  const std::vector<double>& lines = object.vector(axis);
  const auto fail = [&](const std::string& message) { throw Error(object.where(axis), message); };
  if (lines.size() < 2) fail(fmt::format("{} line(s) along {}; expected at least two", lines.size(), axis));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (!std::isfinite(lines[k])) fail(fmt::format("line {} along {} is not a finite number", k + 1, axis));
    if (k > 0 && !(lines[k] > lines[k - 1]))
      fail(fmt::format("line {} along {} is at {}, not beyond the one before it at {}; lines must increase",
                       k + 1, axis, lines[k], lines[k - 1]));
  }
  // What from, to, cells and grading say of this direction must not contradict the lines.
  const auto agree = [&](const char* key, double value) {
    if (p.has(key) && entry(p, key, i) != value)
      throw Error(p.where(key),
                  fmt::format("'{}' is {} along {}, but the lines given there make it {}; change "
                              "one of them",
                              key, entry(p, key, i), axis, value));
  };
  agree("from", lines.front());
  agree("to", lines.back());
  agree("cells", static_cast<double>(lines.size()) - 1);
  agree("grading", 1.0);
  return lines;
}

/// Lines of one stretch. @param keys holds the keys `to`, `grading` and `cells` for messages
std::vector<double> stretch_lines(const Parameters& keys, int i, double from, double to, int n,
                                  double ratio) {
  if (!(to > from) || !std::isfinite(to - from))
    throw Error(keys.where("to"),
                fmt::format("the grid ends at {} = {}, not beyond its start at {}; exchange 'from' "
                            "and 'to'",
                            axis_names[i], to, from));
  if (!(ratio >= 1e-6 && ratio <= 1e6))
    throw Error(keys.where("grading"),
                fmt::format("grading {} along {}; expected the width of the last cell over that "
                            "of the first, between 1e-6 and 1e6",
                            ratio, axis_names[i]));
  std::vector<double> lines = graded_lines(from, to, n, ratio);
  if (!std::is_sorted(lines.begin(), lines.end(), std::less_equal<>()))
    throw Error(keys.where("cells"),
                fmt::format("{} cells between {} and {} along {} are too thin for floating-point "
                            "numbers to tell them apart; use fewer",
                            n, from, to, axis_names[i]));
  return lines;
}

/// One stretch of cells after the other.
std::vector<double> segment_lines(const Parameters& p, int i) {
  const Parameters& segments = p.object("segments");
  if (segments.list(axis_names[i]).empty())
    throw Error(
        segments.where(axis_names[i]),
        fmt::format("no stretch along {}; expected at least one, {{to: ..., cells: ...}}", axis_names[i]));
  std::vector<double> lines{segments.vector("from")[i]};
  for (const Parameters& segment : segments.list(axis_names[i])) {
    const std::vector<double> next =
        stretch_lines(segment, i, lines.back(), segment.number("to"),
                      static_cast<int>(segment.integer("cells")), segment.number("grading"));
    lines.insert(lines.end(), next.begin() + 1, next.end());
  }
  return lines;
}

/// Cells along a direction by the scene's word, before there is anything of them.
double count_along(const Parameters& p, int i) {
  const char* axis = axis_names[i];
  if (p.has("lines") && p.object("lines").has(axis))
    return static_cast<double>(p.object("lines").vector(axis).size()) - 1;
  if (p.has("segments") && p.object("segments").has(axis)) {
    double count = 0;
    for (const Parameters& segment : p.object("segments").list(axis))
      count += static_cast<double>(segment.integer("cells"));
    return count;
  }
  return p.has("cells") ? entry(p, "cells", i) : 1;
}

void require_allowed_size(const Parameters& p, CellType cell, int dimension) {
  double cells = cell == CellType::triangle ? 2 : cell == CellType::tetrahedron ? 6 : 1;
  for (int i = 0; i < dimension; ++i) cells *= std::max(1.0, count_along(p, i));
  const char* key = p.has("cells") ? "cells" : p.has("segments") ? "segments" : "lines";
  require_within(cells, policy().limits.cells, "cells", "cells in the grid", p.where(key));
}

std::vector<double> lines_along(const Parameters& p, int i) {
  if (p.has("lines") && p.object("lines").has(axis_names[i])) return explicit_lines(p, i);
  if (p.has("segments") && p.object("segments").has(axis_names[i])) return segment_lines(p, i);
  for (const char* key : {"from", "to", "cells"})
    if (!p.has(key))
      throw Error(p.where(), fmt::format("the grid needs '{}' (or 'lines' for every direction, and there are "
                                         "none along {})",
                                         key, axis_names[i]));
  const double ratio = p.has("grading") ? entry(p, "grading", i) : 1.0;
  return stretch_lines(p, i, entry(p, "from", i), entry(p, "to", i), cells_along(p, i), ratio);
}

void apply_map(MeshData& mesh, const Parameters& p) {
  const int dim = mesh.dimension;
  const std::vector<Expression>& map = p.vector_expression("map");
  if (static_cast<int>(map.size()) != dim)
    throw Error(p.where("map"), fmt::format("'map' has {} components; expected {}", map.size(), dim));
  for (std::size_t at = 0; at < mesh.coordinates.size(); at += dim) {
    std::array<double, 3> mapped{};
    double* x = &mesh.coordinates[at];
    for (int i = 0; i < dim; ++i) {
      // A free component (null) stays as it is.
      mapped[i] = p.component_given("map", i) ? map[i](x, dim, 0.0) : x[i];
      if (!std::isfinite(mapped[i]))
        throw Error(p.where("map"), fmt::format("component {} of 'map' is not a finite number at ({:g})",
                                                i + 1, fmt::join(x, x + dim, ", ")));
    }
    std::copy_n(mapped.begin(), dim, x);
  }
}

/// Turns x by an angle about a point (and, in 3D, an axis through it), by Rodrigues' formula.
void apply_rotation(MeshData& mesh, const Parameters& p) {
  const int dim = mesh.dimension;
  const Parameters& rotate = p.object("rotate");
  const double angle = rotate.number("angle") * std::numbers::pi / 180, c = std::cos(angle),
               s = std::sin(angle);
  std::array<double, 3> about{}, axis = {0, 0, 1};
  for (int i = 0; i < dim; ++i) about[i] = rotate.has("about") ? entry(rotate, "about", i) : 0.0;
  if (rotate.has("axis")) {
    if (dim == 2) throw Error(rotate.where("axis"), "a plane mesh turns about z only; leave 'axis' out");
    for (int i = 0; i < 3; ++i) axis[i] = entry(rotate, "axis", i);
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    if (!(length > 0)) throw Error(rotate.where("axis"), "the axis of a rotation must not be zero");
    for (double& a : axis) a /= length;
  }
  for (std::size_t at = 0; at < mesh.coordinates.size(); at += dim) {
    std::array<double, 3> r{};
    for (int i = 0; i < dim; ++i) r[i] = mesh.coordinates[at + i] - about[i];
    const double along = axis[0] * r[0] + axis[1] * r[1] + axis[2] * r[2];
    for (int i = 0; i < dim; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double cross = axis[j] * r[k] - axis[k] * r[j];
      mesh.coordinates[at + i] = about[i] + c * r[i] + s * cross + (1 - c) * along * axis[i];
    }
  }
}

/// Sides that get the same name become one boundary.
void rename_sides(MeshData& mesh, const Parameters& sides) {
  std::map<std::string, std::vector<CellFace>> renamed;
  for (std::size_t i = 0; i < side_names.size(); ++i) {
    const char* side = side_names[i];
    if (!sides.has(side)) {
      if (mesh.boundaries.contains(side)) renamed[side] = mesh.boundaries[side];
      continue;
    }
    if (static_cast<int>(i) >= 2 * mesh.dimension)
      throw Error(sides.where(side), fmt::format("a plane grid has no side '{}'", side));
    auto& faces = renamed[sides.text(side)];
    faces.insert(faces.end(), mesh.boundaries[side].begin(), mesh.boundaries[side].end());
  }
  mesh.boundaries = std::move(renamed);
}

}  // namespace

Schema grid_schema() {
  Schema lines("Coordinates of the lines between the cells, per direction.");
  Schema segment("A stretch of cells, up to a coordinate.");
  segment.number("to", "where it ends").unit("m");
  segment.integer("cells", "number of cells").at_least(1);
  segment.number("grading", "width of its last cell over that of its first").above(0).otherwise("1");
  Schema segments("Stretches of cells, one after the other, per direction.");
  segments.vector("from", "corner with the lowest coordinates").unit("m");
  for (const char* axis : axis_names)
    segments.list(axis, fmt::format("stretches along {}", axis), segment).optional();
  Schema sides("New names of the sides.");
  for (const char* axis : axis_names)
    lines.vector(axis, fmt::format("increasing {} coordinates", axis)).unit("m").entries(-1).optional();
  for (const char* side : side_names) sides.text(side, fmt::format("name of side {}", side)).optional();
  Schema rotate("A rotation, applied after the map.");
  rotate.number("angle", "counter-clockwise angle").unit("degree");
  rotate.vector("about", "point that stays where it is; the origin unless given").unit("m").optional();
  rotate.vector("axis", "direction of the axis (3D); z unless given").optional();

  Schema schema("A box cut into cells.");
  schema
      .choice("cell", "shape of the cells; quadrilateral (2D) or hexahedron (3D) unless given",
              {"quadrilateral", "triangle", "hexahedron", "tetrahedron"})
      .optional();
  schema.vector("from", "corner with the lowest coordinates").unit("m").optional();
  schema.vector("to", "corner with the highest coordinates").unit("m").optional();
  schema.vector("cells", "number of cells along each direction").optional();
  schema.vector("grading", "width of the last cell over that of the first, per direction").optional();
  schema
      .object("lines", "explicit coordinates of the lines between cells, instead of the keys above",
              std::move(lines))
      .optional();
  schema.object("segments", "stretches of cells of different width, instead of the keys above", segments)
      .optional();
  schema.integer("order", "polynomial order of the geometry").at_least(1).at_most(2).otherwise("1");
  schema.choice("diagonals", "how rectangles are cut into triangles", {"alternating", "rising", "falling"})
      .optional();
  schema.vector_expression("map", "new position of the node at (x, y, z); null leaves a coordinate as it is")
      .unit("m")
      .optional();
  schema.object("rotate", "turns the grid", std::move(rotate)).optional();
  schema
      .object("sides", "other names for x_min, x_max, ...; sides of one name are one boundary",
              std::move(sides))
      .optional();
  return schema;
}

MeshData load_grid(const Parameters& p, int dimension) {
  Grid grid;
  grid.cell = cell_type(p, dimension);
  grid.order = static_cast<int>(p.integer("order"));
  require_allowed_size(p, grid.cell, dimension);
  for (int i = 0; i < dimension; ++i) grid.lines[i] = lines_along(p, i);
  if (p.has("diagonals")) {
    if (grid.cell != CellType::triangle)
      throw Error(p.where("diagonals"),
                  fmt::format("'diagonals' is for triangles, but the cells are {}s", name(grid.cell)));
    const std::string& word = p.text("diagonals");
    grid.diagonals = word == "rising"    ? Diagonals::rising
                     : word == "falling" ? Diagonals::falling
                                         : Diagonals::alternating;
  }
  MeshData mesh;
  try {
    mesh = make_grid(grid);
  } catch (const Error& e) {
    throw Error(p.where("cells"), e.what());
  }
  if (p.has("map")) apply_map(mesh, p);
  if (p.has("rotate")) apply_rotation(mesh, p);
  if (p.has("sides")) rename_sides(mesh, p.object("sides"));
  return mesh;
}

}  // namespace seam
