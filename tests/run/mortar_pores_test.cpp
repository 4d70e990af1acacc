// SPDX-License-Identifier: BSD-3-Clause
// Porous bodies that mortar methods tie or let touch.
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// A soft column between walls, drained at its top and loaded there, of two pieces. @param cells across of
/// the upper one, of the lower one
std::string column(int upper, int lower, const std::string& rest) {
  const auto piece = [](const char* name, const std::string& ends) {
    return std::string("  ") + name + R"scene(:
    type: porous_solid
    mesh: )scene" +
           name + R"scene(
    material: {type: neo_hookean, young: 100, poisson: 0.2}
    viscosity: 1
    porosity: {initial: 0.5, bulk: 1000, opening: 1}
    permeability: [1e-3]
    boundary:
      - {on: [x_min, x_max], displacement: [0, null], velocity: [0, null]}
)scene" + ends;
  };
  return R"scene(
title: A column of two pieces
dimension: 2
plugins: [solid, poroelasticity, mortar_contact]
parameters: {load: 40}
meshes:
  lower: {grid: {from: [0, 0], to: [0.5, 0.5], cells: [)scene" +
         std::to_string(lower) + R"scene(, 6]}}
  upper: {grid: {from: [0, 0.5], to: [0.5, 1], cells: [)scene" +
         std::to_string(upper) + R"scene(, 6]}}
fields:
)scene" + piece("lower", "      - {on: y_min, displacement: [0, 0], velocity: [0, 0]}\n") +
         piece("upper", "      - {on: y_max, traction: [0, -load]}\n") + R"scene(
time: {theta: 1, end: 0.4, step: {initial: 0.1}}
solver: {newton: {tolerance: 1e-12, increment_tolerance: 1e-11}}
output:
  fields: false
  probes:
    top: {field: upper, at: [0, 1], quantity: displacement, component: y}
    above: {field: upper, at: [0.25, 0.5], quantity: pressure}
    below: {field: lower, at: [0.25, 0.5], quantity: pressure}
    out: {field: upper, on: y_max, quantity: seepage, component: y}
)scene" + rest;
}

const std::string upper_first = R"scene(
interfaces: {seam: {type: non_matching, fields: [upper, lower], boundaries: [y_min, y_max]}}
)scene";
const std::string lower_first = R"scene(
interfaces: {seam: {type: non_matching, fields: [lower, upper], boundaries: [y_max, y_min]}}
)scene";

/// How much more a series falls in a step than the others, which are rates, say.
double most_lost(const Run& run, const std::string& stored,
                 const std::vector<std::pair<double, std::string>>& rates) {
  const auto time = run.series("time"), volume = run.series(stored);
  double most = 0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    double change = volume[k] - volume[k - 1];
    for (const auto& [sign, name] : rates) change += sign * (time[k] - time[k - 1]) * run.series(name)[k];
    most = std::max(most, std::abs(change));
  }
  return most;
}

}  // namespace

TEST_CASE("pores of bodies that are tied are open to each other, and what one loses the other gets") {
  const bool upper = GENERATE(true, false);
  const std::string on = upper ? upper_first : lower_first;
  const Run run(column(3, 4, on + "coupling: [{type: mortar_tie, on: seam}]\n"));
  CAPTURE(upper, run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(most_lost(run, "lower.fluid_volume", {{upper ? -1 : 1, "seam.seepage"}}) < 1e-14);
  CHECK(most_lost(run, "upper.fluid_volume", {{upper ? 1 : -1, "seam.seepage"}, {1, "out"}}) < 1e-14);
  CHECK(std::abs(run.series("seam.seepage").back()) > 1e-3);
  CHECK(run.series("above").back() == Approx(run.series("below").back()).epsilon(1e-3));

  // The same of one piece.
  std::string whole = column(3, 4, "");
  whole.erase(whole.find("  lower: {grid"), whole.find("  upper: {grid") - whole.find("  lower: {grid"));
  whole.erase(whole.find("  lower:\n"), whole.find("  upper:\n") - whole.find("  lower:\n"));
  whole.erase(whole.find("    below:"), whole.find("    out:") - whole.find("    below:"));
  const std::string from = "from: [0, 0.5], to: [0.5, 1], cells: [3, 6]",
                    top = "      - {on: y_max, traction";
  whole.replace(whole.find(from), from.size(), "from: [0, 0], to: [0.5, 1], cells: [3, 12]");
  whole.insert(whole.find(top), "      - {on: y_min, displacement: [0, 0], velocity: [0, 0]}\n");
  const Run one(whole);
  CAPTURE(one.done.output);
  REQUIRE(one.done.code == 0);
  CHECK(run.series("top").back() == Approx(one.series("top").back()).epsilon(1e-4));
  CHECK(run.series("above").back() == Approx(one.series("above").back()).epsilon(1e-3));
}

TEST_CASE("nothing seeps through a tie that is sealed, nor into a solid") {
  const bool upper = GENERATE(true, false);
  const Run run(column(
      3, 4,
      (upper ? upper_first : lower_first) + "coupling: [{type: mortar_tie, on: seam, sealed: true}]\n"));
  CAPTURE(upper, run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(most_lost(run, "lower.fluid_volume", {}) < 1e-14);
  CHECK(most_lost(run, "upper.fluid_volume", {{1, "out"}}) < 1e-14);
  CHECK(run.series("below").back() > 1.2 * run.series("above").back());

  // A solid in place of the lower piece: the upper one does not see what is below.
  const auto solid = [&](std::string text) {
    const std::size_t at = text.find("  lower:\n"), end = text.find("  upper:\n");
    text.replace(at, end - at, R"scene(  lower:
    type: solid
    mesh: lower
    material: {type: neo_hookean, young: 1000, poisson: 0.2}
    boundary:
      - {on: [x_min, x_max], displacement: [0, null]}
      - {on: y_min, displacement: [0, 0]}
)scene");
    const std::string below = "    below: {field: lower, at: [0.25, 0.5], quantity: pressure}\n";
    return text.erase(text.find(below), below.size());
  };
  const Run tied(solid(
      column(3, 4, (upper ? upper_first : lower_first) + "coupling: [{type: mortar_tie, on: seam}]\n")));
  CAPTURE(tied.done.output);
  REQUIRE(tied.done.code == 0);
  CHECK(most_lost(tied, "upper.fluid_volume", {{1, "out"}}) < 1e-14);
  // Nodes that match have one motion.
  std::string text = solid(column(3, 3,
                                  "constraints: [{type: tied, fields: [upper, lower], boundaries: [y_min, "
                                  "y_max], unknowns: [displacement]}]\n"));
  text.insert(text.find("      - {on: y_max, traction"),
              "      - {on: y_min, seepage: 0, seepage_penalty: 0}\n");
  const Run one(text);
  CAPTURE(one.done.output);
  REQUIRE(one.done.code == 0);
  CHECK(tied.series("top").back() == Approx(one.series("top").back()).epsilon(1e-10));
  CHECK(tied.series("above").back() == Approx(one.series("above").back()).epsilon(1e-10));
}

TEST_CASE("a tie and a condition do not both say what seeps through a boundary") {
  std::string text = column(3, 4, upper_first + "coupling: [{type: mortar_tie, on: seam}]\n");
  text.insert(text.find("      - {on: y_max, traction"), "      - {on: y_min, seepage: 0}\n");
  const Run run(text);
  CHECK(run.done.code == 2);
  CHECK_THAT(run.done.output, Catch::Contains("says what passes through boundary 'y_min' of field 'upper'"));
}

TEST_CASE("a tight porous body consolidates under a solid that touches it, the same whatever the meshes") {
  const auto scene = [&](int upper, int lower, const std::string& rest) {
    std::string text = column(upper, lower, rest);
    const std::string base = "{on: y_min, displacement: [0, 0], velocity: [0, 0]}",
                      out = "    out: {field: upper, on: y_max",
                      above = "    above: {field: upper, at: [0.25, 0.5], quantity: pressure}\n";
    text.replace(text.find(base), base.size(),
                 "{on: y_min, displacement: [0, 0]}\n      - {on: y_max, seepage: 0}");
    text.replace(text.find(out), out.size(), "    out: {field: lower, on: y_min");
    text.erase(text.find(above), above.size());
    const std::size_t at = text.find("  upper:\n"), end = text.find("\ntime:");
    return text.replace(at, end - at, R"scene(  upper:
    type: solid
    mesh: upper
    material: {type: neo_hookean, young: 1000, poisson: 0.2}
    boundary:
      - {on: [x_min, x_max], displacement: [0, null]}
      - {on: y_max, traction: [0, -load]}
)scene");
  };
  const Run bonded(scene(4, 4,
                         "constraints: [{type: tied, fields: [lower, upper], boundaries: [y_max, y_min], "
                         "unknowns: [displacement]}]\n"));
  CAPTURE(bonded.done.output);
  REQUIRE(bonded.done.code == 0);
  for (const auto& [upper, lower] : {std::pair(4, 4), std::pair(3, 5), std::pair(7, 3)}) {
    const Run run(scene(upper, lower, R"scene(
interfaces: {seam: {type: contact, from: lower, to: upper, boundaries: [y_max], opposite: [y_min]}}
coupling: [{type: mortar_contact, on: seam}]
)scene"));
    CAPTURE(upper, lower, run.done.output);
    REQUIRE(run.done.code == 0);
    // Pores and skeleton carry the load together.
    CHECK(run.series("seam.force.y").back() == Approx(-20).epsilon(1e-12));
    CHECK(run.series("seam.pressure").back() + run.series("below").back() == Approx(40).epsilon(1e-11));
    CHECK(run.series("seam.pressure").back() > 5);
    CHECK(run.series("below").back() > 5);
    CHECK(run.series("top").back() == Approx(bonded.series("top").back()).epsilon(1e-11));
    CHECK(run.series("below").back() == Approx(bonded.series("below").back()).epsilon(1e-11));
    CHECK(most_lost(run, "lower.fluid_volume", {{-1, "out"}}) < 1e-14);
  }
}

TEST_CASE("where next to nothing has arrived yet, rounding does not refuse steps") {
  // The lower piece is far from the load: its balance of mass is rounding of what its pores hold.
  std::string text = column(3, 4, upper_first + "coupling: [{type: mortar_tie, on: seam}]\n");
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"load: 40", "load: 0.01"},
                                 {"end: 0.4, step: {initial: 0.1}", "end: 0.012, step: {initial: 2e-3}"},
                                 {"tolerance: 1e-12, increment_tolerance: 1e-11", "tolerance: 1e-8"}})
    text.replace(text.find(from), from.size(), to);
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"young: 100, poisson: 0.2", "young: 1000, poisson: 0"},
        {"bulk: 1000, opening: 1", "bulk: 1e9"},
        {"[3, 6]", "[3, 10]"},
        {"[4, 6]", "[4, 10]"}})
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from))
      text.replace(at, from.size(), to);
  const Run run(text);
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(run.series("time").size() == 7);
}

TEST_CASE("pores that contact leaves open by mistake are warned of") {
  std::string text = column(3, 4, R"scene(
interfaces: {seam: {type: contact, from: lower, to: upper, boundaries: [y_max], opposite: [y_min]}}
coupling: [{type: mortar_contact, on: seam}]
)scene");
  const Run open(text);
  const std::string warning = "`mortar_contact` knows of no pores, and those of 'upper' are open";
  CHECK_THAT(open.done.output, Catch::Contains(warning));
  text.insert(text.find("      - {on: y_max, traction"), "      - {on: y_min, seepage: 0}\n");
  const Run one(text);
  CHECK_THAT(one.done.output, !Catch::Contains(warning));
  CHECK_THAT(one.done.output, Catch::Contains("those of 'lower' are open"));
}

TEST_CASE("what leaves a porous body through a boundary that deforms is what it loses") {
  std::string text = column(3, 4, upper_first + "coupling: [{type: mortar_tie, on: seam}]\n");
  const std::string walls = "- {on: [x_min, x_max], displacement: [0, null], velocity: [0, null]}";
  for (std::size_t at = text.find(walls); at != std::string::npos; at = text.find(walls))
    text.replace(at, walls.size(), "- {on: x_min, displacement: [0, null], velocity: [0, null]}");
  const std::string out = "    out: {field: upper, on: y_max, quantity: seepage, component: y}\n";
  std::string probes =
      "    upper_out: {field: upper, on: [x_max, y_max], quantity: outflow}\n"
      "    lower_out: {field: lower, on: x_max, quantity: outflow}\n";
  text.replace(text.find(out), out.size(), probes);
  const Run run(text, "--set parameters.load=20");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(run.series("lower_out").back() > 1e-3);
  CHECK(most_lost(run, "lower.fluid_volume", {{1, "lower_out"}, {-1, "seam.seepage"}}) < 1e-13);
  CHECK(most_lost(run, "upper.fluid_volume", {{1, "upper_out"}, {1, "seam.seepage"}}) < 1e-13);

  text.replace(text.find("on: x_max, quantity: outflow"), 28, "at: [0.5, 0.2], quantity: outflow");
  CHECK_THAT(Run(text).done.output,
             Catch::Contains("'outflow' of field 'lower' is known on its boundaries only"));
}
