// SPDX-License-Identifier: BSD-3-Clause
#include "manufactured.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam::test {
namespace {

/// The law of materials.cpp under test comes from the registry, as scenes get it.
PotentialPointer neo_hookean(double poisson) {
  Registry registry;
  solid::declare_materials(registry);
  Parameters p;
  p.set_type("neo_hookean");
  p.set("young", {1.0, {}, {}, true});
  p.set("poisson", {poisson, {}, {}, true});
  return registry.create<Potential>("hyperelastic", p);
}

class ManufacturedSolid final : public Physics {
 public:
  explicit ManufacturedSolid(const Body& body) : body_(body), material_(neo_hookean(body.poisson)) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int dimension) const override {
    std::vector<Unknown> all{
        {"displacement", dimension, body_.order, body_.dynamic ? 2 : 0, "m", UnknownRole::motion}};
    if (body_.mixed) {
      all.push_back({"pressure", 1, 1, 0, "Pa", UnknownRole::constraint});
      all.push_back({"dilation", 1, 1, 0, ""});
    }
    return all;
  }
  void build(FieldSetup& setup) const override {
    const std::vector<std::string> u{"displacement"};
    if (body_.mixed)
      setup.add_cell_term(make_term(solid::MixedInternalForce{material_}),
                          {"displacement", "pressure", "dilation"});
    else
      setup.add_cell_term(make_term(solid::InternalForce{{material_}}), u);
    if (body_.dynamic) setup.add_cell_term(make_term(BodyInertia{density}), u);
    setup.add_cell_term(make_term(ManufacturedLoad{body_.exact, material_, density, body_.dynamic}, 2), u);
    const int dim = setup.dimension();
    const auto exact = body_.exact.text(dim), rate = body_.exact.rate_text(dim);
    for (int d = 0; d < dim; ++d) {
      for (const char* axis : {"x", "y", "z"})
        for (const char* end : {"min", "max"})
          if (axis[0] - 'x' < dim)
            setup.prescribe(std::string(axis) + "_" + end, "displacement", d, exact[d], {});
      setup.set_initial("displacement", d, exact[d]);
      setup.set_initial_rate("displacement", d, rate[d]);
    }
  }

 private:
  static constexpr double density = 1.5;
  Body body_;
  PotentialPointer material_;
};

std::string scaled(const Wave& w, const std::string& time_factor) {
  return fmt::format("{}*{}", w.amplitude, time_factor);
}

std::string shape(const Wave& w, int i, int dim) {
  static const char* x[] = {"x", "y", "z"};
  return w.linear ? fmt::format("({} + 0.5*{})", x[i], x[(i + 1) % dim])
                  : fmt::format("sin(pi*{} + 0.3)*cos(pi*{})", x[i], x[(i + 1) % dim]);
}

}  // namespace

std::vector<Expression> Wave::text(int dim) const {
  std::vector<Expression> e;
  for (int i = 0; i < dim; ++i)
    e.emplace_back(scaled(*this, fmt::format("cos({}*t)", frequency)) + "*" + shape(*this, i, dim),
                   std::map<std::string, double>{});
  return e;
}

std::vector<Expression> Wave::rate_text(int dim) const {
  std::vector<Expression> e;
  for (int i = 0; i < dim; ++i)
    e.emplace_back(scaled(*this, fmt::format("(-{0})*sin({0}*t)", frequency)) + "*" + shape(*this, i, dim),
                   std::map<std::string, double>{});
  return e;
}

std::vector<Expression> Wave::gradient_text(int dim) const {
  static const char* x[] = {"x", "y", "z"};
  std::vector<Expression> e;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      const int k = (i + 1) % dim;
      std::string slope = "0";
      if (j == i) slope = linear ? "1" : fmt::format("pi*cos(pi*{} + 0.3)*cos(pi*{})", x[i], x[k]);
      if (j == k) slope = linear ? "0.5" : fmt::format("(-pi)*sin(pi*{} + 0.3)*sin(pi*{})", x[i], x[k]);
      e.emplace_back(fmt::format("{}*cos({}*t)*{}", amplitude, frequency, slope),
                     std::map<std::string, double>{});
    }
  return e;
}

std::unique_ptr<Problem> make_problem(const Body& body) {
  Grid grid;
  grid.cell = body.cell;
  grid.order = body.geometry_order;
  for (int d = 0; d < topology(body.cell).dimension; ++d) grid.lines[d] = graded_lines(0, 1, body.cells, 1.3);
  auto data = std::make_shared<MeshData>(make_grid(grid));
  auto problem = std::make_unique<Problem>(Communicator());
  problem->add_field("body", std::make_shared<Mesh>("body", data, Communicator()),
                     std::make_unique<ManufacturedSolid>(body));
  problem->finish();
  return problem;
}

ErrorNorms solve(const Body& body, double theta, double end, int steps) {
  const auto problem = make_problem(body);
  MumpsSolver solver;
  Newton newton(*problem, solver, {1e-11, 1e-5, 25, true});
  problem->initialise(0);
  if (body.dynamic && problem->needs_initial_rates(theta)) newton.solve_initial_rates(0);
  const int count = body.dynamic ? steps : 1;
  for (int k = 1; k <= count; ++k) {
    const TimePoint at = time_point(end * k / count, body.dynamic ? end / count : 0, theta);
    problem->begin_step(at);
    const NewtonReport report = newton.solve(at);
    INFO(report.reason);
    REQUIRE(report.converged);
  }
  const int dim = topology(body.cell).dimension;
  return error_norms(problem->fields()[0], "displacement", body.exact.text(dim),
                     body.exact.gradient_text(dim), end);
}

}  // namespace seam::test
