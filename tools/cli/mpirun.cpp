// SPDX-License-Identifier: BSD-3-Clause
#include "mpirun.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

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

bool has_mpirun() { return on_path("mpirun"); }

std::vector<std::string> mpirun(int ranks) {
  std::vector<std::string> words;
  for (const std::string& variable : variables_of_outer_job()) words.insert(words.end(), {"-u", variable});
  if (!words.empty()) words.insert(words.begin(), "env");
  words.insert(words.end(), {"mpirun", "--oversubscribe", "-np", std::to_string(ranks)});
  return words;
}

}  // namespace seam::cli
