// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace seam {

/// Known functions of position and time that belong together, such as the fields of an exact solution. A type
/// of kind "function": a scene names it in its block `functions`, and expressions use its parts by name,
/// `exact.velocity`.
class Function {
 public:
  virtual ~Function() = default;
  struct Member {
    std::string name;
    int components;  ///< a tensor row by row: the derivative's direction runs fastest
  };
  [[nodiscard]] virtual const std::vector<Member>& members() const = 0;
  /// @param part index into members()
  /// @param x position, [dimension of the scene]
  /// @param value [components]
  virtual void evaluate(int part, const double* x, double t, double* value) const = 0;
  /// First and second derivative by time at a fixed place, at a kink those of the past; no finite number
  /// where there is none. What is prescribed moves by them. Unless a function knows better they come from its
  /// values at some 300 times before, to about 1e-11 and 1e-8 of their size over the time in which it
  /// changes.
  /// @param rate, second_rate [components]
  virtual void rates(int part, const double* x, double t, double* rate, double* second_rate) const;
};

}  // namespace seam
