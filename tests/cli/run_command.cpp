// SPDX-License-Identifier: BSD-3-Clause
#include "run_command.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>

namespace seam_cli_test {

const std::string without_own_mpi =
    "env $(env | sed -nE 's/^((OMPI|PMIX|OPAL)_[A-Za-z0-9_]*)=.*/-u \\1/p' | "
    "grep -vE '_(ALLOW_RUN.*|MCA_(pml|mpi_yield_when_idle|btl_vader_single_copy_mechanism))$') "
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ";

Result seam(const std::string& arguments, const std::string& before) {
  const std::string command = without_own_mpi + "SEAM_PLUGIN_PATH=" SEAM_TEST_PLUGINS " " + before +
                              " " SEAM_COMMAND " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  Result result{-1, ""};
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  return result;
}

Folder::Folder()
    : path(std::filesystem::temp_directory_path() / ("seam_cli_" + std::to_string(std::random_device{}()))) {
  std::filesystem::create_directories(path);
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}

std::string Folder::file(const std::string& name, const std::string& text) const {
  std::ofstream(path / name) << text;
  return (path / name).string();
}

std::string Folder::read(const std::string& name) const {
  std::ifstream in(path / name);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace seam_cli_test
