// SPDX-License-Identifier: BSD-3-Clause
// How Newton's method converges where bodies cut the mesh.
#include <algorithm>
#include <cli/run_command.hpp>
#include <nlohmann/json.hpp>
#include <vector>

using namespace seam_cli_test;

namespace {

nlohmann::json run(const std::string& scene, const std::string& overrides) {
  const Folder folder;
  const Result result =
      seam("run " SEAM_SOURCE_DIR "/configs/fsi/" + scene +
           " --quiet --no-picture --set output.fields=false --folder " + folder.path.string() + overrides);
  INFO(result.output);
  auto summary = nlohmann::json::parse(folder.read("summary.json"));
  REQUIRE(summary.at("status") == "finished");
  return summary;
}

/// Of all pairs of successive residuals r in steps in which no unknown came or went: the largest next/r^2,
/// from where Newton's method should have settled down to rounding.
struct Convergence {
  double worst = 0;
  int pairs = 0;
};
Convergence convergence(const nlohmann::json& summary) {
  Convergence result;
  for (const auto& step : summary.at("newton")) {
    const auto& iterations = step.at("iterations");
    bool is_fixed = true;
    for (std::size_t k = 1; k < iterations.size(); ++k)
      is_fixed = is_fixed && !iterations[k].at("space_changed").get<bool>();
    for (std::size_t k = 2; is_fixed && k < iterations.size(); ++k) {
      const double before = iterations[k - 1].at("residual"), after = iterations[k].at("residual");
      // Above, it may still be on its way; below, rounding takes over.
      if (before > 1e-3 || before < 3e-7) continue;
      result.worst = std::max(result.worst, after / (before * before));
      ++result.pairs;
    }
  }
  return result;
}

}  // namespace

TEST_CASE("Newton's method converges quadratically with a fixed cut and with a moving one") {
  const auto check = [](const std::string& scene, const std::string& overrides) {
    const Convergence quadratic = convergence(run(scene, overrides));
    INFO(scene << overrides);
    CHECK(quadratic.pairs >= 5);
    CHECK(quadratic.worst < 200);
  };
  // A flap that does not yield: what is left is the convection of the fluid.
  check("added_mass.yaml", " --set parameters.E=1e6 --set parameters.step=0.1");
  check("released_disc.yaml", " --set time.end=0.2");
  // Without the shape derivatives the moving cut is followed linearly.
  const Convergence linear = convergence(
      run("released_disc.yaml", " --set time.end=0.2 --set solver.newton.shape_derivatives=false"));
  CHECK(linear.pairs >= 5);
  CHECK(linear.worst > 1e4);
}

TEST_CASE("a body without mass moves as one of hardly any") {
  const auto tip = [](const std::string& ratio) {
    const auto summary = run("added_mass.yaml", " --set time.end=0.3 --set parameters.ratio=" + ratio);
    CHECK(summary.at("rejected_steps") == 0);
    return summary.at("results").at("tip.x").get<double>();
  };
  const double light = tip("1e-5");
  // Without inertia a step starts where the body is, not where it would fly: the cut that the trace size is
  // taken from differs by the motion in a step. (7e-4; with half and a quarter of the step 3e-4 and 1.5e-4.)
  CHECK(tip("0") == Approx(light).epsilon(2e-3));
  CHECK(light > 0.01);
}

TEST_CASE("stiffness and viscosity over eight decades do not break Newton's method") {
  for (const std::string viscosity : {"1e-4", "1e4"})
    for (const std::string young : {"1", "1e8"}) {
      const auto summary =
          run("contrast.yaml", " --set parameters.mu=" + viscosity + " --set parameters.E=" + young);
      INFO("viscosity " << viscosity << ", Young's modulus " << young);
      CHECK(summary.at("rejected_steps") == 0);
      CHECK(summary.at("results").at("newton.iterations.median") <= 4);
      CHECK(summary.at("results").at("newton.iterations.most") <= 6);
    }
}
