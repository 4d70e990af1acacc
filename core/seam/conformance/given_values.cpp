// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/given_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "seam/base/rates.hpp"
#include "seam/field/field.hpp"

namespace seam {
namespace {

/// Largest error of a rate of each order, and largest rate of it by differences.
struct Comparison {
  std::array<double, 2> error{}, size{};

  void add(const Expression& expression, const double* x, int dim, double time) {
    const auto said = expression.rates(x, dim, time);
    const auto found = rates_of([&](double t) { return expression(x, dim, t); }, time);
    for (std::size_t k = 0; k < 2; ++k) {
      if (!std::isfinite(said[k]) || !std::isfinite(found[k])) continue;
      error[k] = std::max(error[k], std::abs(said[k] - found[k]));
      size[k] = std::max({size[k], std::abs(found[k]), std::abs(expression(x, dim, time))});
    }
  }
};

}  // namespace

std::vector<ConformanceCheck> check_given_values(const Problem& problem, double time) {
  constexpr std::array<double, 2> acceptable{1e-6, 1e-4};  // what differences can tell
  constexpr std::size_t enough_nodes = 20;
  std::string wrong;
  std::size_t count = 0;
  for (const FieldEntry& entry : problem.fields()) {
    for (const PrescribedCondition& condition : entry.conditions) {
      const Block& block = entry.field->blocks()[condition.block];
      if (condition.value.is_constant() || block.time_order[condition.component] == 0) continue;
      Comparison of;
      for (std::size_t k = 0; k < std::min(condition.nodes.size(), enough_nodes); ++k)
        of.add(condition.value, block.space->position(condition.nodes[k]), entry.mesh->dimension(), time);
      ++count;
      for (std::size_t k = 0; k < 2; ++k)
        if (of.error[k] > acceptable[k] * of.size[k] && wrong.empty())
          wrong = fmt::format(
              "derivative {} by time of `{}`, given for '{}' of field '{}', is off by {:.2e} of {:.2e}",
              k + 1, condition.value.text(), condition.unknown, entry.name, of.error[k], of.size[k]);
    }
  }
  if (count == 0) return {};
  return {conformance_check("given values: rates are those of the values", wrong.empty(),
                            wrong.empty() ? fmt::format("{} of {}", count, count) : wrong)};
}

}  // namespace seam
