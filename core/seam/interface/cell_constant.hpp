// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace seam {

/// Points of a deformed cell, or of its faces, with what a local problem needs.
struct CellPoints {
  std::vector<double> weight;          ///< [point]; volume: reference, m^d; faces: current, m^(d-1)
  std::vector<double> shape_gradient;  ///< [point][node][dimension], reference configuration, 1/m
  std::vector<double> gradient;        ///< [point][dimension][dimension], of the displacement
  std::vector<double> normal;          ///< [point][dimension], current, out of the cell; faces only
  [[nodiscard]] int count() const { return static_cast<int>(weight.size()); }
};

/// A cell of a deforming body that meets an interface, with all of its faces on it.
struct CellTrace {
  int dimension = 2;
  int nodes = 0;                 ///< of the displacement
  std::vector<double> position;  ///< [node][dimension], current, m
  CellPoints volume, faces;
};

/// A number for each cell of a deforming body along an interface: prepared beforehand, read at the points of
/// coupling terms (Point::constant), not differentiated.
class CellConstant {
 public:
  virtual ~CellConstant() = default;
  /// Which deformation it is computed for.
  enum class Refresh {
    once,      ///< none
    step,      ///< that at the start of each time step
    iteration  ///< the present one
  };
  [[nodiscard]] virtual Refresh refresh() const = 0;
  [[nodiscard]] virtual double compute(const CellTrace& cell) const = 0;
};

}  // namespace seam
