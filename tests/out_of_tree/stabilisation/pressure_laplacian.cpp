// SPDX-License-Identifier: BSD-3-Clause
// A stabilisation for Seam's own fluid: that of Brezzi and Pitkaranta, On the stabilization of finite element
// approximations of the Stokes equations, 1984.
#include "seam/plugin/plugin.hpp"
#include "seam/plugins/cutfem_fluid/stabilisation.hpp"
#include "seam/term/kernel_term.hpp"

namespace {

using namespace seam;

/// factor h^2/(4 mu) (grad q, grad p)
struct PressureLaplacian {
  using pressure = Scalar<1>;
  using Reads = Slots<Gradient<pressure>>;
  using Tests = Slots<Gradient<pressure>>;
  double factor, viscosity;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.gradient(pressure{}) += (factor * x.cell_size * x.cell_size / (4 * viscosity)) * s.gradient(pressure{});
  }
};

class BrezziPitkaranta final : public fluid::Stabilisation {
 public:
  explicit BrezziPitkaranta(const Parameters& p) : factor_(p.number("factor")) {}
  static Schema schema() {
    Schema s("Brezzi and Pitkaranta's, for creeping flow: the pressure's Laplacian.");
    s.number("factor", "Of h^2/(4 mu), with the cell's diameter h").otherwise("0.1").above(0);
    return s;
  }
  [[nodiscard]] int highest_order() const override { return 1; }
  [[nodiscard]] const fluid::JumpConstants& jumps() const override { return jumps_; }
  [[nodiscard]] bool follows_mesh() const override { return true; }
  void add(FieldSetup& setup, const fluid::OnMesh& on_mesh, const fluid::Flow& flow,
           const std::vector<Expression>&) const override {
    setup.add_cell_term(on_mesh.term(PressureLaplacian{factor_, flow.viscosity}),
                        on_mesh.operands("velocity", "pressure"));
  }

 private:
  double factor_;
  fluid::JumpConstants jumps_{0.05, 0.05, 5e-5};
};

}  // namespace

SEAM_PLUGIN(registry) {
  registry.add<fluid::Stabilisation>(
      "fluid_stabilisation", "pressure_laplacian", BrezziPitkaranta::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<BrezziPitkaranta>(p); });
}
