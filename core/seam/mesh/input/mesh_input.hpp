// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "seam/mesh/mesh_data.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

/// Keys of one entry of a scene's `meshes`: either `grid` (a generated box) or `file` (Gmsh .msh or
/// .geo, or .vtu).
Schema mesh_schema();

/// Reads or generates a mesh and validates it (see validate_mesh).
/// @throws Error with the place in the scene or in the mesh file.
MeshData load_mesh(const Parameters& parameters);

/// Checks what no later code wants to meet: node numbers in range, no dangling nodes, no degenerate or
/// inverted cell (inverted ones are reported, not turned), no cell twice, no face with more than two cells.
/// @param origin what to name in messages: the file, or the place of the mesh in the scene
/// @param numbers of the nodes in the file, for messages; empty: they count from 0
/// @throws Error listing up to ten offending cells or nodes.
void validate_mesh(const MeshData& mesh, const std::string& origin,
                   const std::vector<long long>& numbers = {});

/// Gmsh 2.2 or 4.1, ASCII; second-order cells become geometry of order 2. Physical groups of the cells'
/// dimension become regions, those one lower become boundaries.
/// @throws Error with file and line.
MeshData read_gmsh(const std::string& path);
/// The same from memory; `name` is used in messages. Entry point of the fuzz target.
MeshData read_gmsh_text(const std::string& text, const std::string& name);

/// The mesh that the program gmsh makes of a geometry (.geo). Such files are programs: use those you trust.
/// @param numbers values for names that the geometry declares by DefineConstant
/// @throws Error with what gmsh says, or when it is not there
MeshData mesh_geometry(const std::string& path, const std::map<std::string, double>& numbers, int dimension);

/// VTU, in any encoding VTK writes (see parse_vtu). Cell array "region" (integer or string) makes regions;
/// outer faces make the boundary "outer".
/// @throws Error with file and, where one is to blame, line.
MeshData read_vtu(const std::string& path);
/// The same from memory; `name` is used in messages.
MeshData read_vtu_text(const std::string& text, const std::string& name);

}  // namespace seam
