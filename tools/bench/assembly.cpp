// SPDX-License-Identifier: BSD-3-Clause
// Tangent assembly, matrix insertion included: microseconds per cell, and memory beside the matrix.
//   seam-bench-assembly [cells per side of the cube] [cells per side of the square] [... of a solid and a
//   porous square]
// The last compares a porous body with a solid one, by the plugins' own terms and per entry of the cells'
// matrices. The same two forms and meshes are timed in DOLFINx by dolfinx_assembly.py, in one run by
// assembly.sh.
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "poroelasticity/kernels.hpp"
#include "seam/assembly/assembler.hpp"
#include "seam/base/stopwatch.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/input/grid.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/solve/problem.hpp"
#include "seam/term/kernel_term.hpp"
#include "solid/kernels.hpp"

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

/// Terms and the unknowns that they read.
using Terms = std::vector<std::pair<std::shared_ptr<const Term>, std::vector<std::string>>>;

class Carrier final : public Physics {
 public:
  Carrier(std::vector<Unknown> unknowns, Terms terms)
      : unknowns_(std::move(unknowns)), terms_(std::move(terms)) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return unknowns_; }
  void build(FieldSetup& setup) const override {
    for (const auto& [term, operands] : terms_) setup.add_cell_term(term, operands);
    // Zeros would spare the assembly work.
    for (const Unknown& u : unknowns_)
      for (int c = 0; c < u.components; ++c)
        setup.set_initial(u.name, c, Expression(fmt::format("0.05*sin(2*x + 3*y + {})", c + 1), {}));
  }

 private:
  std::vector<Unknown> unknowns_;
  Terms terms_;
};

/// Plane strain, thesis (2.17), as an energy: the solid plugin's way.
struct Energy {
  double c = 5, beta = 0.75;
  template <class T>
  T energy(const std::array<T, 3>& invariant) const {
    using std::expm1, std::log;
    return c * (invariant[0] - 3.0) + (c / beta) * expm1(-2 * beta * log(invariant[2]));
  }
};

/// Resident memory of this process now, bytes.
double resident() {
  std::ifstream status("/proc/self/statm");
  double pages = 0, own = 0;
  status >> pages >> own;
  return own * 4096;
}

/// @param step 0 for a static form at rest; else its length, s, and the unknowns are away from zero
/// @return seconds per cell
double run(const std::string& what, CellType cell, int n, const std::vector<Unknown>& unknowns,
           const Terms& terms, double step = 0) {
  const Communicator world;
  auto problem = std::make_unique<Problem>(world);
  {
    Grid grid;
    grid.cell = cell;
    for (int d = 0; d < topology(cell).dimension; ++d) grid.lines[d] = graded_lines(0, 1, n);
    auto data = std::make_shared<MeshData>(make_grid(grid));
    problem->add_field("field", std::make_shared<Mesh>("box", data, world),
                       std::make_unique<Carrier>(unknowns, terms));
  }
  const double before = resident();
  const Stopwatch setup;
  problem->finish();
  const double pattern_seconds = setup.seconds();
  if (step > 0) problem->initialise(0);
  TimePoint at = time_point(1, step, 1);
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
  return best / cells;
}

void compare_porous_with_solid(int n) {
  const auto energy = std::make_shared<LawPotential<3, Energy>>(Energy{});
  const Unknown displacement{"displacement", 2, 1, 2, ""};
  const std::vector<std::string> u{"displacement"}, up{"displacement", "pressure"},
      all{"displacement", "velocity", "pressure"};
  const double solid =
      run("quad4 solid tangent", CellType::quadrilateral, n, {displacement},
          {{make_term(solid::InternalForce{{energy}}), u}, {make_term(BodyInertia{1}), u}}, 0.1);
  const poro::Porosity porosity{0.4, false, 10, 0.5};
  const poro::PoreFlow flow{1, 1, porosity, true, {5, 0, 0, 0, 10, 0, 0, 0, 7}};
  const double porous = run("quad4 porous tangent", CellType::quadrilateral, n,
                            {displacement, {"velocity", 2, 1, 1, ""}, {"pressure", 1, 1, 1, ""}},
                            {{make_term(poro::Storage{porosity, true}), all},
                             {make_term(poro::PoreMomentum{flow}), all},
                             {make_term(poro::PoreInertia{1, {porosity, false}}), all},
                             {make_term(poro::MixtureStress{{energy, porosity}}), up},
                             {make_term(BodyInertia{1}), u}},
                            0.1);
  // 4 nodes with 2 and with 5 unknowns.
  constexpr double solid_entries = 8 * 8, porous_entries = 20 * 20;
  fmt::print("porous over solid, per entry: {:.2f}\n", porous / porous_entries / (solid / solid_entries));
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int cube = argc > 1 ? std::atoi(argv[1]) : 32, square = argc > 2 ? std::atoi(argv[2]) : 200,
            compared = argc > 3 ? std::atoi(argv[3]) : 0;
  if (square > 0)
    run("quad4 Navier-Stokes tangent", CellType::quadrilateral, square,
        {{"velocity", 2, 1, 0, ""}, {"pressure", 1, 1, 0, ""}},
        {{make_term(NavierStokes{}), {"velocity", "pressure"}}});
  if (cube > 0)
    run("hex8 neo-Hookean tangent", CellType::hexahedron, cube, {{"displacement", 3, 1, 0, ""}},
        {{make_term(NeoHookean{}), {"displacement"}}});
  if (compared > 0) compare_porous_with_solid(compared);
  MPI_Finalize();
}
