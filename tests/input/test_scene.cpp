// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <random>

#include "golden.hpp"
#include "seam/plugin/plugin_host.hpp"
#include "seam/scene/explain.hpp"
#include "seam/scene/json_schema.hpp"
#include "seam/scene/scene.hpp"
#include "seam/scene/yaml_tree.hpp"
#include "test_types.hpp"

using namespace seam;
using namespace seam_test;
using Catch::Matchers::Contains;

namespace {

const std::filesystem::path folder = std::filesystem::path(SEAM_SOURCE_DIR) / "tests/input";

Scene parse(const std::string& text, const Overrides& overrides = {}) {
  Registry registry;
  register_test_types(registry);
  PluginHost host({});
  return parse_scene_text(text, "scene.yaml", overrides, host, registry);
}

std::string good_text() { return read_text(folder / "good.yaml"); }

}  // namespace

TEST_CASE("a scene becomes values, with defaults filled in") {
  const Scene scene = parse(good_text());
  CHECK(scene.root.text("title") == "Two bars");
  CHECK(scene.parameters.at("h") == 0.25);
  const Parameters& left = scene.root.map("fields")[0].second;
  CHECK(scene.root.map("fields")[0].first == "left");
  CHECK(left.type() == "bar");
  CHECK(left.dimension() == 2);
  CHECK(left.number("density") == 1.0);
  CHECK_FALSE(left.given("density"));
  CHECK(left.object("material").number("young") == 200.0);
  CHECK(left.where("mesh").text() == "scene.yaml:10:27");
  const Parameters& fixed = left.list("boundary")[0];
  CHECK(fixed.names("on") == std::vector<std::string>{"x_min"});
  CHECK(fixed.component_given("displacement", 0));
  CHECK_FALSE(fixed.component_given("displacement", 1));
  CHECK(scene.root.map("fields")[1].second.object("material").type() == "rigid");
  CHECK(scene.root.object("solver").object("newton").integer("maximum_iterations") == 25);
  CHECK(scene.root.object("solver").object("linear").type() == "auto");
  CHECK_FALSE(scene.root.has("time"));
  CHECK(scene.root.object("study").map("vary")[0].second.names("values") ==
        std::vector<std::string>{"1/4", "1/8"});
  CHECK(scene.warnings.all().empty());
  CHECK_THROWS_AS(left.number("mesh"), std::logic_error);
  CHECK_THROWS_AS(left.number("absent"), std::logic_error);
}

TEST_CASE("overrides replace and add values") {
  const Scene scene = parse(good_text(), {{"parameters.h", "1/32"},
                                          {"fields.left.density", "2*h"},
                                          {"fields.left.boundary.0.on", "[x_max, y_max]"},
                                          {"time.end", "2"}});
  CHECK(scene.parameters.at("h") == 0.03125);
  const Parameters& left = scene.root.map("fields")[0].second;
  CHECK(left.number("density") == 0.0625);
  CHECK(left.list("boundary")[0].names("on").size() == 2);
  CHECK(scene.root.object("time").number("end") == 2.0);
  CHECK_THROWS_WITH(parse(good_text(), {{"fields.left.densty", "1"}}),
                    Contains("--set fields.left.densty=1") && Contains("mean 'density'"));
  CHECK_THROWS_WITH(parse(good_text(), {{"title.x", "1"}}), Contains("has no keys"));
  CHECK_THROWS_WITH(parse(good_text(), {{"fields.left.boundary.7.on", "a"}}), Contains("count from 0"));
}

TEST_CASE("a bound is in its range or not, as the schema says") {
  const auto accepts = [](const std::string& key, const std::string& value) {
    try {
      parse(good_text(), {{"fields.left." + key, value}});
      return true;
    } catch (const Error& error) {
      CHECK_THAT(error.what(), Contains("is out of range"));
      return false;
    }
  };
  CHECK(accepts("material.poisson", "0"));  // at_least
  CHECK_FALSE(accepts("material.poisson", "-1e-9"));
  CHECK(accepts("material.poisson", "0.499999999"));
  CHECK_FALSE(accepts("material.poisson", "0.5"));  // below
  CHECK(accepts("density", "1e-9"));
  CHECK_FALSE(accepts("density", "0"));  // above
  CHECK(accepts("order", "1"));
  CHECK_FALSE(accepts("order", "0"));
  CHECK(accepts("order", "2"));  // at_most
  CHECK_FALSE(accepts("order", "3"));
}

TEST_CASE("a whole number beyond the largest is refused") {
  CHECK_NOTHROW(parse(good_text(), {{"output.every", "2147483647"}}));
  for (const std::string number : {"2147483648", "1e20", "1e300"})
    CHECK_THROWS_WITH(parse(good_text(), {{"output.every", number}}),
                      Contains("is out of range, expected a whole number of no more than 2147483647"));
}

TEST_CASE("a scene of a newer format is refused before anything else is said") {
  for (const std::string format : {"", "format: 1\n"}) CHECK_NOTHROW(parse(format + good_text()));
  const std::string newer = "format: 2\nunheard: 3\n" + good_text();
  CHECK_THROWS_WITH(parse(newer),
                    Contains("scene.yaml:1:9: error: format: found 2, this Seam reads scenes of "
                             "format 1; use a newer Seam") &&
                        !Contains("unheard"));
  for (const std::string format : {"0", "1.5", "1 + 1", "one"})
    CHECK_THROWS_WITH(parse("format: " + format + "\n" + good_text()), Contains("format"));
}

TEST_CASE("the key that YAML 1.1 makes of `on` is understood") {
  for (const std::string key : {"true", "True", "\"true\""}) {
    const Scene scene = parse(replaced(good_text(), "{on: ", "{" + key + ": "));
    const Parameters& fixed = scene.root.map("fields")[0].second.list("boundary")[0];
    CHECK(fixed.names("on") == std::vector<std::string>{"x_min"});
  }
  CHECK_THROWS_WITH(parse(replaced(good_text(), "{on: ", "{on: x_max, true: ")), Contains("given twice"));
}

TEST_CASE("names of boundaries are checked against the meshes") {
  Registry registry;
  register_test_types(registry);
  PluginHost host({});
  const Scene scene = parse_scene_text(good_text(), "scene.yaml", {}, host, registry);
  CHECK_NOTHROW(check_mesh_names(scene, registry, {{"box", {{"x_min", "x_max"}, {}}}}));
  CHECK_THROWS_WITH(
      check_mesh_names(scene, registry, {{"box", {{"xmin"}, {}}}}),
      Contains("fields.left.boundary[0].on: the mesh 'box' (scene.yaml:7:8) has no boundary 'x_min'") &&
          Contains("Did you mean 'xmin'?") && Contains("output.probes.pull.on"));
  SECTION("in an object inside the one that names the field") {
    register_coat(registry);
    std::string text = good_text();
    const std::string tie = "{type: tie, fields: [left, right]}";
    text.replace(text.find(tie), tie.size(), "{type: coat, body: left, parts: [{on: top}]}");
    const Scene coated = parse_scene_text(text, "scene.yaml", {}, host, registry);
    CHECK_THROWS_WITH(
        check_mesh_names(coated, registry, {{"box", {{"x_min", "x_max"}, {}}}}),
        Contains("interfaces.seam.parts[0].on: the mesh 'box'") && Contains("no boundary 'top'"));
  }
}

TEST_CASE("broken scenes are refused with the expected messages") {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "broken")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  REQUIRE(files.size() >= 10);
  for (const auto& file : files) {
    Registry registry;
    register_test_types(registry);
    PluginHost host({});
    std::string message = "accepted";
    try {
      const Scene scene = load_scene(file, {}, host, registry);
      message = scene.warnings.text();
    } catch (const Error& e) {
      message = e.what();
    }
    check_golden(replaced(message, file.parent_path().string() + "/", ""),
                 std::filesystem::path(file).replace_extension(".txt"));
  }
}

TEST_CASE("files that are no scenes are refused") {
  CHECK_THROWS_WITH(parse(""), Contains("empty"));
  CHECK_THROWS_WITH(parse("- 1"), Contains("expected the keys of a scene"));
  CHECK_THROWS_WITH(parse("a: \x80"), Contains("byte 0x80"));
  CHECK_THROWS_WITH(parse(std::string("a: \0", 4)), Contains("byte 0x00"));
  CHECK_THROWS_WITH(parse(std::string((1 << 20) + 1, ' ')), Contains("at most"));
  CHECK_THROWS_WITH(parse(std::string(5000, '[')), Contains("nested"));
  CHECK_THROWS_WITH(parse("a: b\rc"),
                    Contains("1:5: error: found a carriage return (byte 0x0d) without a line feed"));
  CHECK_THROWS_WITH(parse("a: b\r"), Contains("a carriage return"));
  CHECK_THROWS_WITH(parse("a: &b [1]\nc: *b"), Contains("anchor"));
  CHECK_THROWS_WITH(parse("a: !!binary x"), Contains("tag"));
  CHECK_THROWS_WITH(parse("a: 1\n---\nb: 2"), Contains("second YAML document"));
  CHECK_THROWS_WITH(parse("[a: b}"), Contains("not valid YAML"));
  CHECK_THROWS_WITH(parse("{[1]: 2}"), Contains("as a key"));
}

TEST_CASE("A word without a colon is no key: a file that was cut short may end with one") {
  for (const std::string end :
       {"title", "title ", "title\t", "title  # which", "title\n", "title\r\n", "a:\n  b: 1\n  title"})
    CHECK_THROWS_WITH(parse_yaml("a1: 1\n" + end, "s.yaml"),
                      Contains("error: found the word 'title' where its block ends; expected 'title:'"));
  CHECK_THROWS_WITH(parse_yaml("- a: 1\n  title", "s.yaml"),
                    Contains("s.yaml:2:3: error: found the word 'title'"));
  for (const std::string whole :
       {"title:", "title :", "title:\nb: 1", "a: {title}", "a: {title, b}", "? title",
        "\"title\":", "a: [title]", "- title", "title: # which", "title:\r\nb:\r\n"}) {
    INFO(whole);
    CHECK_NOTHROW(parse_yaml(whole, "s.yaml"));
  }
}

TEST_CASE("large files, broken or not, take seconds at most") {
  std::string fields = "fields:\n", meshes = "meshes:\n", unknown = "xs: [";
  for (int i = 0; i < 6000; ++i) {
    const std::string number = std::to_string(i);
    fields += "  f" + number + ": {type: bar, mesh: m" + number + ", material: rigid}\n";
    meshes += "  m" + number + ": {}\n";
  }
  const std::string head = "title: large\ndimension: 2\n";
  CHECK(parse(head + meshes + fields).root.map("fields").size() == 6000);
  CHECK_THROWS_WITH(parse(head + replaced(meshes, "  m", "  n") + fields), Contains("more"));
  for (int i = 0; i < 30000; ++i) unknown += "z, ";
  CHECK_THROWS_AS(parse(head + unknown + "]"), Error);
  std::string keys;
  for (int i = 0; i < 20000; ++i) keys += "key" + std::to_string(i) + ": 1\n";
  CHECK_THROWS_WITH(parse(keys), Contains("more"));
  std::string sum = "1";
  for (int i = 0; i < 900; ++i) sum += "+E";
  CHECK(parse(head + "parameters: {E: 1, big: " + sum + "}\nmeshes: {}\nfields: {}").parameters.at("big") ==
        901.0);
}

TEST_CASE("mutations of a scene never do worse than an error") {
  const std::string seed = good_text();
  const std::string letters = "[]{}:,-&*!|>'\"%@`#? \n\tabcxyz019.eE+$\x80\xc3";
  std::mt19937 random(7);
  int accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = seed;
    for (unsigned edits = 1 + random() % 4; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = letters[random() % letters.size()];
          break;
        case 1:
          text.insert(at, 1, letters[random() % letters.size()]);
          break;
        case 2:
          text.erase(at, 1 + random() % 20);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 40));
      }
    }
    try {
      parse(text);
      ++accepted;
    } catch (const Error& e) {
      CHECK_FALSE(std::string(e.what()).empty());
    }
  }
  // Mutations of texts and numbers leave valid scenes; if none did, the test would test the YAML parser only.
  CHECK(accepted > 20);
}

TEST_CASE("schema, explanation and list of types come from the declarations") {
  Registry registry;
  register_test_types(registry);
  check_golden(explain(*registry.find("field", "bar"), registry), folder / "golden/explain_bar.txt");
  const std::string types = list_types(registry);
  CHECK_THAT(types, Contains("steel") && Contains("An elastic body, for the tests. (core)"));
  const std::string schema = json_schema(scene_schema(), registry);
  CHECK_THAT(schema, Contains("\"#/definitions/field\"") && Contains("\"field.bar\"") &&
                         Contains("mass per volume [kg/m^3] (default: 1)"));
}

TEST_CASE("a default may follow from a key declared before it, and is explained as a rule") {
  Registry registry;
  register_test_types(registry);
  Schema film("A film.");
  film.integer("order", "of its unknowns").at_least(1).at_most(2).otherwise("1");
  film.typed("material", "how it deforms", "material")
      .otherwise("`rigid` of order 1, steel of order 2", [](const Parameters& before) {
        return before.has("order") && before.integer("order") == 2 ? "{type: steel, young: 7}" : "rigid";
      });
  registry.add<Thing>("field", "film", film,
                      [](const Parameters&, const Registry&) { return std::make_unique<Thing>(); });
  PluginHost host({});
  const auto read = [&](const std::string& order) {
    return parse_scene_text(
        "title: A film\ndimension: 2\nplugins: []\nmeshes: {}\nfields: {a: {type: film, order: " + order +
            "}}\n",
        "scene.yaml", {}, host, registry);
  };
  const auto material = [&](const Scene& scene) {
    return scene.root.map("fields")[0].second.object("material");
  };
  CHECK(material(read("1")).type() == "rigid");
  const Scene stiff = read("2");
  CHECK(material(stiff).number("young") == 7);
  CHECK_FALSE(stiff.root.map("fields")[0].second.given("material"));
  // A mistake in the key that the rule asks for is told as such, and nothing beside it.
  CHECK_THROWS_WITH(read("3"), Contains("fields.a.order") && !Contains("material"));
  CHECK_THAT(explain(*registry.find("field", "film"), registry),
             Contains("(default `rigid` of order 1, steel of order 2)"));
}
