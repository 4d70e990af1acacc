// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace seam::picture {

/// The outer surface (in a plane: all cells) with values, curved cells finely subdivided.
vtkSmartPointer<vtkPolyData> surface_of(vtkUnstructuredGrid* grid);
/// All edges of cells, those of curved cells as smooth lines.
vtkSmartPointer<vtkPolyData> edges_of(vtkUnstructuredGrid* grid);
/// The contour of a plane body, or the sharp edges of a spatial one.
vtkSmartPointer<vtkPolyData> outline_of(vtkUnstructuredGrid* grid);

}  // namespace seam::picture
