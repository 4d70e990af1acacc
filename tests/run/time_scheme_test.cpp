// SPDX-License-Identifier: BSD-3-Clause
// The time schemes against the exact motion of configs/solid/oscillator.yaml.
#include <cmath>
#include <sstream>

#include "cli/run_command.hpp"
#include "run/series.hpp"

using namespace seam_cli_test;

namespace {

/// Error of x = 0.1 sin(2t) at t = 1, after steps that are alternately twice as long and half as long as the
/// one before.
double error(const Folder& folder, const std::string& scheme, int pairs) {
  std::ostringstream steps, call;
  steps << "time\n0\n";
  for (int k = 0; k < pairs; ++k) steps << (k + 1.0 / 3) / pairs << "\n" << (k + 1.0) / pairs << "\n";
  call << "run " SEAM_SOURCE_DIR "/configs/solid/oscillator.yaml --quiet --set " << scheme
       << " --set time.step.replay=" << folder.file("steps.csv", steps.str()) << " --set time.step.initial=1"
       << " --folder " << folder.path.string();
  const Result run = seam(call.str());
  INFO(run.output);
  const std::vector<double> x = column(folder.read("series.csv"), "centre.x");
  REQUIRE(x.size() == 2 * static_cast<std::size_t>(pairs) + 1);
  return std::abs(x.back() - 0.1 * std::sin(2.0));
}

}  // namespace

TEST_CASE(
    "BDF2 and the trapezoidal rule are of second order with steps of any length, implicit Euler of first") {
  const Folder folder;
  const auto order = [&](const std::string& scheme) {
    return std::log2(error(folder, scheme, 40) / error(folder, scheme, 80));
  };
  CHECK(order("time.theta=1") == Approx(1).margin(0.1));
  CHECK(order("time.theta=0.5") == Approx(2).margin(0.1));
  CHECK(order("time.theta=1 --set time.scheme=bdf2") == Approx(2).margin(0.1));
}

TEST_CASE("BDF2 takes no theta") {
  const Folder folder;
  const Result run =
      seam("run " SEAM_SOURCE_DIR "/configs/solid/oscillator.yaml --set time.scheme=bdf2 --folder " +
           folder.path.string());
  CHECK(run.code != 0);
  CHECK_THAT(run.output, Catch::Contains("BDF2 has no theta"));
}
