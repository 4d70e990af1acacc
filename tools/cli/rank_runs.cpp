// SPDX-License-Identifier: BSD-3-Clause
#include "rank_runs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "program.hpp"
#include "seam/conformance/scene_checks.hpp"

namespace seam::cli {
namespace {

bool on_path(const std::string& program) {
  const char* variable = std::getenv("PATH");
  std::istringstream folders(variable ? variable : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

std::string last_lines(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  std::string text;
  for (std::size_t k = lines.size() > 8 ? lines.size() - 8 : 0; k < lines.size(); ++k)
    text += (text.empty() ? "" : "\n") + lines[k];
  return text;
}

}  // namespace

ConformanceCheck run_on_ranks(const std::filesystem::path& scene, const Overrides& overrides,
                              const std::vector<int>& ranks, const std::filesystem::path& folder) {
  const std::string name = "independence of the number of ranks";
  if (ranks.size() < 2)
    return {name, ConformanceCheck::Outcome::skipped, "only one number of ranks asked for"};
  if (!on_path("mpirun")) return {name, ConformanceCheck::Outcome::skipped, "there is no mpirun on the PATH"};
  const std::string self = own_executable().string();
  std::vector<std::filesystem::path> files;
  for (const int n : ranks) {
    const std::filesystem::path results = folder / fmt::format("ranks_{}", n);
    std::filesystem::create_directories(results);
    std::vector<std::string> call{"mpirun",      "--oversubscribe", "-np",      std::to_string(n), self,
                                  "run",         scene.string(),    "--folder", results.string(),  "--quiet",
                                  "--no-picture"};
    for (const auto& [key, value] : overrides) call.insert(call.end(), {"--set", key + "=" + value});
    // The scene's own checks are judged elsewhere.
    call.insert(call.end(), {"--set", "checks=[]"});
    if (run_program(call, results / "log.txt") != 0)
      return conformance_check(
          name, false, fmt::format("the run on {} ranks fails:\n{}", n, last_lines(results / "log.txt")));
    files.push_back(results / "series.csv");
  }
  return check_ranks(files, ranks);
}

}  // namespace seam::cli
