// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "seam/surface/surface.hpp"

namespace seam {

/// Finds the facets of a surface that lie opposite to points of another one, in logarithmic time.
class FacetSearch {
 public:
  explicit FacetSearch(Surface surface);
  ~FacetSearch();
  FacetSearch(FacetSearch&&) noexcept;
  FacetSearch& operator=(FacetSearch&&) noexcept;

  struct Hit {
    int facet;
    std::array<double, 2> on_facet;  ///< the facet's own coordinates: shares of its vertices 1 and 2
    double gap;                      ///< m, along the direction; negative behind the point
  };
  /// True where a facet is no partner of the point that asks.
  using Exclude = std::function<bool(int facet)>;
  /// Where the line through a point first meets a facet whose outside faces the direction, within 60 degrees:
  /// that with the gap of least size.
  /// @param x, direction [dimension]; the direction has length 1
  /// @param depth how far behind the point, m
  /// @param reach how far ahead of it, m
  [[nodiscard]] std::optional<Hit> find(const double* x, const double* direction, double depth, double reach,
                                        const Exclude& exclude = {}) const;
  /// Appends the facets whose boxes meet a box. @param low, high [3]
  /// @param direction which their outside faces; null: any
  void find_near(const double* low, const double* high, const double* direction,
                 std::vector<int>& facets) const;
  /// True where a point lies inside the surface and further than `margin`, m, from it: the first facet along
  /// a direction is met from within, in any direction if the surface is closed.
  [[nodiscard]] bool encloses(const double* x, const double* direction, double margin,
                              const Exclude& exclude = {}) const;
  [[nodiscard]] const Surface& surface() const { return surface_; }

 private:
  struct Tree;
  Surface surface_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace seam
