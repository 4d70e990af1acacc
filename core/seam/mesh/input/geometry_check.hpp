// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace seam {

/// Refuses a geometry (.geo) that does more than describe shapes and their meshes. Geometries are programs:
/// gmsh's language starts other programs, writes files and opens any. Only words known to be harmless may be
/// followed by a text, a number or another word, so that commands of other versions of gmsh are not let
/// through. `Include` and `Merge` of files below the geometry's folder pass; included geometries are looked
/// at, too.
/// @throws Error with file and line, what was found, and what to do
void require_harmless_geometry(const std::string& path);

}  // namespace seam
