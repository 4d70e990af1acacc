// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace seam::picture {

/// Streamlines of a plane vector field, nowhere closer together than `distance` where they start and half of
/// that where they end (after Jobard and Lefer 1997).
/// @param plane whose points carry the array, with three components
vtkSmartPointer<vtkPolyData> streamlines_of(vtkDataSet* plane, const std::string& array, double distance);

}  // namespace seam::picture
