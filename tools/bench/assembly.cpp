// SPDX-License-Identifier: BSD-3-Clause
// Tangent assembly, matrix insertion included: microseconds per cell, and memory beside the matrix.
//   seam-bench-assembly [cells per side of the cube] [cells per side of the square]
// The same two forms and meshes are timed in DOLFINx by dolfinx_assembly.py, in one run by assembly.sh.
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "seam/base/stopwatch.hpp"
#include "seam/mesh/input/grid.hpp"
#include "seam/solve/problem.hpp"
#include "seam/term/kernel_term.hpp"

namespace {

using namespace seam;

/// Neo-Hookean energy c (I1 - 3) + c/beta (J^(-2 beta) - 1), differentiated by hand once to its stress.
struct NeoHookean {
  using u = Vector<0>;
  using Reads = Slots<Gradient<u>>;
  using Tests = Slots<Gradient<u>>;
  double c = 0.5, beta = 0.75;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::pow;
    auto f = s.gradient(u{});
    for (int i = 0; i < dim; ++i) f(i, i) += 1.0;
    const auto cof = cofactor(f);
    const T factor = 2 * c * pow(determinant(f, cof), -2 * beta - 1);
    r.gradient(u{}) += (2 * c) * f - factor * cof;
  }
};

/// Navier-Stokes with a pressure stabilisation, as in the DOLFINx program.
struct NavierStokes {
  using v = Vector<0>;
  using p = Scalar<1>;
  using Reads = Slots<Value<v>, Gradient<v>, Value<p>, Gradient<p>>;
  using Tests = Slots<Value<v>, Gradient<v>, Value<p>, Gradient<p>>;
  double rho_over_dt = 10, mu = 1, tau = 0.01;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const auto velocity = s.value(v{});
    const auto gradient = s.gradient(v{});
    r.value(v{}) += gradient * velocity + rho_over_dt * velocity;
    auto stress = (2 * mu) * sym(gradient);
    for (int i = 0; i < dim; ++i) stress(i, i) -= s.value(p{});
    r.gradient(v{}) += stress;
    r.value(p{}) += trace(gradient);
    r.gradient(p{}) += tau * s.gradient(p{});
  }
};

class Carrier final : public Physics {
 public:
  Carrier(std::vector<Unknown> unknowns, std::shared_ptr<const Term> term)
      : unknowns_(std::move(unknowns)), term_(std::move(term)) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return unknowns_; }
  void build(FieldSetup& setup) const override {
    std::vector<std::string> names;
    for (const Unknown& u : unknowns_) names.push_back(u.name);
    setup.add_cell_term(term_, names);
  }

 private:
  std::vector<Unknown> unknowns_;
  std::shared_ptr<const Term> term_;
};

/// Resident memory of this process now, bytes.
double resident() {
  std::ifstream status("/proc/self/statm");
  double pages = 0, own = 0;
  status >> pages >> own;
  return own * 4096;
}

void run(const std::string& what, CellType cell, int n, const std::vector<Unknown>& unknowns,
         const std::shared_ptr<const Term>& term) {
  const Communicator world;
  auto problem = std::make_unique<Problem>(world);
  {
    Grid grid;
    grid.cell = cell;
    for (int d = 0; d < topology(cell).dimension; ++d) grid.lines[d] = graded_lines(0, 1, n);
    auto data = std::make_shared<MeshData>(make_grid(grid));
    problem->add_field("field", std::make_shared<Mesh>("box", data, world),
                       std::make_unique<Carrier>(unknowns, term));
  }
  const double before = resident();
  const Stopwatch setup;
  problem->finish();
  const double pattern_seconds = setup.seconds();
  TimePoint at = time_point(1, 0, 1);
  double best = 1e300;
  for (int repeat = 0; repeat < 5; ++repeat) {
    MPI_Barrier(world.handle());
    const Stopwatch watch;
    problem->assembler().assemble(at, true);
    best = std::min(best, world.max(watch.seconds()));
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto& matrix = problem->assembler().matrix();
  const double matrix_bytes = world.sum(12.0 * static_cast<double>(matrix.entries()) + 8.0 * matrix.rows);
  const double growth = world.sum(1024.0 * static_cast<double>(usage.ru_maxrss) - before);
  const double cells = static_cast<double>(problem->fields()[0].mesh->whole().cell_count());
  if (world.rank() == 0)
    fmt::print(
        "{}: {:.2f} us/cell on {} ranks ({:.3f} s, pattern {:.3f} s; peak growth {:.0f} MB = {:.2f} x matrix "
        "of {:.0f} MB)\n",
        what, 1e6 * best / cells, world.size(), best, pattern_seconds, growth / 1e6, growth / matrix_bytes,
        matrix_bytes / 1e6);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int cube = argc > 1 ? std::atoi(argv[1]) : 32, square = argc > 2 ? std::atoi(argv[2]) : 200;
  if (square > 0)
    run("quad4 Navier-Stokes tangent", CellType::quadrilateral, square,
        {{"velocity", 2, 1, 0, ""}, {"pressure", 1, 1, 0, ""}}, make_term(NavierStokes{}));
  if (cube > 0)
    run("hex8 neo-Hookean tangent", CellType::hexahedron, cube, {{"displacement", 3, 1, 0, ""}},
        make_term(NeoHookean{}));
  MPI_Finalize();
}
