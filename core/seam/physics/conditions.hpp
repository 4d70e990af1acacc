// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "seam/physics/physics.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

/// Keys that fields have in common, declared and read once: conditions on boundaries, body forces, states at
/// the start.
namespace seam {

/// Adds a list of conditions on parts of the boundary.
/// @param help what the list is and what holds where it says nothing
/// @param condition one of its entries, to which the key `on` is added
inline void declare_boundary(Schema& field, const std::string& help, Schema condition) {
  condition.names("on", "Boundaries of the mesh").naming("boundary");
  field.list("boundary", help, condition).otherwise("[]");
}

/// Calls `add(condition, name)` for each part of the boundary that an entry of the list names.
template <class Add>
void for_each_boundary(const Parameters& field, const Add& add) {
  for (const Parameters& condition : field.list("boundary"))
    for (const std::string& name : condition.names("on")) add(condition, name);
}

/// Prescribes on a boundary those components of an unknown that the key of its name gives, if any.
inline void prescribe_given(FieldSetup& setup, const Parameters& condition, const std::string& boundary,
                            const std::string& unknown) {
  if (!condition.has(unknown)) return;
  const std::vector<Expression>& values = condition.vector_expression(unknown);
  for (int d = 0; d < static_cast<int>(values.size()); ++d)
    if (condition.component_given(unknown, d))
      setup.prescribe(boundary, unknown, d, values[d], condition.where(unknown));
}

/// A key of the object `initial`, and what it says of the state at the start.
struct InitialKey {
  enum class Of { vector, scalar, rate_of_vector };
  std::string key, help, unit, unknown;
  Of of = Of::vector;
};

inline void declare_initial(Schema& field, const std::string& help, const std::vector<InitialKey>& keys) {
  Schema initial("State at the start");
  for (const InitialKey& k : keys) {
    Parameter& value = k.of == InitialKey::Of::scalar ? initial.expression(k.key, k.help)
                                                      : initial.vector_expression(k.key, k.help);
    value.unit(k.unit).optional();
  }
  field.object("initial", help, initial).optional();
}

/// What the object says. @param keys as they were declared
inline void set_initial(FieldSetup& setup, const Parameters& field, const std::vector<InitialKey>& keys) {
  if (!field.has("initial")) return;
  const Parameters& initial = field.object("initial");
  for (const InitialKey& k : keys) {
    if (!initial.has(k.key)) continue;
    if (k.of == InitialKey::Of::scalar) {
      setup.set_initial(k.unknown, 0, initial.expression(k.key));
      continue;
    }
    const std::vector<Expression>& values = initial.vector_expression(k.key);
    for (int d = 0; d < setup.dimension(); ++d)
      if (k.of == InitialKey::Of::vector)
        setup.set_initial(k.unknown, d, values[d]);
      else
        setup.set_initial_rate(k.unknown, d, values[d]);
  }
}

/// Adds body forces (key and help of each), m/s^2, and the key `interpolate_body_force`.
inline void declare_body_forces(Schema& field,
                                const std::vector<std::pair<std::string, std::string>>& forces) {
  for (const auto& [key, help] : forces) field.vector_expression(key, help).unit("m/s^2").optional();
  field
      .boolean("interpolate_body_force",
               "Take body forces at the nodes and interpolate, instead of at every point")
      .otherwise("false");
}

/// A body force that may be given: a function of the place, or an unknown of the same name that is given at
/// the nodes.
class BodyForce {
 public:
  BodyForce(const Parameters& field, std::string key) : field_(field), key_(std::move(key)) {}
  [[nodiscard]] const std::string& key() const { return key_; }
  [[nodiscard]] bool is_given() const { return field_.has(key_); }
  [[nodiscard]] bool is_nodal() const { return is_given() && field_.boolean("interpolate_body_force"); }
  /// Where none is given it is empty.
  [[nodiscard]] std::vector<Expression> per_mass() const {
    return is_given() ? field_.vector_expression(key_) : std::vector<Expression>{};
  }
  /// @throws Error where it acts on nothing. @param missing the key that would give it a mass
  void require_mass(bool has_mass, const std::string& missing) const {
    if (is_given() && !has_mass)
      throw Error(field_.where(key_),
                  "a force per mass acts on something without mass: give a `" + missing + "`");
  }
  void add_unknown(std::vector<Unknown>& unknowns, int dimension, int order) const {
    if (!is_nodal()) return;
    unknowns.push_back({key_, dimension, order, 0, "m/s^2"});
    unknowns.back().given = true;
  }
  /// Says what the unknown is, where there is one.
  void give(FieldSetup& setup) const {
    for (int d = 0; is_nodal() && d < setup.dimension(); ++d) setup.give(key_, d, per_mass()[d]);
  }

 private:
  Parameters field_;
  std::string key_;
};

}  // namespace seam
