// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/field_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "seam/base/plugin_fault.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/term/term_name.hpp"

namespace seam {
namespace {

std::vector<Operand> on_side_zero(const std::vector<std::string>& unknowns) {
  std::vector<Operand> operands;
  for (const std::string& unknown : unknowns) operands.push_back({0, unknown});
  return operands;
}

}  // namespace

int cell_degree(const Field& field, const Term& term) {
  const Mesh& mesh = field.mesh();
  const int order = field.order();
  const Signature& s = term.signature(mesh.dimension());
  const bool simplex = is_simplex(mesh.type());
  const auto is_gradient = [](const Slot& slot) { return slot.shape == Shape::gradient; };
  // Gradients on straight simplices are a degree lower.
  const bool gradients_only = simplex && mesh.order() == 1 && !s.outputs.empty() &&
                              std::all_of(s.inputs.begin(), s.inputs.end(), is_gradient) &&
                              std::all_of(s.outputs.begin(), s.outputs.end(), is_gradient);
  const int degree = (gradients_only ? 2 * (order - 1) : 2 * order) + term.extra_degree();
  const bool tensor = mesh.type() == CellType::quadrilateral || mesh.type() == CellType::hexahedron;
  // What Gauss' points give on whole cells anyway; rules of cut cells have exactly the degree asked for.
  return tensor ? degree / 2 * 2 + 1 : degree;
}

std::vector<int> boundary_nodes(const Field& field, int block, const std::string& boundary) {
  const CellTopology& cell = topology(field.mesh().type());
  const Space& space = *field.blocks()[block].space;
  const std::size_t per_face = static_cast<std::size_t>(topology(cell.face_type).nodes(space.order()));
  std::vector<int> nodes;
  if (boundary.empty()) {
    nodes.resize(space.nodes());
    std::iota(nodes.begin(), nodes.end(), 0);
    return nodes;
  }
  for (const CellFace& face : field.mesh().boundary(boundary))
    for (std::size_t a = 0; a < per_face; ++a)
      for (int set = 0; set < space.sets(); ++set)
        nodes.push_back(space.in_set(space.cell_nodes(face.cell)[cell.face_nodes[face.face][a]], set));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// What the physics asks for cannot be.
void FieldBuilder::refuse(const std::string& what) const {
  throw PluginFault(entry_.where,
                    fmt::format("field '{}'{}: {}", entry_.name, plugin_of(*entry_.physics), what));
}

void FieldBuilder::require_term(const Term* term, bool is_quantity) const {
  if (!term) refuse(fmt::format("its build() adds {} that is null", is_quantity ? "a quantity" : "a term"));
  const Signature& signature = term->signature(dimension());
  if (is_quantity && signature.values == 0)
    refuse(fmt::format("its build() adds the term '{}' as a quantity; make_quantity() makes those",
                       term_name(*term)));
  if (!is_quantity && signature.values > 0)
    refuse(fmt::format("its build() adds the quantity '{}' as a term; make_term() makes those",
                       term_name(*term)));
}

Field::ComponentRange FieldBuilder::component_place(const std::string& unknown, int component) const {
  Field::ComponentRange place = entry_.field->place(unknown);
  if (component < 0 || component >= place.components)
    refuse(fmt::format("its build() speaks of component {} of '{}', which has {}: 0 is the first", component,
                       unknown, place.components));
  place.offset += component;
  return place;
}

std::vector<std::string> FieldBuilder::boundaries() const {
  std::vector<std::string> names;
  for (const auto& entry : entry_.shape->boundaries()) names.push_back(entry.first);
  return names;
}

int FieldBuilder::boundary_axis(const std::string& boundary) const {
  const Mesh& mesh = *entry_.shape;
  const MeshData& whole = mesh.whole();
  const CellTopology& cell = topology(mesh.type());
  const std::size_t per_face = static_cast<std::size_t>(topology(cell.face_type).nodes(mesh.order()));
  const int dim = mesh.dimension();
  double low[3], high[3], extent = 0;
  std::fill_n(low, 3, INFINITY);
  std::fill_n(high, 3, -INFINITY);
  static_cast<void>(mesh.boundary(boundary));  // throws when there is none
  for (const CellFace& face : whole.boundaries.at(boundary))
    for (std::size_t a = 0; a < per_face; ++a) {
      const int local = cell.face_nodes[face.face][a];
      const int node = whole.cells[static_cast<std::size_t>(face.cell) * whole.nodes_per_cell() + local];
      for (int d = 0; d < dim; ++d) {
        const double x = whole.coordinates[static_cast<std::size_t>(node) * dim + d];
        low[d] = std::min(low[d], x);
        high[d] = std::max(high[d], x);
        extent = std::max(extent, high[d] - low[d]);
      }
    }
  for (int d = 0; d < dim; ++d)
    if (high[d] - low[d] <= 1e-12 * extent) return d;
  return -1;
}

void FieldBuilder::publish(const std::string& constant, double value) {
  entry_.field->set_constant(constant, value);
}

void FieldBuilder::publish(const std::string& name, std::shared_ptr<const Law> law) {
  for (int region = 0; region < entry_.field->regions(); ++region)
    if (region_ < 0 || region == region_) entry_.field->set_law(name, region, law);
}

void FieldBuilder::divide(const std::vector<std::pair<std::vector<std::string>, Location>>& names) {
  const MeshData& whole = entry_.shape->whole();
  std::vector<int> region_of_cell(whole.cell_count(), -1);
  for (std::size_t region = 0; region < names.size(); ++region)
    for (const std::string& name : names[region].first)
      for (const int cell : whole.regions.at(name)) {
        int& of_cell = region_of_cell[cell];
        if (of_cell >= 0 && of_cell != static_cast<int>(region))
          throw Error(names[region].second,
                      fmt::format("cell {} of mesh '{}' lies in two regions of field '{}'; the other one "
                                  "stands at {}",
                                  cell, entry_.shape->name(), entry_.name, names[of_cell].second.text()));
        of_cell = static_cast<int>(region);
      }
  const auto missing = std::ranges::count(region_of_cell, -1);
  if (missing > 0)
    throw Error(
        names.front().second,
        fmt::format("{} of {} cells of mesh '{}' lie in none of the regions of field '{}', the first of "
                    "them is cell {}; add a region that holds them, if need be under `regions` of the "
                    "mesh",
                    missing, region_of_cell.size(), entry_.shape->name(), entry_.name,
                    std::ranges::find(region_of_cell, -1) - region_of_cell.begin()));
  entry_.field->divide(static_cast<int>(names.size()), std::move(region_of_cell));
}

void FieldBuilder::within(int region, const std::function<void()>& add) {
  region_ = region;
  add();
  region_ = -1;
}

BoundTerm FieldBuilder::bind(std::shared_ptr<const Term> term, std::vector<Operand> operands,
                             int sides) const {
  BoundTerm bound{std::move(term), std::move(operands)};
  bound.where = entry_.where;
  // A field's own terms speak of its own unknowns: a wrong name is no fault of the scene's.
  for (const Operand& operand : bound.operands) try {
      static_cast<void>(entry_.field->place(operand.unknown));
    } catch (const Error& error) {
      throw PluginFault(entry_.where, fmt::format("field '{}'{}: {}", entry_.name, plugin_of(*entry_.physics),
                                                  error.what()));
    }
  if (region_ >= 0 && entry_.field->regions() > 1)
    for (int side = 0; side < sides; ++side) bound.regions.push_back({side, region_});
  return bound;
}

void FieldBuilder::add_quantity(std::vector<FieldQuantity>& list, const std::string& name,
                                std::shared_ptr<const Term> quantity,
                                const std::vector<std::string>& operands) const {
  require_term(quantity.get(), true);
  const bool continued = region_ > 0 && !list.empty();
  const auto known = continued ? std::ranges::find(list, name, &FieldQuantity::name) : list.end();
  if (known != list.end())
    known->terms.push_back(bind(std::move(quantity), on_side_zero(operands)));
  else
    list.push_back({name, {bind(std::move(quantity), on_side_zero(operands))}});
}

void FieldBuilder::add_cell_term(std::shared_ptr<const Term> term, std::vector<std::string> operands) {
  require_term(term.get(), false);
  const int degree = cell_degree(*entry_.field, *term);
  cell_terms_[{CellDomain::Cells::all, degree}].push_back(bind(std::move(term), on_side_zero(operands)));
}

void FieldBuilder::add_uncut_cell_term(std::shared_ptr<const Term> term, std::vector<std::string> operands) {
  require_term(term.get(), false);
  const int degree = cell_degree(*entry_.field, *term);
  cell_terms_[{CellDomain::Cells::uncut, degree}].push_back(bind(std::move(term), on_side_zero(operands)));
}

void FieldBuilder::add_boundary_term(const std::string& boundary, std::shared_ptr<const Term> term,
                                     std::vector<std::string> operands) {
  require_term(term.get(), false);
  const int degree = 2 * entry_.field->order() + term->extra_degree();
  std::set<std::string> tested;
  for (const Slot& slot : term->signature(dimension()).outputs)
    if (slot.operand < static_cast<int>(operands.size())) tested.insert(operands[slot.operand]);
  entry_.loads.emplace_back(boundary, std::move(tested));
  boundary_terms_[{boundary, degree}].push_back(bind(std::move(term), on_side_zero(operands)));
}

void FieldBuilder::add_surface_term(std::shared_ptr<const Term> term, std::vector<std::string> operands,
                                    const std::string& name) {
  require_term(term.get(), false);
  const int degree = 2 * entry_.field->order() + term->extra_degree();
  for (const Unknown& unknown : entry_.field->unknowns())
    if (unknown.role != UnknownRole::motion && std::ranges::find(operands, unknown.name) != operands.end())
      entry_.surfaces[name].unknowns.insert(unknown.name);
  surface_terms_[{name, degree}].push_back(bind(std::move(term), on_side_zero(operands)));
}

void FieldBuilder::add_interior_face_term(std::shared_ptr<const Term> term, std::vector<Operand> operands) {
  require_term(term.get(), false);
  const int degree = 2 * entry_.field->order() + term->extra_degree();
  face_terms_[{InteriorFaceDomain::Faces::all, degree}].push_back(
      bind(std::move(term), std::move(operands), 2));
}

void FieldBuilder::add_ghost_face_term(GhostFaces faces, std::shared_ptr<const Term> term,
                                       std::vector<Operand> operands) {
  require_term(term.get(), false);
  const int degree = 2 * entry_.field->order() + term->extra_degree();
  const auto which =
      faces == GhostFaces::all ? InteriorFaceDomain::Faces::ghost : InteriorFaceDomain::Faces::wet_ghost;
  face_terms_[{which, degree}].push_back(bind(std::move(term), std::move(operands), 2));
}

void FieldBuilder::fix_level(const std::string& unknown, double value,
                             std::vector<std::string> open_boundaries) {
  const Field::ComponentRange place = entry_.field->place(unknown);
  if (place.components != 1)
    refuse(fmt::format("its build() fixes the level of '{}', which has {} components; only a scalar has one",
                       unknown, place.components));
  entry_.levels.push_back({unknown, place.block, place.offset, value, std::move(open_boundaries), {}});
}

void FieldBuilder::prescribe(const std::string& boundary, const std::string& unknown, int component,
                             Expression value, const Location& where) {
  const Field::ComponentRange place = component_place(unknown, component);
  for (const PrescribedCondition& other : entry_.conditions)
    if (other.boundary == boundary && other.block == place.block && other.component == place.offset)
      throw Error(
          where,
          fmt::format("component {} of '{}' on boundary '{}' of field '{}' is prescribed twice; the other "
                      "condition stands at {}",
                      component, unknown, boundary, entry_.name, other.where.text()));
  entry_.conditions.push_back({boundary, unknown, place.block, place.offset,
                               boundary_nodes(*entry_.field, place.block, boundary), std::move(value),
                               where});
}

void FieldBuilder::give(const std::string& unknown, int component, Expression value) {
  const Field::ComponentRange place = component_place(unknown, component);
  entry_.given.push_back({place.block, place.offset, std::move(value)});
}

void FieldBuilder::set_initial(const std::string& unknown, int component, Expression value) {
  const Field::ComponentRange place = component_place(unknown, component);
  entry_.initial.push_back({place.block, place.offset, std::move(value), false});
}

void FieldBuilder::set_initial_rate(const std::string& unknown, int component, Expression value) {
  const Field::ComponentRange place = component_place(unknown, component);
  entry_.initial.push_back({place.block, place.offset, std::move(value), true});
}

void FieldBuilder::add_output(const std::string& name, std::shared_ptr<const Term> quantity,
                              std::vector<std::string> operands) {
  add_quantity(entry_.outputs, name, std::move(quantity), operands);
}

void FieldBuilder::add_integral(const std::string& name, std::shared_ptr<const Term> quantity,
                                std::vector<std::string> operands) {
  require_term(quantity.get(), true);
  add_quantity(entry_.integrals, name, std::move(quantity), operands);
}

void FieldBuilder::add_boundary_quantity(const std::string& name, std::shared_ptr<const Term> quantity,
                                         std::vector<std::string> operands) {
  add_quantity(entry_.boundary_quantities, name, std::move(quantity), operands);
}

Moments FieldBuilder::moments() const {
  const Mesh& mesh = *entry_.shape;
  const int dim = mesh.dimension();
  Field carrier("moments", mesh, {});
  const CellDomain cells(carrier, 2 * mesh.order() + 2);
  Element element;
  // Volume, first and second moments summed over all ranks, about a point of the body: about the origin those
  // of a body far from it would be differences of large numbers.
  const double* about = mesh.whole().coordinates.data();
  std::vector<double> sums(1 + 3 + 9, 0.0);
  for (int e = 0; e < cells.size(); ++e) {
    cells.fill(e, element);
    for (int q = 0; q < element.points; ++q) {
      double x[3] = {0, 0, 0};
      for (int i = 0; i < dim; ++i)
        x[i] = element.sides[0].position[static_cast<std::size_t>(q) * dim + i] - about[i];
      sums[0] += element.weight[q];
      for (int i = 0; i < dim; ++i) {
        sums[1 + i] += element.weight[q] * x[i];
        for (int j = 0; j < dim; ++j) sums[4 + 3 * i + j] += element.weight[q] * x[i] * x[j];
      }
    }
  }
  mesh.communicator().sum(sums);
  Moments m;
  m.volume = sums[0];
  for (int i = 0; i < 3; ++i) m.centre[i] = sums[1 + i] / m.volume;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m.second[i][j] = sums[4 + 3 * i + j] - m.volume * m.centre[i] * m.centre[j];
  for (int i = 0; i < dim; ++i) m.centre[i] += about[i];
  return m;
}

void FieldBuilder::finish() {
  for (auto& [key, terms] : cell_terms_)
    domains_.emplace_back(std::make_shared<CellDomain>(*entry_.field, key.second, key.first),
                          std::move(terms));
  for (auto& [key, terms] : boundary_terms_)
    domains_.emplace_back(std::make_shared<BoundaryDomain>(*entry_.field, key.first, key.second),
                          std::move(terms));
  for (auto& [key, terms] : surface_terms_) {
    const auto surface = std::make_shared<BoundaryDomain>(*entry_.field, "", key.second);
    entry_.surfaces[key.first].faces.push_back(surface);
    domains_.emplace_back(surface, std::move(terms));
  }
  for (auto& [key, terms] : face_terms_)
    domains_.emplace_back(std::make_shared<InteriorFaceDomain>(*entry_.field, key.second, key.first),
                          std::move(terms));
}

}  // namespace seam
