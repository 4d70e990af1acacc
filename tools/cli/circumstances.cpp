// SPDX-License-Identifier: BSD-3-Clause
#include "circumstances.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "seam/base/program.hpp"

namespace seam::cli {
namespace {

namespace fs = std::filesystem;

/// The first line of a file of the form "key : value" with that key; "" when there is none.
std::string line_of(const fs::path& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t value = line.find_first_not_of(" \t", line.find(':') + 1);
    return value == std::string::npos ? "" : line.substr(value);
  }
  return "";
}

std::string machine() {
  utsname name{};
  uname(&name);
  const std::string model = line_of("/proc/cpuinfo", "model name");
  const std::string release = std::string(name.release).substr(0, std::string(name.release).find('-'));
  return fmt::format("{} {} {}, {}{} cores", name.sysname, release, name.machine,
                     model.empty() ? "" : model + ", ", std::thread::hardware_concurrency());
}

/// The commit of the folder a file lies in; "unknown" where git refuses to look, as in a folder of another
/// user. The configuration of a repository may name programs that git then runs: none of them is.
std::string commit(const fs::path& file) {
  const std::vector<std::string> git{"env",
                                     "GIT_ALLOW_PROTOCOL=none",
                                     "GIT_OPTIONAL_LOCKS=0",
                                     "git",
                                     "--no-pager",
                                     "-c",
                                     "core.fsmonitor=false",
                                     "-c",
                                     "core.hooksPath=/dev/null",
                                     "-c",
                                     "safe.bareRepository=explicit",
                                     "-C",
                                     fs::absolute(file).parent_path().string()};
  const auto ask = [&](std::vector<std::string> words) {
    words.insert(words.begin(), git.begin(), git.end());
    return program_output(words);
  };
  const std::string hash = ask({"rev-parse", "--short=12", "HEAD"});
  if (hash.empty()) return "unknown";
  // Filters have names of their own, so that none can be turned off unseen; those of the user's own
  // configuration are the user's.
  const auto filters = [&](const char* scope) {
    return ask({"config", scope, "--includes", "--name-only", "--get-regexp", "^filter\\."});
  };
  if (!filters("--local").empty() || !filters("--worktree").empty())
    return hash + " (changes unknown: the repository runs filters)";
  const bool is_changed =
      !ask({"status", "--porcelain", "--untracked-files=no", "--ignore-submodules=all"}).empty();
  return hash + (is_changed ? " with changes" : "");
}

}  // namespace

std::vector<std::pair<std::string, std::string>> circumstances(const fs::path& file,
                                                               const std::string& fingerprint) {
  const auto now = std::chrono::system_clock::now();
  return {{"machine", machine()},
          {"commit", commit(file)},
          {"date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(now))},
          {"versions", fmt::format("Seam {}, {}", SEAM_VERSION, fingerprint)}};
}

}  // namespace seam::cli
