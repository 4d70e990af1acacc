// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <type_traits>

namespace seam {

/// A number that carries its derivatives with respect to n inputs (forward mode). Nests: Fad<n, Fad<m>> holds
/// second derivatives. Plain loops over a fixed array vectorise; see docs/decisions for the measurement
/// against a library type.
template <int n, class T = double>
struct Fad {
  T v{};
  T d[n];

  Fad() : Fad(T(0.0)) {}
  // Numbers convert silently, so that kernels read like formulas.
  Fad(const T& value) : v(value) {
    for (int i = 0; i < n; ++i) d[i] = T(0.0);
  }
  template <class S>
  requires(std::is_arithmetic_v<S> && !std::is_same_v<S, T>) Fad(S value)
      : Fad(T(static_cast<double>(value))) {}
  /// Input number i.
  Fad(const T& value, int i) : Fad(value) { d[i] = T(1.0); }

  Fad& operator+=(const Fad& o) {
    v += o.v;
    for (int i = 0; i < n; ++i) d[i] += o.d[i];
    return *this;
  }
  Fad& operator-=(const Fad& o) {
    v -= o.v;
    for (int i = 0; i < n; ++i) d[i] -= o.d[i];
    return *this;
  }
  Fad& operator*=(const Fad& o) { return *this = *this * o; }
  Fad& operator/=(const Fad& o) { return *this = *this / o; }

  friend Fad operator-(const Fad& a) { return chain(a, -a.v, T(-1.0)); }
  friend Fad operator+(Fad a, const Fad& b) { return a += b; }
  friend Fad operator-(Fad a, const Fad& b) { return a -= b; }
  friend Fad operator*(const Fad& a, const Fad& b) {
    Fad r(Raw{});
    r.v = a.v * b.v;
    for (int i = 0; i < n; ++i) r.d[i] = a.v * b.d[i] + b.v * a.d[i];
    return r;
  }
  friend Fad operator/(const Fad& a, const Fad& b) {
    const T inverse = T(1.0) / b.v;
    Fad r(Raw{});
    r.v = a.v * inverse;
    for (int i = 0; i < n; ++i) r.d[i] = (a.d[i] - r.v * b.d[i]) * inverse;
    return r;
  }
  friend Fad operator+(double a, Fad b) { return b.v += a, b; }
  friend Fad operator+(Fad a, double b) { return a.v += b, a; }
  friend Fad operator-(Fad a, double b) { return a.v -= b, a; }
  friend Fad operator-(double a, const Fad& b) { return chain(b, a - b.v, T(-1.0)); }
  friend Fad operator*(double a, const Fad& b) { return chain(b, a * b.v, T(a)); }
  friend Fad operator*(const Fad& a, double b) { return chain(a, a.v * b, T(b)); }
  friend Fad operator/(const Fad& a, double b) { return a * (1.0 / b); }
  friend Fad operator/(double a, const Fad& b) {
    const T value = a / b.v;
    return chain(b, value, -value / b.v);
  }

  friend bool operator<(const Fad& a, const Fad& b) { return a.v < b.v; }
  friend bool operator>(const Fad& a, const Fad& b) { return b.v < a.v; }
  friend bool operator<=(const Fad& a, const Fad& b) { return !(b.v < a.v); }
  friend bool operator>=(const Fad& a, const Fad& b) { return !(a.v < b.v); }

  friend Fad sqrt(const Fad& a) {
    using std::sqrt;
    const T value = sqrt(a.v);
    return chain(a, value, 0.5 / value);
  }
  friend Fad exp(const Fad& a) {
    using std::exp;
    const T value = exp(a.v);
    return chain(a, value, value);
  }
  friend Fad expm1(const Fad& a) {
    using std::exp, std::expm1;
    return chain(a, expm1(a.v), exp(a.v));
  }
  friend Fad log(const Fad& a) {
    using std::log;
    return chain(a, log(a.v), 1.0 / a.v);
  }
  friend Fad sin(const Fad& a) {
    using std::cos, std::sin;
    return chain(a, sin(a.v), cos(a.v));
  }
  friend Fad cos(const Fad& a) {
    using std::cos, std::sin;
    return chain(a, cos(a.v), -sin(a.v));
  }
  friend Fad tan(const Fad& a) {
    using std::tan;
    const T value = tan(a.v);
    return chain(a, value, 1.0 + value * value);
  }
  friend Fad asin(const Fad& a) {
    using std::asin, std::sqrt;
    return chain(a, asin(a.v), 1.0 / sqrt(1.0 - a.v * a.v));
  }
  friend Fad acos(const Fad& a) {
    using std::acos, std::sqrt;
    return chain(a, acos(a.v), -1.0 / sqrt(1.0 - a.v * a.v));
  }
  friend Fad atan(const Fad& a) {
    using std::atan;
    return chain(a, atan(a.v), 1.0 / (1.0 + a.v * a.v));
  }
  friend Fad sinh(const Fad& a) {
    using std::cosh, std::sinh;
    return chain(a, sinh(a.v), cosh(a.v));
  }
  friend Fad cosh(const Fad& a) {
    using std::cosh, std::sinh;
    return chain(a, cosh(a.v), sinh(a.v));
  }
  friend Fad tanh(const Fad& a) {
    using std::tanh;
    const T value = tanh(a.v);
    return chain(a, value, 1.0 - value * value);
  }
  friend Fad asinh(const Fad& a) {
    using std::asinh, std::sqrt;
    return chain(a, asinh(a.v), 1.0 / sqrt(1.0 + a.v * a.v));
  }
  friend Fad acosh(const Fad& a) {
    using std::acosh, std::sqrt;
    return chain(a, acosh(a.v), 1.0 / sqrt(a.v * a.v - 1.0));
  }
  friend Fad atanh(const Fad& a) {
    using std::atanh;
    return chain(a, atanh(a.v), 1.0 / (1.0 - a.v * a.v));
  }
  friend Fad erf(const Fad& a) {
    using std::erf, std::exp;
    constexpr double two_over_root_pi = 1.1283791670955126;
    return chain(a, erf(a.v), two_over_root_pi * exp(-a.v * a.v));
  }
  friend Fad log1p(const Fad& a) {
    using std::log1p;
    return chain(a, log1p(a.v), 1.0 / (1.0 + a.v));
  }
  friend Fad cbrt(const Fad& a) {
    using std::cbrt;
    const T value = cbrt(a.v);
    return chain(a, value, 1.0 / (3.0 * value * value));
  }
  friend Fad atan2(const Fad& y, const Fad& x) {
    using std::atan2;
    const T square = x.v * x.v + y.v * y.v;
    Fad r(Raw{});
    r.v = atan2(y.v, x.v);
    for (int i = 0; i < n; ++i) r.d[i] = (x.v * y.d[i] - y.v * x.d[i]) / square;
    return r;
  }
  friend Fad pow(const Fad& a, double exponent) {
    using std::pow;
    const T value = pow(a.v, exponent);
    // One call instead of two, except where it would be 0/0.
    if (is_zero(a.v)) return chain(a, value, exponent * pow(a.v, exponent - 1));
    return chain(a, value, exponent * value / a.v);
  }
  /// Of a positive number.
  friend Fad pow(const Fad& a, const Fad& exponent) {
    using std::log, std::pow;
    const T value = pow(a.v, exponent.v), by_base = exponent.v * value / a.v, by_exponent = log(a.v) * value;
    Fad r(Raw{});
    r.v = value;
    for (int i = 0; i < n; ++i) r.d[i] = by_base * a.d[i] + by_exponent * exponent.d[i];
    return r;
  }
  friend Fad pow(double a, const Fad& exponent) {
    using std::log, std::pow;
    const T value = pow(a, exponent.v);
    return chain(exponent, value, std::log(a) * value);
  }
  friend Fad abs(const Fad& a) { return a.v < T(0.0) ? -a : a; }
  friend Fad max(const Fad& a, const Fad& b) { return a.v < b.v ? b : a; }
  friend Fad min(const Fad& a, const Fad& b) { return b.v < a.v ? b : a; }

 private:
  struct Raw {};
  static bool is_zero(const T& t) { return !(t < T(0.0)) && !(T(0.0) < t); }
  explicit Fad(Raw) {}
  /// f(a), given its value and slope.
  static Fad chain(const Fad& a, const T& value, const T& slope) {
    Fad r(Raw{});
    r.v = value;
    for (int i = 0; i < n; ++i) r.d[i] = slope * a.d[i];
    return r;
  }
};

/// How often differentiation types are nested: 0 for a plain number, 1 for Fad<n>, 2 for Fad<n, Fad<m>>.
template <class T>
inline constexpr int derivative_depth = 0;
template <int n, class T>
inline constexpr int derivative_depth<Fad<n, T>> = 1 + derivative_depth<T>;

/// The one or the other, in the manner of `condition ? yes : no` for numbers of any kind.
template <class T>
T select(bool condition, const T& yes, const T& no) {
  return condition ? yes : no;
}

/// True when the number is zero and so are all its derivatives.
inline bool vanishes(double v) { return v == 0; }
template <int n, class T>
bool vanishes(const Fad<n, T>& a) {
  if (!vanishes(a.v)) return false;
  for (int i = 0; i < n; ++i)
    if (!vanishes(a.d[i])) return false;
  return true;
}

/// The plain value behind any scalar type.
inline double plain(double v) { return v; }
template <int n, class T>
double plain(const Fad<n, T>& a) {
  return plain(a.v);
}

/// Whether the number is none, or one of its derivatives.
inline bool isnan(double v) { return std::isnan(v); }
template <int n, class T>
bool isnan(const Fad<n, T>& a) {
  if (isnan(a.v)) return true;
  for (int i = 0; i < n; ++i)
    if (isnan(a.d[i])) return true;
  return false;
}
/// sqrt(x) with derivatives 0 where x is 0, and the true ones are infinite.
inline double safe_sqrt(double x) { return std::sqrt(x); }
template <int n, class T>
Fad<n, T> safe_sqrt(const Fad<n, T>& x) {
  return plain(x) == 0 ? Fad<n, T>(0.0) : sqrt(x);
}

}  // namespace seam
