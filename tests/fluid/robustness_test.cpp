// SPDX-License-Identifier: BSD-3-Clause
// Cut flows over decades of penalties, of viscosity and of the time step.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "cut_flow.hpp"
#include "seam/record/checks.hpp"

using namespace seam;
using namespace seam::test;

namespace {

CutErrors vortex_errors(const std::string& field, const std::string& coupling) {
  return errors_of(
      BodyInFlow{.exact = vortices("1", "0"), .cells = 16, .field = field, .coupling = coupling});
}

/// Errors over those of the usual parameters.
void stays_below(double factor, const CutErrors& errors, const CutErrors& usual) {
  INFO("v " << errors.velocity / usual.velocity << ", grad v " << errors.gradient / usual.gradient << ", p "
            << errors.pressure / usual.pressure);
  CHECK(errors.velocity < factor * usual.velocity);
  CHECK(errors.gradient < factor * usual.gradient);
  CHECK(errors.pressure < factor * usual.pressure);
}

}  // namespace

TEST_CASE("errors of a cut flow stay bounded over decades of all penalties", "[study]") {
  // The defaults' own errors are smaller than those of the sets of the thesis, which bound them, too.
  const auto [stabilisation, compared] =
      GENERATE(table<std::string, std::string>({{"thesis", "thesis"},
                                                {"cip", "thesis"},
                                                {"residual_thesis", "residual_thesis"},
                                                {"residual", "residual_thesis"}}));
  const std::string field = "stabilisation: " + stabilisation;
  const CutErrors usual = vortex_errors("stabilisation: " + compared, "");
  stays_below(1.001, vortex_errors(field, ""), usual);
  for (const double factor : {1e-2, 1e-1, 1e1, 1e2}) {
    INFO(stabilisation << ", times " << factor);
    {
      INFO("Nitsche's penalty");
      stays_below(3,
                  vortex_errors(field, fmt::format("penalty: {{normal: {0}, tangential: {0}}}", 35 * factor)),
                  usual);
    }
    {
      INFO("ghost penalty");
      const std::string ghost =
          fmt::format("\nghost_penalty: {{viscous: {}, transient: {}, second_order: {}}}", 0.1 * factor,
                      0.001 * factor, 0.05 * factor);
      stays_below(3, vortex_errors(field + ghost, ""), usual);
    }
  }
}

TEST_CASE("cut flows stay stable from creeping to convective, from short steps to steady", "[study]") {
  const std::string stabilisation = GENERATE("cip", "residual");
  for (const std::string reynolds : {"1e-3", "1", "1e3"})
    for (const std::string step : {"1e-6", "1e-3", "1e6"}) {
      FlowRun flow(SEAM_SOURCE_DIR "/configs/fluid/contrast.yaml",
                   {{"fields.water.stabilisation", stabilisation},
                    {"parameters.Re", reynolds},
                    {"parameters.dt", step},
                    {"parameters.steps", "5"}});
      const Results& results = flow.run();
      for (const CheckResult& check : evaluate_checks(flow.scene().root.list("checks"), results)) {
        INFO(stabilisation << ", Re " << reynolds << ", step " << step << ": " << check.that << " = "
                           << check.value << ", expected " << check.expected);
        CHECK(check.passed);
      }
    }
}
