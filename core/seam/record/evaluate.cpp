// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/evaluate.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "seam/assembly/assembler.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"
#include "seam/record/unknown_quantity.hpp"

namespace seam {
namespace {

/// Chosen points in chosen cells.
class SampleDomain final : public IntegrationDomain {
 public:
  struct Sample {
    int cell, part;
  };
  SampleDomain(const FieldEntry& entry, std::vector<Sample> cells, const std::vector<double>& reference)
      : entry_(entry), cells_(std::move(cells)) {
    const Mesh& mesh = entry.field->mesh();
    const int dim = std::max(1, topology(mesh.type()).dimension);
    const int points = mesh.type() == CellType::point ? 1 : static_cast<int>(reference.size()) / dim;
    for (int order = 1; order <= 2; ++order)
      tabulate(mesh.type(), order, reference.data(), points, false, tables_[order - 1]);
  }
  [[nodiscard]] int size() const override { return static_cast<int>(cells_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return {entry_.field.get()}; }
  void fill(int index, Element& element) const override {
    element.dimension = entry_.field->mesh().dimension();
    element.points = tables_[0].points;
    element.sides.resize(1);
    attach_cell(element.sides[0], *entry_.field, cells_[index].cell, cells_[index].part);
    element.sides[0].table[0] = &tables_[0];
    element.sides[0].table[1] = &tables_[1];
    element.sides[0].map_geometry();
    element.weight.assign(element.points, 1.0);
    element.normal.clear();
    element.set_sizes(element.sides[0].diameter, element.sides[0].diameter);
  }
  [[nodiscard]] const int* nodes(int index, int, int block) const override {
    return entry_.field->cell_nodes(block, cells_[index].cell, cells_[index].part);
  }
  [[nodiscard]] std::string description() const override { return "points of field '" + entry_.name + "'"; }

 private:
  const FieldEntry& entry_;
  std::vector<Sample> cells_;
  ShapeTable tables_[2];
};

std::vector<double> integrate(const IntegrationDomain& domain, const NamedQuantity& quantity,
                              const TimePoint& at, const Communicator& communicator) {
  ElementEvaluator evaluator(domain, quantity.terms);
  std::vector<double> sum(quantity.components, 0.0);
  for (int e = 0; e < domain.size(); ++e) {
    const auto& values = evaluator.compute_values(e, at);
    for (int q = 0; q < evaluator.element().points; ++q)
      for (int c = 0; c < quantity.components; ++c)
        sum[c] +=
            evaluator.element().weight[q] * values[static_cast<std::size_t>(q) * quantity.components + c];
  }
  communicator.sum(sum);
  return sum;
}

const Field& first_field(const Problem& problem, const std::string& interface) {
  return *problem.interfaces().at(interface).front().domain->fields().front();
}

/// Calls `add(node, component, force)` for all that the couplings on an interface add to the equations of an
/// unknown of side 0.
template <class Add>
void for_each_force(const Problem& problem, const std::string& interface, const Field::ComponentRange& place,
                    const TimePoint& at, const Add& add) {
  const std::vector<InterfacePart>& parts = problem.interfaces().at(interface);
  for (const Problem::DomainTerms& integrated : problem.domains()) {
    const auto& domain = integrated.first;
    if (std::ranges::none_of(parts, [&](const InterfacePart& p) { return p.domain == domain; })) continue;
    ElementEvaluator evaluator(*domain, integrated.second);
    for (const ElementEvaluator::SideBlock& part : evaluator.side_blocks()) {
      if (part.side != 0 || part.block != place.block) continue;
      for (int e = 0; e < domain->size(); ++e) {
        evaluator.compute(e, at, false);
        const int* nodes = domain->nodes(e, 0, place.block);
        for (int c = 0; c < place.components; ++c)
          for (int a = 0; a < part.nodes; ++a)
            add(nodes[a], c, evaluator.residual()[part.offset + (place.offset + c) * part.stride + a]);
      }
    }
  }
}

/// First component, in the block of an unknown, of what displaces its nodes; -1 where they are at rest.
/// @throws Error where nodes of another order are displaced
int displacement_beside(const FieldEntry& entry, const Field::ComponentRange& place) {
  const std::string displacement = entry.physics->displacement();
  const auto& unknowns = entry.field->unknowns();
  if (std::ranges::find(unknowns, displacement, &Unknown::name) == unknowns.end()) return -1;
  const Field::ComponentRange moved = entry.field->place(displacement);
  if (moved.block == place.block) return moved.offset;
  throw Error(fmt::format("a moment needs '{}' and '{}' of field '{}' to be of one order",
                          unknowns.front().name, displacement, entry.name));
}

}  // namespace

NamedQuantity find_quantity(const FieldEntry& entry, const std::string& name, bool on_boundary) {
  const int dim = entry.field->mesh().dimension();
  for (const FieldQuantity& quantity : entry.boundary_quantities) {
    if (quantity.name != name) continue;
    if (!on_boundary)
      throw Error(fmt::format("'{}' of field '{}' is known on its boundaries only: say `on`, and of which",
                              name, entry.name));
    return {quantity.terms, quantity.terms.front().term->signature(dim).values};
  }
  std::vector<std::string> known;
  for (const Unknown& unknown : entry.field->unknowns()) {
    if (unknown.name == name)
      return {{{std::make_shared<UnknownQuantity>(unknown.components, Shape::value, dim), {{0, name}}}},
              unknown.components};
    known.push_back(unknown.name);
  }
  for (const FieldQuantity& output : entry.outputs) {
    if (output.name == name) return {output.terms, output.terms.front().term->signature(dim).values};
    known.push_back(output.name);
  }
  for (const FieldQuantity& quantity : entry.boundary_quantities)
    if (on_boundary) known.push_back(quantity.name);
  const std::string nearest = nearest_name(name, known);
  throw Error(fmt::format("field '{}' has no quantity '{}'{}; it has: {}", entry.name, name,
                          nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                          fmt::join(known, ", ")));
}

std::vector<double> nodal_values(const FieldEntry& entry, const Space& space, const NamedQuantity& quantity,
                                 const TimePoint& at) {
  const Mesh& mesh = entry.field->mesh();
  const CellTopology& cell = topology(mesh.type());
  std::vector<SampleDomain::Sample> cells;
  for (int c = 0; c < mesh.cells(); ++c)
    for (int p = 0; p < entry.field->parts(c) && entry.field->active_cells()[c]; ++p)
      if (!entry.field->is_covered(c)) cells.push_back({c, p});
  const int per_cell = space.nodes_per_cell(), components = quantity.components;
  const std::vector<double> reference(
      cell.node_coordinates.begin(),
      cell.node_coordinates.begin() +
          std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(per_cell) * cell.dimension,
                                   static_cast<std::ptrdiff_t>(cell.node_coordinates.size())));
  const SampleDomain domain(entry, cells, reference);
  ElementEvaluator evaluator(domain, quantity.terms);
  std::vector<double> sum(static_cast<std::size_t>(space.nodes()) * components, 0.0);
  std::vector<int> count(space.nodes(), 0);
  for (int e = 0; e < domain.size(); ++e) {
    const auto& values = evaluator.compute_values(e, at);
    for (int a = 0; a < per_cell; ++a) {
      const int node = entry.field->cell_nodes(space, cells[e].cell, cells[e].part)[a];
      ++count[node];
      for (int k = 0; k < components; ++k)
        sum[static_cast<std::size_t>(node) * components + k] +=
            values[static_cast<std::size_t>(a) * components + k];
    }
  }
  for (int node = 0; node < space.nodes(); ++node)
    for (int k = 0; k < components && count[node] > 0; ++k)
      sum[static_cast<std::size_t>(node) * components + k] /= count[node];
  return sum;
}

std::vector<double> cell_integral(const CellDomain& cells, const NamedQuantity& quantity,
                                  const TimePoint& at) {
  return integrate(cells, quantity, at, cells.fields().front()->mesh().communicator());
}

std::vector<double> boundary_integral(const FieldEntry& entry, const std::vector<std::string>& boundaries,
                                      const NamedQuantity& quantity, const TimePoint& at) {
  std::vector<double> sum(quantity.components, 0.0);
  int extra = 0;
  for (const BoundTerm& of : quantity.terms) extra = std::max(extra, of.term->extra_degree());
  for (const std::string& name : boundaries) {
    const BoundaryDomain faces(*entry.field, name, 2 * entry.field->order() + extra);
    const auto part = integrate(faces, quantity, at, entry.field->mesh().communicator());
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += part[c];
  }
  return sum;
}

std::vector<double> interface_integral(const Problem& problem, const std::string& interface,
                                       const NamedQuantity& quantity, const TimePoint& at) {
  std::vector<double> sum(quantity.components, 0.0);
  for (const InterfacePart& part : problem.interfaces().at(interface)) {
    if (!part.bounds_field) continue;
    const auto share = integrate(*part.domain, quantity, at, problem.communicator());
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += share[c];
  }
  return sum;
}

double interface_measure(const InterfaceMeasure& measure, const TimePoint& at,
                         const Communicator& communicator) {
  double sum = 0, square = 0;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const auto& [domain, quantity] : measure.integrals) {
    ElementEvaluator evaluator(*domain, {quantity});
    const int dim = domain->fields().front()->mesh().dimension();
    const auto components = static_cast<std::size_t>(quantity.term->signature(dim).values);
    for (int e = 0; e < domain->size(); ++e) {
      const auto& values = evaluator.compute_values(e, at);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const double weight = evaluator.element().weight[i / components];
        sum += weight * values[i];
        square += weight * values[i] * values[i];
        least = std::min(least, values[i]);
        greatest = std::max(greatest, values[i]);
      }
    }
  }
  switch (measure.of) {
    case MeasureOf::norm:
      return std::sqrt(communicator.sum(square));
    case MeasureOf::integral:
      return communicator.sum(sum);
    case MeasureOf::least:
      return -communicator.max(-least);
    case MeasureOf::greatest: {
      // Where there is no point, as where nothing is opposite any more, nothing presses.
      const double most = communicator.max(greatest);
      return std::isinf(most) && most < 0 ? 0 : most;
    }
  }
  return 0;
}

std::vector<double> interface_force(const Problem& problem, const std::string& interface,
                                    const std::string& unknown, const TimePoint& at) {
  const Field::ComponentRange place = first_field(problem, interface).place(unknown);
  std::vector<double> sum(place.components, 0.0);
  for_each_force(problem, interface, place, at, [&](int, int c, double force) { sum[c] += force; });
  problem.communicator().sum(sum);
  return sum;
}

std::vector<double> interface_moment(const Problem& problem, const std::string& interface,
                                     const FieldEntry& entry, const std::array<double, 3>& about,
                                     const TimePoint& at) {
  const Field& field = *entry.field;
  const int dim = field.mesh().dimension();
  const Field::ComponentRange place = field.place(field.unknowns().front().name);
  const Block& block = field.blocks()[place.block];
  const int moved = displacement_beside(entry, place);
  std::vector<double> sum(3, 0.0);
  for_each_force(problem, interface, place, at, [&](int node, int c, double force) {
    double arm[3] = {0, 0, 0};
    for (int d = 0; d < dim; ++d) {
      arm[d] = block.space->position(node)[d] - about[d];
      if (moved >= 0) arm[d] += block.now.value[static_cast<std::size_t>(node) * block.size + moved + d];
    }
    const int next = (c + 1) % 3, last = (c + 2) % 3;
    sum[next] += arm[last] * force;
    sum[last] -= arm[next] * force;
  });
  problem.communicator().sum(sum);
  return dim == 2 ? std::vector<double>{sum[2]} : sum;
}

ProbePoint::ProbePoint(const FieldEntry& entry, const std::vector<double>& position, const Location& where) {
  const Mesh& mesh = entry.field->mesh();
  const Communicator& communicator = mesh.communicator();
  if (mesh.type() == CellType::point) {
    if (mesh.owned_cells() > 0) places_.push_back({0, {}});
    return;
  }
  const int dim = mesh.dimension();
  std::copy_n(position.begin(), dim, position_.begin());
  constexpr double tolerance = 1e-6;
  struct Candidate {
    int cell;
    PlaceInCell place;
  };
  std::vector<Candidate> candidates;
  double best = std::numeric_limits<double>::max();
  for (int c = 0; c < mesh.owned_cells(); ++c) {
    ElementSide side;
    attach_cell(side, *entry.field, c);
    double distance = 0;
    for (int d = 0; d < dim; ++d) distance += std::pow(side.geometry[d] - position[d], 2);
    if (std::sqrt(distance) > 2 * side.diameter) continue;
    const auto place = locate(side, position.data());
    if (!place) continue;
    best = std::min(best, place->outside);
    if (place->outside <= tolerance) candidates.push_back({c, *place});
  }
  const double overall = communicator.min(best);
  if (overall > tolerance)
    throw Error(where, fmt::format("the point ({}) lies outside the mesh '{}' of field '{}'",
                                   fmt::join(position, ", "), mesh.name(), entry.name));
  constexpr double rounding = 1e-10;
  for (Candidate& candidate : candidates)
    if (candidate.place.outside <= overall + rounding)
      places_.push_back({candidate.cell, std::move(candidate.place.reference)});
}

std::vector<double> ProbePoint::evaluate(const FieldEntry& entry, const NamedQuantity& quantity,
                                         const TimePoint& at) const {
  const Field& field = *entry.field;
  const Communicator& communicator = field.mesh().communicator();
  // Cells that a body covers count only where there is nothing else.
  const auto is_active = [&](const InCell& place) { return field.active_cells()[place.cell] != 0; };
  const bool any = communicator.any(std::ranges::any_of(places_, is_active));
  std::vector<double> sum(quantity.components + 1, 0.0);  // the last one counts
  for (const InCell& place : places_) {
    if (any && !is_active(place)) continue;
    const int part = field.parts(place.cell) > 1 ? field.cut()->part_at(place.cell, position_) : 0;
    const SampleDomain domain(entry, {{place.cell, part}}, place.reference);
    ElementEvaluator evaluator(domain, quantity.terms);
    const auto& values = evaluator.compute_values(0, at);
    for (int c = 0; c < quantity.components; ++c) sum[c] += values[c];
    ++sum.back();
  }
  communicator.sum(sum);
  std::vector<double> result(sum.begin(), sum.end() - 1);
  for (double& value : result) value /= sum.back();
  return result;
}

std::vector<double> reaction(Problem& problem, const FieldEntry& entry, const std::string& unknown,
                             const std::vector<std::string>& boundaries) {
  const Field::ComponentRange place = entry.field->place(unknown);
  const Block& block = entry.field->blocks()[place.block];
  std::vector<char> counted(block.space->nodes(), 0);
  std::vector<double> sum(place.components, 0.0);
  for (const std::string& boundary : boundaries)
    for (const PrescribedCondition& condition : entry.conditions) {
      if (condition.boundary != boundary || condition.block != place.block) continue;
      for (const int node : condition.nodes) counted[node] = 1;
    }
  for (int node = 0; node < block.space->owned_nodes(); ++node)
    for (int c = 0; c < place.components && counted[node]; ++c) {
      if (!block.prescribed[static_cast<std::size_t>(node) * block.size + place.offset + c]) continue;
      const int row = problem.assembler().row(*entry.field, place.block, node, place.offset + c);
      if (row >= 0) sum[c] += problem.assembler().full_residual()[row];
    }
  problem.communicator().sum(sum);
  return sum;
}

const HoldsField* find_holding(const Problem& problem, const FieldEntry& entry, const std::string& name) {
  for (const Constraint* constraint : problem.constraints()) {
    const auto* holds = dynamic_cast<const HoldsField*>(constraint);
    if (holds == nullptr || &holds->held() != entry.field.get()) continue;
    const std::vector<HoldsField::Force> forces = holds->forces();
    if (std::ranges::find(forces, name, &HoldsField::Force::name) != forces.end()) return holds;
  }
  return nullptr;
}

std::vector<double> holding_force(const Problem& problem, const HoldsField& holds, const std::string& name) {
  const Assembler& assembler = problem.assembler();
  const auto left = [&](const Field& field, int block, int node, int component) {
    const int row = assembler.row(field, block, node, component);
    return row < 0 ? 0.0 : assembler.full_residual()[row];
  };
  return holds.force(name, left, problem.constraints());
}

}  // namespace seam
