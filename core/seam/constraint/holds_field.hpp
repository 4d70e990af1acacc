// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace seam {

class Constraint;
class Field;

/// What a constraint may be, too: one that holds a field with forces that can be recorded.
class HoldsField {
 public:
  struct Force {
    std::string name;
    int components;
  };
  /// What is left of the equation of an unknown that this rank owns, by its local node: of one that is tied
  /// the force that holds it, without what others hand on to it.
  using Left = std::function<double(const Field& field, int block, int node, int component)>;

  virtual ~HoldsField() = default;
  [[nodiscard]] virtual const Field& held() const = 0;
  [[nodiscard]] virtual std::vector<Force> forces() const = 0;
  /// What it exerts on the field, with what the scene's constraints tied last. Collective.
  /// @param name of one of forces()
  /// @param all constraints of the scene: some may hand on to the field what holds others
  [[nodiscard]] virtual std::vector<double> force(const std::string& name, const Left& left,
                                                  const std::vector<const Constraint*>& all) const = 0;
};

}  // namespace seam
