// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "seam/mesh/input/face_match.hpp"
#include "seam/mesh/input/gmsh_file.hpp"
#include "seam/mesh/input/mesh_input.hpp"
#include "seam/mesh/input/read_text.hpp"

namespace seam {

namespace {

/// Where node a of our cell stands in Gmsh's. The two differ in the edges of tetrahedra and in the edges and
/// faces of hexahedra.
std::vector<int> gmsh_order(const GmshElementType& type) {
  if (type.type == CellType::tetrahedron && type.order == 2) return {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
  if (type.type == CellType::hexahedron && type.order == 2)
    return {0,  1,  2,  3,  4,  5,  6,  7,                   // vertices
            8,  11, 13, 9,  16, 18, 19, 17, 10, 12, 14, 15,  // edges
            22, 23, 21, 24, 20, 25, 26};                     // faces, centre
  std::vector<int> same(type.nodes);
  std::iota(same.begin(), same.end(), 0);
  return same;
}

class Conversion {
 public:
  Conversion(const GmshFile& file, const std::string& name) : file_(file), name_(name) {}

  MeshData convert() {
    choose_cells();
    add_nodes();
    for (const auto& block : file_.elements)
      if (topology(block.type.type).dimension == mesh_.dimension) add_cells(block);
    const FaceMatch faces(mesh_);
    for (const auto& block : file_.elements)
      if (topology(block.type.type).dimension == mesh_.dimension - 1) add_faces(block, faces);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw Error(Location{name_, line, 0}, message);
  }

  /// Cells are the elements of the highest dimension; they must all be of one type.
  void choose_cells() {
    const GmshFile::Elements* cells = nullptr;
    const auto dimension = [](const GmshFile::Elements& e) { return topology(e.type.type).dimension; };
    for (const auto& block : file_.elements)
      if (!cells || dimension(block) > dimension(*cells)) cells = &block;
    if (!cells || dimension(*cells) < 2)
      fail(0,
           "the mesh has no cells of dimension 2 or 3; in Gmsh, mesh the surfaces (-2) or volumes (-3) and "
           "put "
           "them into a physical group");
    for (const auto& block : file_.elements)
      if (dimension(block) == dimension(*cells) &&
          (block.type.type != cells->type.type || block.type.order != cells->type.order))
        fail(block.line,
             fmt::format("{}s of order {} here, but {}s of order {} in line {}; expected cells of one type "
                         "and order (in Gmsh, recombine all surfaces or none)",
                         seam::name(block.type.type), block.type.order, seam::name(cells->type.type),
                         cells->type.order, cells->line));
    mesh_.dimension = dimension(*cells);
    mesh_.type = cells->type.type;
    mesh_.order = cells->type.order;
  }

  void add_nodes() {
    const int dim = mesh_.dimension;
    double extent = 0;
    for (const auto& x : file_.node_positions) extent = std::max({extent, std::abs(x[0]), std::abs(x[1])});
    mesh_.coordinates.reserve(file_.node_positions.size() * dim);
    for (std::size_t i = 0; i < file_.node_positions.size(); ++i) {
      const auto& x = file_.node_positions[i];
      if (dim == 2 && std::abs(x[2]) > 1e-12 * extent)
        fail(0, fmt::format(
                    "node {} of the plane mesh is at z = {:g}; expected z = 0 everywhere (a 3D mesh needs "
                    "volume cells, gmsh -3)",
                    file_.node_tags[i], x[2]));
      mesh_.coordinates.insert(mesh_.coordinates.end(), x.begin(), x.begin() + dim);
    }
  }

  void add_cells(const GmshFile::Elements& block) {
    if (mesh_.cells.size() + block.nodes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      fail(block.line, "the mesh has more cells than can be counted");
    const std::vector<int> order = gmsh_order(block.type);
    const int first = mesh_.cell_count();
    for (std::size_t at = 0; at < block.nodes.size(); at += order.size())
      for (const int a : order) mesh_.cells.push_back(block.nodes[at + a]);
    for (const int tag : block.groups) {
      auto& region = mesh_.regions[group_name(mesh_.dimension, tag)];
      for (int c = first; c < mesh_.cell_count(); ++c) region.push_back(c);
    }
  }

  void add_faces(const GmshFile::Elements& block, const FaceMatch& faces) {
    for (const int tag : block.groups) {
      const std::string group = group_name(mesh_.dimension - 1, tag);
      auto& boundary = mesh_.boundaries[group];
      const int vertices = topology(block.type.type).vertices;
      for (std::size_t at = 0; at < block.nodes.size(); at += block.type.nodes) {
        const std::span<const int> nodes(&block.nodes[at], vertices);
        const CellFace face = faces.find(nodes);
        if (face.cell < 0) fail(block.line, no_cell(group, nodes));
        boundary.push_back(face);
      }
    }
  }

  [[nodiscard]] std::string no_cell(const std::string& group, std::span<const int> nodes) const {
    std::vector<long long> tags;
    for (const int a : nodes) tags.push_back(file_.node_tags[a]);
    return fmt::format(
        "physical group '{}' has a face (nodes {}) that belongs to no cell; in Gmsh, put the surface or "
        "volume next to it into a physical group, too",
        group, fmt::join(tags, " "));
  }

  /// An unnamed group goes by its number.
  [[nodiscard]] std::string group_name(int dimension, int tag) const {
    const auto found = file_.group_names.find({dimension, tag});
    return found == file_.group_names.end() ? std::to_string(tag) : found->second;
  }

  const GmshFile& file_;
  const std::string& name_;
  MeshData mesh_;
};

}  // namespace

MeshData read_gmsh_text(const std::string& text, const std::string& name) {
  const GmshFile file = parse_gmsh(text, name);
  MeshData mesh = Conversion(file, name).convert();
  validate_mesh(mesh, name, file.node_tags);
  return mesh;
}

MeshData read_gmsh(const std::string& path) { return read_gmsh_text(read_text(path), path); }

}  // namespace seam
