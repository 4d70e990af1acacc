// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/series_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "seam/assembly/element.hpp"
#include "seam/field/field.hpp"
#include "seam/record/probes.hpp"
#include "seam/scene/expression.hpp"

namespace seam {
namespace {

using Units = std::map<std::string, std::string>;

/// What types say of their quantities or of their series.
Units declared(const Registry& registry, const std::string& kind, const std::string& type, Published::As as) {
  Units units;
  for (const Published& p : registry.published(kind, type))
    if (p.as == as) units[p.name] = p.unit;
  return units;
}

std::string times(const std::string& unit, const std::string& factor) {
  return unit.empty() ? factor : unit + " " + factor;
}

/// What a probe records, if that is known: of a field's quantity at a point, or integrated.
std::optional<std::string> unit_of_probe(const Parameters& p, const Problem& problem, const Scene& scene,
                                         const Registry& registry) {
  const std::string& quantity = p.text("quantity");
  const std::string interface = p.has("interface") ? p.text("interface") : "";
  const std::string field = interface.empty()
                                ? p.text("field")
                                : problem.interfaces().at(interface).front().domain->fields().front()->name();
  const auto entry = std::ranges::find(problem.fields(), field, &FieldEntry::name);
  if (entry == problem.fields().end()) return std::nullopt;
  const std::vector<Unknown>& unknowns = entry->field->unknowns();
  const bool moment = quantity == "moment" && !interface.empty();
  if (quantity == "reaction" || moment || (quantity == "force" && !interface.empty())) {
    // What works on a way, or on its rate, is a force.
    const std::string acts_on = quantity == "reaction" && p.has("on")
                                    ? unknown_of_reaction(*entry, p.names("on"))
                                    : unknowns.front().name;
    const std::string& way = std::ranges::find(unknowns, acts_on, &Unknown::name)->unit;
    return way == "m" || way == "m/s" ? std::optional<std::string>(moment ? "N m" : "N") : std::nullopt;
  }
  Units units;
  for (const auto& [name, parameters] : scene.root.map("fields"))
    if (name == field) units = declared(registry, "field", parameters.type(), Published::As::quantity);
  for (const Unknown& unknown : unknowns) units[unknown.name] = unknown.unit;
  const auto found = units.find(quantity);
  if (found == units.end()) return std::nullopt;
  return interface.empty() && !p.has("on") ? found->second : times(found->second, "m^(d-1)");
}

/// Where the factor of a unit that begins at a position ends: before a space or a stroke outside of
/// parentheses.
std::size_t end_of_factor(const std::string& unit, std::size_t at) {
  for (int depth = 0; at < unit.size(); ++at) {
    if (depth == 0 && (unit[at] == ' ' || unit[at] == '/')) break;
    depth += unit[at] == '(' ? 1 : unit[at] == ')' ? -1 : 0;
  }
  return at;
}

/// Base units with their powers, in the order in which they first come.
using Factors = std::vector<std::pair<std::string, double>>;

/// @param sign of the powers: -1 behind a stroke
void add_factors(const std::string& unit, int sign, int dimension, Factors& factors) {
  for (std::size_t at = 0; at < unit.size();) {
    const bool divides = unit[at] == '/';
    at += divides || unit[at] == ' ' ? 1 : 0;
    const std::size_t end = end_of_factor(unit, at);
    const std::string factor = unit.substr(at, end - at);
    at = end;
    const int own_sign = divides ? -sign : sign;
    if (factor.starts_with("(") && factor.ends_with(")")) {
      add_factors(factor.substr(1, factor.size() - 2), own_sign, dimension, factors);
      continue;
    }
    const std::size_t power_at = factor.find('^');
    const std::string name = factor.substr(0, power_at);
    if (name.empty() || name == "1") continue;
    double power = own_sign;
    if (power_at != std::string::npos)
      power *= evaluate_formula(factor.substr(power_at + 1), {{"d", static_cast<double>(dimension)}});
    const auto known = std::ranges::find(factors, name, &Factors::value_type::first);
    if (known == factors.end())
      factors.emplace_back(name, power);
    else
      known->second += power;
  }
}

}  // namespace

std::string unit_in_space(const std::string& unit, int dimension) {
  Factors factors;
  try {
    add_factors(unit, 1, dimension, factors);
  } catch (const Error&) {
    return unit;  // written in a way of its own
  }
  std::string above, below;
  for (const auto& [name, power] : factors) {
    if (power == 0) continue;
    const std::string factor = std::abs(power) == 1 ? name : fmt::format("{}^{:g}", name, std::abs(power));
    (power > 0 ? above : below) += (power > 0 ? above.empty() ? "" : " " : "/") + factor;
  }
  return above.empty() && !below.empty() ? "1" + below : above + below;
}

Units series_units(const Scene& scene, const Registry& registry, const Problem& problem,
                   const std::vector<std::string>& names) {
  Units units;
  for (const auto& [name, parameters] : scene.root.map("fields"))
    for (const auto& [series, unit] : declared(registry, "field", parameters.type(), Published::As::series))
      units[name + "." + series] = unit;
  for (const Parameters& coupling : scene.root.list("coupling"))
    for (const auto& [series, unit] : declared(registry, "coupling", coupling.type(), Published::As::series))
      units[coupling.text("on") + "." + series] = unit;
  for (const auto& [name, p] : scene.root.object("output").map("probes")) {
    const std::optional<std::string> unit = unit_of_probe(p, problem, scene, registry);
    for (const std::string& series : names)
      if (unit && is_series_of(series, name)) units[series] = *unit;
  }
  const int dimension = static_cast<int>(scene.root.integer("dimension"));
  Units result;
  for (const std::string& series : names) {
    auto found = units.find(series);
    if (found == units.end())  // a component of what is declared
      found = units.find(series.substr(0, series.rfind('.')));
    if (found != units.end() && is_series_of(series, found->first))
      result[series] = unit_in_space(found->second, dimension);
  }
  return result;
}

}  // namespace seam
