// SPDX-License-Identifier: BSD-3-Clause
// configs/fsi/pushed_channel_elastic.yaml against the one-dimensional problem that it is: a bar pushes a
// column of water of constant volume.
#include <Eigen/Dense>
#include <cli/run_command.hpp>
#include <cmath>
#include <map>
#include <sstream>

using namespace seam_cli_test;

namespace {

/// At the end of a step: velocity of the water, its pressure at x = 0.1, displacement of the bar's front.
struct State {
  double speed, pressure, front;
};

/// The bar: linear elements, mass rho h/6 [2 1; 1 2], axial force P = E/2 (s - 1/s) of the stretch s
/// (neo-Hookean, nu = 0, laterally held), from X = 0.23 to 0.73, its end at 0.73 moved by -2.5 t^4, with the
/// velocity and acceleration of that. The water
/// between the outlet at x = -0.5 (no pressure) and the front moves as one: p(x) = -rho a (x + 0.5) with a =
/// u''(front), and pushes the front by p(0.23 + u). Rates by the one-step-theta rule; the first step by
/// implicit Euler, as the velocities of water and bar are tied and initial accelerations are not known.
std::vector<State> bar(double theta, double step, int cells) {
  constexpr double young = 1000, rho = 1, rho_water = 1, length = 0.5, column = 0.73;
  const int steps = static_cast<int>(std::lround(0.4 / step)), last = cells;
  const double h = length / cells;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(cells + 1, cells + 1);
  for (int e = 0; e < cells; ++e)
    mass.block<2, 2>(e, e) += rho * h / 6 * (Eigen::Matrix2d() << 2, 1, 1, 2).finished();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(cells + 1), v = u, a = u;
  std::vector<State> result;
  for (int k = 1; k <= steps; ++k) {
    const double th = k == 1 ? 1 : theta, rate = 1 / (th * step), keep = (1 - th) / th;
    Eigen::VectorXd now = u, velocity, acceleration;
    const double time = k * step;
    now[last] = -2.5 * std::pow(time, 4);
    const auto update_rates = [&] {
      velocity = rate * (now - u) - keep * v;
      velocity[last] = -10 * std::pow(time, 3);
      acceleration = rate * (velocity - v) - keep * a;
      acceleration[last] = -30 * time * time;
    };
    for (double change = 1; change > 1e-15;) {
      update_rates();
      Eigen::VectorXd residual = mass * acceleration;
      Eigen::MatrixXd tangent = rate * rate * mass;
      for (int e = 0; e < cells; ++e) {
        const double stretch = 1 + (now[e + 1] - now[e]) / h;
        const double force = young / 2 * (stretch - 1 / stretch);
        const double stiffness = young / 2 * (1 + 1 / (stretch * stretch)) / h;
        residual[e] -= force, residual[e + 1] += force;
        tangent.block<2, 2>(e, e) += stiffness * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
      }
      residual[0] += rho_water * acceleration[0] * (column + now[0]);
      tangent(0, 0) += rho_water * (rate * rate * (column + now[0]) + acceleration[0]);
      const Eigen::VectorXd move = tangent.topLeftCorner(cells, cells).lu().solve(residual.head(cells));
      now.head(cells) -= move;
      change = move.lpNorm<Eigen::Infinity>();
    }
    update_rates();
    u = now, v = velocity, a = acceleration;
    result.push_back({v[0], -rho_water * a[0] * 0.6, u[0]});
  }
  return result;
}

/// The scene's numbers at every step but the start.
std::vector<State> scene(double theta, double step, int cells, const std::string& scheme = "one_step_theta") {
  const Folder folder;
  std::ostringstream call;
  call << "run " SEAM_SOURCE_DIR
          "/configs/fsi/pushed_channel_elastic.yaml --quiet --no-picture --set "
          "output.fields=false --set parameters.theta="
       << theta << " --set time.scheme=" << scheme << " --set parameters.step=" << step
       << " --set parameters.cells=" << cells << " --folder " << folder.path.string();
  const Result run = seam(call.str());
  INFO(run.output);
  std::istringstream in(folder.read("series.csv"));
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> result;
    std::istringstream parts(line);
    for (std::string part; std::getline(parts, part, ',');) result.push_back(part);
    return result;
  };
  std::string line;
  REQUIRE(std::getline(in, line));
  const std::vector<std::string> names = cells_of(line);
  REQUIRE(std::getline(in, line));
  std::vector<State> states;
  while (std::getline(in, line)) {
    const std::vector<std::string> row = cells_of(line);
    std::map<std::string, double> values;
    for (std::size_t c = 0; c < names.size(); ++c) values[names[c]] = std::stod(row[c]);
    states.push_back({values.at("speed"), values.at("pressure"), values.at("front")});
  }
  return states;
}

}  // namespace

TEST_CASE("an elastic pusher with its water is a bar with a column of water") {
  for (const double theta : {1.0, 0.5}) {
    const std::vector<State> expected = bar(theta, 0.02, 10), found = scene(theta, 0.02, 10);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      INFO("theta " << theta << ", step " << k + 1);
      CHECK(found[k].speed == Approx(expected[k].speed).epsilon(0).margin(1e-6 * 0.6));
      CHECK(found[k].pressure == Approx(expected[k].pressure).epsilon(0).margin(1e-6 * 2));
      CHECK(found[k].front == Approx(expected[k].front).epsilon(0).margin(1e-6 * 0.064));
    }
  }
}

TEST_CASE("orders in time: one for implicit Euler, two for the trapezoidal rule and BDF2", "[study]") {
  struct Scheme {
    std::string name;
    double theta;
    int order;
    double step;  // the longest one of the asymptotic range
  };
  const State exact = bar(0.5, 1e-4, 2).back();
  for (const Scheme& scheme : std::vector<Scheme>{
           {"one_step_theta", 1, 1, 0.02}, {"one_step_theta", 0.5, 2, 0.02}, {"bdf2", 1, 2, 0.005}}) {
    double coarse = 0;
    for (const double step : {scheme.step, scheme.step / 2, scheme.step / 4}) {
      const double error = std::abs(scene(scheme.theta, step, 2, scheme.name).back().speed - exact.speed);
      INFO(scheme.name << ", theta " << scheme.theta << ", step " << step << ", error " << error);
      if (coarse > 0) CHECK(std::log2(coarse / error) == Approx(scheme.order).margin(0.15));
      coarse = error;
    }
  }
}
