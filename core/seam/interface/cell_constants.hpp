// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "seam/field/field.hpp"
#include "seam/interface/cell_constant.hpp"

namespace seam {

struct RemoteCell;

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
