// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "seam/assembly/assembler.hpp"
#include "seam/field/field.hpp"
#include "seam/field/row_law.hpp"

namespace seam {

void Assembler::number_laws() {
  laws_.clear();
  is_unreached_.resize(blocks_.size());
  for (std::size_t number = 0; number < blocks_.size(); ++number) {
    const NumberedBlock& b = blocks_[number];
    for (const Unknown& unknown : b.field->unknowns()) {
      const Field::ComponentRange place = b.field->place(unknown.name);
      if (!unknown.law || &b.field->blocks()[place.block] != b.block) continue;
      for (int node = 0; node < b.block->space->owned_nodes(); ++node) {
        if (b.node_index[node] < 0) continue;
        const int first = graph_.node(b.node_index[node]).first + place.offset;
        const auto is_related = [&](int c) { return relation_[first + c] != is_free; };
        bool any = false;
        for (int c = 0; c < place.components; ++c) any = any || is_related(c);
        if (any) continue;
        const std::size_t state = static_cast<std::size_t>(node) * b.block->size + place.offset;
        laws_.push_back({unknown.law.get(), first, number, state,
                         b.block->boundaries ? b.block->surface_share[node] : 0.0});
      }
    }
  }
}

/// Rows that are functions of assembled rows, of which all is here now: they are local to their owner.
void Assembler::apply_laws(bool with_tangent) {
  std::vector<double> residual, by_value, by_assembled, row;
  for (const LawRows& rows : laws_) {
    if (const auto& unreached = is_unreached_[rows.block]; !unreached.empty() && unreached[rows.state] != 0)
      continue;
    const int n = rows.law->components();
    const double* value = &blocks_[rows.block].block->now.value[rows.state];
    residual.assign(n, 0.0);
    by_value.assign(static_cast<std::size_t>(n) * n, 0.0);
    by_assembled = by_value;
    rows.law->evaluate(value, &local_residual_[rows.first], rows.share, residual.data(), by_value.data(),
                       by_assembled.data());
    // Of what is `length` long and stands behind each other for each row.
    const auto combine = [&](double* first, std::size_t length, std::size_t stride, const auto& factor) {
      row.assign(n * length, 0.0);
      for (int c = 0; c < n; ++c)
        for (int k = 0; k < n; ++k)
          for (std::size_t i = 0; i < length; ++i)
            row[c * length + i] += factor(by_assembled[c * n + k]) * first[k * stride + i];
      for (int c = 0; c < n; ++c) std::copy_n(&row[c * length], length, first + c * stride);
    };
    const auto as_it_is = [](double factor) { return factor; };
    combine(&local_magnitude_[rows.first], 1, 1, [](double factor) { return std::abs(factor); });
    combine(&local_lift_[rows.first], 1, 1, as_it_is);
    for (int c = 0; c < n; ++c) {
      local_residual_[rows.first + c] = residual[c];
      for (int k = 0; k < n; ++k)
        local_magnitude_[rows.first + c] += std::abs(by_value[c * n + k] * value[k]);
    }
    if (!with_tangent) continue;
    const std::size_t start = matrix_.row_start[rows.first];
    const std::size_t length = matrix_.row_start[rows.first + 1] - start;
    combine(&matrix_.value.data[start], length, length, as_it_is);
    for (int c = 0; c < n; ++c)
      for (int k = 0; k < n; ++k) value_at(rows.first + c, rows.first + k) += by_value[c * n + k];
  }
}

/// Of the residual that was kept nothing is taken out of a law's rows.
void Assembler::meet_laws_as_they_are() {
  for (const LawRows& rows : laws_)
    std::fill_n(kept_residual_[rows.block].begin() + static_cast<std::ptrdiff_t>(rows.state),
                rows.law->components(), 0.0);
}

/// Unknowns of surfaces that no term speaks of now, as where nothing is opposite, are zero. Which these are
/// is seen in the matrix, whose rows they leave empty: when it is not asked for, they are those of the last
/// one.
void Assembler::hold_unreached(bool with_tangent) {
  // Functions that vanish on the part of a surface where terms act do so up to rounding.
  constexpr double rounding = 1e-13;
  for (std::size_t number = 0; number < blocks_.size(); ++number) {
    if (!blocks_[number].block->boundaries) continue;
    const Block& block = *blocks_[number].block;
    std::vector<char>& is_unreached = is_unreached_[number];
    is_unreached.resize(block.now.value.size(), 0);
    const auto for_each = [&](const auto& use) {
      for (int node = 0; node < block.space->owned_nodes(); ++node)
        for (int c = 0; c < block.size && blocks_[number].node_index[node] >= 0; ++c)
          use(static_cast<std::size_t>(node) * block.size + c,
              graph_.node(blocks_[number].node_index[node]).first + c);
    };
    if (with_tangent) {
      const auto largest_of = [&](int row) {
        double largest = 0;
        for (std::size_t k = matrix_.row_start[row]; k < matrix_.row_start[row + 1]; ++k)
          largest = std::max(largest, std::abs(matrix_.value[k]));
        return largest;
      };
      std::vector<double> largest(block.size, 0.0);
      for_each([&](std::size_t state, int row) {
        largest[state % block.size] = std::max(largest[state % block.size], largest_of(row));
      });
      communicator_.max(largest);
      for_each([&](std::size_t state, int row) {
        is_unreached[state] =
            relation_[row] == is_free && largest_of(row) <= rounding * largest[state % block.size];
      });
    }
    for_each([&](std::size_t state, int row) {
      if (is_unreached[state] == 0) return;
      local_residual_[row] = block.now.value[state];
      local_magnitude_[row] = std::abs(block.now.value[state]);
      local_lift_[row] = 0;
      if (!with_tangent) return;
      std::fill(matrix_.value.begin() + matrix_.row_start[row],
                matrix_.value.begin() + matrix_.row_start[row + 1], 0.0);
      value_at(row, row) = 1;
    });
  }
}

}  // namespace seam
