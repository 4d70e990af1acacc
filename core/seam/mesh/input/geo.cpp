// SPDX-License-Identifier: BSD-3-Clause
// Geometries that the program gmsh meshes when a scene is read.
#include <fmt/format.h>

#include <cctype>
#include <csignal>
#include <sstream>

#include "seam/base/policy.hpp"
#include "seam/base/program.hpp"
#include "seam/mesh/input/geometry_check.hpp"
#include "seam/mesh/input/mesh_input.hpp"
#include "seam/mesh/input/read_text.hpp"

namespace seam {

namespace {

/// Whether a name occurs in a text as a word of its own.
bool has_word(const std::string& text, const std::string& name) {
  const auto letter = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if ((at == 0 || !letter(at - 1)) && !letter(at + name.size())) return true;
  return false;
}

/// What another program has printed, within a message of ours: its lines must not look like ours.
std::string quoted_lines(const std::string& output) {
  std::string result;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) result += "\n  gmsh: " + on_one_line(line);
  return result;
}

}  // namespace

MeshData mesh_geometry(const std::string& path, const std::map<std::string, double>& numbers, int dimension) {
  if (!policy().trust_geometry) require_harmless_geometry(path);
  const std::string geometry = read_text(path);
  const NamelessFile mesh, log;
  std::vector<std::string> command = {"gmsh",     path.starts_with('-') ? "./" + path : path,
                                      "-nopopup", "-v",
                                      "2",        fmt::format("-{}", dimension),
                                      "-format",  "msh41",
                                      "-o",       mesh.path()};
  for (const auto& [name, value] : numbers) {
    if (!has_word(geometry, name))
      throw Error(Location{path}, fmt::format("the geometry has no number '{}' that could be set; declare it "
                                              "there: DefineConstant[ {} = {:g} ];",
                                              name, name, value));
    command.insert(command.end(), {"-setnumber", name, fmt::format("{:.17g}", value)});
  }
  const Limits& limits = policy().limits;
  const int code =
      run_program(command, log, {limits.mesher_seconds, limits.mesher_bytes, limits.mesher_bytes});
  if (code == 127)
    throw Error(Location{path},
                "the program gmsh cannot be started; install it (Debian: gmsh), or mesh the "
                "geometry elsewhere and name the .msh file");
  if (code == timed_out || code == 128 + SIGXCPU)
    throw Error(
        Location{path},
        fmt::format("gmsh has not meshed this geometry within {:g} s and was ended; does it loop for ever? "
                    "Else allow more by --limit mesher_seconds=...",
                    limits.mesher_seconds));
  const std::string output = log.read();
  if (code != 0 || output.find("Error") != std::string::npos)
    throw Error(Location{path}, fmt::format("gmsh cannot mesh this geometry (exit code {}{}):{}", code,
                                            code > 128 ? ", ended by a signal: its limits are "
                                                         "--limit mesher_bytes and mesher_seconds"
                                                       : "",
                                            quoted_lines(output)));
  return read_gmsh_text(mesh.read(), path + " (its mesh)");
}

}  // namespace seam
