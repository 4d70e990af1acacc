// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/error_norms.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "seam/assembly/domains.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/field/field.hpp"
#include "seam/record/unknown_quantity.hpp"
#include "seam/term/tensor.hpp"

namespace seam {
namespace {

/// Where the points of a moving mesh are, and how its cells have been deformed there.
class MovedPoints {
 public:
  MovedPoints(const IntegrationDomain& domain, int dim, const std::string& displacement)
      : dim_(dim),
        value_(domain, {{std::make_shared<UnknownQuantity>(dim, Shape::value, dim), {{0, displacement}}}}),
        gradient_(domain,
                  {{std::make_shared<UnknownQuantity>(dim, Shape::gradient, dim), {{0, displacement}}}}) {}
  void compute(int element, const TimePoint& at) {
    shift_ = &value_.compute_values(element, at);
    slope_ = &gradient_.compute_values(element, at);
  }
  /// Moves point q. @param x [dim] @return change of volume
  double move(int q, double* x) {
    Mat<3, 3, double> f = identity<3>();
    for (int i = 0; i < dim_; ++i) {
      x[i] += (*shift_)[static_cast<std::size_t>(q) * dim_ + i];
      for (int j = 0; j < dim_; ++j)
        f(i, j) += (*slope_)[(static_cast<std::size_t>(q) * dim_ + i) * dim_ + j];
    }
    inverse_ = inverse(f);
    return determinant(f);
  }
  /// Of the point moved last, a gradient in space from one in the reference configuration.
  /// @param gradient [components][dim], overwritten
  void map(std::vector<double>& gradient) const {
    for (std::size_t c = 0; c < gradient.size(); c += dim_) {
      double mapped[3] = {};
      for (int i = 0; i < dim_; ++i)
        for (int j = 0; j < dim_; ++j) mapped[i] += gradient[c + j] * inverse_(j, i);
      std::copy_n(mapped, dim_, &gradient[c]);
    }
  }

 private:
  int dim_;
  ElementEvaluator value_, gradient_;
  const std::vector<double>*shift_ = nullptr, *slope_ = nullptr;
  Mat<3, 3, double> inverse_;
};

/// The difference between an unknown, or its gradient, and a known solution on one side of a domain.
class Difference {
 public:
  /// @param displacement of a mesh that moves through space (Physics::moves_through_space), else ""
  Difference(const IntegrationDomain& domain, int side, const std::string& unknown, double time,
             const std::string& displacement = "")
      : domain_(domain), field_(*domain.fields()[side]), side_(side), unknown_(unknown) {
    at_.time = time;
    if (!displacement.empty()) moved_.emplace(domain, field_.mesh().dimension(), displacement);
  }
  /// @param along_normal take the gradient's component along the normal
  [[nodiscard]] double norm(Shape shape, const std::vector<Expression>& known, bool along_normal) {
    const int dim = field_.mesh().dimension(), size = field_.place(unknown_).components;
    const int components = size * rows(shape, dim);
    ElementEvaluator evaluator(
        domain_, {{std::make_shared<UnknownQuantity>(size, shape, dim), {Operand{side_, unknown_}}}});
    double square = 0;
    std::vector<double> difference(components);
    for (int e = 0; e < domain_.size(); ++e) {
      const auto& values = evaluator.compute_values(e, at_);
      if (moved_) moved_->compute(e, at_);
      const Element& element = evaluator.element();
      for (int q = 0; q < element.points; ++q) {
        double x[3] = {}, weight = element.weight[q];
        std::copy_n(&element.sides[side_].position[static_cast<std::size_t>(q) * dim], dim, x);
        std::copy_n(&values[static_cast<std::size_t>(q) * components], components, difference.begin());
        if (moved_) weight *= moved_->move(q, x);
        if (moved_ && shape == Shape::gradient) moved_->map(difference);
        for (int c = 0; c < components; ++c) difference[c] -= known[c](x, dim, at_.time);
        const double* normal = along_normal ? &element.normal[static_cast<std::size_t>(q) * dim] : nullptr;
        square += weight * square_of(difference, normal, dim);
      }
    }
    return std::sqrt(field_.mesh().communicator().sum(square));
  }

 private:
  static double square_of(const std::vector<double>& difference, const double* normal, int dim) {
    double square = 0;
    for (std::size_t c = 0; c < difference.size(); c += normal ? dim : 1) {
      double d = difference[c];
      if (normal) d = std::inner_product(normal, normal + dim, &difference[c], 0.0);
      square += d * d;
    }
    return square;
  }
  const IntegrationDomain& domain_;
  const Field& field_;
  int side_;
  std::string unknown_;
  TimePoint at_;
  std::optional<MovedPoints> moved_;
};

}  // namespace

void require_known_solution(const FieldEntry& entry, const Parameters& p) {
  const std::string& unknown = p.text("unknown");
  std::vector<std::string> names;
  for (const Unknown& u : entry.field->unknowns()) names.push_back(u.name);
  if (std::ranges::find(names, unknown) == names.end()) {
    const std::string nearest = nearest_name(unknown, names);
    throw Error(p.where("unknown"),
                fmt::format("field '{}' has no unknown '{}'{}; it has: {}", entry.name, unknown,
                            nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest),
                            fmt::join(names, ", ")));
  }
  const int size = entry.field->place(unknown).components, dim = entry.mesh->dimension();
  for (const auto& [key, shape] :
       {std::pair("exact", Shape::value), std::pair("gradient", Shape::gradient)}) {
    const int expected = size * rows(shape, dim);
    if (!p.has(key) || static_cast<int>(p.vector_expression(key).size()) == expected) continue;
    throw Error(
        p.where(key),
        fmt::format("the known solution of '{}' has {} entries here; expected {}{}", unknown,
                    p.vector_expression(key).size(), expected,
                    shape == Shape::value ? ", one a component"
                                          : ", derivatives by x, y(, z) of one component after the other"));
  }
}

ErrorNorms error_norms(const FieldEntry& entry, const std::string& unknown,
                       const std::vector<Expression>& exact, const std::vector<Expression>& gradient,
                       double time) {
  const CellDomain cells(*entry.field, 2 * entry.field->order() + 4);
  Difference difference(cells, 0, unknown, time,
                        entry.physics->moves_through_space() ? entry.physics->displacement() : "");
  ErrorNorms norms;
  norms.l2 = difference.norm(Shape::value, exact, false);
  if (!gradient.empty()) norms.h1 = difference.norm(Shape::gradient, gradient, false);
  return norms;
}

ErrorNorms interface_error_norms(const std::vector<InterfacePart>& interface, const FieldEntry& entry,
                                 const std::string& unknown, const std::vector<Expression>& exact,
                                 const std::vector<Expression>& gradient, double time) {
  ErrorNorms norms;
  if (!gradient.empty()) norms.h1 = 0;
  if (entry.physics->moves_through_space())
    throw Error(fmt::format("errors along an interface are not measured in field '{}', whose mesh moves",
                            entry.name));
  for (const InterfacePart& part : interface) {
    if (!part.bounds_field) continue;
    const std::vector<Field*> fields = part.domain->fields();
    const auto side = std::find(fields.begin(), fields.end(), entry.field.get());
    if (side == fields.end())
      throw Error(fmt::format("field '{}' lies on no side of {}", entry.name, part.domain->description()));
    Difference difference(*part.domain, static_cast<int>(side - fields.begin()), unknown, time);
    norms.l2 = std::hypot(norms.l2, difference.norm(Shape::value, exact, false));
    if (norms.h1) norms.h1 = std::hypot(*norms.h1, difference.norm(Shape::gradient, gradient, true));
  }
  return norms;
}

}  // namespace seam
