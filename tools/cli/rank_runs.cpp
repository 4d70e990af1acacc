// SPDX-License-Identifier: BSD-3-Clause
#include "rank_runs.hpp"

#include <fmt/format.h>

#include <fstream>

#include "mpirun.hpp"
#include "seam/base/program.hpp"
#include "seam/conformance/scene_checks.hpp"

namespace seam::cli {

std::string first_lines(const std::filesystem::path& log) {
  constexpr int most = 8;
  std::ifstream in(log);
  std::string text;
  int count = 0;
  for (std::string line; count < most && std::getline(in, line);) {
    if (line.empty() || line.starts_with("-----")) continue;
    text += (count++ == 0 ? "" : "\n") + line;
  }
  return text;
}

std::filesystem::path series_on_ranks(const std::filesystem::path& folder, int ranks) {
  return folder / fmt::format("ranks_{}", ranks) / "series.csv";
}

std::optional<ConformanceCheck> run_on_ranks(const std::filesystem::path& scene, const Overrides& overrides,
                                             const std::vector<int>& ranks,
                                             const std::filesystem::path& folder) {
  const std::string name = "independence of the number of ranks";
  if (ranks.size() < 2)
    return ConformanceCheck{name, ConformanceCheck::Outcome::skipped, "only one number of ranks asked for"};
  if (!has_mpirun())
    return ConformanceCheck{name, ConformanceCheck::Outcome::skipped, "there is no mpirun on the PATH"};
  const std::string self = own_executable().string();
  for (const int n : ranks) {
    const std::filesystem::path results = series_on_ranks(folder, n).parent_path();
    std::filesystem::create_directories(results);
    std::vector<std::string> call = mpirun(n);
    call.insert(call.end(),
                {self, "run", scene.string(), "--folder", results.string(), "--quiet", "--no-picture"});
    for (const auto& [key, value] : overrides) call.insert(call.end(), {"--set", key + "=" + value});
    // The scene's own checks are judged elsewhere.
    call.insert(call.end(), {"--set", "checks=[]"});
    if (run_program(call, results / "log.txt") != 0)
      return conformance_check(
          name, false, fmt::format("the run on {} ranks fails:\n{}", n, first_lines(results / "log.txt")));
  }
  return std::nullopt;
}

}  // namespace seam::cli
