// SPDX-License-Identifier: BSD-3-Clause
// A plugin that goes wrong is named, with its type, field, line of the scene, term and cell; the process ends
// with the code for a plugin's failure; the conformance kit survives it.
#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include "../cli/run_command.hpp"

using namespace seam_cli_test;
using Catch::Matchers::Contains;

namespace {

const std::string scene = SEAM_FAULTY_SCENE;
constexpr int plugin_failure = 3;

std::string going_wrong(const std::string& how) { return " --set 'fields.plate.how=" + how + "'"; }

/// A copy of the scene that goes wrong: the kit takes no overrides.
std::string scene_going_wrong(const Folder& folder, const std::string& how) {
  std::ifstream in(scene);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string key = "how: right";
  text.replace(text.find(key), key.size(), "how: " + how);
  return folder.file("faulty.yaml", text);
}

Result run_kit(const std::string& how, const std::string& ranks) {
  const Folder folder;
  return seam("plugin test " SEAM_FAULTY_PLUGIN " --scene " + scene_going_wrong(folder, how) + " --ranks " +
              ranks);
}

}  // namespace

TEST_CASE("what a plugin declares that cannot be is refused by check, with plugin, field and line") {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"order", "its unknown 'temperature' is of order 3; there are 1 and 2"},
      {"components", "its unknown 'temperature' has 0 components; at least 1 is needed"},
      {"time order", "its unknown 'temperature' has time_order 5"},
      {"no name", "its unknown '' has no name"},
      {"twice", "its unknown 'temperature' is declared twice"},
      {"no rate",
       "it depends on a rate of 'temperature', which has none: its time_order is 0; declare at least 1"},
      {"few operands", "its kernel speaks of 1 unknowns, but 0 were given"},
      {"many operands", "its kernel speaks of 1 unknowns, but 2 were given, 'temperature' twice"},
      {"unknown operand", "has no unknown 'temprature'; it has: temperature"},
      {"crowd", "its kernel speaks of 33 unknowns; 32 at most are possible"},
      {"null term", "its build() adds a term that is null"},
      {"null quantity", "its build() adds a quantity that is null"},
      {"quantity as term", "adds the quantity 'Numbers<1>' as a term; make_term() makes those"},
      {"term as quantity", "adds the term 'Radiation' as a quantity; make_quantity() makes those"},
      {"prescribes", "component 7 of 'temperature', which has 1: 0 is the first"},
      {"prescribes before", "component -1 of 'temperature', which has 1"},
      {"starts", "component 1 of 'temperature', which has 1"},
      {"starts rate", "component 1 of 'temperature', which has 1"},
      {"gives", "component 1 of 'temperature', which has 1"},
      {"build throws", "failed: stoi (std::runtime_error)"},
      {"constructor throws", "failed: no such row (std::out_of_range)"},
      {"undeclared key", "parameter 'conductivity' of 'faulty' has no value"},
  };
  for (const auto& [how, text] : wrong) {
    const Result result = seam("check " + scene + going_wrong(how));
    INFO(how << "\n" << result.output);
    CHECK(result.code == plugin_failure);
    CHECK_THAT(result.output, Contains(text));
    CHECK_THAT(result.output, Contains("plugin 'faulty'"));
    CHECK_THAT(result.output, Contains("faulty.yaml:9:"));
  }
  CHECK(seam("check " + scene).code == 0);
}

TEST_CASE(
    "an exception in a kernel names plugin, term, field and cell, whatever is thrown; the last state is "
    "kept") {
  for (const auto& [how, text] : std::vector<std::pair<std::string, std::string>>{
           {"throws", "the table ends at 5 K (std::runtime_error)"},
           {"throws error", "the table ends at 5 K"},
           {"throws number", "an exception of type int"}}) {
    const Folder folder;
    const Result result = seam("run " + scene + going_wrong(how) + " --quiet --no-picture --folder " +
                               (folder.path / "out").string());
    INFO(how << "\n" << result.output);
    CHECK(result.code == plugin_failure);
    CHECK_THAT(result.output, Contains("faulty.yaml:9:"));
    CHECK_THAT(result.output,
               Contains("the term 'Conduction' of plate.temperature on cells of field 'plate' of "
                        "plugin 'faulty' failed in cell 0 at ("));
    CHECK_THAT(result.output, Contains(text));
    CHECK_THAT(result.output, Contains("The last good state (t = 0.5, step 2)"));
  }
  const Result quantity = seam("check " + scene + going_wrong("quantity throws"));
  INFO(quantity.output);
  CHECK(quantity.code == plugin_failure);
  CHECK_THAT(quantity.output, Contains("the term 'Numbers<1>' of plate.temperature"));
}

TEST_CASE("a crash says in which plugin it came about") {
#if !defined(__SANITIZE_ADDRESS__)  // which has its own words
  const Result result = seam("check " + scene + going_wrong("constructor crashes"));
  INFO(result.output);
  CHECK(result.code == 128 + SIGSEGV);
  CHECK_THAT(result.output,
             Contains("a crash (Segmentation fault) within plugin 'faulty': a defect of the plugin"));
#endif
}

TEST_CASE("the kit survives a plugin that crashes or throws, and says during what") {
  const Result crash = run_kit("crashes", "1");
  INFO(crash.output);
  CHECK(crash.code == 1);
  CHECK_THAT(crash.output, Contains("FAIL  comes to its end"));
  CHECK_THAT(crash.output, Contains(" in: runs"));
  CHECK_THAT(crash.output, Contains("ok    used by a scene: field:faulty"));
  const Result thrown = run_kit("throws number", "1");
  INFO(thrown.output);
  CHECK(thrown.code == 1);
  CHECK_THAT(thrown.output, Contains("FAIL  runs"));
  CHECK_THAT(thrown.output, Contains("an exception of type int"));
}

TEST_CASE("the kit finds relations between unknowns that are told wrongly, or remember") {
  const auto with_constraint = [](const std::string& how) {
    const Folder folder;
    std::ifstream in(scene);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    text.insert(text.find("time:"), "constraints: [{type: crooked, how: " + how + "}]\n\n");
    return seam("plugin test " SEAM_FAULTY_PLUGIN " --scene " + folder.file("faulty.yaml", text) +
                " --ranks 1");
  };
  const std::string values = "ties of unknowns: values change as the coefficients say",
                    handed = "ties of unknowns: what is handed on changes as said",
                    rates = "ties of unknowns: values change as their rates say",
                    motions = "ties of unknowns: what is handed on changes as motions say";
  const Result right = with_constraint("right");
  INFO(right.output);
  for (const std::string& check :
       {values, handed, rates, motions, std::string("tangent: whole system"), std::string("rewind")})
    CHECK_THAT(right.output, Contains("ok    " + check));
  CHECK_THAT(with_constraint("slope").output, Contains("FAIL  " + values));
  CHECK_THAT(with_constraint("rate").output, Contains("FAIL  " + rates));
  const Result clock = with_constraint("clock");
  CHECK_THAT(clock.output,
             Contains("FAIL  " + rates) && Contains("ok    " + values) && Contains("1.0 times"));
  const Result motion = with_constraint("motion");
  CHECK_THAT(motion.output,
             Contains("FAIL  " + motions) && Contains("ok    " + rates) && Contains("ok    " + handed));
  const Result change = with_constraint("change");
  CHECK_THAT(change.output, Contains("FAIL  " + handed) && Contains("FAIL  tangent: whole system"));
  CHECK_THAT(with_constraint("remembers").output, Contains("FAIL  rewind"));
  CHECK_THAT(with_constraint("throws").output, Contains("no such row") && Contains("plugin 'faulty'"));
}

TEST_CASE("the kit finds a function whose rates are not those of its values") {
  const std::string check = "given values: rates are those of the values";
  const Result right = run_kit("warms", "1"), rate = run_kit("rate", "1"),
               second = run_kit("second rate", "1");
  INFO(right.output << rate.output << second.output);
  CHECK_THAT(right.output, Contains("ok    " + check));
  CHECK_THAT(rate.output,
             Contains("FAIL  " + check) && Contains("derivative 1 by time of `heat[0]`, given for "
                                                    "'temperature' of field 'plate'"));
  CHECK_THAT(second.output, Contains("FAIL  " + check) && Contains("derivative 2"));
}

TEST_CASE("the kit differentiates at rest, and says of terms that they were not exercised") {
  const Result rest = run_kit("slope at rest", "1");
  INFO(rest.output);
  CHECK_THAT(rest.output, Contains("FAIL  finite at the start"));
  CHECK_THAT(rest.output, Contains("the term 'Conduction' of plate.temperature"));
  // No probe and no picture asks for it.
  const Result unseen = run_kit("output throws", "1");
  INFO(unseen.output);
  CHECK(unseen.code != 0);
  CHECK_THAT(unseen.output, Contains("no such row"));
  const Result nothing = run_kit("nothing", "1");
  INFO(nothing.output);
  CHECK_THAT(nothing.output, Contains("skip  tangent: Radiation on cells of field 'plate'"));
  CHECK_THAT(nothing.output, Contains("not exercised"));
  CHECK_THAT(nothing.output, Contains("ok    tangent: Conduction on cells of field 'plate'"));
}

TEST_CASE(
    "a balance that is zero but for rounding is the same on all ranks; keys that point nowhere are told") {
  const Result result = run_kit("right", "1,2");
  INFO(result.output);
  CHECK_THAT(result.output, Contains("ok    the same on 1, 2 ranks"));
  CHECK_THAT(result.output, Contains("FAIL  schema of field:pointless"));
  CHECK_THAT(result.output, Contains("'planet' names a 'planet'"));
  CHECK_THAT(result.output, Contains("'where' names a 'boundry'"));
  CHECK_THAT(result.output, Contains("'law' takes a 'laws_of_nature'"));
}
