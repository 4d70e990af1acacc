// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/term/term.hpp"

namespace seam::test {

/// What a term gives at a single point for what it reads, slot by slot.
inline std::vector<double> residual(const Term& term, int dim, const std::vector<double>& inputs,
                                    const std::vector<double>& normal = {}, double trace_size = 0.3) {
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
  std::vector<double> result(term.signature(dim).output_size(dim));
  term.evaluate(batch, result.data(), nullptr);
  return result;
}

}  // namespace seam::test
