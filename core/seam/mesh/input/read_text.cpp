// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/read_text.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "seam/base/diagnostics.hpp"

namespace seam {

std::string read_text(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(Location{path}, "this is a folder; expected a mesh file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(Location{path}, std::string("cannot open the mesh file: ") + std::strerror(errno));
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad())
    throw Error(Location{path}, std::string("cannot read the mesh file: ") + std::strerror(errno));
  return text;
}

}  // namespace seam
