// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include "seam/term/term.hpp"

namespace seam {

/// The unknown itself (or its gradient) as a quantity of any number of components.
class UnknownQuantity final : public Term {
 public:
  UnknownQuantity(int components, Shape shape, int dimension)
      : size_(components * rows(shape, dimension)),
        signature_{{components}, {Slot{0, shape, Level::now}}, {}, {}, size_} {}
  [[nodiscard]] const Signature& signature(int) const override { return signature_; }
  void evaluate(const PointBatch& points, double* values, double*) const override {
    std::copy_n(points.inputs, static_cast<std::ptrdiff_t>(points.count) * size_, values);
  }

 private:
  int size_;
  Signature signature_;
};

}  // namespace seam
