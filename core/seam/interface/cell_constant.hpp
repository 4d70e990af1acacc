// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "seam/assembly/remote_cells.hpp"
#include "seam/field/field.hpp"

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

/// The constants of the cells along one interface. Computed when they are asked for: each rank knows the
/// cells it meets.
class CellConstants {
 public:
  /// @param displacement of the body
  CellConstants(const Field& body, Field::ComponentRange displacement) : body_(&body), place_(displacement) {}
  /// @param region the one in whose cells it is read; elsewhere it is 0
  /// @return its number
  int add(std::shared_ptr<const CellConstant> constant, int region);
  [[nodiscard]] int count() const { return static_cast<int>(constants_.size()); }
  /// Those of this policy are computed anew.
  void forget(CellConstant::Refresh policy);
  /// @param number of the constant
  /// @param index of the cell among those of the interface
  /// @param faces all local faces of the cell on the interface
  double value(int number, int index, const RemoteCell& cell, const std::vector<int>& faces);

 private:
  [[nodiscard]] CellTrace trace(const RemoteCell& cell, const std::vector<int>& faces,
                                CellConstant::Refresh policy) const;
  struct Request {
    std::shared_ptr<const CellConstant> constant;
    int region;
    std::vector<double> value;  ///< [cell]
    std::vector<char> known;
  };
  const Field* body_;
  Field::ComponentRange place_;
  std::vector<Request> constants_;
};

}  // namespace seam
