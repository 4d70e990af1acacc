// SPDX-License-Identifier: BSD-3-Clause
#include "rank_runs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "seam/base/program.hpp"
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

/// What an MPI process finds in its environment about itself, and leaves to its children: an mpirun among
/// them would take itself for a part of that job.
std::vector<std::string> variables_of_outer_job() {
  const std::vector<std::string> marks{"PMIX_",
                                       "OMPI_COMM_",
                                       "OMPI_UNIVERSE_",
                                       "OMPI_APP_",
                                       "OMPI_FIRST_",
                                       "OMPI_NUM_",
                                       "OMPI_ARGV",
                                       "OMPI_COMMAND",
                                       "OMPI_FILE_LOC",
                                       "OMPI_MCA_orte_",
                                       "OMPI_MCA_ess",
                                       "OMPI_MCA_pmix",
                                       "OMPI_MCA_mpi_oversubscribe"};
  std::vector<std::string> names;
  for (char** variable = environ; *variable; ++variable) {
    const std::string entry = *variable;
    const bool marked =
        std::any_of(marks.begin(), marks.end(), [&](const std::string& m) { return entry.starts_with(m); });
    if (marked) names.push_back(entry.substr(0, entry.find('=')));
  }
  return names;
}

}  // namespace

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
  if (!on_path("mpirun"))
    return ConformanceCheck{name, ConformanceCheck::Outcome::skipped, "there is no mpirun on the PATH"};
  const std::string self = own_executable().string();
  for (const int n : ranks) {
    const std::filesystem::path results = series_on_ranks(folder, n).parent_path();
    std::filesystem::create_directories(results);
    std::vector<std::string> call{"env"};
    for (const std::string& variable : variables_of_outer_job()) call.insert(call.end(), {"-u", variable});
    call.insert(call.end(), {"mpirun", "--oversubscribe", "-np", std::to_string(n), self, "run",
                             scene.string(), "--folder", results.string(), "--quiet", "--no-picture"});
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
