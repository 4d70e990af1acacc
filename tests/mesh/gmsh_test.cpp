// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "mesh/mesh_test.hpp"
#include "seam/mesh/input/mesh_input.hpp"

using namespace seam;
using Catch::Contains;

namespace {

/// Two squares side by side: format 4.1, with a named region, a named boundary and an unnamed one.
const std::string squares_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 "left side"
2 3 "plate"
$EndPhysicalNames
$Entities
0 2 1 0
1 0 0 0 0 1 0 1 7 2 1 -2
2 2 0 0 2 1 0 1 -9 2 3 -4
1 0 0 0 2 1 0 1 3 2 1 2
$EndEntities
$Comment
anything
$EndComment
$Nodes
1 6 10 60
2 1 0 6
10
20
30
40
50
60
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
3 4 1 4
1 1 1 1
1 40 10
1 2 1 1
2 30 60
2 1 3 2
3 10 20 50 40
4 20 30 60 50
$EndElements
)";

/// The same in format 2.2.
const std::string squares_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 "left side"
2 3 "plate"
$EndPhysicalNames
$Nodes
6
10 0 0 0
20 1 0 0
30 2 0 0
40 0 1 0
50 1 1 0
60 2 1 0
$EndNodes
$Elements
4
1 1 2 7 1 40 10
2 1 2 9 2 30 60
3 3 2 3 1 10 20 50 40
4 3 2 3 1 20 30 60 50
$EndElements
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string error(const std::string& text) {
  return error_of([&] { validate_mesh(read_gmsh_text(text, "m.msh"), "m.msh"); });
}

/// A file of format 2.2 with one cell whose nodes stand at the given places.
std::string one_cell(int type, const std::vector<std::array<double, 3>>& places) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(places.size()) + "\n";
  for (std::size_t i = 0; i < places.size(); ++i)
    text += fmt::format("{} {} {} {}\n", i + 1, places[i][0], places[i][1], places[i][2]);
  text += fmt::format("$EndNodes\n$Elements\n1\n1 {} 0", type);
  for (std::size_t i = 0; i < places.size(); ++i) text += fmt::format(" {}", i + 1);
  return text + "\n$EndElements\n";
}

/// Appends the midpoints of Gmsh's edges, faces, ... given by their vertices.
void append_midpoints(std::vector<std::array<double, 3>>& places, const std::vector<std::vector<int>>& of) {
  for (const auto& vertices : of) {
    std::array<double, 3> x{};
    for (const int v : vertices)
      for (int i = 0; i < 3; ++i) x[i] += places[v][i] / static_cast<double>(vertices.size());
    places.push_back(x);
  }
}

/// Every node of a cell with straight edges must be where its reference coordinates map to.
void check_node_order(const MeshData& m) {
  const CellTopology& t = topology(m.type);
  for (int a = 0; a < t.nodes(2); ++a)
    for (int i = 0; i < m.dimension; ++i)
      CHECK(m.coordinates[m.cells[a] * m.dimension + i] == Approx(t.node_coordinates[a * m.dimension + i]));
}

}  // namespace

TEST_CASE("Gmsh 2.2 and 4.1 give the same mesh") {
  for (const std::string& text : {squares_41, squares_22}) {
    const MeshData m = read_gmsh_text(text, "m.msh");
    CHECK_NOTHROW(validate_mesh(m, "m.msh"));
    CHECK(m.dimension == 2);
    CHECK(m.type == CellType::quadrilateral);
    CHECK(m.order == 1);
    CHECK(m.cells == std::vector<int>{0, 1, 4, 3, 1, 2, 5, 4});
    CHECK(volume(m) == Approx(2));
    REQUIRE(m.boundaries.size() == 2);
    CHECK(m.boundaries.at("left side") == std::vector<CellFace>{{0, 3}});
    CHECK(m.boundaries.at("9") == std::vector<CellFace>{{1, 1}});
    CHECK(m.regions.at("plate") == std::vector<int>{0, 1});
  }
}

TEST_CASE("Line ends of any system are read") {
  std::string text;
  for (const char c : squares_41) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(read_gmsh_text(text, "m.msh").boundaries.contains("left side"));
}

TEST_CASE("Gmsh's second-order cells are put into our order") {
  using P = std::vector<std::array<double, 3>>;
  P triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  append_midpoints(triangle, {{0, 1}, {1, 2}, {2, 0}});
  check_node_order(read_gmsh_text(one_cell(9, triangle), "m"));

  P quad = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  append_midpoints(quad, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}});
  check_node_order(read_gmsh_text(one_cell(10, quad), "m"));

  P tetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  append_midpoints(tetrahedron, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}});
  check_node_order(read_gmsh_text(one_cell(11, tetrahedron), "m"));

  P hex = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  append_midpoints(hex, {{0, 1},
                         {0, 3},
                         {0, 4},
                         {1, 2},
                         {1, 5},
                         {2, 3},
                         {2, 6},
                         {3, 7},
                         {4, 5},
                         {4, 7},
                         {5, 6},
                         {6, 7},
                         {0, 3, 2, 1},
                         {0, 1, 5, 4},
                         {0, 4, 7, 3},
                         {1, 2, 6, 5},
                         {2, 3, 7, 6},
                         {4, 5, 6, 7},
                         {0, 1, 2, 3, 4, 5, 6, 7}});
  check_node_order(read_gmsh_text(one_cell(12, hex), "m"));
}

TEST_CASE("A file that is no Gmsh mesh is refused") {
  CHECK_THAT(error(""), Contains("m.msh:1: ") && Contains("the file is empty"));
  CHECK_THAT(error("hello"), Contains("does not start with $MeshFormat"));
  CHECK_THAT(error(replaced(squares_41, "4.1 0", "4.0 0")),
             Contains("m.msh:2:") && Contains("format 4") && Contains("Mesh.MshFileVersion = 4.1"));
  CHECK_THAT(error(replaced(squares_41, "4.1 0", "4.1 1")),
             Contains("binary") && Contains("Mesh.Binary = 0"));
}

TEST_CASE("Cells that cannot be used are refused with a hint") {
  CHECK_THAT(error(replaced(squares_22, "3 3 2 3", "3 16 2 3")),
             Contains("m.msh:22:") && Contains("serendipity") && Contains("Mesh.SecondOrderIncomplete = 0"));
  CHECK_THAT(error(replaced(squares_22, "3 3 2 3", "3 6 2 3")), Contains("the mesh has prisms"));
  CHECK_THAT(error(replaced(squares_22, "3 3 2 3", "3 7 2 3")), Contains("the mesh has pyramids"));
  CHECK_THAT(error(replaced(squares_22, "3 3 2 3", "3 21 2 3")), Contains("element type 21 is not known"));
  CHECK_THAT(error(replaced(squares_22, "4 3 2 3 1 20 30 60 50", "4 2 2 3 1 20 30 60")),
             Contains("m.msh:23:") &&
                 Contains("triangles of order 1 here, but quadrilaterals of order 1 in line 22"));
  CHECK_THAT(error(replaced(replaced(squares_22, "3 3 2 3 1 10 20 50 40\n", ""), "4 3 2 3 1 20 30 60 50",
                            "4 15 2 3 1 20\n5 15 2 3 1 20")),
             Contains("no cells of dimension 2 or 3"));
}

TEST_CASE("Nodes that do not fit are reported") {
  CHECK_THAT(error(replaced(squares_22, "30 2 0 0", "30 2 0 0.5")),
             Contains("node 30 of the plane mesh is at z = 0.5; expected z = 0"));
  CHECK_THAT(error(replaced(squares_22, "30 2 0 0", "20 2 0 0")), Contains("node 20 is there twice"));
  CHECK_THAT(error(replaced(squares_22, "20 30 60 50", "20 31 60 50")),
             Contains("m.msh:23:") && Contains("names node 31, which is not in $Nodes"));
  CHECK_THAT(error(replaced(squares_22, "30 2 0 0", "30 2 nan 0")),
             Contains("m.msh:13:") && Contains("'nan' where a coordinate was expected"));
  CHECK_THAT(error(replaced(squares_22, "30 2 0 0", "30 2 x 0")),
             Contains("'x' where a coordinate was expected"));
}

TEST_CASE("Groups must belong to cells") {
  CHECK_THAT(error(replaced(squares_22, "1 1 2 7 1 40 10", "1 1 2 7 1 50 10")),
             Contains("physical group 'left side' has a face (nodes 50 10) that belongs to no cell"));
}

TEST_CASE("Shapes that cannot be computed with are reported") {
  CHECK_THAT(error(replaced(squares_22, "10 20 50 40", "40 50 20 10")),
             Contains("1 inverted cell(s)") && Contains("the cell (nodes 40 50 20 10) around (0.5, 0.5)") &&
                 Contains("counter-clockwise"));
  CHECK_THAT(error(replaced(squares_22, "50 1 1 0", "50 0.2 0.2 0")), Contains("1 inverted cell(s)"));
  CHECK_THAT(error(replaced(squares_22, "60 2 1 0", "60 1 0.5 0")),
             Contains("inverted") || Contains("degenerate"));
  CHECK_THAT(
      error(replaced(replaced(squares_22, "$Nodes\n6", "$Nodes\n7"), "60 2 1 0", "60 2 1 0\n70 5 5 0")),
      Contains("1 dangling node(s)") && Contains("node 70 at (5, 5)"));
  CHECK_THAT(
      error(replaced(squares_22, "4 3 2 3 1 20 30 60 50", "4 3 2 3 1 20 30 60 50\n5 3 2 3 1 30 60 50 20")),
      Contains("m.msh:24:") && Contains("$EndElements"));
  CHECK_THAT(error(replaced(replaced(squares_22, "$Elements\n4", "$Elements\n5"), "4 3 2 3 1 20 30 60 50",
                            "4 3 2 3 1 20 30 60 50\n5 3 2 3 1 30 60 50 20")),
             Contains("1 cell(s) that are there twice") &&
                 Contains("(nodes 30 60 50 20) around (1.5, 0.5) repeats another one"));
}

TEST_CASE("Counts that a file cannot hold are refused before memory is asked for") {
  for (const char* count : {"999999999999999999", "1e9", "-1", "99999999999999999999999"}) {
    CAPTURE(count);
    CHECK_FALSE(error(replaced(squares_22, "$Nodes\n6", std::string("$Nodes\n") + count)).empty());
    CHECK_FALSE(error(replaced(squares_22, "$Elements\n4", std::string("$Elements\n") + count)).empty());
    CHECK_FALSE(error(replaced(squares_41, "0 2 1 0", std::string("0 2 1 ") + count)).empty());
    CHECK_FALSE(error(replaced(squares_41, "2 1 0 6", std::string("2 1 0 ") + count)).empty());
    CHECK_FALSE(error(replaced(squares_41, "2 1 3 2", std::string("2 1 3 ") + count)).empty());
  }
  std::string groups = "101";
  for (int i = 1; i <= 101; ++i) groups += fmt::format(" {}", i);
  CHECK_THAT(error(replaced(squares_41, "1 0 1 3 2 1 2", "1 0 " + groups + " 2 1 2")),
             Contains("at most 100"));
  CHECK_THAT(error(replaced(squares_22, "$Nodes\n6", "$Nodes\n999999999")),
             Contains("m.msh:10:") && Contains("the number of nodes is 999999999, but the") &&
                 Contains("truncated"));
}

TEST_CASE("A file truncated anywhere gives an error with its line") {
  for (const std::string& text : {squares_41, squares_22})
    for (std::size_t length = 0; length + 2 < text.size(); ++length) {
      CAPTURE(length);
      CHECK_THAT(error_of([&] { read_gmsh_text(text.substr(0, length), "m.msh"); }), Contains("m.msh:"));
    }
}

TEST_CASE("Files are opened, and their dimension compared with the scene's") {
  const TemporaryFolder folder;
  const std::string path = folder.write("squares.msh", squares_41);
  CHECK(mesh_from_yaml("file: " + path, 2).cell_count() == 2);
  CHECK_THAT(error_of([&] { mesh_from_yaml("file: " + path, 3); }),
             Contains("consists of quadrilaterals and so has dimension 2, but the scene has dimension 3"));
  CHECK_THAT(error_of([&] { mesh_from_yaml("file: " + folder.write("a.stl", ""), 2); }),
             Contains("cannot tell the format"));
  CHECK_THAT(error_of([&] { read_gmsh(folder.path("none.msh")); }),
             Contains("cannot open the mesh file: No such"));
  CHECK_THAT(error_of([&] { read_gmsh(folder.path("")); }), Contains("this is a folder"));
}

TEST_CASE("Faces of more than two cells are reported") {
  // Three triangles on one edge.
  const std::string text = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 -1 0
5 0.5 2 0
$EndNodes
$Elements
3
1 2 0 1 2 3
2 2 0 2 1 4
3 2 0 1 2 5
$EndElements
)";
  CHECK_THAT(error(text),
             Contains("1 face(s) that more than two cells share") && Contains("face with nodes 1 2"));
}
