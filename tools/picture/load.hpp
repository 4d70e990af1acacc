// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "options.hpp"

namespace seam::picture {

/// One body, ready to be drawn.
struct Body {
  vtkSmartPointer<vtkUnstructuredGrid> reference;  ///< as in the file
  vtkSmartPointer<vtkUnstructuredGrid> current;  ///< displaced; scalars (if any) are the values to colour by
  bool coloured = false;
  bool displaced = false;
  bool cell_values = false;
  bool sliced = false;  ///< the plane of a spatial result, not all of it
};

/// Reads the results and prepares them. One that has no array for the colour stays grey, one that has none
/// for the displacement stays where it is: a fluid knows no displacement.
/// @throws Error when a file cannot be read or none has such an array
std::vector<Body> load_bodies(const Options& options);

}  // namespace seam::picture
