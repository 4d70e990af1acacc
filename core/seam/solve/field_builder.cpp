// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/field_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace seam {
namespace {

std::vector<Operand> on_side_zero(const std::vector<std::string>& unknowns) {
  std::vector<Operand> operands;
  for (const std::string& unknown : unknowns) operands.push_back({0, unknown});
  return operands;
}

int order_of(const Field& field) {
  int order = 1;
  for (const Block& block : field.blocks()) order = std::max(order, block.space->order());
  return order;
}

}  // namespace

int cell_degree(const Field& field, const Term& term) {
  const Mesh& mesh = field.mesh();
  const int order = order_of(field);
  const Signature& s = term.signature(mesh.dimension());
  const bool simplex = mesh.type() == CellType::triangle || mesh.type() == CellType::tetrahedron;
  const auto is_gradient = [](const Slot& slot) { return slot.shape == Shape::gradient; };
  // Gradients on straight simplices are a degree lower.
  const bool gradients_only = simplex && mesh.order() == 1 && !s.outputs.empty() &&
                              std::all_of(s.inputs.begin(), s.inputs.end(), is_gradient) &&
                              std::all_of(s.outputs.begin(), s.outputs.end(), is_gradient);
  return (gradients_only ? 2 * (order - 1) : 2 * order) + term.extra_degree();
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
      nodes.push_back(space.cell_nodes(face.cell)[cell.face_nodes[face.face][a]]);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

int FieldBuilder::highest_order() const { return order_of(*entry_.field); }

void FieldBuilder::add_cell_term(std::shared_ptr<const Term> term, std::vector<std::string> operands) {
  const int degree = cell_degree(*entry_.field, *term);
  cell_terms_[degree].push_back({std::move(term), on_side_zero(operands)});
}

void FieldBuilder::add_boundary_term(const std::string& boundary, std::shared_ptr<const Term> term,
                                     std::vector<std::string> operands) {
  const int degree = 2 * highest_order() + term->extra_degree();
  boundary_terms_[{boundary, degree}].push_back({std::move(term), on_side_zero(operands)});
}

void FieldBuilder::add_interior_face_term(std::shared_ptr<const Term> term, std::vector<Operand> operands) {
  const int degree = 2 * highest_order() + term->extra_degree();
  face_terms_[degree].push_back({std::move(term), std::move(operands)});
}

void FieldBuilder::prescribe(const std::string& boundary, const std::string& unknown, int component,
                             Expression value, const Location& where) {
  const Field::Place place = entry_.field->place(unknown);
  for (const PrescribedCondition& other : entry_.conditions)
    if (other.boundary == boundary && other.block == place.block &&
        other.component == place.offset + component)
      throw Error(
          where,
          fmt::format("component {} of '{}' on boundary '{}' of field '{}' is prescribed twice; the other "
                      "condition stands at {}",
                      component, unknown, boundary, entry_.name, other.where.text()));
  entry_.conditions.push_back({boundary, unknown, place.block, place.offset + component,
                               boundary_nodes(*entry_.field, place.block, boundary), std::move(value),
                               where});
}

void FieldBuilder::set_initial(const std::string& unknown, int component, Expression value) {
  const Field::Place place = entry_.field->place(unknown);
  entry_.initial.push_back({place.block, place.offset + component, std::move(value), false});
}

void FieldBuilder::set_initial_rate(const std::string& unknown, int component, Expression value) {
  const Field::Place place = entry_.field->place(unknown);
  entry_.initial.push_back({place.block, place.offset + component, std::move(value), true});
}

void FieldBuilder::add_output(const std::string& name, std::shared_ptr<const Term> quantity,
                              std::vector<std::string> operands) {
  entry_.outputs.push_back({name, std::move(quantity), std::move(operands)});
}

void FieldBuilder::add_integral(const std::string& name, std::shared_ptr<const Term> quantity,
                                std::vector<std::string> operands) {
  entry_.integrals.push_back({name, std::move(quantity), std::move(operands)});
}

Moments FieldBuilder::moments() const {
  const Mesh& mesh = *entry_.shape;
  const int dim = mesh.dimension();
  Field carrier("moments", mesh, {});
  const CellDomain cells(carrier, 2 * mesh.order() + 2);
  Element element;
  // Volume, first and second moments about the origin, summed over all ranks.
  std::vector<double> sums(1 + 3 + 9, 0.0);
  for (int e = 0; e < cells.size(); ++e) {
    cells.fill(e, element);
    for (int q = 0; q < element.points; ++q) {
      const double* x = &element.sides[0].position[static_cast<std::size_t>(q) * dim];
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
  return m;
}

void FieldBuilder::finish() {
  for (auto& [degree, terms] : cell_terms_)
    domains_.emplace_back(std::make_shared<CellDomain>(*entry_.field, degree), std::move(terms));
  for (auto& [key, terms] : boundary_terms_)
    domains_.emplace_back(std::make_shared<BoundaryDomain>(*entry_.field, key.first, key.second),
                          std::move(terms));
  for (auto& [degree, terms] : face_terms_)
    domains_.emplace_back(std::make_shared<InteriorFaceDomain>(*entry_.field, degree), std::move(terms));
}

}  // namespace seam
