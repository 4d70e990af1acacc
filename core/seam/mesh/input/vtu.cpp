// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/mesh/input/face_match.hpp"
#include "seam/mesh/input/mesh_input.hpp"
#include "seam/mesh/input/read_text.hpp"
#include "seam/mesh/input/vtu_file.hpp"

namespace seam {

namespace {

struct VtkCell {
  CellType type;
  int order;
};

class Conversion {
 public:
  Conversion(const VtuFile& file, const std::string& name) : file_(file), name_(name) {}

  MeshData convert() {
    choose_cells();
    add_nodes();
    add_cells();
    add_regions();
    mesh_.boundaries["outer"] = outer_faces(mesh_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw Error(Location{name_}, message); }

  [[nodiscard]] const std::vector<double>& values(const char* section, const char* array) const {
    const auto found = file_.arrays.find({section, array});
    if (found == file_.arrays.end())
      fail(fmt::format("the file has no array '{}' in <{}>; it is truncated or no mesh", array, section));
    return found->second.values;
  }

  /// VTK's cells have our order of nodes.
  [[nodiscard]] VtkCell cell(double number) const {
    constexpr int limit = 255;
    switch (number >= 0 && number <= limit ? static_cast<int>(number) : limit) {
      case 5:
        return {CellType::triangle, 1};
      case 9:
        return {CellType::quadrilateral, 1};
      case 10:
        return {CellType::tetrahedron, 1};
      case 12:
        return {CellType::hexahedron, 1};
      case 22:
        return {CellType::triangle, 2};
      case 24:
        return {CellType::tetrahedron, 2};
      case 28:
        return {CellType::quadrilateral, 2};
      case 29:
        return {CellType::hexahedron, 2};
      case 23:
      case 25:
        fail(
            "the mesh has serendipity cells (8-node quadrilaterals or 20-node hexahedra); expected 9 and 27 "
            "nodes");
      default:
        fail(fmt::format(
            "the mesh has cells of VTK type {}; expected triangles (5 or 22), quadrilaterals (9 or 28), "
            "tetrahedra (10 or 24) or hexahedra (12 or 29)",
            number));
    }
  }

  void choose_cells() {
    const std::vector<double>& types = values("Cells", "types");
    if (types.empty()) fail("the mesh has no cells");
    for (std::size_t c = 1; c < types.size(); ++c)
      if (types[c] != types[0])
        fail(fmt::format("cell {} has VTK type {}, but cell 0 has type {}; expected cells of one type", c,
                         types[c], types[0]));
    const VtkCell chosen = cell(types[0]);
    mesh_.type = chosen.type;
    mesh_.order = chosen.order;
    mesh_.dimension = topology(chosen.type).dimension;
  }

  void add_nodes() {
    const auto& points = values("Points", "");
    if (file_.arrays.at({"Points", ""}).components != 3) fail("points have other than three components");
    double extent = 0;
    for (const double x : points) extent = std::max(extent, std::abs(x));
    for (std::size_t at = 0; at < points.size(); at += 3) {
      if (mesh_.dimension == 2 && std::abs(points[at + 2]) > 1e-12 * extent)
        fail(fmt::format("point {} of the plane mesh is at z = {:g}; expected z = 0 everywhere", at / 3,
                         points[at + 2]));
      for (int i = 0; i < mesh_.dimension; ++i) mesh_.coordinates.push_back(points[at + i]);
    }
  }

  void add_cells() {
    const int n = mesh_.nodes_per_cell();
    const auto& offsets = values("Cells", "offsets");
    for (std::size_t c = 0; c < offsets.size(); ++c)
      if (offsets[c] != static_cast<double>((c + 1) * n))
        fail(fmt::format("the nodes of cell {} end at offset {}; expected {} ({} nodes per cell)", c,
                         offsets[c], (c + 1) * n, n));
    const auto& connectivity = values("Cells", "connectivity");
    if (connectivity.size() != offsets.size() * n || connectivity.size() > std::numeric_limits<int>::max())
      fail(fmt::format("connectivity has {} entries; expected {} ({} cells of {} nodes)", connectivity.size(),
                       offsets.size() * n, offsets.size(), n));
    for (std::size_t i = 0; i < connectivity.size(); ++i) {
      if (!(connectivity[i] >= 0 && connectivity[i] < static_cast<double>(file_.points)))
        fail(fmt::format("cell {} names point {}; the mesh has points 0 to {}", i / n, connectivity[i],
                         static_cast<long long>(file_.points) - 1));
      mesh_.cells.push_back(static_cast<int>(connectivity[i]));
    }
  }

  void add_regions() {
    const auto found = file_.arrays.find({"CellData", "region"});
    if (found == file_.arrays.end()) return;
    const VtuFile::Array& array = found->second;
    if (array.components != 1)
      fail(fmt::format("cell array 'region' has {} components; expected 1", array.components));
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      if (array.words.empty() && array.values[c] != std::floor(array.values[c]))
        fail(fmt::format("cell {} is in region {}; expected a whole number or a name", c, array.values[c]));
      mesh_.regions[array.words.empty() ? fmt::format("{:.0f}", array.values[c]) : array.words[c]].push_back(
          c);
    }
  }

  const VtuFile& file_;
  const std::string& name_;
  MeshData mesh_;
};

}  // namespace

MeshData read_vtu_text(const std::string& text, const std::string& name) {
  const VtuFile file = parse_vtu(text, name);
  return Conversion(file, name).convert();
}

MeshData read_vtu(const std::string& path) { return read_vtu_text(read_text(path), path); }

}  // namespace seam
