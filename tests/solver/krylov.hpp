// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "seam/linear/krylov_solver.hpp"
#include "seam/plugin/registry.hpp"

namespace seam::test {

/// Divides by the diagonal; counts how often one was built.
class DiagonalInverse final : public BlockInverse {
 public:
  static inline int built = 0;
  void build(const Matrix& matrix, const EquationBlock& equations) override {
    ++built;
    diagonal_.assign(matrix.rows, 0.0);  // rows that are not named are not inverted
    for (const int r : equations.unknowns.at(0).rows)
      for (std::size_t k = matrix.row_start[r]; k < matrix.row_start[r + 1]; ++k)
        if (matrix.column[k] == r) diagonal_[r] = matrix.value[k];
  }
  void apply(std::span<const double> b, std::span<double> x) const override {
    for (std::size_t r = 0; r < b.size(); ++r) x[r] = b[r] / diagonal_[r];
  }

 private:
  std::vector<double> diagonal_;
};

struct KrylovOptions {
  double tolerance = 1e-12;
  double keep = 1.5;
  long fill = 1;
  std::vector<std::pair<std::string, std::string>> fields;  ///< inverses of single ones
};

/// @param preconditioner of all fields
inline KrylovSolver krylov(const std::string& preconditioner, const KrylovOptions& options = {}) {
  static const Registry registry = [] {
    Registry all;
    register_linear_solvers(all);
    all.add<BlockInverse>(
        "block_inverse", "diagonal", Schema("For tests."),
        [](const Parameters&, const Registry&) { return std::make_unique<DiagonalInverse>(); });
    return all;
  }();
  const auto inverse_of = [&](const std::string& type) {
    Parameters inverse;
    inverse.set_type(type);
    inverse.set("fill", {options.fill, {}, {}, true});
    return inverse;
  };
  std::vector<std::pair<std::string, Parameters>> fields;
  for (const auto& [field, type] : options.fields) fields.emplace_back(field, inverse_of(type));
  Parameters p;
  p.set("tolerance", {options.tolerance, {}, {}, true});
  p.set("maximum_iterations", {300L, {}, {}, true});
  p.set("restart", {100L, {}, {}, true});
  p.set("keep", {options.keep, {}, {}, true});
  p.set("preconditioner", {std::vector<Parameters>{inverse_of(preconditioner)}, {}, {}, true});
  p.set("fields", {fields, {}, {}, true});
  return {p, registry};
}

}  // namespace seam::test
