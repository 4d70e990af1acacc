// SPDX-License-Identifier: BSD-3-Clause
#include "exact_state.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace seam::test {
namespace {

template <class Interface>
std::unique_ptr<Interface> create(const std::string& kind, const std::string& yaml) {
  Registry registry;
  manufactured::declare_fsi_vortices(registry);
  solid::declare_materials(registry);
  Diagnostics diagnostics;
  ValidationContext context{.registry = registry,
                            .diagnostics = diagnostics,
                            .dimension = 2,
                            .parameters = {},
                            .folder = {},
                            .provider = {},
                            .used_plugins = {}};
  Schema schema;
  schema.typed("it", "", kind);
  const Parameters wrapped = validate(parse_yaml("it: {" + yaml + "}", "test"), schema, context, "");
  diagnostics.throw_if_errors();
  return registry.create<Interface>(kind, wrapped.object("it"));
}

int number(const Function& function, const std::string& name) {
  for (std::size_t p = 0; p < function.members().size(); ++p)
    if (function.members()[p].name == name) return static_cast<int>(p);
  throw std::logic_error("no part " + name);
}

}  // namespace

std::unique_ptr<Function> vortices(const std::string& yaml) {
  return create<Function>("function", "type: fsi_vortices, " + yaml);
}

std::vector<Expression> part(const std::shared_ptr<const Function>& function, const std::string& name) {
  return Expression::components(function, number(*function, name));
}

std::vector<double> values(const Function& function, const std::string& name, const double* x, double t) {
  const int p = number(function, name);
  std::vector<double> result(
      static_cast<std::size_t>(function.members()[static_cast<std::size_t>(p)].components));
  function.evaluate(p, x, t, result.data());
  return result;
}

std::shared_ptr<const Potential> material(const std::string& type, double young, double poisson) {
  return create<Potential>("hyperelastic",
                           fmt::format("type: {}, young: {}, poisson: {}", type, young, poisson));
}

}  // namespace seam::test
