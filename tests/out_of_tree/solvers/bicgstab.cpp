// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <vector>

#include "seam/linear/linear_solver.hpp"
#include "seam/plugin/plugin.hpp"

void declare_node_jacobi(seam::Registry& registry);

namespace {

using namespace seam;

/// The stabilised method of biconjugate gradients (van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992),
/// 631-644) of the equations as LinearSolver weighs them, each unknown scaled by its diagonal entry.
class Bicgstab final : public LinearSolver {
 public:
  explicit Bicgstab(const Parameters& p)
      : tolerance_(p.number("tolerance")), most_(static_cast<int>(p.integer("maximum_iterations"))) {
    acceptable_residual_ = 100 * tolerance_;
  }

 protected:
  void solve_into(const Matrix& a, const std::vector<EquationBlock>&, const std::vector<double>& b,
                  std::vector<double>& x, SolveReport& report) override {
    using Vector = std::vector<double>;
    const std::size_t n = b.size();
    Vector scale(n, 1.0);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1]; ++k)
        if (a.column[k] == static_cast<int>(r) && a.value[k] != 0) scale[r] = 1 / a.value[k];
    Vector scaled(n);
    const auto act = [&](const Vector& v, Vector& to) {  // to = W A S v
      for (std::size_t i = 0; i < n; ++i) scaled[i] = scale[i] * v[i];
      multiply(a, scaled, to);
      for (std::size_t i = 0; i < n; ++i) to[i] *= weights()[i];
    };
    const auto dot = [&](const Vector& u, const Vector& v) {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += u[i] * v[i];
      return a.communicator.sum(sum);
    };
    Vector r(n), y(n, 0.0), p(n, 0.0), v(n, 0.0), s(n), t(n);
    for (std::size_t i = 0; i < n; ++i) r[i] = weights()[i] * b[i];
    const Vector shadow = r;
    const double enough = tolerance_ * std::sqrt(dot(r, r));
    double rho = 1, alpha = 1, omega = 1;
    while (std::sqrt(dot(r, r)) > enough && report.iterations < most_) {
      ++report.iterations;
      const double next = dot(shadow, r), beta = next / rho * alpha / omega;
      rho = next;
      for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
      act(p, v);
      alpha = rho / dot(shadow, v);
      for (std::size_t i = 0; i < n; ++i) s[i] = r[i] - alpha * v[i];
      act(s, t);
      const double square = dot(t, t);
      omega = square > 0 ? dot(t, s) / square : 0;
      for (std::size_t i = 0; i < n; ++i) {
        y[i] += alpha * p[i] + omega * s[i];
        r[i] = s[i] - omega * t[i];
      }
      if (omega == 0) break;  // it has arrived, or breaks down: the residual is looked at anyway
    }
    for (std::size_t i = 0; i < n; ++i) x[i] = scale[i] * y[i];
  }

 private:
  double tolerance_;
  int most_;
};

}  // namespace

SEAM_PLUGIN(registry) {
  Schema schema("Stabilised biconjugate gradients, scaled by the diagonal.");
  schema.number("tolerance", "relative residual to reach").otherwise("1e-10").above(0).below(1);
  schema.integer("maximum_iterations", "then it gives up").otherwise("2000").at_least(1);
  registry.add<LinearSolver>("linear_solver", "bicgstab", schema, [](const Parameters& p, const Registry&) {
    return std::make_unique<Bicgstab>(p);
  });
  declare_node_jacobi(registry);
}
