// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace seam {

class Function;

/// A scalar function of position and time, written in the scene in muParser's syntax: `"0.002*(t - 1000)"`.
/// It may use x, y, z, t, pi and the scene's parameters (bare or as `${name}`). Or a component of a Function.
/// Cheap to copy. A copy shares the compiled expression, so one object must not be evaluated by two threads
/// at once.
class Expression {
 public:
  /// The constant 0.
  Expression() = default;
  explicit Expression(double constant) : value_(constant) {}
  /// @throws Error naming the text, the position in it and what is wrong.
  Expression(const std::string& text, const std::map<std::string, double>& parameters);
  /// One expression per component of a part of a function; at one point and time they share one evaluation.
  static std::vector<Expression> components(const std::shared_ptr<const Function>& function, int part);

  /// @param x position, `dim` entries (missing ones count as 0)
  double operator()(const double* x, int dim, double t) const;
  /// First and second derivative by time at a fixed place: those of the formula, or those that its Function
  /// gives. At a kink those of the past; no finite number where there is none.
  [[nodiscard]] std::array<double, 2> rates(const double* x, int dim, double t) const;
  /// True when the value depends on neither position nor time.
  [[nodiscard]] bool is_constant() const { return !compiled_; }
  /// True when the value is the constant 0: terms may leave it out.
  [[nodiscard]] bool is_zero() const { return !compiled_ && value_ == 0.0; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  struct Compiled;
  struct Formula;
  struct Component;
  std::shared_ptr<Compiled> compiled_;
  double value_ = 0.0;
  std::string text_ = "0";
};

/// Evaluates text that may use the scene's parameters but not x, y, z, t: `"1/16"`, `"2*E"`, `"${mu}"`.
/// @throws Error as Expression does.
double evaluate_constant(const std::string& text, const std::map<std::string, double>& parameters);

/// As evaluate_constant, of what is known by name at some time; the result may be infinite or no number, as a
/// ratio of things that are still zero is.
double evaluate_formula(const std::string& text, const std::map<std::string, double>& values);

/// True for names that mean something of their own in expressions (x, y, z, t, pi, sin, ...): no parameter
/// may take them.
bool is_reserved_in_expressions(const std::string& name);

}  // namespace seam
