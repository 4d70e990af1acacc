// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>

#include "seam/assembly/element.hpp"
#include "seam/base/error_list.hpp"
#include "seam/base/memory.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/cut/field_cut.hpp"
#include "seam/field/field.hpp"
#include "seam/run/scene_builder.hpp"

namespace seam {
namespace {

/// What an interface may ask of the scene while it is built.
class SceneInterfaceSetup final : public InterfaceSetup {
 public:
  SceneInterfaceSetup(BuiltScene& built, const std::vector<std::string>& names, int extra) : built_(built) {
    int order = 1;
    for (const std::string& name : names) {
      entries_.push_back(&built.problem->field(name));
      sides.push_back(entries_.back()->field.get());
      order = std::max(order, sides.back()->order());
    }
    degree = 2 * order;
    extra_degree = extra;
  }
  FieldCut& cut(int side) override {
    if (!displacement(side).empty())
      throw Error(fmt::format(
          "field '{}' moves its mesh, so that no body can be cut out of it; only fields on fixed meshes can",
          entries_[side]->name));
    return built_.problem->cut(*entries_[side]);
  }
  std::string displacement(int side) override {
    const Physics& physics = *entries_[side]->physics;
    return physics.support() == Support::mesh ? physics.displacement() : "";
  }
  std::shared_ptr<const MeshData> mesh(const std::string& name) override { return built_.meshes.at(name); }

 private:
  BuiltScene& built_;
  std::vector<FieldEntry*> entries_;
};

/// An interface whose points exist.
struct BuiltInterface {
  const Interface* of;
  std::vector<InterfacePart> parts;
  std::vector<Field*> sides;

  /// @throws Error when there is no such part
  [[nodiscard]] const std::shared_ptr<IntegrationDomain>& part(const std::string& name) const {
    for (const InterfacePart& part : parts)
      if (part.name == name) return part.domain;
    std::vector<std::string> names;
    for (const InterfacePart& part : parts) names.push_back("'" + part.name + "'");
    throw Error(fmt::format("the coupling acts on the part '{}' of an interface whose parts are: {}", name,
                            fmt::join(names, ", ")));
  }
};

bool speaks_of(const Coupling::SideTerm& term, int side) {
  return std::ranges::any_of(term.operands, [&](const Operand& operand) { return operand.side == side; });
}

/// The regions that a term of a coupling holds in, on the sides that it speaks of.
std::vector<BoundTerm::Region> regions_of(const Coupling::SideTerm& term, const CouplingSides& sides) {
  std::vector<BoundTerm::Region> result;
  for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side)
    if (sides.fields[side]->regions() > 1 && speaks_of(term, side))
      result.push_back({side, sides.regions[side]});
  return result;
}

/// Of the terms that a coupling gives for each combination of regions, those that do not speak of a side
/// count once for all regions there.
bool concerns(const Coupling::SideTerm& term, const CouplingSides& sides) {
  for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side)
    if (sides.regions[side] > 0 && !speaks_of(term, side)) return false;
  return true;
}

/// The next combination of regions of the sides. @return false after the last one
bool next_regions(CouplingSides& sides) {
  for (std::size_t side = 0; side < sides.fields.size(); ++side) {
    if (++sides.regions[side] < sides.fields[side]->regions()) return true;
    sides.regions[side] = 0;
  }
  return false;
}

/// Binds the terms and measures of one coupling to the points of its interface.
class CouplingBinder {
 public:
  CouplingBinder(const SceneCoupling& of, const BuiltInterface& on) : of_(of), on_(on) {}

  void bind_to(Problem& problem) {
    CouplingSides sides{{on_.sides.begin(), on_.sides.end()}, std::vector<int>(on_.sides.size(), 0)};
    for (const Coupling::Brought& brought : of_.coupling->brings(sides))
      problem.leave_out(on_.sides.at(brought.side)->name(), brought.term, on_.of->boundaries(brought.side),
                        of_.describe());
    do {
      for (const auto& term : of_.coupling->terms(sides))
        if (concerns(term, sides)) terms_[term.part].push_back(bound(term, sides));
      bind_measures(sides);
    } while (next_regions(sides));
    for (InterfaceMeasure& measure : measures_) problem.add_measure(std::move(measure));
    for (auto& [part, of_part] : terms_) problem.add_coupling(on_.part(part), std::move(of_part));
  }

 private:
  void bind_measures(const CouplingSides& sides) {
    std::size_t number = 0;
    for (const auto& measure : of_.coupling->measures(sides)) {
      if (number == measures_.size()) measures_.push_back({of_.on(), measure.name, {}, measure.of});
      for (const auto& quantity : measure.quantities)
        if (concerns(quantity, sides))
          measures_[number].integrals.push_back({on_.part(quantity.part), bound(quantity, sides)});
      ++number;
    }
  }
  [[nodiscard]] BoundTerm bound(const Coupling::SideTerm& term, const CouplingSides& sides) const {
    const Location where = of_.parameters.where();
    if (!term.term) throw PluginFault(where, of_.describe() + " gives a term that is null");
    BoundTerm result{term.term, term.operands, {-1, -1}, regions_of(term, sides), where};
    for (std::size_t k = 0; k < term.constants.size(); ++k) {
      const auto& [side, constant] = term.constants[k];
      result.constants.at(k) = on_.part(term.part)->add_constant(side, constant, sides.regions.at(side));
    }
    return result;
  }

  const SceneCoupling& of_;
  const BuiltInterface& on_;
  std::map<std::string, std::vector<BoundTerm>> terms_;  ///< by part
  std::vector<InterfaceMeasure> measures_;
};

std::map<std::string, BuiltInterface> build_interfaces(const Scene& scene, BuiltScene& built,
                                                       const std::map<std::string, int>& extra_degree,
                                                       ErrorList& errors) {
  std::map<std::string, BuiltInterface> all;
  const auto build = [&](const std::string& name, const Interface& interface) {
    const auto extra = extra_degree.find(name);
    SceneInterfaceSetup setup(built, interface.fields(), extra == extra_degree.end() ? 0 : extra->second);
    const Location where = scene.where("interfaces", name);
    auto parts = needing_memory(fmt::format("the interface '{}'", name), where, [&] {
      return call_plugin(
          where, [&] { return fmt::format("interface '{}'{}", name, plugin_of(interface)); },
          [&] { return interface.build(setup); });
    });
    built.problem->name_interface(name, parts, where);
    all[name] = {&interface, std::move(parts), setup.sides};
  };
  for (const auto& [name, interface] : built.interfaces)
    errors.attempt([&, &called = name, &of = interface] { build(called, *of); });
  errors.throw_if_any();
  return all;
}

/// Lets each coupling look at all others. @throws Error where they do not go together, by `errors`
void check_neighbours(const BuiltScene& built, ErrorList& errors) {
  const std::vector<SceneCoupling>& couplings = built.couplings;
  std::vector<Coupling::Neighbour> neighbours;
  for (const SceneCoupling& of : couplings)
    for (const auto& [name, interface] : built.interfaces)
      if (name == of.on()) neighbours.push_back({of.parameters, interface->fields()});
  for (std::size_t k = 0; k < couplings.size(); ++k)
    errors.attempt([&] { couplings[k].coupling->check_beside(neighbours, k); });
}

}  // namespace

std::string SceneCoupling::describe() const {
  return fmt::format("coupling '{}' on '{}'{}", parameters.type(), on(), plugin_of(*coupling));
}

std::vector<Unknown> unknowns_of_couplings(const BuiltScene& built, const std::string& field, int dimension,
                                           const std::vector<Unknown>& of_physics) {
  std::vector<Unknown> result;
  for (const SceneCoupling& of : built.couplings) {
    const auto on =
        std::ranges::find(built.interfaces, of.on(), [](const auto& named) { return named.first; });
    if (on == built.interfaces.end()) continue;
    const Interface& interface = *on->second;
    call_plugin(
        of.parameters.where(), [&] { return of.describe(); },
        [&] {
          const std::vector<std::string> fields = interface.fields();
          for (int side = 0; side < static_cast<int>(fields.size()); ++side) {
            if (fields[side] != field) continue;
            for (Unknown& brought : of.coupling->unknowns(side, dimension, of_physics)) {
              brought.boundaries = interface.boundaries(side);
              result.push_back(std::move(brought));
            }
          }
        });
  }
  return result;
}

void build_couplings(const Scene& scene, BuiltScene& built) {
  const int dimension = static_cast<int>(scene.root.integer("dimension"));
  std::map<std::string, int> extra_degree;  // by interface
  ErrorList errors(built.problem->communicator());
  for (const SceneCoupling& of : built.couplings) {
    int& most = extra_degree[of.on()];
    most = std::max(most, of.coupling->extra_degree(dimension));
  }
  const std::map<std::string, BuiltInterface> interfaces =
      build_interfaces(scene, built, extra_degree, errors);
  check_neighbours(built, errors);
  for (const SceneCoupling& of : built.couplings)
    errors.attempt([&] {
      call_plugin(
          of.parameters.where(), [&] { return of.describe(); },
          [&] { CouplingBinder(of, interfaces.at(of.on())).bind_to(*built.problem); });
    });
  errors.throw_if_any();
}

}  // namespace seam
