// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "seam/cut/field_cut.hpp"

namespace seam {

namespace {

/// The field a probe speaks of: named, or the one on the interface's first side.
std::string field_of(const Parameters& p, const Problem& problem) {
  if (p.has("field") == p.has("interface"))
    throw Error(p.where(), "a probe needs either `field` or `interface`");
  if (p.has("field")) return p.text("field");
  return problem.interfaces().at(p.text("interface")).front().domain->fields().front()->name();
}

/// The names of a vector's components, or of a symmetric tensor's.
const std::vector<std::string>& names_of_components(std::size_t count) {
  static const std::vector<std::string> axes{"x", "y", "z", "w"};
  static const std::vector<std::string> tensor{"xx", "yy", "zz", "xy", "yz", "xz"};
  return count == 6 ? tensor : axes;
}

/// Appends what one or several components are, under a name or under names of the components.
void append(const std::string& name, const std::vector<double>& values, Results& results) {
  if (values.size() == 1) {
    results.series[name].push_back(values[0]);
    return;
  }
  const std::vector<std::string>& names = names_of_components(values.size());
  for (std::size_t c = 0; c < values.size(); ++c)
    results.series[name + "." + (c < names.size() ? names[c] : std::to_string(c + 1))].push_back(values[c]);
}

}  // namespace

std::string unknown_of_reaction(const FieldEntry& entry, const std::vector<std::string>& boundaries) {
  const std::vector<Unknown>& unknowns = entry.field->unknowns();
  const auto is_prescribed = [&](const Unknown& unknown) {
    return std::ranges::any_of(entry.conditions, [&](const PrescribedCondition& condition) {
      return condition.unknown == unknown.name &&
             (condition.boundary.empty() ||
              std::ranges::find(boundaries, condition.boundary) != boundaries.end());
    });
  };
  const auto found = std::ranges::find_if(unknowns, is_prescribed);
  return (found == unknowns.end() ? unknowns.front() : *found).name;
}

bool is_series_of(const std::string& series, const std::string& name) {
  if (!series.starts_with(name)) return false;
  if (series == name) return true;
  if (series[name.size()] != '.') return false;
  const std::string component = series.substr(name.size() + 1);
  const auto is_one_of = [&](std::size_t count) {
    return std::ranges::find(names_of_components(count), component) != names_of_components(count).end();
  };
  return is_one_of(3) || is_one_of(6) || component.find_first_not_of("0123456789") == std::string::npos;
}

Probe::Probe(std::string name, const Parameters& p, Problem& problem)
    : name_(std::move(name)),
      where_(p.has("component") ? p.where("component") : p.where()),
      field_(field_of(p, problem)),
      quantity_name_(p.text("quantity")) {
  const FieldEntry& entry = problem.field(field_);
  if (p.has("interface")) interface_ = p.text("interface");
  if (p.has("on")) boundaries_ = p.names("on");
  if (p.has("component")) component_ = p.text("component");
  choose_quantity(p, entry, problem);
  if (!interface_.empty() || !boundaries_.empty() || holding_ != nullptr) return;
  const bool on_point = entry.physics->support() == Support::point;
  if (!p.has("at") && !on_point) throw Error(p.where(), "a probe needs `at`, a point, or `on`, boundaries");
  point_.emplace(entry, p.has("at") ? p.vector("at") : std::vector<double>(3, 0.0), p.where("at"));
}

void Probe::choose_quantity(const Parameters& p, const FieldEntry& entry, const Problem& problem) {
  // The force that holds what is prescribed: known only where something is prescribed.
  reaction_ = quantity_name_ == "reaction";
  force_ = quantity_name_ == "force" && !interface_.empty();
  if (quantity_name_ == "moment" && !interface_.empty()) {
    moment_about_.emplace();
    if (p.has("about")) std::ranges::copy(p.vector("about"), moment_about_->begin());
  } else if (p.has("about")) {
    throw Error(p.where("about"), "only the `moment` of what an `interface` exerts is about a point");
  }
  const bool exerted = reaction_ || force_ || moment_about_;
  try {
    if (reaction_ && boundaries_.empty())
      throw Error("a reaction needs `on`, the boundaries on which something is prescribed");
    if (interface_.empty() && boundaries_.empty()) holding_ = find_holding(problem, entry, quantity_name_);
    if (holding_ != nullptr) {
      const std::vector<HoldsField::Force> forces = holding_->forces();
      quantity_.components = std::ranges::find(forces, quantity_name_, &HoldsField::Force::name)->components;
    }
    exerted_ = reaction_ ? unknown_of_reaction(entry, boundaries_) : entry.field->unknowns().at(0).name;
    if (holding_ == nullptr)
      quantity_ = find_quantity(entry, exerted ? exerted_ : quantity_name_, !boundaries_.empty());
    if (moment_about_ && quantity_.components != entry.mesh->dimension())
      throw Error(fmt::format("what '{}' exerts has no moment: '{}' is no vector", interface_, exerted_));
    if (quantity_.components == 1 && !component_.empty() && component_ != "magnitude" && !force_)
      throw Error(
          fmt::format("'{}' is one number, without components: leave `component` out", quantity_name_));
  } catch (const Error& error) {
    throw Error(p.where("quantity"), error.what());
  }
}

std::vector<double> Probe::evaluate(Problem& problem, const TimePoint& at) const {
  const FieldEntry& entry = problem.field(field_);
  if (force_) return interface_force(problem, interface_, exerted_, at);
  if (moment_about_) return interface_moment(problem, interface_, entry, *moment_about_, at);
  if (!interface_.empty()) return interface_integral(problem, interface_, quantity_, at);
  if (reaction_) return reaction(problem, entry, exerted_, boundaries_);
  if (holding_ != nullptr) return holding_force(problem, *holding_, quantity_name_);
  if (point_) return point_->evaluate(entry, quantity_, at);
  return boundary_integral(entry, boundaries_, quantity_, at);
}

void Probe::record(Problem& problem, const TimePoint& at, Results& results) const {
  const std::vector<double> values = evaluate(problem, at);
  if (component_ == "magnitude") {
    double square = 0;
    for (const double v : values) square += v * v;
    results.series[name_].push_back(std::sqrt(square));
  } else if (!component_.empty()) {
    const std::size_t c = component_[0] - 'x';
    if (c >= values.size())
      throw Error(where_,
                  fmt::format("probe '{}': '{}' has {} component{}, no component '{}'", name_, quantity_name_,
                              values.size(), values.size() == 1 ? "" : "s", component_));
    results.series[name_].push_back(values[c]);
  } else {
    append(name_, values, results);
  }
}

void record_integrals(Problem& problem, const TimePoint& at, Results& results) {
  for (const InterfaceMeasure& measure : problem.measures())
    results.series[measure.interface + "." + measure.name].push_back(
        interface_measure(measure, at, problem.communicator()));
  for (const FieldEntry& entry : problem.fields()) {
    if (entry.cut) results.series[entry.name + ".dropped_volume"].push_back(entry.cut->dropped_volume());
    if (entry.integrals.empty()) continue;
    const CellDomain cells(*entry.field, 2 * entry.field->order());
    for (const FieldQuantity& integral : entry.integrals) {
      const int components = integral.terms.front().term->signature(entry.mesh->dimension()).values;
      append(entry.name + "." + integral.name, cell_integral(cells, {integral.terms, components}, at),
             results);
    }
  }
}

}  // namespace seam
