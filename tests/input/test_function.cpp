// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "seam/plugin/plugin_host.hpp"
#include "seam/scene/function.hpp"
#include "seam/scene/scene.hpp"
#include "test_types.hpp"

using namespace seam;
using namespace seam_test;
using Catch::Matchers::Contains;

namespace {

/// level = speed t, flow = (x, y + t).
class Tide final : public Function {
 public:
  explicit Tide(double speed) : speed_(speed) {}
  [[nodiscard]] const std::vector<Member>& members() const override {
    static const std::vector<Member> parts{{"level", 1}, {"flow", 2}};
    return parts;
  }
  void evaluate(int part, const double* x, double t, double* value) const override {
    ++evaluations;
    if (part == 0)
      value[0] = speed_ * t;
    else
      value[0] = x[0], value[1] = x[1] + t;
  }
  void rates(int part, const double* x, double t, double* rate, double* second_rate) const override {
    if (part == 1) return Function::rates(part, x, t, rate, second_rate);
    ++evaluations_of_rates;
    rate[0] = speed_;
    second_rate[0] = 7;  // not what values say: so it is seen who is asked
  }
  static inline int evaluations_of_rates = 0;
  static inline int evaluations = 0;

 private:
  double speed_;
};

Scene parse(const std::string& displacement, const std::string& functions) {
  Registry registry;
  register_test_types(registry);
  Schema schema("Water that rises.");
  schema.number("speed", "of its level").above(0);
  registry.add<Function>("function", "tide", schema, [](const Parameters& p, const Registry&) {
    if (p.number("speed") > 100) throw Error("no tide is as fast as that");
    return std::make_unique<Tide>(p.number("speed"));
  });
  PluginHost host({});
  return parse_scene_text(
      "title: Two bars\ndimension: 2\nparameters: {s: 3}\nfunctions: " + functions +
          "\nmeshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [4, 4]}}}\nfields:\n  left:\n    type: "
          "bar\n"
          "    mesh: box\n    material: rigid\n    boundary: [{on: x_min, displacement: " +
          displacement + "}]\n",
      "scene.yaml", {}, host, registry);
}

const std::string tide = "{sea: {type: tide, speed: 2*s}}";

}  // namespace

TEST_CASE("expressions use the parts of functions by name") {
  const Scene scene = parse("sea.flow", tide);
  const Parameters& fixed = scene.root.map("fields")[0].second.list("boundary")[0];
  const auto& flow = fixed.vector_expression("displacement");
  REQUIRE(flow.size() == 2);
  CHECK(fixed.component_given("displacement", 1));
  const double here[2] = {0.25, 0.5}, there[2] = {1, 2};
  Tide::evaluations = 0;
  CHECK(flow[0](here, 2, 10) == 0.25);
  CHECK(flow[1](here, 2, 10) == 10.5);
  CHECK(Tide::evaluations == 1);
  CHECK(flow[1](there, 2, 10) == 12);
  CHECK(flow[1](there, 2, 11) == 13);
  CHECK(Tide::evaluations == 3);
  CHECK_FALSE(flow[0].is_constant());
  const Scene mixed = parse("[null, sea.level]", tide);
  const auto& level =
      mixed.root.map("fields")[0].second.list("boundary")[0].vector_expression("displacement");
  CHECK(level[1](here, 2, 7) == 42);
}

TEST_CASE("rates of a function are those that it gives, or found from its values") {
  const Scene scene = parse("[sea.level, sea.level]", tide), other = parse("sea.flow", tide);
  const auto displacement = [](const Scene& of) {
    return of.root.map("fields")[0].second.list("boundary")[0].vector_expression("displacement");
  };
  const auto level = displacement(scene), flow = displacement(other);
  const double here[2] = {0.25, 0.5}, there[2] = {1, 2};
  Tide::evaluations_of_rates = 0;
  CHECK(level[0].rates(here, 2, 10) == std::array<double, 2>{6, 7});
  CHECK(level[0].rates(here, 2, 10) == std::array<double, 2>{6, 7});
  CHECK(Tide::evaluations_of_rates == 1);
  CHECK(level[0].rates(there, 2, 10)[1] == 7);
  CHECK(level[0].rates(there, 2, 11)[1] == 7);
  CHECK(Tide::evaluations_of_rates == 3);
  CHECK(flow[0].rates(here, 2, 10)[0] == Approx(0).margin(1e-10));
  CHECK(flow[1].rates(here, 2, 10)[0] == Approx(1).epsilon(1e-10));
  CHECK(flow[1].rates(here, 2, 10)[1] == Approx(0).margin(1e-7));
  CHECK(flow[1](here, 2, 10) == 10.5);
}

TEST_CASE("what is wrong with a function is said once, with the nearest name") {
  CHECK_THROWS_WITH(parse("see.flow", tide), Contains("no function 'see'") && Contains("mean 'sea'"));
  CHECK_THROWS_WITH(parse("sea.flw", tide),
                    Contains("function 'sea' has no part 'flw'") && Contains("mean 'flow'"));
  CHECK_THROWS_WITH(parse("sea.level", tide), Contains("'sea.level' has 1 components, expected 2"));
  CHECK_THROWS_WITH(parse("[sea.flow, 0]", tide), Contains("'sea.flow' has 2 components, expected one"));
  CHECK_THROWS_WITH(parse("sea.flow", "{sea: {type: tide, speed: -1}}"),
                    Contains("functions.sea.speed") && !Contains("no function"));
  CHECK_THROWS_WITH(parse("sea.flow", "{sea: {type: tide, speed: 200}}"), Contains("no tide is as fast"));
  CHECK_THROWS_WITH(parse("sea.flow", "{sea: {type: tid, speed: 1}}"), Contains("mean 'tide'"));
}
