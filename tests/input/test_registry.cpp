// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "seam/base/diagnostics.hpp"
#include "test_types.hpp"

using namespace seam;
using Catch::Matchers::Contains;

TEST_CASE("the registry builds what a type names") {
  Registry registry;
  seam_test::register_test_types(registry);
  Parameters parameters;
  parameters.set_type("steel");
  CHECK(registry.create<seam_test::Thing>("material", parameters) != nullptr);
  CHECK_THROWS_WITH(registry.create<int>("material", parameters),
                    Contains("another version of this interface"));
  parameters.set_type("stone");
  CHECK_THROWS_WITH(registry.create<seam_test::Thing>("material", parameters),
                    Contains("known: rigid, steel"));
  CHECK(registry.names("material") == std::vector<std::string>{"rigid", "steel"});
}

TEST_CASE("a name can be taken once") {
  Registry registry;
  seam_test::register_test_types(registry);
  registry.set_current_plugin("second");
  CHECK_THROWS_WITH(seam_test::register_test_types(registry),
                    Contains("by plugin 'core' and by plugin 'second'"));
  registry.add<seam_test::Thing>("material", "wood", Schema(), nullptr);
  registry.remove_plugin("second");
  CHECK(registry.find("material", "wood") == nullptr);
  CHECK(registry.find("material", "steel") != nullptr);
}

TEST_CASE("the nearest name is one that may be meant") {
  CHECK(nearest_name("densty", {"density", "mesh"}) == "density");
  CHECK(nearest_name("Density", {"density"}) == "density");
  CHECK(nearest_name("dnesity", {"density"}) == "density");
  CHECK(nearest_name("banana", {"density", "mesh"}).empty());
  CHECK(nearest_name("", {"a"}).empty());
  CHECK(nearest_name("x", {"y"}).empty());
}

TEST_CASE("diagnostics are sorted and limited") {
  Diagnostics diagnostics;
  diagnostics.warning({"b", 2, 1}, "later");
  diagnostics.error({"b", 1, 7}, "sooner");
  CHECK(diagnostics.text() == "b:1:7: error: sooner\nb:2:1: warning: later");
  CHECK_THROWS_WITH(diagnostics.throw_if_errors(), diagnostics.text());
  for (int i = 0; i < 100; ++i) diagnostics.error({"c", i + 1, 0}, "x");
  CHECK_THAT(diagnostics.text(), Catch::Matchers::EndsWith("... and 52 more"));
}
