// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "seam/mesh/input/mesh_input.hpp"

using namespace seam;
using Catch::Contains;

namespace {

/// A square of n x n cells; n is 2 unless it is set.
const std::string square = R"(
DefineConstant[ n = 2 ];
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
For k In {1:4}
  Line(k) = {k, k%4 + 1};
  Transfinite Curve{k} = n + 1;
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Surface{1};
Recombine Surface{1};
Physical Curve("floor") = {1};
Physical Surface("square") = {1};
)";

/// A file that is gone with this object.
struct GeometryFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("seam_geo_test_" + std::to_string(getpid()) + ".geo");
  explicit GeometryFile(const std::string& text) { std::ofstream(path) << text; }
  GeometryFile(const GeometryFile&) = delete;
  GeometryFile& operator=(const GeometryFile&) = delete;
  ~GeometryFile() { std::filesystem::remove(path); }
};

}  // namespace

TEST_CASE("gmsh meshes a geometry with the numbers that it is given") {
  const GeometryFile file(square);
  CHECK(mesh_geometry(file.path, {}, 2).cell_count() == 4);
  const MeshData mesh = mesh_geometry(file.path, {{"n", 3}}, 2);
  CHECK(mesh.cell_count() == 9);
  CHECK(mesh.boundaries.at("floor").size() == 3);
  CHECK(mesh.regions.at("square").size() == 9);
}

TEST_CASE("a number that a geometry does not have is an error") {
  const GeometryFile file(square);
  CHECK_THROWS_WITH(mesh_geometry(file.path, {{"poin", 3}}, 2), Contains("has no number 'poin'"));
}

TEST_CASE("a geometry that cannot be meshed says what gmsh says") {
  const GeometryFile file("Line(1) = {1, 2};\n");
  CHECK_THROWS_WITH(mesh_geometry(file.path, {}, 2), Contains("gmsh cannot mesh") && Contains("line 1"));
}
