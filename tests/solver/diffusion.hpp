// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/linear/mumps_solver.hpp"
#include "seam/mesh/input/grid.hpp"
#include "seam/record/evaluate.hpp"
#include "seam/solve/newton.hpp"
#include "seam/term/kernel_term.hpp"

/// A small nonlinear physics of one scalar unknown, to test what the core does without a plugin.
namespace seam::test {

using c = Scalar<0>;

/// (grad dc, (1 + c^2) grad c) - (dc, source)
struct Diffusion {
  using Reads = Slots<Value<c>, Gradient<c>>;
  using Tests = Slots<Value<c>, Gradient<c>>;
  double source = 1;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T value = s.value(c{});
    r.gradient(c{}) += (1.0 + value * value) * s.gradient(c{});
    r.value(c{}) -= source;
  }
};

/// <tau [dc/dn], [dc/dn]> over interior faces, and a second-derivative term.
struct JumpPenalty {
  using left = Scalar<0>;
  using right = Scalar<1>;
  using Reads = Slots<NormalDerivative<left>, NormalDerivative<right>, SecondNormalDerivative<left>,
                      SecondNormalDerivative<right>>;
  using Tests = Reads;
  double first = 0.1, second = 0;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const double h = x.cell_size;
    const T jump = first * h * (s.normal_derivative(left{}) - s.normal_derivative(right{}));
    r.normal_derivative(left{}) += jump;
    r.normal_derivative(right{}) -= jump;
    const T bend =
        second * h * h * h * (s.second_normal_derivative(left{}) - s.second_normal_derivative(right{}));
    r.second_normal_derivative(left{}) += bend;
    r.second_normal_derivative(right{}) -= bend;
  }
};

struct Options {
  double source = 1;
  double first_jump = 0, second_jump = 0;
  bool held = true;  ///< c = value on x_min
  int order = 1;
  std::string value = "0";
};

class DiffusionPhysics final : public Physics {
 public:
  explicit DiffusionPhysics(Options options) : options_(std::move(options)) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override {
    return {{"c", 1, options_.order, 0, ""}};
  }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(Diffusion{options_.source}), {"c"});
    if (options_.first_jump > 0 || options_.second_jump > 0)
      setup.add_interior_face_term(make_term(JumpPenalty{options_.first_jump, options_.second_jump}),
                                   {{0, "c"}, {1, "c"}});
    if (options_.held) setup.prescribe("x_min", "c", 0, Expression(options_.value, {}), {});
  }

 private:
  Options options_;
};

inline std::shared_ptr<const MeshData> box(CellType cell, int n, double length = 1) {
  Grid grid;
  grid.cell = cell;
  for (int d = 0; d < topology(cell).dimension; ++d) grid.lines[d] = graded_lines(0, d == 0 ? length : 1, n);
  return std::make_shared<MeshData>(make_grid(grid));
}

inline std::unique_ptr<Problem> diffusion_problem(CellType cell, int n, const Options& options) {
  auto problem = std::make_unique<Problem>(Communicator());
  problem->add_field("body", std::make_shared<Mesh>("box", box(cell, n), Communicator()),
                     std::make_unique<DiffusionPhysics>(options));
  return problem;
}

inline NewtonReport solve_static(Problem& problem, double time = 1) {
  MumpsSolver solver;
  Newton newton(problem, solver, {1e-11, 1e-5, 25, true});
  const TimePoint at = time_point(time, 0, 1);
  problem.begin_step(at);
  return newton.solve(at);
}

}  // namespace seam::test
