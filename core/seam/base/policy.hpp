// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "seam/base/diagnostics.hpp"

namespace seam {

/// What a scene may ask for. What asks for more is refused before any memory is taken for it.
struct Limits {
  double cells = 1e8;                                        ///< of a mesh
  double facets = 1e7;                                       ///< of a body's outline
  double unknowns = 1e9;                                     ///< of a field
  double file_bytes = 1e11;                                  ///< of a file that the scene names
  double mesher_seconds = 3600;                              ///< of gmsh on one geometry
  double mesher_bytes = 1.6e10;                              ///< memory of gmsh, and size of its mesh
  double seconds = std::numeric_limits<double>::infinity();  ///< of a run

  /// Those of `--restricted`.
  static Limits strict();
};

/// How far this process trusts the scenes that it reads.
struct Policy {
  bool restricted = false;      ///< scenes open nothing outside their folder, and load no plugin from there
  bool trust_geometry = false;  ///< geometries (.geo) may start programs and open files
  Limits limits;
};

/// The policy of this process: one for all scenes, as a process that has run a stranger's code is lost for
/// all.
const Policy& policy();
/// To be called before the first scene is read.
void set_policy(const Policy& policy);

/// Sets one limit by its name, as in `--limit cells=1e9`.
/// @throws Error listing the names
void set_limit(Limits& limits, const std::string& name, double value);

/// @param limit one of policy().limits @param name of it
/// @param what there is too much of, "cells in the grid"
/// @throws Error with the place, both numbers, and how to raise the limit
void require_within(double found, double limit, const char* name, const std::string& what,
                    const Location& where);

/// Whether a path leads below a folder once all links are followed.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder);

/// A text from a scene or another program as a part of one line of output: control characters become
/// spaces, and what GitHub's runners take for commands is broken up.
std::string on_one_line(std::string text);

}  // namespace seam
