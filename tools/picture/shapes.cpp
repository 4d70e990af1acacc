// SPDX-License-Identifier: BSD-3-Clause
#include "shapes.hpp"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace seam::picture {

namespace {

/// Both surfaces and lines of curved cells are cut into this many pieces per edge.
constexpr int pieces = 8, subdivision_level = 3;
static_assert(pieces == 1 << subdivision_level);

using Edge = std::pair<vtkIdType, vtkIdType>;

/// Edges between parts of one and the same cell of the mesh, which the array "cell" of a cut field tells.
std::set<Edge> edges_within_cells(vtkUnstructuredGrid* grid) {
  std::set<Edge> within;
  vtkDataArray* cell_of = grid->GetCellData()->GetArray("cell");
  std::map<Edge, double> first;
  for (vtkIdType c = 0; cell_of && c < grid->GetNumberOfCells(); ++c) {
    vtkCell* cell = grid->GetCell(c);
    for (int e = 0; e < cell->GetNumberOfEdges(); ++e) {
      vtkIdList* ends = cell->GetEdge(e)->GetPointIds();
      const Edge edge = std::minmax(ends->GetId(0), ends->GetId(1));
      const auto [found, is_new] = first.try_emplace(edge, cell_of->GetTuple1(c));
      if (!is_new && found->second == cell_of->GetTuple1(c)) within.insert(edge);
    }
  }
  return within;
}

}  // namespace

vtkSmartPointer<vtkPolyData> surface_of(vtkUnstructuredGrid* grid) {
  vtkNew<vtkDataSetSurfaceFilter> filter;
  filter->SetInputData(grid);
  filter->SetNonlinearSubdivisionLevel(subdivision_level);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> edges_of(vtkUnstructuredGrid* grid) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  std::set<Edge> done = edges_within_cells(grid);
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    vtkCell* cell = grid->GetCell(c);
    for (int e = 0; e < cell->GetNumberOfEdges(); ++e) {
      vtkCell* edge = cell->GetEdge(e);
      const vtkIdType a = edge->GetPointId(0), b = edge->GetPointId(1);
      if (!done.insert(std::minmax(a, b)).second) continue;
      const bool curved = edge->GetNumberOfPoints() == 3;
      double x[3][3];
      for (int k = 0; k < (curved ? 3 : 2); ++k) grid->GetPoint(edge->GetPointId(k), x[k]);
      const int n = curved ? pieces : 1;
      lines->InsertNextCell(n + 1);
      for (int i = 0; i <= n; ++i) {
        const double s = static_cast<double>(i) / n;
        // Quadratic Lagrange functions; the third point is the middle one.
        const std::array<double, 3> w =
            curved ? std::array{(1 - s) * (1 - 2 * s), s * (2 * s - 1), 4 * s * (1 - s)}
                   : std::array{1 - s, s, 0.0};
        std::array<double, 3> at{};
        for (int k = 0; k < (curved ? 3 : 2); ++k)
          for (int d = 0; d < 3; ++d) at[d] += w[k] * x[k][d];
        lines->InsertCellPoint(points->InsertNextPoint(at.data()));
      }
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetLines(lines);
  return result;
}

vtkSmartPointer<vtkPolyData> outline_of(vtkUnstructuredGrid* grid) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface_of(grid));
  edges->BoundaryEdgesOn();
  edges->FeatureEdgesOn();
  edges->ManifoldEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

}  // namespace seam::picture
