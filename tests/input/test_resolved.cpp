// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "golden.hpp"
#include "seam/plugin/plugin_host.hpp"
#include "seam/scene/function.hpp"
#include "seam/scene/resolved.hpp"
#include "test_types.hpp"

using namespace seam;
using namespace seam_test;

namespace {

const std::filesystem::path folder = std::filesystem::path(SEAM_SOURCE_DIR) / "tests/input";

std::string good_text() { return read_text(folder / "good.yaml"); }

/// A function whose parts have the same names as those of another one.
class Wave : public Function {
 public:
  [[nodiscard]] const std::vector<Member>& members() const override {
    static const std::vector<Member> all{{"height", 1}, {"push", 2}};
    return all;
  }
  void evaluate(int part, const double* /*x*/, double /*t*/, double* value) const override {
    value[0] = value[part] = 1;
  }
};

/// The scene's values with one piece of its text replaced.
ResolvedScene resolved(const std::string& found = "", const std::string& instead = "",
                       const Overrides& overrides = {}, const std::filesystem::path& path = "scene.yaml") {
  Registry registry;
  register_test_types(registry);
  Schema wave("A wave.");
  wave.number("speed", "of it").otherwise("1");
  registry.add<Function>("function", "wave", wave,
                         [](const Parameters&, const Registry&) { return std::make_unique<Wave>(); });
  PluginHost host({});
  std::string text = good_text();
  const std::size_t at = text.find(found);
  REQUIRE(at != std::string::npos);
  text.replace(at, found.size(), instead);
  return resolve(parse_scene_text(text, path, overrides, host, registry), registry);
}

std::string with(const std::string& found, const std::string& instead, const Overrides& overrides = {}) {
  return resolved_checksum(resolved(found, instead, overrides));
}

std::string with_default_density(const std::string& value) {
  Schema schema("A bar.");
  schema.reference("mesh", "its mesh", "mesh");
  schema.number("density", "mass per volume").otherwise(value);
  Registry registry;
  registry.add<Thing>("field", "bar", schema,
                      [](const Parameters&, const Registry&) { return std::make_unique<Thing>(); });
  registry.add<Thing>("linear_solver", "auto", Schema("A factorisation."),
                      [](const Parameters&, const Registry&) { return std::make_unique<Thing>(); });
  PluginHost host({});
  const Scene scene = parse_scene_text(
      "{title: a, dimension: 2, meshes: {m: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}}, "
      "fields: {f: {type: bar, mesh: m}}}",
      "scene.yaml", {}, host, registry);
  return resolved_checksum(resolve(scene, registry));
}

}  // namespace

TEST_CASE("a resolved scene has every value in one spelling, defaults filled in") {
  const ResolvedScene values = resolved();
  CHECK(values.at("fields.left.type") == "bar");
  CHECK(values.at("fields.left.density") == "1");
  CHECK(values.at("fields.left.material.young") == "200");
  CHECK(values.at("fields.left.material.poisson") == "0.3");
  CHECK(values.at("fields.left.boundary.0.on") == "[x_min]");
  CHECK(values.at("fields.left.boundary.0.displacement") == "[0, null]");
  CHECK(values.at("fields.left.boundary.1.traction") == "[sin(t)*x, 100]");
  CHECK(values.at("fields.right.material.type") == "rigid");
  CHECK(values.at("meshes.box.grid.cells") == "[4, 4]");
  CHECK(values.at("coupling.0.penalty") == "100");
  CHECK(values.at("solver.newton.tolerance") == "1e-08");
  CHECK(values.at("solver.linear.type") == "auto");
  CHECK(values.at("time.static") == "true");
  CHECK(values.at("time.end") == "1");
  CHECK(values.at("output.probes.pull.on") == "[x_max]");
  CHECK(values.at("parameters.E") == "100");
}

TEST_CASE("what does not decide what is computed leaves the checksum as it is") {
  const std::string as_it_is = with("", "");
  const auto [what, found, instead] = GENERATE(table<std::string, std::string, std::string>({
      {"title", "title: Two bars", "title: One bar"},
      {"source", "title: Two bars", "title: Two bars\nsource: a paper"},
      {"tier", "title: Two bars", "title: Two bars\ntier: nightly"},
      {"format version", "title: Two bars", "title: Two bars\nformat: 1"},
      {"comment", "dimension: 2", "dimension: 2  # a plane"},
      {"folders with plugins", "dimension: 2", "dimension: 2\nplugin_folders: [elsewhere]"},
      {"order of keys", "{type: steel, young: 2*E, poisson: 0.3}", "{poisson: 0.3, young: 2*E, type: steel}"},
      {"spelling of a number", "poisson: 0.3", "poisson: 3.0e-1"},
      {"an expression of the same value", "young: 2*E", "young: 200"},
      {"a parameter's other spelling", "E: 100", "E: 1e2"},
      {"a parameter in braces", "young: 2*E", "young: \"2*${E}\""},
      {"a parameter that nothing uses", "  E: 100", "  E: 100\n  unused: 3"},
      {"blanks in a formula", "sin(t)*x", "sin( t ) * x"},
      {"one name for a list of one", "on: [x_max]", "on: x_max"},
      {"a default that is written out", "type: bar, mesh: box,", "type: bar, mesh: box, density: 1.0,"},
      {"a default of a coupling", "{type: glue, on: seam}", "{type: glue, on: seam, penalty: 1e2}"},
      {"a type as an object", "material: rigid", "material: {type: rigid}"},
      {"defaults of the solver",
       "output:", "solver: {newton: {tolerance: 1e-8, damping: true}, linear: auto}\noutput:"},
      {"the time that a static scene has", "output:", "time: {static: true, end: 1, theta: 1}\noutput:"},
      {"order of maps", "  right:\n    type: bar\n    mesh: other\n    material: rigid\n",
       "  right: {material: rigid, mesh: other, type: bar}\n"},
      {"a check", "is: 0.5, within: 0.1%, source: by hand", "at_most: 0.7, source: a guess"},
      {"output", "output:", "output:\n  every: 10\n  fields: false\n  folder: there"},
      {"restart", "output:", "output:\n  restart: {minutes: 3}"},
      {"a formula", "output:", "output:\n  formulas: {twice: 2*tip}"},
      {"a probe", "at: [1, 1]", "at: [1, 0.5]"},
      {"study", "measure: tip", "measure: [tip, time]"},
  }));
  INFO(what);
  CHECK(with(found, instead) == as_it_is);
}

TEST_CASE("a key decides what is computed unless it is known not to") {
  for (const char* other : {"format", "title", "source", "tier", "output.every", "parameters.h", "plugins",
                            "plugin_folders", "study.measure", "checks.0.is"})
    CHECK_FALSE(determines_numbers(other));
  for (const char* other :
       {"time.end", "fields.water.source", "titles", "a_key_of_tomorrow", "meshes.output"})
    CHECK(determines_numbers(other));
  CHECK(says_what_is_measured("output.errors.velocity.exact"));
  CHECK_FALSE(says_what_is_measured("output.formulas.drag"));
}

TEST_CASE("a parameter in a formula is its value") {
  CHECK(with("sin(t)*x", "E*sin(1e3*t)*x") == with("sin(t)*x", "100*sin(1000*t)*x"));
  CHECK(with("sin(t)*x", "h*sin(t)*x") != with("sin(t)*x", "h*sin(t)*x", {{"parameters.h", "1/8"}}));
  CHECK(with("sin(t)*x", "${E}*sin(t)*x") == with("sin(t)*x", "100*sin(t)*x"));
  // Else 2-E would be 2--100, and x^E something else than x^(-100).
  CHECK(with("sin(t)*x", "x^E", {{"parameters.E", "-100"}, {"fields.left.material.young", "1"}}) ==
        with("sin(t)*x", "x^(-100)", {{"parameters.E", "-100"}, {"fields.left.material.young", "1"}}));
}

TEST_CASE("what decides what is computed changes the checksum") {
  const std::string as_it_is = with("", "");
  const auto [what, found, instead] = GENERATE(table<std::string, std::string, std::string>({
      {"a parameter", "E: 100", "E: 101"},
      {"a parameter in its last bit", "E: 100", "E: 100.00000000000001"},
      {"an expression", "sin(t)*x", "cos(t)*x"},
      {"a component that is free", "[0, null]", "[0, 0]"},
      {"a mesh", "cells: [1/h, 4]", "cells: [1/h, 5]"},
      {"a type", "material: rigid", "material: {type: steel, young: 1}"},
      {"a material", "poisson: 0.3", "poisson: 0.31"},
      {"a default", "type: bar, mesh: box,", "type: bar, mesh: box, density: 2,"},
      {"a choice", "type: bar, mesh: box,", "type: bar, mesh: box, strain: small,"},
      {"order", "type: bar, mesh: box,", "type: bar, mesh: box, order: 2,"},
      {"a boundary", "on: x_min", "on: y_min"},
      {"a coupling", "{type: glue, on: seam}", "{type: glue, on: seam, penalty: 99}"},
      {"no coupling", "  - {type: glue, on: seam}\n", "  []\n"},
      {"Newton's tolerance", "output:", "solver: {newton: {tolerance: 1e-9}}\noutput:"},
      {"time", "output:", "time: {end: 1}\noutput:"},
      {"the time step", "output:", "time: {static: true, end: 1, step: {initial: 0.5}}\noutput:"},
      {"the order of a list", "[left, right]", "[right, left]"},
  }));
  INFO(what);
  CHECK(with(found, instead) != as_it_is);
}

TEST_CASE("a default that a plugin's schema changes changes the checksum") {
  CHECK(with_default_density("1") != with_default_density("1000"));
  CHECK(with_default_density("1000") == with_default_density("1e3"));
}

TEST_CASE("parts of functions are told apart by the function") {
  const std::string functions = "functions: {one: wave, two: {type: wave, speed: 2}}\nfields:";
  const auto at = [&](const std::string& traction) {
    return resolved("fields:", functions, {{"fields.left.boundary.1.traction", traction}});
  };
  CHECK(at("one.push").at("fields.left.boundary.1.traction") == "one.push");
  CHECK(at("[one.height, 2]").at("fields.left.boundary.1.traction") == "[one.height, 2]");
  CHECK(resolved_checksum(at("one.push")) != resolved_checksum(at("two.push")));
  CHECK(resolved_checksum(at("[one.height, 2]")) != resolved_checksum(at("[two.height, 2]")));
}

TEST_CASE("a file counts by its content") {
  const auto files = std::filesystem::temp_directory_path() / "seam_resolved";
  std::filesystem::create_directories(files);
  const auto mesh = [&](const std::string& name, const std::string& content) {
    std::ofstream(files / name) << content;
    return resolved_checksum(resolved("{grid: {from: [1, 0], to: [2, 1], cells: [4, 4]}}",
                                      "{file: " + name + "}", {}, files / "scene.yaml"));
  };
  for (const std::string end : {".msh", ".geo"}) {
    const std::string before = mesh("a" + end, "one");
    CHECK(mesh("a" + end, "two") != before);
    CHECK(mesh("a" + end, "one") == before);
    CHECK(mesh("b" + end, "one") == before);
  }
  CHECK(mesh("a.msh", "one") != mesh("a.geo", "one"));
  std::filesystem::remove_all(files);
}

TEST_CASE("differences are told by key, with those of what is measured") {
  using Lines = std::vector<std::string>;
  CHECK(resolved_differences(resolved(), resolved("E: 100", "E: 150")) ==
        Lines{"fields.left.boundary.1.traction: [sin(t)*x, 100], now [sin(t)*x, 150]",
              "fields.left.material.young: 200, now 300"});
  CHECK(resolved_differences(resolved(), resolved("at: [1, 1]", "at: [1, 0.5]")) ==
        Lines{"output.probes.tip.at: [1, 1], now [1, 0.5]"});
  CHECK(resolved_differences(resolved(), resolved("within: 0.1%", "within: 1%")).empty());
  CHECK(resolved_differences(resolved(), resolved("  - {type: glue, on: seam}\n", "  []\n")).front() ==
        "coupling: not there, now []");
}
