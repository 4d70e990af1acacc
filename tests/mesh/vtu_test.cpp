// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/vtu.hpp"

#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <catch2/catch.hpp>

#include "mesh/mesh_test.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/mesh/input/grid.hpp"
#include "seam/mesh/input/mesh_input.hpp"
#include "seam/output/pvd.hpp"

using namespace seam;
using Catch::Contains;

namespace {

MeshData box(CellType type, int order) {
  Grid grid;
  grid.cell = type;
  grid.order = order;
  for (auto& line : grid.lines) line = {0, 0.5, 2};
  return make_grid(grid);
}

VtuPiece piece_of(const MeshData& m) {
  VtuPiece piece{m.dimension, m.type, m.order, m.coordinates, m.cells, {}, {}, {}};
  piece.point_arrays.push_back({"displacement", m.dimension, m.coordinates, {"x", "y"}});
  VtuArray region{"region", 1, std::vector<double>(m.cell_count(), 4)};
  region.values[0] = 7;
  piece.cell_arrays.push_back(region);
  return piece;
}

/// A small file in plain text.
const std::string ascii = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
  <UnstructuredGrid>
    <Piece NumberOfPoints="4" NumberOfCells="2">
      <CellData><Array type="String" Name="region" format="ascii">97 0 98 99 0</Array></CellData>
      <Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0</DataArray></Points>
      <Cells>
        <DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 0 2 3</DataArray>
        <DataArray type="Int32" Name="offsets" format="ascii">3 6</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">5 5</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

std::string error(const std::string& text) {
  return error_of([&] { validate_mesh(read_vtu_text(text, "m.vtu"), "m.vtu"); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("What write_vtu writes, read_vtu reads") {
  const TemporaryFolder folder;
  for (const CellType type :
       {CellType::triangle, CellType::quadrilateral, CellType::tetrahedron, CellType::hexahedron})
    for (const int order : {1, 2}) {
      CAPTURE(name(type), order);
      const MeshData m = box(type, order);
      write_vtu(folder.path("a.vtu"), piece_of(m));
      const MeshData r = read_vtu(folder.path("a.vtu"));
      CHECK_NOTHROW(validate_mesh(r, "a.vtu"));
      CHECK(r.type == m.type);
      CHECK(r.order == m.order);
      CHECK(r.coordinates == m.coordinates);
      CHECK(r.cells == m.cells);
      CHECK(r.regions.at("7") == std::vector<int>{0});
      CHECK(static_cast<int>(r.regions.at("4").size()) == m.cell_count() - 1);
      std::size_t outer = 0;
      for (const auto& [side, faces] : m.boundaries) outer += faces.size();
      CHECK(r.boundaries.at("outer").size() == outer);
      CHECK_FALSE(std::filesystem::exists(folder.path("a.vtu.tmp")));
    }
}

TEST_CASE("All ways in which VTK writes are read") {
  const TemporaryFolder folder;
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (const auto& p : {std::array{0., 0.}, std::array{1., 0.}, std::array{1., 1.}, std::array{0., 1.}})
    points->InsertNextPoint(p[0], p[1], 0);
  grid->SetPoints(points);
  const vtkIdType nodes[] = {0, 1, 2, 3};
  grid->InsertNextCell(VTK_QUAD, 4, nodes);
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
    for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4})
      for (const int header : {vtkXMLWriter::UInt32, vtkXMLWriter::UInt64})
        for (const bool base64 : {false, true}) {
          CAPTURE(mode, compressor, header, base64);
          vtkNew<vtkXMLUnstructuredGridWriter> writer;
          writer->SetFileName(folder.path("a.vtu").c_str());
          writer->SetInputData(grid);
          writer->SetDataMode(mode);
          writer->SetCompressorType(compressor);
          writer->SetHeaderType(header);
          writer->SetEncodeAppendedData(base64);
          REQUIRE(writer->Write());
          const MeshData m = read_vtu(folder.path("a.vtu"));
          CHECK(m.cells == std::vector<int>{0, 1, 2, 3});
          CHECK(m.coordinates == std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1});
        }
}

TEST_CASE("Regions may have names") {
  const TemporaryFolder folder;
  const MeshData m = read_vtu(folder.write("a.vtu", ascii));
  CHECK(m.regions.at("a") == std::vector<int>{0});
  CHECK(m.regions.at("bc") == std::vector<int>{1});
  CHECK(mesh_from_yaml("file: " + folder.path("a.vtu"), 2).cell_count() == 2);
}

TEST_CASE("A broken VTU file is refused with its reason") {
  const auto with = [&](const std::string& from, const std::string& to) {
    return error(replaced(ascii, from, to));
  };
  CHECK(error(ascii).empty());
  CHECK_THAT(error(""), Contains("m.vtu:1:") && Contains("does not start with <VTKFile>"));
  CHECK_THAT(with("\"UnstructuredGrid\"", "\"PolyData\""),
             Contains("type 'PolyData'; expected UnstructuredGrid"));
  CHECK_THAT(with("LittleEndian", "BigEndian"), Contains("big-endian"));
  CHECK_THAT(with("</VTKFile>", ""), Contains("ends without </VTKFile>"));
  CHECK_THAT(with("Points=\"4\"", "Points=\"999999999999\""),
             Contains("m.vtu:4:") && Contains("more than a file of"));
  CHECK_THAT(with("Points=\"4\"", "Points=\"5\""), Contains("array 'Points' has 12 values; expected 15"));
  CHECK_THAT(with("0 2 3<", "0 2 9<"), Contains("cell 1 names point 9; the mesh has points 0 to 3"));
  CHECK_THAT(with("0 2 3<", "0 2 -1<"), Contains("cell 1 names point -1"));
  CHECK_THAT(with("0 2 3<", "0 2<"), Contains("connectivity has 5 entries; expected 6"));
  CHECK_THAT(with("3 6<", "3 7<"), Contains("the nodes of cell 1 end at offset 7; expected 6"));
  CHECK_THAT(with("5 5<", "5 9<"), Contains("cell 1 has VTK type 9, but cell 0 has type 5"));
  CHECK_THAT(with("5 5<", "23 23<"), Contains("serendipity"));
  CHECK_THAT(with("5 5<", "13 13<"), Contains("cells of VTK type 13"));
  CHECK_THAT(with("5 5<", "x 5<"), Contains("array 'types' holds something that is not a finite number"));
  CHECK_THAT(with("\"types\"", "\"kinds\""), Contains("no array 'types' in <Cells>"));
  CHECK_THAT(with("1 1 0 0 1 0", "1 1 3 0 1 0"), Contains("point 2 of the plane mesh is at z = 3"));
  CHECK_THAT(with("0 1 2 0 2 3<", "0 2 1 0 2 3<"), Contains("inverted"));
  CHECK_THAT(with("98 99 0", "98 99"), Contains("array 'region' has 1 strings; expected 2"));
}

TEST_CASE("A VTU file whose tags do not fit together is refused") {
  const auto with = [](const std::string& from, const std::string& to) {
    return error(replaced(ascii, from, to));
  };
  CHECK_THAT(with("</Cells>", "</Cells></Cells>"), Contains("found </Cells>; expected </Piece>"));
  CHECK_THAT(with("</Piece>", ""), Contains("found </UnstructuredGrid>; expected </Piece>"));
  CHECK_THAT(with("<Cells>", ""), Contains("m.vtu:11: error: found </Cells>; expected </Piece>"));
  CHECK_THAT(with("<Points>", "<Points/>"), Contains("found </Points>; expected </Piece>"));
  CHECK_THAT(with("</VTKFile>", "</VTKFile></VTKFile>"), Contains("expected nothing more"));
  CHECK_THAT(with("<VTKFile ", "<?xml version=\"1.0\"?>\n<VTKFile "),
             Contains("the XML declaration stands within the file"));
  CHECK_THAT(with("\"0.1\"", "\"0.\x1b\""), Contains("attribute 'version' holds a control character"));
  CHECK_THAT(with("byte_order", "byte\x1b_order"),
             Contains("m.vtu:2: error: a name in this XML tag holds a character"));
  CHECK_THAT(with("\"0.1\"", "\"0&1\""), Contains("attribute 'version' holds '&'"));
  CHECK_THAT(with("Name=\"offsets\"", "Name=\"offsets\" Name=\"types\""),
             Contains("m.vtu:9: error: this XML tag has the attribute 'Name' twice"));
}

TEST_CASE("A VTU file truncated or damaged anywhere never does harm") {
  const TemporaryFolder folder;
  write_vtu(folder.path("a.vtu"), piece_of(box(CellType::quadrilateral, 1)));
  const std::string whole = contents(folder.path("a.vtu"));
  CHECK_THAT(error(replaced(whole, "</AppendedData>", "")),
             Contains("ends without </AppendedData></VTKFile>"));
  CHECK_THAT(error(replaced(whole, "</UnstructuredGrid>", "")),
             Contains("within <UnstructuredGrid>; expected them within <VTKFile>"));
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    INFO(length);
    CHECK_FALSE(error(whole.substr(0, length)).empty());
  }
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const char c : {'\0', '\xff'}) {
      std::string damaged = whole;
      damaged[at] = c;
      CHECK_NOTHROW(error(damaged));  // an Error or a mesh, nothing else
    }
}

TEST_CASE("A file that cannot be written is an error, and contradictions are found") {
  const VtuPiece piece = piece_of(box(CellType::triangle, 1));
  CHECK_THAT(error_of([&] { write_vtu("/nonexistent/a.vtu", piece); }),
             Contains("/nonexistent/a.vtu") && Contains("cannot write the file"));
  VtuPiece wrong = piece;
  wrong.point_arrays[0].values.pop_back();
  CHECK_THROWS_AS(write_vtu("a.vtu", wrong), std::logic_error);
  wrong = piece;
  wrong.connectivity[0] = 1000;
  CHECK_THROWS_AS(write_vtu("a.vtu", wrong), std::logic_error);
}

TEST_CASE("Pieces are named whatever letters their files' names have") {
  const TemporaryFolder folder;
  const std::string path = folder.path("run.pvtu");
  write_pvtu(path, {"a & \"b\"<c>.vtu"}, piece_of(box(CellType::triangle, 1)));
  std::ifstream stream(path);
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  CHECK_THAT(text, Contains("<Piece Source=\"a &amp; &quot;b&quot;&lt;c&gt;.vtu\"/>"));
}

TEST_CASE("A series of files goes on after a restart") {
  const TemporaryFolder folder;
  const std::string path = folder.path("run.pvd");
  PvdSeries first(path);
  first.add(0, "run_0.vtu");
  first.add(0.1, "run_1.vtu");
  first.add(0.30000000000000004, "a & \"b\".vtu");
  CHECK(PvdSeries::resume(path, 1).entries() == first.entries());
  PvdSeries second = PvdSeries::resume(path, 0.1);
  CHECK(second.entries().size() == 2);
  second.add(0.2, "run_2.vtu");
  CHECK(PvdSeries::resume(path, 1).entries().back() == std::pair<double, std::string>(0.2, "run_2.vtu"));
  CHECK(PvdSeries::resume(folder.path("none.pvd"), 1).entries().empty());
  CHECK_THAT(error_of([&] { PvdSeries::resume(folder.write("x.pvd", "hello"), 1); }),
             Contains("not a complete .pvd"));
}
