// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <compare>

namespace seam {

/// A number that changes with time: its value, its first and its second rate. Where functions have a kink,
/// all three are those of the past: jets compare as their numbers did just before.
struct Jet {
  double value = 0, rate = 0, second_rate = 0;

  /// f(a), from f and its first two derivatives at the value of a. What stands still has no rate, not even
  /// where f has no derivative.
  static Jet chain(const Jet& a, double f, double first, double second) {
    Jet result{f};
    if (a.rate != 0) {
      result.rate = first * a.rate;
      result.second_rate = second * a.rate * a.rate;
    }
    if (a.second_rate != 0) result.second_rate += first * a.second_rate;
    return result;
  }

  friend Jet operator+(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.rate + b.rate, a.second_rate + b.second_rate};
  }
  friend Jet operator-(const Jet& a) { return {-a.value, -a.rate, -a.second_rate}; }
  friend Jet operator-(const Jet& a, const Jet& b) { return a + -b; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate,
            a.second_rate * b.value + 2 * a.rate * b.rate + a.value * b.second_rate};
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double inverse = 1 / b.value;
    Jet result = a * chain(b, inverse, -inverse * inverse, 2 * inverse * inverse * inverse);
    result.value = a.value / b.value;
    return result;
  }
  /// As they were just before: what has grown to the same value was less.
  friend std::partial_ordering operator<=>(const Jet& a, const Jet& b) {
    if (a.value != b.value) return a.value <=> b.value;
    if (a.rate != b.rate) return b.rate <=> a.rate;
    return a.second_rate <=> b.second_rate;
  }
  friend bool operator==(const Jet& a, const Jet& b) { return (a <=> b) == 0; }
};

}  // namespace seam
