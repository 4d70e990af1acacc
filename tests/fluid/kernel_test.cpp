// SPDX-License-Identifier: BSD-3-Clause
// The integrands at single points: tangents against differences, the parameters of the thesis, and the
// identities that make the weak conditions stable.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "face_jumps.hpp"
#include "fluid_fluid.hpp"
#include "quantities.hpp"
#include "residual_stabilisation.hpp"
#include "weak_boundary.hpp"

using namespace seam;
using namespace seam::fluid;

namespace {

constexpr double time_step = 0.2, theta = 0.6, cell_size = 0.3, trace_size = 0.17;
const double factors[5][3] = {{1, 1 / (theta * time_step), 0},
                              {1, 1 / (theta * time_step), 0},
                              {1, 1 / (theta * time_step), 0},
                              {1, 1 / (theta * time_step), 0},
                              {1, 1 / (theta * time_step), 0}};

/// One point with a normal that is parallel to no axis.
struct OnePoint {
  int dim;
  double step = time_step;
  std::vector<double> position{0.3, -0.4, 0.7}, normal{0.6, 0.8, 0};
  explicit OnePoint(int d, double length = time_step) : dim(d), step(length) {
    if (dim == 3) normal = {2.0 / 7, 3.0 / 7, -6.0 / 7};
  }
  [[nodiscard]] PointBatch batch(const std::vector<double>& inputs) const {
    PointBatch b;
    b.dimension = dim;
    b.count = 1;
    b.position = position.data();
    b.normal = normal.data();
    b.cell_size = &cell_size;
    b.trace_size = &trace_size;
    b.inputs = inputs.data();
    b.time = 1.1;
    b.step = step;
    b.theta = theta;
    b.level_factor = factors;
    return b;
  }
};

std::vector<double> random_inputs(const Term& term, int dim, double size = 1) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> part(-size, size);
  std::vector<double> inputs(term.signature(dim).input_size(dim));
  for (double& x : inputs) x = part(generator);
  return inputs;
}

std::vector<double> residual(const Term& term, const OnePoint& at, const std::vector<double>& inputs) {
  std::vector<double> r(term.signature(at.dim).output_size(at.dim));
  term.evaluate(at.batch(inputs), r.data(), nullptr);
  return r;
}

/// Largest difference between the tangent and central differences, relative to the largest entry.
double tangent_error(const Term& term, const OnePoint& at, const std::vector<double>& inputs) {
  const Signature& s = term.signature(at.dim);
  const int out = s.output_size(at.dim), columns = s.column_size(at.dim);
  std::vector<double> r(out), tangent(static_cast<std::size_t>(out) * columns);
  term.evaluate(at.batch(inputs), r.data(), tangent.data());
  const std::vector<double> plain_residual = residual(term, at, inputs);
  for (int i = 0; i < out; ++i) CHECK(r[i] == Approx(plain_residual[i]).epsilon(1e-12).margin(1e-13));
  double error = 0, largest = 0;
  int column = 0;
  for (const Slot& wanted : s.columns)
    for (int k = 0; k < s.components[wanted.operand] * rows(wanted.shape, at.dim); ++k, ++column) {
      // All levels of an unknown move with it, as the time scheme says.
      std::vector<double> direction(inputs.size());
      int first = 0;
      for (const Slot& slot : s.inputs) {
        if (slot.operand == wanted.operand && slot.shape == wanted.shape)
          direction[first + k] = factors[slot.operand][static_cast<int>(slot.level)];
        first += s.components[slot.operand] * rows(slot.shape, at.dim);
      }
      constexpr double h = 1e-5;
      std::vector<double> ahead = inputs, behind = inputs;
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        ahead[i] += h * direction[i];
        behind[i] -= h * direction[i];
      }
      const auto plus = residual(term, at, ahead), minus = residual(term, at, behind);
      for (int i = 0; i < out; ++i) {
        const double exact = tangent[static_cast<std::size_t>(i) * columns + column];
        error = std::max(error, std::abs((plus[i] - minus[i]) / (2 * h) - exact));
        largest = std::max(largest, std::abs(exact));
      }
    }
  return error / largest;
}

const Flow flow{1.7, 0.23, true}, creeping{1.7, 0.23, false};
const JumpConstants constants{0.05, 0.06, 0.002};

std::vector<Expression> functions(const std::vector<std::string>& texts) {
  std::vector<Expression> result;
  for (const std::string& text : texts) result.emplace_back(text, std::map<std::string, double>{});
  return result;
}

const auto wall_velocity = functions({"1 + x*t", "y", "-0.4"});
const auto wall_traction = functions({"0.5", "x + y", "t"});

std::shared_ptr<const Term> wall(const Flow& fluid, double slip, double xi) {
  return make_term(WeakVelocity{fluid, wall_velocity, wall_traction, slip, xi, 20, 30});
}

double dot_of(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

TEST_CASE("tangents of all integrands match finite differences") {
  const int dim = GENERATE(2, 3);
  const OnePoint at(dim);
  std::vector<std::pair<std::string, std::shared_ptr<const Term>>> terms{
      {"Stokes", make_term(Stokes{0.3})},
      {"inertia", make_term(Inertia{1.7})},
      {"convection", make_term(Convection{1.7})},
      {"do-nothing outflow", make_term(DoNothing{0.3})},
      {"backflow", make_term(Backflow{1.7, 0.5})},
      {"interior penalty", make_term(InteriorPenalty{flow, constants})},
      {"interior penalty, Stokes", make_term(InteriorPenalty{creeping, constants})},
      {"ghost penalty", make_term(GhostPenalty{flow, constants, 0.1, 0.002, 0.05})},
      {"residual", make_term(ResidualStabilisation{flow, wall_traction, 1, 0.7})},
      {"residual, Stokes", make_term(ResidualStabilisation{creeping, {}, 1, 0.7})}};
  for (const double xi : {1.0, 0.0, -1.0})
    for (const double slip : {0.0, 0.4, 1e9, std::numeric_limits<double>::infinity()})
      terms.emplace_back("wall", wall(flow, slip, xi));
  for (const auto& [what, term] : terms)
    for (const double size : {1.0, 1e-2, 1e-9}) {
      INFO(what << " in " << dim << " dimensions, inputs of size " << size);
      std::vector<double> inputs = random_inputs(*term, dim, size);
      // Backflow has a kink where the flow turns; here it flows in, faster than the difference's step.
      if (what == "backflow")
        for (int d = 0; d < dim; ++d) inputs[d] = -(size + 1e-3) * at.normal[d];
      CHECK(tangent_error(*term, at, inputs) < (size < 1e-3 ? 1e-5 : 1e-8));
    }
}

TEST_CASE("jump penalties have the parameters of (2.118) and (3.6)") {
  const double step = GENERATE(0.0, time_step);
  const auto length = GENERATE(JumpLength::diameter, JumpLength::across);
  JumpConstants chosen = constants;
  chosen.length = length;
  const OnePoint at(2, step);
  // v, dv/dn on both sides, dp/dn on both sides, and the second derivatives of the same.
  const std::vector<double> in{1.2, -0.9, 0.3, 0.5, -0.2, 0.1, 2.0, -1.0, 0.7, 0.4, 0.2, -0.6, 1.5, 0.5};
  const double h = length == JumpLength::across ? trace_size : cell_size, mu = flow.viscosity,
               rho = flow.density, square = 1.2 * 1.2 + 0.9 * 0.9;
  const double slow = 0.1 * mu / (rho * h), speed = square / std::sqrt(square + slow * slow);
  CHECK(speed == Approx(std::sqrt(square)).epsilon(1e-2));
  const double inertia = step > 0 ? rho / (theta * step) : 0;
  const double phi = mu + h * rho * speed / 6 + h * h * inertia / 12;
  const double tau_p = 0.06 * h * h * h / phi, tau_div = 0.002 * h * phi;
  const double tau_u = 0.05 * rho * rho * square * h * h * h / phi;
  const double jump[2] = {0.3 + 0.2, 0.5 - 0.1}, divergence = 0.6 * jump[0] + 0.8 * jump[1];

  const std::vector<double> first(in.begin(), in.begin() + 8);
  const auto cip = residual(*make_term(InteriorPenalty{flow, chosen}), at, first);
  const double expected[2] = {tau_u * jump[0] + tau_div * divergence * 0.6,
                              tau_u * jump[1] + tau_div * divergence * 0.8};
  for (int i = 0; i < 2; ++i) {
    CHECK(cip[i] == Approx(expected[i]).epsilon(1e-13));
    CHECK(cip[2 + i] == -cip[i]);
  }
  CHECK(cip[4] == Approx(tau_p * 3).epsilon(1e-13));
  CHECK(cip[5] == -cip[4]);

  const auto ghost = residual(*make_term(GhostPenalty{flow, chosen, 0.1, 0.002, 0.05}), at, in);
  const double cell = cell_size, more = 0.1 * cell * mu + 0.002 * cell * cell * cell * inertia;
  for (int i = 0; i < 2; ++i) CHECK(ghost[i] == Approx(expected[i] + more * jump[i]).epsilon(1e-13));
  CHECK(ghost[4] == Approx(tau_p * 3).epsilon(1e-13));
  const double second = 0.05 * cell * cell;
  CHECK(ghost[6] == Approx(second * (tau_u + more + tau_div) * (0.7 - 0.2)).epsilon(1e-13));
  CHECK(ghost[7] == Approx(second * (tau_u + more + tau_div) * (0.4 + 0.6)).epsilon(1e-13));
  CHECK(ghost[10] == Approx(second * tau_p * (1.5 - 0.5)).epsilon(1e-13));
  CHECK(ghost[11] == -ghost[10]);
}

TEST_CASE("with the skew adjoint, a weak wall takes exactly the energy of its penalty and its friction") {
  const int dim = GENERATE(2, 3);
  const OnePoint at(dim);
  const std::vector<Expression> rest(dim);
  const double mu = flow.viscosity;
  for (const double slip : {0.0, 0.4, 1e9, std::numeric_limits<double>::infinity()}) {
    const auto term = make_term(WeakVelocity{flow, rest, {}, slip, 1, 20, 30});
    const std::vector<double> in = random_inputs(*term, dim);
    // The test functions are the unknowns themselves: v, grad v, p.
    const double energy = dot_of(residual(*term, at, in), in);

    double square = 0, through = 0, n_sigma_n = 0;
    std::vector<double> sigma_n(dim);
    for (int i = 0; i < dim; ++i) {
      square += in[i] * in[i];
      through += in[i] * at.normal[i];
      sigma_n[i] = -in[dim + dim * dim] * at.normal[i];
      for (int j = 0; j < dim; ++j)
        sigma_n[i] += mu * (in[dim + i * dim + j] + in[dim + j * dim + i]) * at.normal[j];
    }
    for (int i = 0; i < dim; ++i) n_sigma_n += sigma_n[i] * at.normal[i];
    double along = 0, friction = 0;
    for (int i = 0; i < dim; ++i) {
      along += std::pow(in[i] - through * at.normal[i], 2);
      friction += std::pow(sigma_n[i] - n_sigma_n * at.normal[i], 2);
    }
    const double h = trace_size, slow = 0.1 * mu / (flow.density * h);
    const double phi = mu + h * flow.density / 6 * square / std::sqrt(square + slow * slow) +
                       h * h / 12 * flow.density / (theta * time_step);
    const double beta = h / (30 * phi), lambda = slip / mu;
    const double tangential =
        std::isinf(lambda) ? beta * friction : (along + beta * lambda * friction) / (lambda + beta);
    INFO("slip length " << slip);
    CHECK(energy == Approx(20 * phi / h * through * through + tangential).epsilon(1e-12));
  }
}

TEST_CASE("a weak wall with infinite slip leaves only its own traction along it") {
  const int dim = GENERATE(2, 3);
  const OnePoint at(dim);
  const auto free = wall(flow, std::numeric_limits<double>::infinity(), 0);
  std::vector<double> in = random_inputs(*free, dim);
  const auto r = residual(*free, at, in);
  // Component along the wall of the coefficient of dv: -P h.
  double n_r = 0, n_h = 0;
  std::vector<double> h(dim);
  for (int i = 0; i < dim; ++i) {
    h[i] = wall_traction[i](at.position.data(), dim, 1.1);
    n_r += r[i] * at.normal[i];
    n_h += h[i] * at.normal[i];
  }
  for (int i = 0; i < dim; ++i)
    CHECK(r[i] - n_r * at.normal[i] == Approx(-(h[i] - n_h * at.normal[i])).epsilon(0).margin(1e-12));
}

TEST_CASE("residual stabilisation vanishes where momentum and mass balance hold") {
  // v = (1, 2), grad v without trace, and p so that rho (dv/dt + grad v v - b) + grad p = 0 with b = (0.5, x
  // + y).
  const OnePoint at(2);
  const double rho = flow.density;
  const double rate[2] = {0.3, -0.4}, b[2] = {0.5, -0.1}, grad[4] = {0.7, 1.1, -0.2, -0.7};
  std::vector<double> in{1, 2, rate[0], rate[1], grad[0], grad[1], grad[2], grad[3], 0, 0};
  for (int i = 0; i < 2; ++i) in[8 + i] = -rho * (rate[i] + grad[2 * i] + 2 * grad[2 * i + 1] - b[i]);
  const auto term = make_term(ResidualStabilisation{flow, wall_traction, 1, 1});
  for (const double value : residual(*term, at, in)) CHECK(std::abs(value) < 1e-14);
  in[8] += 1;
  const double h = cell_size / std::sqrt(2.0);
  const double tau = 1 / std::sqrt(std::pow(2 * rho / h, 2) * 5 + std::pow(12 * flow.viscosity / (h * h), 2) +
                                   std::pow(rho / (theta * time_step), 2));
  const auto r = residual(*term, at, in);
  CHECK(r[0] == Approx(rho * tau * 1));
  CHECK(r[1] == Approx(rho * tau * 2));
  CHECK(r[4] == Approx(tau));
}

TEST_CASE("what passes through the edge of a patch takes the velocity of where it comes from") {
  const OnePoint at(2);
  const Vec<2, double> here{{1.2, -0.7}}, there{{0.4, 0.9}}, jump = here - there;
  const Vec<2, double> n{{at.normal[0], at.normal[1]}};
  const double middle = 0.5 * dot(here + there, n);
  for (const double relative : {0.5, -0.5, 2.0, -2.0}) {
    // The edge moves along as well, which carries nothing through it.
    const double w = middle - relative;
    const Vec<2, double> edge{{w * n[0] - 0.3 * n[1], w * n[1] + 0.3 * n[0]}};
    const std::vector<double> in{here[0], here[1], 0.1, 0.2, 0.3, -0.1, 0.4, there[0], there[1], 0.2,
                                 -0.3,    0.1,     0.5, 0.6, 0.1, 0.05, 0.2, -0.1,     edge[0],  edge[1]};
    const auto with = residual(*make_term(FluidFluid{flow, 0.3, 1, 20, true}), at, in);
    const auto without = residual(*make_term(FluidFluid{flow, 0.3, 1, 20, false}), at, in);
    REQUIRE(with.size() == 14);
    const double into_patch = std::max(relative, 0.0), out_of_it = std::max(-relative, 0.0);
    for (int i = 0; i < 2; ++i) {
      CHECK(with[i] - without[i] == Approx(flow.density * out_of_it * jump[i]).epsilon(0).margin(1e-12));
      CHECK(with[7 + i] - without[7 + i] ==
            Approx(-flow.density * into_patch * jump[i]).epsilon(0).margin(1e-12));
    }
  }
}

TEST_CASE("simple shear takes the power of its stress times its rate") {
  const auto dissipation = make_quantity(Dissipation{0.23});
  // dv_x/dy = 3: the stress is 0.23 times 3; a rotation takes nothing.
  for (const double turn : {0.0, 1.7}) {
    const std::vector<double> in{0, 3 - turn, turn, 0};
    double value = 0;
    dissipation->evaluate(OnePoint(2).batch(in), &value, nullptr);
    CHECK(value == Approx(0.23 * 3 * 3));
  }
}

TEST_CASE(
    "residual stabilisation resists a change of volume by half the momentum through a cell and the "
    "viscosity") {
  const OnePoint at(2);
  const double h = cell_size / std::sqrt(2.0), speed = std::hypot(1.2, 0.5);
  // div v = 2, everything else as it comes: of the tests with grad v the trace is that of grad-div and SUPG.
  const std::vector<double> in{1.2, 0.5, 0, 0, 1.5, 0, 0, 0.5, 0, 0};
  const auto with = residual(*make_term(ResidualStabilisation{flow, {}, 1, 0.7}), at, in);
  const auto without = residual(*make_term(ResidualStabilisation{flow, {}, 1, 0}), at, in);
  const double tau = 0.7 * std::hypot(0.5 * flow.density * h * speed, flow.viscosity);
  const double expected[4] = {2 * tau, 0, 0, 2 * tau};
  for (int k = 0; k < 4; ++k) CHECK(with[k] - without[k] == Approx(expected[k]).epsilon(0).margin(1e-13));
}

TEST_CASE("what is left of the traction of a developed flow at its outlet is nothing") {
  // v = (y^2, 0) through x = const: sigma n - mu dv/dn = mu grad(v)^T n.
  OnePoint at(2);
  at.normal = {1, 0};
  const std::vector<double> developed{0, 0.8, 0, 0};  // dv_x/dy alone
  const auto term = make_term(DoNothing{0.3});
  CHECK(residual(*term, at, developed)[0] == 0);
  CHECK(residual(*term, at, developed)[1] == Approx(-0.3 * 0.8));
  // A flow that turns across the outlet, dv_y/dx, leaves nothing.
  for (const double r : residual(*term, at, {0, 0, 0.8, 0})) CHECK(r == 0);
}

TEST_CASE("backflow takes out what energy it would bring in, and nothing where fluid leaves") {
  const OnePoint at(2);
  const auto term = make_term(Backflow{1.7, 0.5});
  const std::vector<double> in{-1.1, 0.2}, out{1.1, -0.2};  // n = (0.6, 0.8)
  const double through = -1.1 * 0.6 + 0.2 * 0.8;
  // Half the kinetic energy that comes in with the flow.
  CHECK(dot_of(residual(*term, at, in), in) == Approx(-0.5 * 1.7 * through * dot_of(in, in)));
  for (const double r : residual(*term, at, out)) CHECK(r == 0);
}

TEST_CASE(
    "with the skew adjoint, the edge of a patch takes exactly the energy of its penalty and its upwind "
    "flux") {
  const int dim = GENERATE(2, 3);
  const OnePoint at(dim);
  const auto term = make_term(FluidFluid{flow, 0.3, 1, 20, true});
  const std::vector<double> in = random_inputs(*term, dim, 0.4);
  const int matrix = dim * dim, patch = dim + matrix + 1;
  const std::vector<double> r = residual(*term, at, in);
  double energy = 0, square = 0, middle_square = 0, through = 0;
  for (int i = 0; i < 2 * patch; ++i) energy += r[i] * in[i];
  for (int i = 0; i < dim; ++i) {
    const double here = in[i], there = in[patch + i], edge = in[2 * patch + matrix + i];
    square += std::pow(here - there, 2);
    middle_square += std::pow((here + there) / 2, 2);
    through += ((here + there) / 2 - edge) * at.normal[i];
  }
  const double h = trace_size, slow = 0.1 * flow.viscosity / (flow.density * h);
  const double phi = flow.viscosity +
                     h * flow.density / 6 * middle_square / std::sqrt(middle_square + slow * slow) +
                     h * h / 12 * flow.density / (theta * time_step);
  // rho/2 <|m| [v] - m (v_0 + v_1), [v]>: the second part is what convection gives on both sides.
  double convected = 0;
  for (int i = 0; i < dim; ++i) convected += (in[i] + in[patch + i]) * (in[i] - in[patch + i]);
  const double upwind = flow.density / 2 * (std::abs(through) * square - through * convected);
  CHECK(energy == Approx(20 * phi / h * square + upwind).epsilon(1e-12));
}

TEST_CASE("vorticity, kinetic energy and what passes to a patch have their signs and factors") {
  const OnePoint at(2);
  double value = 0;
  // A rotation about z by 1.5 1/s: v = 1.5 (-y, x).
  const std::vector<double> turning{0, -1.5, 1.5, 0};
  make_quantity(Vorticity{})->evaluate(at.batch(turning), &value, nullptr);
  CHECK(value == Approx(3));
  const std::vector<double> velocity{3, 4};
  make_quantity(KineticEnergy{1.7})->evaluate(at.batch(velocity), &value, nullptr);
  CHECK(value == Approx(0.5 * 1.7 * 25));
  const std::vector<double> along_with_edge{3, 4, 3, 4}, resting_edge{3, 4, 0, 0};
  make_quantity(FluidTransfer{})->evaluate(at.batch(along_with_edge), &value, nullptr);
  CHECK(value == Approx(0).margin(1e-14));
  make_quantity(FluidTransfer{})->evaluate(at.batch(resting_edge), &value, nullptr);
  CHECK(value == Approx(3 * 0.6 + 4 * 0.8));
}
