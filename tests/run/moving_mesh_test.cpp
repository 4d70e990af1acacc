// SPDX-License-Identifier: BSD-3-Clause
// Fluids on meshes that move: patches in a background, fitted to bodies.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// A number from the summary of a run.
double result(const Folder& folder, const std::string& where, const std::string& name) {
  return nlohmann::json::parse(folder.read(where + "/summary.json")).at("results").at(name).get<double>();
}

const std::string fitted =
    "run " SEAM_SOURCE_DIR
    "/configs/fsi/pushed_channel_fitted.yaml --quiet --no-picture --set output.fields=false ";

/// What a scene with one changed line says.
std::string refusal(const std::string& change) {
  const Folder folder;
  const Result run = seam(fitted + "--set " + change + " --folder " + folder.path.string());
  CHECK(run.code != 0);
  return run.output;
}

}  // namespace

TEST_CASE("errors in a background and in a patch that moves through it are of second order", "[study]") {
  const Folder folder;
  for (const int n : {10, 20})
    REQUIRE(seam(fmt::format("run " SEAM_SOURCE_DIR
                             "/configs/fluid/patch_vortices.yaml --quiet --no-picture --set "
                             "checks=[] --set parameters.n={0} --folder {1}/{0}",
                             n, folder.path.string()))
                .code == 0);
  for (const std::string name :
       {"velocity.l2", "pressure.l2", "patch_velocity.l2", "patch_pressure.l2", "edge.jump"}) {
    INFO(name);
    CHECK(std::log2(result(folder, "10", name) / result(folder, "20", name)) > 1.8);
  }
  CHECK(std::log2(result(folder, "10", "patch_velocity.h1") / result(folder, "20", "patch_velocity.h1")) >
        0.95);
}

TEST_CASE("a body with a fitted mesh moves alike on any number of ranks, and after a restart",
          "[sanitized]") {
  const Folder folder;
  const auto run = [&](const std::string& where, const std::string& more, const std::string& before = "") {
    const Result result = seam(fitted + more + " --folder " + (folder.path / where).string(), before);
    INFO(result.output);
    REQUIRE(result.code == 0);
  };
  run("1", "");
  run("2", "", "mpirun --oversubscribe -np 2");
  run("3", "--stop-after 11", "mpirun --oversubscribe -np 3");
  run("3", "--resume");
  for (const std::string ranks : {"2", "3"})
    CHECK(difference(folder.read("1/series.csv"), folder.read(ranks + "/series.csv"), 1e-6) < 1e-7);
}

TEST_CASE("what a moving mesh cannot do is said") {
  using Catch::Matchers::Contains;
  CHECK_THAT(refusal("fields.patch.stabilisation=cip"), Contains("found `cip`, expected `residual`"));
  CHECK_THAT(refusal("coupling.1.stress=solid"), Contains("whose mesh moves"));
  CHECK_THAT(refusal("fields.patch.viscosity=0.2"), Contains("are not the same fluid"));
  CHECK_THAT(refusal("interfaces.edge.field=patch --set interfaces.edge.body=pusher"),
             Contains("moves its mesh"));
}
