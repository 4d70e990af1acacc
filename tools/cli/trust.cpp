// SPDX-License-Identifier: BSD-3-Clause
// How far a process trusts the scenes it reads: --restricted, --trust-geometry, --limit.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdlib>

#include "command.hpp"
#include "seam/base/policy.hpp"

namespace seam::cli {
namespace {

std::vector<std::string> words;

/// Of a signal handler: says why the process ends.
void end_for_lack_of_time(int) {
  constexpr char message[] =
      "error: the processor time that --restricted allows is used up (--limit seconds=...)\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof message - 1);
  _exit(out_of_time);
}

/// What no check of ours foresees ends with the process.
void confine_process(const Limits& limits) {
  // Set-up and output come on top of the steps, which --limit seconds ends in good order.
  constexpr double grace = 60;
  std::signal(SIGXCPU, end_for_lack_of_time);
  const auto at_most = [](decltype(RLIMIT_CPU) resource, double value) {
    rlimit bounds{};
    if (!std::isfinite(value) || getrlimit(resource, &bounds) != 0) return;
    bounds.rlim_cur = std::min(bounds.rlim_cur, static_cast<rlim_t>(std::min(value, 9e18)));
    setrlimit(resource, &bounds);
  };
  at_most(RLIMIT_CPU, limits.seconds + grace);
  at_most(RLIMIT_CORE, 0);
}

}  // namespace

void Trust::add_options(CommandLine& line) {
  line.add_flag(
      "--restricted", restricted_,
      "for scenes of strangers: nothing outside the scene's folder is read, no geometry (.geo) and none but "
      "installed plugins are run, and limits are tight");
  line.add_flag("--trust-geometry", trust_geometry_, "let geometries (.geo) start programs and open files");
  line.add_option("--limit", limits_,
                  "another limit: NAME=NUMBER with cells, facets, unknowns, file_bytes, mesher_seconds, "
                  "mesher_bytes or "
                  "seconds; may be repeated")
      .take_all()
      .one_word_each();
}

void Trust::apply() const {
  Policy policy;
  policy.restricted = restricted_;
  policy.trust_geometry = trust_geometry_;
  if (restricted_) policy.limits = Limits::strict();
  if (restricted_) words.emplace_back("--restricted");
  if (trust_geometry_) words.emplace_back("--trust-geometry");
  if (restricted_ && trust_geometry_)
    throw Error("error: --restricted and --trust-geometry contradict each other; leave one of them out");
  for (const std::string& text : limits_) {
    const std::size_t equals = text.find('=');
    double value = 0;
    const char* last = text.data() + text.size();
    const char* first = equals == std::string::npos ? last : text.data() + equals + 1;
    const auto [end, code] = std::from_chars(first, last, value);
    if (code != std::errc{} || end != last || !(value > 0))
      throw Error(fmt::format(
          "error: --limit {}: expected NAME=NUMBER with a number above 0, as in --limit cells=1e9", text));
    try {
      set_limit(policy.limits, text.substr(0, equals), value);
    } catch (const Error& error) {
      throw Error(fmt::format("error: --limit {}: {}", text, error.what()));
    }
    words.insert(words.end(), {"--limit", text});
  }
  set_policy(policy);
  if (!restricted_) return;
  // Folders that the environment names are not installed plugins.
  unsetenv("SEAM_PLUGIN_PATH");
  confine_process(policy.limits);
}

std::vector<std::string> trust_as_words() { return words; }

}  // namespace seam::cli
