// SPDX-License-Identifier: BSD-3-Clause
#include "exact_flow.hpp"

#include <fmt/format.h>

namespace seam::test {

ExactFlow vortices(const std::string& g, const std::string& dg) {
  const std::string sa = "sin(pi*x + 0.3)", ca = "cos(pi*x + 0.3)", sb = "sin(pi*y + 0.2)",
                    cb = "cos(pi*y + 0.2)";
  ExactFlow e;
  const std::string u = sa + "*" + cb, w = "-" + ca + "*" + sb;
  e.velocity = {g + "*" + u, g + "*(" + w + ")"};
  e.rate = {dg + "*" + u, dg + "*(" + w + ")"};
  e.gradient = {g + "*pi*" + ca + "*" + cb, "-" + g + "*pi*" + sa + "*" + sb, g + "*pi*" + sa + "*" + sb,
                "-" + g + "*pi*" + ca + "*" + cb};
  e.laplacian = {"-2*pi^2*" + e.velocity[0], "-2*pi^2*" + e.velocity[1]};
  e.pressure = g + "*sin(2*pi*x)*cos(pi*y + 0.5)";
  e.pressure_gradient = {g + "*2*pi*cos(2*pi*x)*cos(pi*y + 0.5)",
                         "-" + g + "*pi*sin(2*pi*x)*sin(pi*y + 0.5)"};
  return e;
}

ExactFlow spirals() {
  // So wide that four cells per direction resolve it.
  const auto with_number = [](const char* text) {
    return fmt::format(fmt::runtime(text), fmt::arg("k", 1.5));
  };
  ExactFlow e;
  for (const char* text : {"sin({k}*z) + cos({k}*y)", "sin({k}*x) + cos({k}*z)", "sin({k}*y) + cos({k}*x)"}) {
    e.velocity.push_back(with_number(text));
    e.laplacian.push_back(with_number("-{k}^2*(") + e.velocity.back() + ")");
    e.rate.emplace_back("0");
  }
  for (const char* text : {"0", "-{k}*sin({k}*y)", "{k}*cos({k}*z)", "{k}*cos({k}*x)", "0", "-{k}*sin({k}*z)",
                           "-{k}*sin({k}*x)", "{k}*cos({k}*y)", "0"})
    e.gradient.push_back(with_number(text));
  e.pressure = with_number("sin({k}*x)*cos({k}*y + 0.5)*cos({k}*z)");
  for (const char* text :
       {"{k}*cos({k}*x)*cos({k}*y + 0.5)*cos({k}*z)", "-{k}*sin({k}*x)*sin({k}*y + 0.5)*cos({k}*z)",
        "-{k}*sin({k}*x)*cos({k}*y + 0.5)*sin({k}*z)"})
    e.pressure_gradient.push_back(with_number(text));
  e.viscosity = 0.3;
  return e;
}

std::string quoted(const std::vector<std::string>& entries) {
  std::string list;
  for (const std::string& entry : entries) list += (list.empty() ? "[\"" : ", \"") + entry + "\"";
  return list + "]";
}

std::vector<Expression> expressions(const std::vector<std::string>& texts) {
  std::vector<Expression> result;
  for (const std::string& text : texts) result.emplace_back(text, std::map<std::string, double>{});
  return result;
}

std::vector<std::string> ExactFlow::body_force() const {
  const int dim = dimension();
  std::vector<std::string> force;
  for (int i = 0; i < dim; ++i) {
    std::string acceleration = "(" + rate[i] + ")";
    for (int j = 0; j < dim && convection; ++j)
      acceleration += fmt::format(" + ({})*({})", velocity[j], gradient[i * dim + j]);
    force.push_back(fmt::format("{} + ({} - ({})*({}))/{}", acceleration, pressure_gradient[i], viscosity,
                                laplacian[i], density));
  }
  return force;
}

std::string ExactFlow::scene(const std::string& more) const {
  const int dim = dimension();
  std::vector<std::string> traction;
  for (int i = 0; i < dim; ++i)
    traction.push_back(fmt::format("{}*(({}) + ({})){}", viscosity, gradient[i * dim], gradient[i],
                                   i == 0 ? " - (" + pressure + ")" : ""));
  return fmt::format(
      "density: {}\nviscosity: {}\nconvection: {}\nbody_force: {}\n"
      "boundary:\n  - {{on: [x_min, y_min, y_max{}], velocity: {}}}\n  - {{on: x_max, traction: {}}}\n"
      "initial: {{velocity: {}, pressure: \"{}\"}}\n{}\n",
      density, viscosity, convection, quoted(body_force()), dim == 3 ? ", z_min, z_max" : "",
      quoted(velocity), quoted(traction), quoted(velocity), pressure, more);
}

}  // namespace seam::test
