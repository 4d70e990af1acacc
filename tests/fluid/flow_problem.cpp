// SPDX-License-Identifier: BSD-3-Clause
#include "flow_problem.hpp"

#include <catch2/catch.hpp>

#include "fluid.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/scene/validate.hpp"

namespace seam::test {

std::unique_ptr<Physics> make_fluid(int dimension, const std::string& yaml,
                                    const std::map<std::string, double>& parameters) {
  Registry registry;
  fluid::declare_stabilisations(registry);
  Diagnostics diagnostics;
  ValidationContext context{.registry = registry,
                            .diagnostics = diagnostics,
                            .dimension = dimension,
                            .parameters = parameters,
                            .folder = {},
                            .provider = {},
                            .used_plugins = {}};
  const Parameters values =
      validate(parse_yaml("mesh: box\n" + yaml, "fluid.yaml"), fluid::Fluid::schema(), context, "fluid");
  diagnostics.throw_if_errors();
  return std::make_unique<fluid::Fluid>(values, registry);
}

namespace {

/// A shear that leaves the planes of constant x and y where they are.
void distort(MeshData& mesh) {
  const int dim = mesh.dimension;
  for (int n = 0; n < mesh.node_count(); ++n) {
    double* x = &mesh.coordinates[static_cast<std::size_t>(n) * dim];
    double bump = 0.06;
    for (int d = 0; d < dim; ++d) bump *= 4 * x[d] * (1 - x[d]);
    for (int d = 0; d < dim; ++d) x[d] += d % 2 == 0 ? bump : -bump;
  }
}

}  // namespace

std::unique_ptr<Problem> make_flow(const Box& box, const std::string& yaml,
                                   const std::map<std::string, double>& parameters) {
  Grid grid;
  grid.cell = box.cell;
  for (int d = 0; d < box.dimension(); ++d)
    grid.lines[d] = graded_lines(0, 1, box.cells, box.distorted ? 1.3 : 1.0);
  auto data = std::make_shared<MeshData>(make_grid(grid));
  if (box.distorted) distort(*data);
  auto problem = std::make_unique<Problem>(Communicator());
  problem->add_field("water", std::make_shared<Mesh>("box", data, Communicator()),
                     make_fluid(box.dimension(), yaml, parameters));
  problem->finish();
  return problem;
}

void march(Problem& problem, double end, int steps, double theta) {
  MumpsSolver solver;
  Newton newton(problem, solver, {1e-12, 1e-5, 25, true});
  problem.initialise(0, steps > 0);
  for (int k = 1; k <= std::max(steps, 1); ++k) {
    const TimePoint at = steps > 0 ? time_point(end * k / steps, end / steps, theta) : time_point(end, 0, 1);
    problem.begin_step(at);
    const NewtonReport report = newton.solve(at);
    INFO(report.reason);
    REQUIRE(report.converged);
  }
}

FlowErrors errors(const Problem& problem, const ExactFlow& exact, double time) {
  const FieldEntry& water = problem.fields()[0];
  const ErrorNorms velocity =
      error_norms(water, "velocity", expressions(exact.velocity), expressions(exact.gradient), time);
  const ErrorNorms pressure = error_norms(water, "pressure", expressions({exact.pressure}), {}, time);
  return {velocity.l2, *velocity.h1, pressure.l2};
}

}  // namespace seam::test
