// SPDX-License-Identifier: BSD-3-Clause
// What an element's terms say that is no finite number, in words.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "seam/assembly/binding.hpp"

namespace seam {
namespace {

/// The first point, of `count`, at which one of `size` numbers is not finite; -1 if there is none.
int first_bad(const std::vector<double>& values, int count, std::size_t size) {
  for (int q = 0; q < count; ++q)
    for (std::size_t k = 0; k < size; ++k)
      if (!std::isfinite(values[static_cast<std::size_t>(q) * size + k])) return q;
  return -1;
}

}  // namespace

std::string ElementEvaluator::describe_not_finite(int index, const TimePoint& at) {
  compute(index, at, true);
  const auto finite = [](const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
  };
  if (finite(residual_) && finite(magnitude_) && (role_ == Role::sweep || finite(matrix_))) return "";
  for (const Compiled& term : terms_) {
    if (!term.bound.holds(element_)) continue;
    compute_inputs(term);
    if (moves_now_ && role_ == Role::integrate && term.signature->follows_motion) compute_input_change(term);
    evaluate(term, at, role_ != Role::sweep);
    if (std::string text = describe_not_finite(term); !text.empty()) return text;
  }
  return fmt::format(" the geometry of {}, cell {}, is not finite", domain_->description(),
                     element_.sides[0].global_cell);
}

/// Of the term that was evaluated last.
std::string ElementEvaluator::describe_not_finite(const Compiled& term) const {
  const int columns = term.columns + (moves_now_ && term.signature->follows_motion ? moves_ : 0);
  const auto inputs = static_cast<std::size_t>(term.inputs), outputs = static_cast<std::size_t>(term.outputs);
  const char* what = "is given";
  int point = first_bad(inputs_, element_.points, inputs);
  if (point < 0) {
    what = "gives";
    point = first_bad(point_residual_, element_.points, outputs);
  }
  if (point < 0 && role_ != Role::sweep) {
    what = "gives derivatives that are";
    point = first_bad(point_tangent_, element_.points, outputs * static_cast<std::size_t>(columns));
  }
  if (point < 0) return "";
  return fmt::format(" {} {} no finite number {}", describe(term.bound, *domain_), what, place_of(point));
}

std::string ElementEvaluator::place_of(int point) const {
  const double* x = &element_.sides[0].position[static_cast<std::size_t>(point) * dim_];
  return fmt::format("in cell {} at ({:.6g})", element_.sides[0].global_cell, fmt::join(x, x + dim_, ", "));
}

}  // namespace seam
