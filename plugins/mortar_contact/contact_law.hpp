// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "seam/field/row_law.hpp"

namespace seam::mortar {

/// What pressure and gap have to do with each other at a node of a surface: the kind "contact_law". Make one
/// with make_contact_law().
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;
  /// Of the pressure's equations, which terms make up as minus the weighted gap.
  /// @param stiffness Pa/m, of gaps beside pressures; read when rows are evaluated
  [[nodiscard]] virtual std::shared_ptr<const RowLaw> rows(std::shared_ptr<const double> stiffness) const = 0;
};

/// A law that is written once, as a template on the scalar.
/// @tparam Function `template <class T> T operator()(const T& pressure, const T& gap, double stiffness)
/// const`: from the pressure, Pa, and the mean gap, m, at a node to a length that is zero where the law is
/// met. `stiffness`, Pa/m, lets one be compared with the other, and answers must not depend on it
template <class Function>
class ContactLawOf final : public ContactLaw {
 public:
  explicit ContactLawOf(Function function) : function_(std::move(function)) {}
  [[nodiscard]] std::shared_ptr<const RowLaw> rows(std::shared_ptr<const double> stiffness) const override {
    return make_row_law(AtNode{function_, std::move(stiffness)});
  }

 private:
  struct AtNode {
    static constexpr int components = 1;
    Function function;
    std::shared_ptr<const double> stiffness;
    template <class T>
    Vec<1, T> operator()(const Vec<1, T>& pressure, const Vec<1, T>& row, double area) const {
      const T gap = (-1 / area) * row[0];
      return {{-area * function(pressure[0], gap, *stiffness)}};
    }
  };
  Function function_;
};

template <class Function>
std::unique_ptr<ContactLaw> make_contact_law(Function function) {
  return std::make_unique<ContactLawOf<Function>>(std::move(function));
}

}  // namespace seam::mortar
