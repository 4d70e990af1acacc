// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/vtu.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <stdexcept>

#include "seam/base/diagnostics.hpp"
#include "seam/output/atomic_file.hpp"
#include "seam/output/xml_escape.hpp"

namespace seam {

namespace {

int vtk_type(CellType type, int order) {
  switch (type) {
    case CellType::point:
      return VTK_VERTEX;
    case CellType::segment:
      return order == 1 ? VTK_LINE : VTK_QUADRATIC_EDGE;
    case CellType::triangle:
      return order == 1 ? VTK_TRIANGLE : VTK_QUADRATIC_TRIANGLE;
    case CellType::quadrilateral:
      return order == 1 ? VTK_QUAD : VTK_BIQUADRATIC_QUAD;
    case CellType::tetrahedron:
      return order == 1 ? VTK_TETRA : VTK_QUADRATIC_TETRA;
    case CellType::hexahedron:
      return order == 1 ? VTK_HEXAHEDRON : VTK_TRIQUADRATIC_HEXAHEDRON;
  }
  throw std::logic_error("seam::write_vtu: not a cell type");
}

/// Components in the file: plane vectors become spatial ones.
int written_components(int components) { return components == 2 ? 3 : components; }

void add_array(vtkFieldData* to, const VtuArray& array, std::size_t tuples) {
  if (array.components < 1 || array.values.size() != tuples * array.components)
    throw std::logic_error(fmt::format("seam::write_vtu: array '{}' has {} values; expected {} tuples of {}",
                                       array.name, array.values.size(), tuples, array.components));
  const int n = written_components(array.components);
  vtkNew<vtkDoubleArray> values;
  values->SetName(array.name.c_str());
  values->SetNumberOfComponents(n);
  values->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  for (std::size_t k = 0; k < array.component_names.size(); ++k)
    values->SetComponentName(static_cast<vtkIdType>(k), array.component_names[k].c_str());
  double* out = values->GetPointer(0);
  for (std::size_t t = 0; t < tuples; ++t)
    for (int k = 0; k < n; ++k) *out++ = k < array.components ? array.values[t * array.components + k] : 0.0;
  to->AddArray(values);
}

/// Adds cells of `nodes` points each, all of one type.
void add_cells(const std::vector<int>& connectivity, int nodes, int type, std::size_t point_count,
               vtkCellArray* cells, vtkUnsignedCharArray* types) {
  if (connectivity.size() % nodes)
    throw std::logic_error("seam::write_vtu: the connectivity is not whole tuples");
  for (std::size_t at = 0; at < connectivity.size(); at += nodes) {
    cells->InsertNextCell(nodes);
    types->InsertNextValue(static_cast<unsigned char>(type));
    for (int a = 0; a < nodes; ++a) {
      const int point = connectivity[at + a];
      if (point < 0 || static_cast<std::size_t>(point) >= point_count)
        throw std::logic_error(
            fmt::format("seam::write_vtu: a cell names point {} of {}", point, point_count));
      cells->InsertCellPoint(point);
    }
  }
}

vtkNew<vtkUnstructuredGrid> make_grid(const VtuPiece& piece) {
  const int dim = piece.dimension;
  if (dim < 2 || dim > 3 || piece.points.size() % dim)
    throw std::logic_error("seam::write_vtu: the points are not whole tuples");
  const std::size_t point_count = piece.points.size() / dim;

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(point_count));
  for (std::size_t p = 0; p < point_count; ++p) {
    const double* x = &piece.points[p * dim];
    points->SetPoint(static_cast<vtkIdType>(p), x[0], x[1], dim == 3 ? x[2] : 0.0);
  }
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> types;
  add_cells(piece.connectivity, topology(piece.type).nodes(piece.order), vtk_type(piece.type, piece.order),
            point_count, cells, types);
  add_cells(piece.simplices, dim + 1, dim == 2 ? VTK_TRIANGLE : VTK_TETRA, point_count, cells, types);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(types, cells);
  const auto cell_count = static_cast<std::size_t>(cells->GetNumberOfCells());
  for (const auto& array : piece.point_arrays) add_array(grid->GetPointData(), array, point_count);
  for (const auto& array : piece.cell_arrays) add_array(grid->GetCellData(), array, cell_count);
  return grid;
}

std::string parallel_arrays(const char* section, const std::vector<VtuArray>& arrays) {
  std::string text = fmt::format("    <{}>\n", section);
  for (const auto& array : arrays) {
    text += fmt::format("      <PDataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\"",
                        xml_escape(array.name), written_components(array.components));
    for (std::size_t k = 0; k < array.component_names.size(); ++k)
      text += fmt::format(" ComponentName{}=\"{}\"", k, xml_escape(array.component_names[k]));
    text += "/>\n";
  }
  return text + fmt::format("    </{}>\n", section);
}

}  // namespace

void write_vtu(const std::string& path, const VtuPiece& piece) {
  const auto grid = make_grid(piece);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  // To memory: VTK reports a full disk or a missing folder on the terminal, and then returns success.
  writer->WriteToOutputStringOn();
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  // Level 1 is several times faster than the default and hardly larger on floating-point data.
  writer->SetCompressionLevel(1);
  if (!writer->Write()) throw Error(Location{path}, "VTK cannot write this grid");
  write_text_atomically(path, writer->GetOutputString());
}

void write_pvtu(const std::string& path, const std::vector<std::string>& pieces, const VtuPiece& like) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  text += parallel_arrays("PPointData", like.point_arrays) + parallel_arrays("PCellData", like.cell_arrays);
  text +=
      "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n    "
      "</PPoints>\n";
  for (const auto& piece : pieces) text += fmt::format("    <Piece Source=\"{}\"/>\n", xml_escape(piece));
  write_text_atomically(path, text + "  </PUnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace seam
