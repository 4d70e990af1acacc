// SPDX-License-Identifier: BSD-3-Clause
// What penalties, porosity and slip do to the interface of a flow and a porous body: the trends of thesis
// 4.4.3-4.4.5 on a coarse mesh; docs/results/c08_normal, c08_tangential, c09 and c10 have the finer ones.
#include <cli/run_command.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

using namespace seam_cli_test;

namespace {

using Errors = std::map<std::string, double>;

const std::vector<std::string> norms{"v.l2", "v.h1", "p.l2", "v_pores.l2", "p_pores.l2", "u.l2"};
const std::string across = "gamma.mismatch_across", along = "gamma.mismatch_along";

Errors c07(const std::string& overrides) {
  const Folder folder;
  const Result result = seam("run " SEAM_SOURCE_DIR
                             "/configs/poro/c07.yaml --quiet --no-picture --set checks=[] --set "
                             "parameters.n=16 --folder " +
                             folder.path.string() + " " + overrides);
  INFO(overrides << '\n' << result.output);
  REQUIRE(result.code == 0);
  return nlohmann::json::parse(folder.read("summary.json")).at("results").get<Errors>();
}

/// Each error of `a` is at most `factor` that of `b`, and the other way round.
void check_alike(const Errors& a, const Errors& b, double factor,
                 const std::vector<std::string>& which = norms) {
  for (const std::string& norm : which) {
    INFO(norm << ": " << a.at(norm) << ", " << b.at(norm));
    CHECK(a.at(norm) < factor * b.at(norm));
    CHECK(b.at(norm) < factor * a.at(norm));
  }
}

}  // namespace

TEST_CASE("the penalty of a porous interface may vary over eight decades in the skew form", "[study]") {
  const auto normal = [](const std::string& adjoint, const std::string& gamma) {
    return c07("--set coupling.0.adjoint=" + adjoint + " --set coupling.0.penalty.normal=" + gamma);
  };
  const Errors least = normal("skew", "1e-3"), small = normal("skew", "0.1"), ten = normal("skew", "10"),
               hundred = normal("skew", "100"), most = normal("skew", "1e5");
  check_alike(least, ten, 1.2);
  check_alike(small, ten, 1.2);
  check_alike(hundred, ten, 1.1);
  CHECK(least.at("p.l2") > ten.at("p.l2"));
  CHECK(least.at(across) > small.at(across));
  CHECK(small.at(across) > 2 * ten.at(across));
  CHECK(ten.at(across) > hundred.at(across));

  const Errors symmetric_small = normal("symmetric", "0.1"), symmetric_hundred = normal("symmetric", "100"),
               symmetric_most = normal("symmetric", "1e5");
  check_alike(symmetric_hundred, hundred, 1.1);
  CHECK(symmetric_small.at(across) > 3 * small.at(across));
  CHECK(symmetric_small.at("p.l2") > 1.5 * small.at("p.l2"));
  // Far too much spoils what is not on the interface, whatever the form.
  for (const auto& [much, enough] :
       {std::pair{most, hundred}, std::pair{symmetric_most, symmetric_hundred}}) {
    for (const std::string& norm : norms) {
      INFO(norm);
      CHECK(much.at(norm) > 1.1 * enough.at(norm));
    }
    CHECK(much.at("p.l2") > 2 * enough.at("p.l2"));
    CHECK(much.at(across) < 0.2 * enough.at(across));
  }

  const auto tangential = [](const std::string& adjoint, const std::string& gamma) {
    return c07("--set coupling.0.adjoint=" + adjoint + " --set coupling.0.penalty.tangential=" + gamma);
  };
  const std::vector<std::string> velocities{"v.l2", "v.h1", "v_pores.l2"};
  const Errors weak = tangential("skew", "1e-3"), strong = tangential("skew", "1e5");
  check_alike(weak, hundred, 1.1, velocities);
  check_alike(strong, hundred, 1.1, velocities);
  CHECK(tangential("symmetric", "1").at("v.l2") > 2 * hundred.at("v.l2"));
}

TEST_CASE("substitution fails for low porosity, Nitsche's method does not", "[study]") {
  const auto at = [](const std::string& tangential, const std::string& alpha, const std::string& porosity) {
    return c07(
        "--set 'parameters.K=0.6*phi^3/(1-phi^2)' --set parameters.AP=-1e-5 --set parameters.AS=-1e-5 --set "
        "functions.exact.kozeny_carman=true --set fields.square.kozeny_carman=true --set parameters.phi=" +
        porosity + " --set coupling.0.alpha=" + alpha + " --set coupling.0.tangential=" + tangential);
  };
  const Errors half = at("nitsche", "1", "0.5"), tenth = at("nitsche", "1", "0.1"),
               low = at("nitsche", "1", "1e-3"), lower = at("nitsche", "1", "1e-4"),
               lowest = at("nitsche", "1", "1e-6");
  check_alike(low, at("nitsche", "10", "1e-3"), 1.05);
  check_alike(low, lowest, 1.5);
  check_alike(tenth, lowest, 1.1, {"v.l2", "v.h1"});
  CHECK(half.at("v_pores.l2") > 3 * tenth.at("v_pores.l2"));
  CHECK(half.at(along) > 3 * tenth.at(along));

  const Errors substituted = at("substitution", "1", "1e-3"), failing = at("substitution", "1", "1e-4");
  check_alike(substituted, low, 2);
  for (const auto* norm : {"p.l2", "v_pores.l2", "p_pores.l2", "u.l2"}) {
    INFO(norm);
    CHECK(failing.at(norm) > 3 * lower.at(norm));
  }
  CHECK(failing.at(along) < 0.6 * substituted.at(along));
}

TEST_CASE("Saffmann's condition bears any slip, that of Beavers and Joseph loses accuracy", "[study]") {
  const auto at = [](const std::string& tangential, bool saffmann, const std::string& alpha) {
    return c07("--set coupling.0.tangential=" + tangential + " --set coupling.0.alpha=" + alpha +
               (saffmann ? " --set coupling.0.slip_against=skeleton --set coupling.0.jump.slip.fluid="
                           "exact.velocity --set coupling.0.jump.slip.body=exact.displacement_rate"
                         : ""));
  };
  const Errors slipping = at("nitsche", false, "1e-8"), one = at("nitsche", false, "1"),
               saffmann = at("nitsche", true, "1e-8");
  check_alike(slipping, saffmann, 1.05);
  check_alike(slipping, at("substitution", false, "1e-8"), 1.05);
  check_alike(slipping, at("substitution", true, "1e-8"), 1.05);
  const std::vector<std::string> but_u{"v.l2", "v.h1", "p.l2", "v_pores.l2", "p_pores.l2"};
  check_alike(one, at("nitsche", true, "1"), 1.05, but_u);
  check_alike(one, at("substitution", false, "1"), 1.05, but_u);
  check_alike(one, at("substitution", true, "1"), 1.05, but_u);

  const Errors sticking = at("nitsche", false, "1e4"), stuck = at("nitsche", false, "1e8"),
               saffmann_sticking = at("nitsche", true, "1e4");
  for (const auto* norm : {"v.l2", "p.l2", "u.l2"}) {
    INFO(norm);
    CHECK(sticking.at(norm) > 1.5 * one.at(norm));
  }
  CHECK(sticking.at(along) < 0.3 * one.at(along));
  check_alike(sticking, stuck, 1.05);
  for (const auto* norm : {"v.l2", "v.h1", "p.l2", "v_pores.l2", "u.l2"}) {
    INFO(norm);
    CHECK(saffmann_sticking.at(norm) < 1.05 * saffmann.at(norm));
  }
  CHECK(at("substitution", false, "1e4").at("p.l2") > 2 * sticking.at("p.l2"));
  CHECK(at("substitution", true, "1e4").at("p.l2") > 2 * saffmann_sticking.at("p.l2"));
}
