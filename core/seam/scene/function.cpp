// SPDX-License-Identifier: BSD-3-Clause
#include "seam/scene/function.hpp"

#include <array>
#include <cstddef>

#include "seam/base/rates.hpp"

namespace seam {

void Function::rates(int part, const double* x, double t, double* rate, double* second_rate) const {
  const auto components = static_cast<std::size_t>(members().at(static_cast<std::size_t>(part)).components);
  std::vector<double> value(components);
  for (std::size_t c = 0; c < components; ++c) {
    const std::array<double, 2> both = rates_of(
        [&](double time) {
          evaluate(part, x, time, value.data());
          return value[c];
        },
        t);
    rate[c] = both[0];
    second_rate[c] = both[1];
  }
}

}  // namespace seam
