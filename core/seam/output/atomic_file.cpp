// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "seam/base/diagnostics.hpp"

namespace seam {

void write_text_atomically(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".tmp";
  errno = 0;
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) {
    const std::string reason = errno ? std::strerror(errno) : "unknown reason";
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw Error(Location{path}, "cannot write the file: " + reason);
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) throw Error(Location{path}, "cannot put the file in place: " + error.message());
}

}  // namespace seam
