// SPDX-License-Identifier: BSD-3-Clause
// Geometries that the program gmsh meshes when a scene is read.
#include <fmt/format.h>
#include <stdlib.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "seam/base/program.hpp"
#include "seam/mesh/input/mesh_input.hpp"
#include "seam/mesh/input/read_text.hpp"

namespace seam {

namespace {

/// A folder of this process alone, gone with this object.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((std::filesystem::temp_directory_path() / "seam-mesh-XXXXXX").string()) {
    if (!mkdtemp(path_.data()))
      throw Error(fmt::format("cannot make a temporary folder '{}': {}", path_, std::strerror(errno)));
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string operator/(const char* file) const { return path_ + "/" + file; }

 private:
  std::string path_;
};

/// Whether a name occurs in a text as a word of its own.
bool has_word(const std::string& text, const std::string& name) {
  const auto letter = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if ((at == 0 || !letter(at - 1)) && !letter(at + name.size())) return true;
  return false;
}

}  // namespace

MeshData mesh_geometry(const std::string& path, const std::map<std::string, double>& numbers, int dimension) {
  const std::string geometry = read_text(path);
  const TemporaryFolder folder;
  const std::string mesh = folder / "mesh.msh", log = folder / "log";
  std::vector<std::string> command = {
      "gmsh", path, "-nopopup", "-v", "2", fmt::format("-{}", dimension), "-format", "msh41", "-o", mesh};
  for (const auto& [name, value] : numbers) {
    if (!has_word(geometry, name))
      throw Error(Location{path}, fmt::format("the geometry has no number '{}' that could be set; declare it "
                                              "there: DefineConstant[ {} = {:g} ];",
                                              name, name, value));
    command.insert(command.end(), {"-setnumber", name, fmt::format("{:.17g}", value)});
  }
  const int code = run_program(command, log);
  if (code == 127)
    throw Error(Location{path},
                "the program gmsh cannot be started; install it (Debian: gmsh), or mesh the "
                "geometry elsewhere and name the .msh file");
  const std::string output = read_text(log);
  if (code != 0 || output.find("Error") != std::string::npos)
    throw Error(Location{path},
                fmt::format("gmsh cannot mesh this geometry (exit code {}):\n{}", code, output));
  return read_gmsh_text(read_text(mesh), path + " (its mesh)");
}

}  // namespace seam
