// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "seam/term/fad.hpp"
#include "seam/term/tensor.hpp"

namespace seam {

/// What becomes of the equations of an unknown: at each node a function of what all terms together have
/// assembled there and of the unknown itself, as of a multiplier and a gap of which one is zero. Its branches
/// are chosen anew in each iteration; nothing is remembered. Make one with make_row_law().
class RowLaw {
 public:
  virtual ~RowLaw() = default;
  /// Components of the unknown.
  [[nodiscard]] virtual int components() const = 0;
  /// @param value of the unknown at the node, [component]
  /// @param assembled residual there, [component]
  /// @param share of the boundaries on which the unknown lives that the node stands for, m^(d-1); 0 where it
  /// lives on all of the mesh
  /// @param residual instead of the assembled one, [component]
  /// @param by_value, by_assembled its derivatives, [component][component]
  virtual void evaluate(const double* value, const double* assembled, double share, double* residual,
                        double* by_value, double* by_assembled) const = 0;
};

/// The derivatives of a function of an unknown's components and of those of its residual.
/// @tparam Function `static constexpr int components` and a template `operator()` on the scalar T: from
/// `Vec<components, T> value, Vec<components, T> assembled, double share` to a `Vec<components, T>`
template <class Function>
class DifferentiatedRowLaw final : public RowLaw {
 public:
  explicit DifferentiatedRowLaw(Function function) : function_(std::move(function)) {}
  [[nodiscard]] int components() const override { return n; }
  void evaluate(const double* value, const double* assembled, double share, double* residual,
                double* by_value, double* by_assembled) const override {
    using T = Fad<2 * n>;
    Vec<n, T> unknown, row;
    for (int c = 0; c < n; ++c) {
      unknown[c] = T(value[c], c);
      row[c] = T(assembled[c], n + c);
    }
    const Vec<n, T> result = function_(unknown, row, share);
    for (int c = 0; c < n; ++c) {
      residual[c] = result[c].v;
      for (int k = 0; k < n; ++k) {
        by_value[c * n + k] = result[c].d[k];
        by_assembled[c * n + k] = result[c].d[n + k];
      }
    }
  }

 private:
  static constexpr int n = Function::components;
  Function function_;
};

template <class Function>
std::shared_ptr<const RowLaw> make_row_law(Function function) {
  return std::make_shared<DifferentiatedRowLaw<Function>>(std::move(function));
}

}  // namespace seam
