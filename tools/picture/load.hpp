// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>

#include "options.hpp"

namespace seam::picture {

/// One body, ready to be drawn.
struct Body {
  vtkSmartPointer<vtkUnstructuredGrid> reference;  ///< as in the file
  vtkSmartPointer<vtkUnstructuredGrid> current;  ///< displaced; scalars (if any) are the values to colour by
  bool coloured = false;
  bool cell_values = false;
  bool sliced = false;  ///< the plane of a spatial result, not all of it
};

/// Reads a result and prepares it.
/// @throws Error when the file cannot be read or has no such array
Body load_body(const std::string& file, const Options& options);

}  // namespace seam::picture
