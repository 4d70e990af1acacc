// SPDX-License-Identifier: BSD-3-Clause
// Porous bodies that press fluid out through their pores, and stand on the ground in the end.
#include <algorithm>
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// A field: a column, guided at its sides. @param ends conditions at its ends
std::string column_of(const std::string& mesh, const std::string& ends) {
  return "  " + mesh + ":\n    type: porous_solid\n    mesh: " + mesh + R"yaml(
    material: {type: neo_hookean, young: 50, poisson: 0}
    viscosity: 1
    porosity: {initial: 0.5, bulk: 100, opening: 1}
    permeability: [1e-3]
    boundary:
      - {on: [x_min, x_max], displacement: [0, null], velocity: [0, null]}
)yaml" + ends;
}

const std::string pressed_top = "      - {on: y_max, traction: [0, \"-0.5*min(t/2, 1)\"], seepage: 0}\n",
                  drained_foot = "      - {on: y_min, displacement: [0, 0], pore_pressure: 0}\n",
                  steps = R"yaml(
time: {theta: 1, end: 8, step: {initial: 0.125}}
solver: {newton: {tolerance: 1e-10, increment_tolerance: 1e-9, maximum_iterations: 40}, linear: {type: direct}}
)yaml";

/// They are pressed together, tight on top, and drain through the foot of the lower one.
const std::string two_columns = R"yaml(
title: Two porous columns on top of each other
dimension: 2
plugins: [solid, cutfem_fluid, poroelasticity, nitsche_fsci]
meshes:
  film: {grid: {from: [0, 0.41], to: [0.125, 0.66], cells: [2, 4]}}
  upper: {grid: {from: [-0.02, 0.49999], to: [0.145, 0.99999], cells: [2, 4]}}
  lower: {grid: {from: [-0.02, 0], to: [0.145, 0.5], cells: [3, 4]}}
fields:
  water:
    type: cutfem_fluid
    mesh: film
    density: 0.1
    viscosity: 1
    fix_pressure: never
    boundary: [{on: [x_min, x_max], slip: true}]
)yaml" + column_of("upper", pressed_top) +
                                column_of("lower", drained_foot) + R"yaml(
interfaces:
  down: {type: embedded_contact, field: water, body: upper, to: lower, boundaries: [y_min, x_min, x_max]}
  up: {type: embedded_contact, field: water, body: lower, to: upper, boundaries: [y_max, x_min, x_max]}
coupling:
  - {type: porous_contact_in_fluid, on: down}
  - {type: porous_contact_in_fluid, on: up}
output:
  fields: false
  probes:
    high: {field: upper, at: [0, 0.74999], quantity: pressure}
    above: {field: upper, at: [0, 0.49999], quantity: pressure}
    below: {field: lower, at: [0, 0.5], quantity: pressure}
    low: {field: lower, at: [0, 0.25], quantity: pressure}
)yaml" + steps;

const std::string one_column = R"yaml(
title: One of the same height
dimension: 2
plugins: [solid, poroelasticity]
meshes: {column: {grid: {from: [-0.02, 0], to: [0.145, 1], cells: [2, 8]}}}
fields:
)yaml" + column_of("column", pressed_top + drained_foot) +
                               R"yaml(
output:
  fields: false
  probes:
    high: {field: column, at: [0, 0.75], quantity: pressure}
    above: {field: column, at: [0, 0.5], quantity: pressure}
    low: {field: column, at: [0, 0.25], quantity: pressure}
)yaml" + steps;

}  // namespace

TEST_CASE("a porous column closes a film of fluid that can only drain through it", "[sanitized]") {
  SECTION("what the film loses the pores get, and forces balance, in each step") {
    const ShippedRun run("poro/falling_column", "--set checks=[] --set parameters.end=4");
    const std::vector<double> time = run.series("time"), film = run.series("water.volume"),
                              pores = run.series("column.fluid_volume"), seepage = run.series("foot.seepage"),
                              out = run.series("out"), force = run.series("foot.force.y");
    REQUIRE(time.size() > 35);
    for (std::size_t k = 1; k < time.size(); ++k) {
      const double step = time[k] - time[k - 1];
      CHECK(std::abs(film[k] - film[k - 1] + step * seepage[k]) < 1e-12 * film.front());
      CHECK(std::abs(pores[k] - pores[k - 1] - step * (seepage[k] - out[k])) < 1e-12 * pores.front());
      CHECK(std::abs(force[k] / (0.05 * 0.127) - 1) < 1e-8);
    }
    CHECK(film.back() < 0.9 * film.front());
  }
  SECTION("with a sudden seal it closes when the film has drained, and consolidates on a tight wall") {
    const ShippedRun run(
        "poro/falling_column",
        "--set checks=[] --set output.statistics={} --set parameters.end=11 --set "
        "parameters.gap=2e-4 --set parameters.step=0.05 --set 'coupling.0.seal={by: switch}'");
    const std::vector<double> time = run.series("time"), base = run.series("base"),
                              film = run.series("water.volume"), contact = run.series("foot.contact_force.y");
    // 2e-4 mu/(K q) = 4 s.
    const auto closed = std::ranges::find_if(contact, [](double force) { return force > 0; });
    REQUIRE(closed != contact.end());
    CHECK(time[closed - contact.begin()] == Approx(4).margin(0.15));
    CHECK(film.back() == 0);
    CHECK(contact.back() == Approx(0.05 * 0.127).epsilon(1e-8));
    // Diffusion in a column that was drained at its foot until then.
    const auto at = [&](double wanted) {
      return base[std::ranges::lower_bound(time, wanted - 1e-6) - time.begin()];
    };
    CHECK(at(5.5) == Approx(0.03555).epsilon(0.04));
    CHECK(at(7.5) == Approx(0.02783).epsilon(0.04));
    CHECK(at(10.5) == Approx(0.01994).epsilon(0.04));
  }
  SECTION("the seal of the thesis loses fluid, and says so") {
    const ShippedRun run("poro/falling_column",
                         "--set checks=[] --set parameters.end=4 --set 'coupling.0.seal={by: smoothing}'");
    CHECK(std::abs(run("foot.dropped")) > 0.05 * std::abs(run("foot.seepage")));
  }
  SECTION("a second word on what passes through its surface is refused") {
    const Result seepage = seam("run " SEAM_SOURCE_DIR
                                "/configs/poro/falling_column.yaml --set 'fields.column.boundary.1={on: "
                                "y_min, seepage: 0}'");
    CHECK(seepage.code != 0);
    CHECK_THAT(seepage.output,
               Catch::Contains("says what passes through boundary 'y_min' of field 'column', and "
                               "so does a condition there on"));
    const Result stress =
        seam("run " SEAM_SOURCE_DIR "/configs/poro/falling_column.yaml --set coupling.1.stress=own");
    CHECK(stress.code != 0);
    CHECK_THAT(stress.output, Catch::Contains("write `stress: other`"));
    const Run both_own(two_columns, "--set coupling.0.stress=own --set coupling.1.stress=own");
    CHECK(both_own.done.code != 0);
    CHECK_THAT(both_own.done.output, Catch::Contains("`stress: own` on both looks of"));
  }
}

TEST_CASE("two porous columns that touch consolidate as one", "[sanitized]") {
  for (const std::string stress : {"", " --set coupling.0.stress=own --set coupling.1.stress=other"}) {
    CAPTURE(stress);
    const Run one(one_column, ""), two(two_columns, stress);
    INFO(two.done.output);
    REQUIRE(two.done.code == 0);
    const std::vector<double> time = two.series("time"), down = two.series("down.seepage_through"),
                              up = two.series("up.seepage_through"), push = two.series("down.force.y"),
                              back = two.series("up.force.y");
    // What one loses the other gets.
    const std::vector<double> upper = two.series("upper.fluid_volume");
    for (std::size_t k = 1; k < time.size(); ++k) {
      CHECK(std::abs(upper[k] - upper[k - 1] + (time[k] - time[k - 1]) * (down[k] - up[k])) < 1e-14);
      CHECK(push[k] == Approx(0.165 * 0.5 * std::min(time[k] / 2, 1.0)).epsilon(1e-8));
      CHECK(push[k] == Approx(-back[k]).epsilon(1e-6));
    }
    CHECK(upper.back() < 0.995 * upper.front());
    // Later than the first steps, which are short where the pressure on the joint comes and goes.
    const auto at = [](const Run& run, const std::string& name, double when) {
      const std::vector<double> times = run.series("time");
      return run.series(name).at(std::ranges::lower_bound(times, when - 1e-9) - times.begin());
    };
    for (const double when : {2.0, 4.0, 8.0}) {
      CAPTURE(when);
      for (const std::string name : {"high", "low"})
        CHECK(at(two, name, when) == Approx(at(one, name, when)).margin(5e-4 * 0.5));
      CHECK(at(two, "above", when) == Approx(at(one, "above", when)).margin(2e-3 * 0.5));  // coarse
      CHECK(at(two, "below", when) == Approx(at(two, "above", when)).margin(1e-3 * 0.5));
    }
  }
}

TEST_CASE("a porous stamp closes over a pool that drains, rests, and is lifted by the fluid's pressure",
          "[study]") {
  const std::string coarse =
      "--set checks=[] --set parameters.n=12 --set parameters.fine=0.5 --set parameters.start=100 --set "
      "parameters.rise=150 --set output.fields=false --set parameters.end=";
  const ShippedRun run("contact/porous_stamp", coarse + "300");
  const std::vector<double> time = run.series("time"), first = run.series("gap_1"),
                            last = run.series("gap_0"), contact = run.series("by_contact"),
                            unbalanced = run.series("unbalanced"), missing = run.series("missing"),
                            pores = run.series("mean_pores");
  const auto below = [&](const std::vector<double>& gap) {
    return time[std::ranges::find_if(gap, [](double g) { return g < 1e-3; }) - gap.begin()];
  };
  const auto row = [&](double wanted) { return std::ranges::lower_bound(time, wanted) - time.begin(); };
  CHECK(below(first) == Approx(43).margin(3));
  CHECK(below(last) > below(first) + 4);
  CHECK(contact[row(100)] > 0.95 * 1.5);
  CHECK(pores[row(100)] < 0.1 * pores[row(30)]);
  for (std::size_t k = 1; k < time.size(); ++k) {
    CAPTURE(time[k]);
    CHECK(std::abs(missing[k]) * (time[k] - time[k - 1]) < 1e-10);
    CHECK(unbalanced[k] < (time[k] > 1 ? 1e-4 : 0.2));
    CHECK(first[k] > -1.25e-3);
    CHECK(last[k] > -1.25e-3);
  }
  // Lifted soon after the fluid's pressure has come up to the load, at 250.
  const auto released =
      std::ranges::find_if(contact.rbegin(), contact.rend(), [](double f) { return f > 0; });
  const double at = time[contact.rend() - released - 1];
  CHECK(at > 250);
  CHECK(at < 290);

  SECTION("on any number of ranks, which may change while it touches") {
    const Folder folder;
    const std::string command = "run " SEAM_SOURCE_DIR
                                "/configs/contact/porous_stamp.yaml --quiet --no-picture " +
                                coarse + "300 --folder " + (folder.path / "out").string();
    const auto on = [](const std::string& ranks) {
      return "timeout 1000 mpirun --oversubscribe -np " + ranks + " ";
    };
    const Result three = seam(command + " --stop-at 46", on("3"));
    INFO(three.output);
    REQUIRE(three.code == 0);
    const Result two = seam(command + " --resume --stop-at 50", on("2"));
    INFO(two.output);
    REQUIRE(two.code == 0);
    const std::string csv = folder.read("out/series.csv");
    for (const std::string name :
         {"time", "gap_0", "gap_1", "gap_2", "by_contact", "by_fluid", "mean_pores"}) {
      CAPTURE(name);
      const std::vector<double> other = column(csv, name), one = run.series(name);
      REQUIRE(other.size() > 100);
      REQUIRE(other.size() <= one.size());
      double most = 0;
      for (const double x : one) most = std::max(most, std::abs(x));
      for (std::size_t k = 0; k < other.size(); ++k) CHECK(std::abs(other[k] - one[k]) < 1e-6 * most);
    }
  }
}

TEST_CASE("without permeability a porous stamp falls as the elastic one that keeps its fluid", "[study]") {
  const std::string coarse =
      " --set checks=[] --set output.statistics={} --set output.fields=false --set parameters.n=8 --set "
      "parameters.fine=0.5 --set parameters.end=12 --set time.step.tolerance=0.05";
  const auto solid = [&](const std::string& material) {
    return ShippedRun(
        "contact/porous_stamp",
        coarse +
            " --set 'plugins=[cutfem_fluid, solid, undrained, nitsche_fsci]' --set "
            "'plugin_folders=[" SEAM_TROUBLE_PLUGIN
            "]' --set 'fields.stamp={type: solid, mesh: stamp, order: 2, "
            "density: 1e-3, material: " +
            material +
            ", boundary: [{on: middle, displacement: [0, null]}, {on: top, traction: [0, -2]}]}' --set "
            "meshes.stamp.numbers.order=2 --set 'meshes.stamp.numbers.fine=\"0.5*fine\"' --set "
            "'coupling.0={type: contact_in_fluid, on: foot, stress: own, near_slip: {factor: 0.1, reach: "
            "1/n}}' "
            "--set 'output.probes={p0: {field: stamp, at: [0, 0.5], quantity: displacement, component: y}, "
            "p1: "
            "{field: stamp, at: [\"-sin(0.3*arc)\", \"1.5 - cos(0.3*arc)\"], quantity: displacement, "
            "component: "
            "y}}' --set 'output.formulas={gap_0: 0.5 + p0, gap_1: 1.5 - cos(0.3*arc) + p1}'");
  };
  const ShippedRun porous("contact/porous_stamp",
                          coarse + " --set parameters.permeability=1e-8 --set coupling.0.alpha=.inf");
  const ShippedRun undrained = solid("{type: undrained, young: 50, bulk: 100, porosity: 0.5}"),
                   drained = solid("{type: neo_hookean, young: 50, poisson: 0}");
  const auto at = [](const ShippedRun& run, const std::string& name, double t) {
    const std::vector<double> time = run.series("time"), value = run.series(name);
    const auto k = std::ranges::lower_bound(time, t) - time.begin();
    return value[k - 1] + (value[k] - value[k - 1]) * (t - time[k - 1]) / (time[k] - time[k - 1]);
  };
  for (const std::string gap : {"gap_0", "gap_1"})
    for (const double t : {1.0, 5.0, 10.0}) {
      CAPTURE(gap, t);
      CHECK(at(porous, gap, t) == Approx(at(undrained, gap, t)).epsilon(0.04));
    }
  CHECK(at(drained, "gap_0", 10) > 1.15 * at(undrained, "gap_0", 10));
}

TEST_CASE(
    "a body that is half solid, half porous rests in a fluid under pressure, and touches on any ranks") {
  const std::string coarse =
      " --set checks=[] --set output.statistics={} --set output.fields=false --set parameters.n=10 --set "
      "parameters.m=4 --set ";
  SECTION("exactly, whatever its halves make of the pressure") {
    const ShippedRun rest(
        "contact/half_porous_stamp",
        coarse +
            "parameters.load=0 --set parameters.pressure=3 --set 'time={theta: 1, end: 4e4, "
            "step: {initial: 1e4}}'");
    for (const char* pressure : {"beside", "below", "pores"})
      CHECK(rest(pressure) == Approx(3).epsilon(0).margin(1e-9));
    CHECK(rest("water.dissipation") < 1e-20);
    CHECK(std::abs(rest("carried")) < 1e-9);
    CHECK(rest("corner.y") > 1e-4);
  }
  SECTION("as on one") {
    const std::string fixed = coarse + "'time={theta: 1, end: 3, step: {initial: 0.05}}'";
    const ShippedRun one("contact/half_porous_stamp", fixed),
        three("contact/half_porous_stamp", fixed, "mpirun --oversubscribe -np 3 ");
    REQUIRE(one.series("skin_right.contact_force.y").back() > 1);
    for (const char* name : {"corner.y", "skin_right.contact_force.y", "skin_left.force.y", "pores"}) {
      CAPTURE(name);
      const std::vector<double> here = one.series(name), there = three.series(name);
      REQUIRE(here.size() == there.size());
      double most = 0;
      for (const double x : here) most = std::max(most, std::abs(x));
      for (std::size_t k = 0; k < here.size(); ++k) CHECK(std::abs(here[k] - there[k]) < 1e-6 * most);
    }
  }
}

TEST_CASE("what is missing around a porous body that may touch is said") {
  const auto said = [](const std::string& change, const std::string& to) {
    std::string text = two_columns;
    const std::size_t at = text.find(change);
    REQUIRE(at != std::string::npos);
    text.replace(at, change.size(), to);
    const Folder folder;
    return seam("check " + folder.file("scene.yaml", text)).output;
  };
  const std::string look = "  - {type: porous_contact_in_fluid, on: up}\n";
  CHECK_THAT(said("title: Two", "title: Two"), !Catch::Contains("may touch") && !Catch::Contains("only '"));
  CHECK_THAT(said(look, ""),
             Catch::Contains("'upper' may touch 'lower', which the field 'water' knows nothing of"));
  CHECK_THAT(
      said(look, "  - {type: contact_in_fluid, on: up, stress: other}\n"),
      Catch::Contains("'upper' and 'lower' are porous, and only 'upper' looks at the other") &&
          Catch::Contains(
              "`contact_in_fluid` knows of no pores, and those of 'lower' are open to a pressure of 0"));
  CHECK_THAT(said("boundaries: [y_min, x_min, x_max]}",
                  "boundaries: [y_min, x_min, x_max]}\n  foot: {type: "
                  "embedded, field: water, body: upper, boundaries: y_min}"),
             Catch::Contains("two interfaces have the same part of the surface of 'upper'"));
}

TEST_CASE("flat porous faces come off each other again, and the gap fills through the pores") {
  // Pressed together by the fluid, then parted by what flows in at the foot of the lower one.
  const std::string text = R"yaml(
title: Two porous blocks that a flow presses together and parts
dimension: 2
plugins: [cutfem_fluid, solid, poroelasticity, nitsche_fsci]
parameters: {turn: 0.5, hair: 1e-4}
meshes:
  box: {grid: {from: [0, -0.237], to: [0.25, 0.763], cells: [2, 8]}}
  a: {grid: {from: [-hair, 0.01], to: [0.25 + hair, 0.41], cells: [2, 4]}}
  b: {grid: {from: [-hair, -0.6], to: [0.25 + hair, 0], cells: [2, 6]}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1e-6
    convection: false
    viscosity: 0.01
    fix_pressure: never
    boundary: [{on: [x_min, x_max], slip: true}, {on: y_max, traction: [0, "t < turn ? -10 : 0"]}]
  a:
    type: porous_solid
    mesh: a
    material: {type: neo_hookean, young: 500, poisson: 0}
    viscosity: 0.01
    porosity: {initial: 0.5, bulk: 1e6}
    permeability: [5e-5]
    boundary: [{on: [x_min, x_max], displacement: [0, null], velocity: [0, null]}]
  b:
    type: porous_solid
    mesh: b
    material: {type: neo_hookean, young: 1000, poisson: 0}
    viscosity: 0.01
    porosity: {initial: 0.5, bulk: 1e6}
    permeability: [2e-4]
    boundary:
      - {on: [x_min, x_max], displacement: [0, null], velocity: [0, null]}
      - {on: y_min, displacement: [0, 0], pore_pressure: "t < turn ? 0 : 10"}
interfaces:
  a: {type: embedded_contact, field: water, body: a, to: b}
  b: {type: embedded_contact, field: water, body: b, to: a, boundaries: [y_max, x_min, x_max]}
coupling:
  - {type: porous_contact_in_fluid, on: a, stress: own, extension: pore_pressure}
  - {type: porous_contact_in_fluid, on: b, stress: other, extension: pore_pressure}
time: {theta: 1, end: 0.8, step: {initial: 0.01}}
output: {fields: false, probes: {inflow: {field: water, on: y_max, quantity: velocity, component: y}}}
)yaml";
  const Run run(text);
  INFO(run.done.output);
  REQUIRE(run.done.code == 0);
  const std::vector<double> time = run.series("time"), gap = run.series("a.gap"),
                            inflow = run.series("inflow"), dropped = run.series("water.dropped_volume");
  const auto row = [&](double wanted) {
    return std::ranges::lower_bound(time, wanted - 1e-9) - time.begin();
  };
  // Darcy through both, 10 Pa over the heights times viscosity over permeability; then through the lower one.
  const double through = 10 / (0.01 * (0.4 / 5e-5 + 0.6 / 2e-4)), rises = 10 / (0.01 * 0.6 / 2e-4);
  CHECK(inflow[row(0.49)] == Approx(-0.25 * through).epsilon(0.01));
  CHECK(gap[row(0.49)] < 1e-4);
  CHECK((gap.back() - gap[row(0.7)]) / (time.back() - time[row(0.7)]) == Approx(rises).epsilon(0.005));
  CHECK(dropped.back() == 0);
  // What leaves the upper one enters the film, the lower one, or the gap while nothing else fills that.
  const std::vector<double> held = run.series("a.fluid_volume"), seeps = run.series("a.seepage"),
                            down = run.series("a.seepage_through"), up = run.series("b.seepage_through"),
                            fills = run.series("a.into_gaps");
  for (std::size_t k = 1; k < time.size(); ++k)
    CHECK(std::abs(held[k] - held[k - 1] -
                   (time[k] - time[k - 1]) * (seeps[k] + up[k] - down[k] - fills[k])) < 1e-12 * held[0]);
  CHECK(*std::ranges::max_element(fills) > 1e-6);
}
