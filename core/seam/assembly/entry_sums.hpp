// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace seam {

/// Sums of matrix entries at few rows and columns that are met many times, as those of what the nodes of an
/// element are tied to: to look each up in a sparse row of all that a body touches costs more than its terms.
class EntrySums {
 public:
  /// Forgets all. @param unknowns how many rows and columns there are
  void reset(std::size_t unknowns) {
    place_.assign(unknowns, -1);
    unknowns_.clear();
    std::fill(sum_.begin(), sum_.end(), 0.0);
  }

  void add(int row, int column, double entry) {
    const int i = place(row), j = place(column);
    sum_[static_cast<std::size_t>(i) * width_ + j] += entry;
  }

  /// Hands on all sums that are not zero, and forgets them.
  /// @param use (row, column, sum)
  template <class Use>
  void take(const Use& use) {
    const int n = static_cast<int>(unknowns_.size());
    for (int i = 0; i < n; ++i) {
      double* row = &sum_[static_cast<std::size_t>(i) * width_];
      for (int j = 0; j < n; ++j)
        if (row[j] != 0) use(unknowns_[i], unknowns_[j], row[j]);
      std::fill_n(row, n, 0.0);
    }
    for (const int unknown : unknowns_) place_[unknown] = -1;
    unknowns_.clear();
  }

 private:
  int place(int unknown) {
    int& place = place_[unknown];
    if (place < 0) {
      place = static_cast<int>(unknowns_.size());
      unknowns_.push_back(unknown);
      if (place >= width_) widen();
    }
    return place;
  }

  void widen() {
    const int wider = std::max(64, 2 * width_);
    std::vector<double> sum(static_cast<std::size_t>(wider) * wider, 0.0);
    for (int i = 0; i < width_; ++i)
      std::copy_n(&sum_[static_cast<std::size_t>(i) * width_], width_,
                  &sum[static_cast<std::size_t>(i) * wider]);
    sum_.swap(sum);
    width_ = wider;
  }

  std::vector<int> place_;     ///< [unknown], -1: not met
  std::vector<int> unknowns_;  ///< [place]
  std::vector<double> sum_;    ///< [place of row][place of column], `width_` a row
  int width_ = 0;
};

}  // namespace seam
