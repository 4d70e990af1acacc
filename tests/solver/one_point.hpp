// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/term/term.hpp"

namespace seam::test {

/// What a term or a quantity gives at a single point for what it reads, slot by slot.
/// @param size of what it gives
template <class Evaluated>
std::vector<double> at_one_point(const Evaluated& evaluated, int dim, const std::vector<double>& inputs,
                                 std::size_t size, const std::vector<double>& normal = {},
                                 double trace_size = 0.3) {
  const double position[3] = {0.3, -0.4, 0.7}, cell_size = 0.3;
  const double factors[3][3] = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  PointBatch batch;
  batch.dimension = dim;
  batch.count = 1;
  batch.position = position;
  batch.normal = normal.empty() ? nullptr : normal.data();
  batch.cell_size = &cell_size;
  batch.trace_size = &trace_size;
  batch.inputs = inputs.data();
  batch.level_factor = factors;
  std::vector<double> result(size);
  evaluated.evaluate(batch, result.data(), nullptr);
  return result;
}

inline std::vector<double> residual(const Term& term, int dim, const std::vector<double>& inputs,
                                    const std::vector<double>& normal = {}, double trace_size = 0.3) {
  return at_one_point(term, dim, inputs, term.signature(dim).output_size(dim), normal, trace_size);
}

}  // namespace seam::test
