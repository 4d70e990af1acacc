// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/mesh_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "seam/base/policy.hpp"
#include "seam/mesh/input/face_match.hpp"
#include "seam/mesh/input/grid.hpp"

namespace seam {

namespace {

/// Mean of the vertices of a cell or of one of its faces.
std::array<double, 3> centre(const MeshData& mesh, int cell, const std::vector<int>& vertices) {
  std::array<double, 3> sum{};
  const int* nodes = &mesh.cells[static_cast<std::size_t>(cell) * mesh.nodes_per_cell()];
  for (const int v : vertices)
    for (int i = 0; i < mesh.dimension; ++i)
      sum[i] += mesh.coordinates[static_cast<std::size_t>(nodes[v]) * mesh.dimension + i] /
                static_cast<double>(vertices.size());
  return sum;
}

Error matches_nothing(const Parameters& p, const std::string& name, const char* what) {
  return Error(p.where("where"), fmt::format("no {} fulfils '{}', so '{}' would be empty; the expression is "
                                             "evaluated at its midpoint",
                                             what, p.expression("where").text(), name));
}

void add_boundaries(MeshData& mesh, const Parameters& p) {
  const std::vector<CellFace> outer = outer_faces(mesh);
  for (const auto& [name, entry] : p.map("boundaries")) {
    if (mesh.boundaries.contains(name))
      throw Error(entry.where(),
                  fmt::format("the mesh has a boundary '{}' already; choose another name", name));
    const Expression& where = entry.expression("where");
    std::vector<CellFace> faces;
    for (const CellFace& f : outer)
      if (where(centre(mesh, f.cell, topology(mesh.type).faces[f.face]).data(), mesh.dimension, 0.0) != 0.0)
        faces.push_back(f);
    if (faces.empty()) throw matches_nothing(entry, name, "outer face");
    mesh.boundaries[name] = std::move(faces);
  }
}

void add_regions(MeshData& mesh, const Parameters& p) {
  std::vector<int> vertices(topology(mesh.type).vertices);
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = static_cast<int>(v);
  for (const auto& [name, entry] : p.map("regions")) {
    if (mesh.regions.contains(name))
      throw Error(entry.where(),
                  fmt::format("the mesh has a region '{}' already; choose another name", name));
    const Expression& where = entry.expression("where");
    std::vector<int> cells;
    for (int c = 0; c < mesh.cell_count(); ++c)
      if (where(centre(mesh, c, vertices).data(), mesh.dimension, 0.0) != 0.0) cells.push_back(c);
    if (cells.empty()) throw matches_nothing(entry, name, "cell");
    mesh.regions[name] = std::move(cells);
  }
}

MeshData read_file(const Parameters& p) {
  const std::string& path = p.text("file");
  const std::string extension = std::filesystem::path(path).extension().string();
  MeshData mesh;
  std::map<std::string, double> numbers;
  if (p.has("numbers"))
    for (const auto& [name, entry] : p.map("numbers")) numbers[name] = entry.number("value");
  if (!numbers.empty() && extension != ".geo")
    throw Error(p.where("numbers"), "only a geometry (.geo) has numbers that can be set");
  if (extension == ".msh")
    mesh = read_gmsh(path);
  else if (extension == ".geo" && policy().restricted)
    throw Error(p.where("file"),
                fmt::format("'{}' is a geometry, which gmsh would run as a program: --restricted "
                            "allows none; mesh it elsewhere and name the .msh file",
                            path));
  else if (extension == ".geo")
    mesh = mesh_geometry(path, numbers, p.dimension());
  else if (extension == ".vtu")
    mesh = read_vtu(path);  // judged below; those of Gmsh have been, with the numbers in the file
  else
    throw Error(p.where("file"),
                fmt::format("cannot tell the format of mesh file '{}'; expected a name that ends in "
                            ".msh or .geo (Gmsh) or .vtu (VTK)",
                            path));
  require_within(mesh.cell_count(), policy().limits.cells, "cells", "cells in the mesh file",
                 p.where("file"));
  if (mesh.dimension != p.dimension())
    throw Error(p.where("file"),
                fmt::format("mesh '{}' consists of {}s and so has dimension {}, but the scene has "
                            "dimension {}",
                            path, name(mesh.type), mesh.dimension, p.dimension()));
  if (extension == ".vtu") validate_mesh(mesh, path);
  return mesh;
}

}  // namespace

Schema mesh_schema() {
  Schema boundary("Outer faces picked by their place.");
  boundary.expression("where",
                      "picks the outer faces at whose midpoint it is not 0, as in \"x > 0.9 && y < 1\"");
  Schema region("Cells picked by their place.");
  region.expression("where", "picks the cells at whose midpoint it is not 0");

  Schema number("A number of a geometry.");
  number.number("value", "takes the place of the geometry's own");

  Schema schema("A mesh: a generated grid or a file.");
  schema.object("grid", "a generated box", grid_schema()).optional();
  schema
      .file("file",
            "mesh file: Gmsh (.msh, format 2.2 or 4.1, ASCII; .geo, which the program gmsh meshes) or VTK "
            "(.vtu)")
      .optional();
  schema.value_map("numbers", "numbers of the .geo file, declared there by DefineConstant", std::move(number))
      .optional();
  schema.map("boundaries", "further named boundaries", std::move(boundary)).optional();
  schema.map("regions", "further named sets of cells", std::move(region)).optional();
  return schema;
}

MeshData load_mesh(const Parameters& p) {
  const bool grid = p.has("grid"), file = p.has("file");
  if (grid == file)
    throw Error(p.where(), grid ? "the mesh has both 'grid' and 'file'; give one of them"
                                : "the mesh has neither 'grid' nor 'file'; give one of them");
  MeshData mesh = grid ? load_grid(p.object("grid"), p.dimension()) : read_file(p);
  if (grid) validate_mesh(mesh, p.where("grid").text());
  if (p.has("boundaries")) add_boundaries(mesh, p);
  if (p.has("regions")) add_regions(mesh, p);
  return mesh;
}

}  // namespace seam
