// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "seam/term/fad.hpp"
#include "seam/term/tensor.hpp"

/// Functions of symmetric tensors, with exact derivatives of any order, also where eigenvalues coincide.
namespace seam {

/// Eigenvalues in rising order and eigenvectors of a symmetric tensor, n = 2 or 3.
/// @param a [n][n], of which the lower half is read @param values [n]
/// @param vectors [n][n], one in each column
void symmetric_eigen(int n, const double* a, double* values, double* vectors);

namespace detail {

template <class F>
double derivative(const F& f, double x, std::integral_constant<int, 0>) {
  return f(x);
}
/// The m-th derivative of a function that is written for any scalar type.
template <class F, int m>
double derivative(const F& f, double x, std::integral_constant<int, m>) {
  return derivative([&](const auto& at) { return f(Fad<1, std::decay_t<decltype(at)>>(at, 0)).d[0]; }, x,
                    std::integral_constant<int, m - 1>{});
}

/// Mean of f over the simplex of m + 1 numbers, times its volume 1/m!: product rule of Gauss and Jacobi
/// made of Gauss' rule in the variables of Duffy.
template <int m, class F>
double over_simplex(const F& f, const double* x) {
  static constexpr std::array<double, 5> at{0.04691007703066800, 0.23076534494715845, 0.5,
                                            0.76923465505284155, 0.95308992296933200};
  static constexpr std::array<double, 5> weight{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                                0.23931433524968324, 0.11846344252809454};
  if constexpr (m == 0) {
    return f(x[0]);
  } else {
    double sum = 0;
    for (int k = 0; k < 5; ++k) {
      // x[0] with the part 1 - t, the others with t.
      const double t = at[k];
      const auto with_first = [&](double others) { return f((1 - t) * x[0] + t * others); };
      sum += weight[k] * std::pow(t, m - 1) * over_simplex<m - 1>(with_first, x + 1);
    }
    return sum;
  }
}

/// The divided difference f[x_0, ..., x_m], also of numbers that are close to each other: there the mean of
/// the derivative (Hermite and Genocchi).
template <int m, class F>
double divided_difference(const F& f, std::array<double, m + 1> x) {
  if constexpr (m == 0) {
    return f(x[0]);
  } else {
    std::sort(x.begin(), x.end());
    const double spread = x[m] - x[0], size = std::max(std::abs(x[0]), std::abs(x[m]));
    if (spread > 0.1 * size) {
      std::array<double, m> left, right;
      std::copy_n(x.begin(), m, left.begin());
      std::copy_n(x.begin() + 1, m, right.begin());
      return (divided_difference<m - 1>(f, right) - divided_difference<m - 1>(f, left)) / spread;
    }
    const auto slope = [&](double at) { return derivative(f, at, std::integral_constant<int, m>{}); };
    if (spread <= 1e-8 * size) return slope(x[0]) / (m == 3 ? 6 : m);
    return over_simplex<m>(slope, x.data());
  }
}

/// A symmetric tensor in the axes of the plain numbers' eigenvectors: there its plain part is diagonal, and
/// what is left of it holds derivatives alone, so that series in it end with their order.
template <int n, class T>
struct InOwnAxes {
  std::array<double, n> value;  ///< eigenvalues of the plain part
  Mat<n, n, double> axes;       ///< one in each column
  Mat<n, n, T> rest;            ///< without plain part

  explicit InOwnAxes(const Mat<n, n, T>& a) {
    Mat<n, n, double> numbers;
    for (int i = 0; i < n * n; ++i) numbers.c[i] = plain(a.c[i]);
    symmetric_eigen(n, numbers.c.data(), value.data(), axes.c.data());
    rest = transpose(axes) * (a * axes);
    for (int i = 0; i < n; ++i) rest(i, i) -= value[i];
  }
};

}  // namespace detail

/// f(a) of a symmetric tensor: the tensor with the same eigenvectors, and f of the eigenvalues (series of
/// Daleckii and Krein 1965).
/// @param f of one number, for any scalar type: `[](const auto& x) { using std::log; return log(x); }`
template <int n, class T, class F>
Mat<n, n, T> isotropic_function(const Mat<n, n, T>& a, const F& f) {
  constexpr int depth = derivative_depth<T>;
  static_assert(depth <= 3, "tensor functions have derivatives up to the third");
  const detail::InOwnAxes<n, T> own(a);
  const auto& x = own.value;
  const auto& e = own.rest;
  Mat<n, n, T> r;
  for (int i = 0; i < n; ++i) {
    r(i, i) += f(x[i]);
    if constexpr (depth > 0)
      for (int j = 0; j < n; ++j) r(i, j) += detail::divided_difference<1>(f, {x[i], x[j]}) * e(i, j);
    if constexpr (depth > 1)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k)
          r(i, j) += detail::divided_difference<2>(f, {x[i], x[k], x[j]}) * (e(i, k) * e(k, j));
    if constexpr (depth > 2)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k)
          for (int l = 0; l < n; ++l)
            r(i, j) +=
                detail::divided_difference<3>(f, {x[i], x[k], x[l], x[j]}) * (e(i, k) * (e(k, l) * e(l, j)));
  }
  return own.axes * (r * transpose(own.axes));
}

template <int n, class T>
Mat<n, n, T> exponential(const Mat<n, n, T>& a) {
  return isotropic_function(a, [](const auto& x) {
    using std::exp;
    return exp(x);
  });
}
/// Of a positive definite tensor.
template <int n, class T>
Mat<n, n, T> logarithm(const Mat<n, n, T>& a) {
  return isotropic_function(a, [](const auto& x) {
    using std::log;
    return log(x);
  });
}
/// Of a positive definite tensor: with 1/2 its square root.
template <int n, class T>
Mat<n, n, T> power(const Mat<n, n, T>& a, double exponent) {
  return isotropic_function(a, [exponent](const auto& x) {
    using std::pow;
    return pow(x, exponent);
  });
}

/// Eigenvalues in rising order. Where they coincide each by itself has no derivative: first derivatives are
/// those of one direction, and second ones leave out how they part; take functions of the tensor there.
template <int n, class T>
Vec<n, T> eigenvalues(const Mat<n, n, T>& a) {
  constexpr int depth = derivative_depth<T>;
  static_assert(depth <= 2, "eigenvalues have derivatives up to the second");
  const detail::InOwnAxes<n, T> own(a);
  Vec<n, T> r;
  for (int i = 0; i < n; ++i) {
    r[i] = own.rest(i, i) + own.value[i];
    for (int j = 0; j < n && depth > 1; ++j)
      if (const double gap = own.value[i] - own.value[j]; gap != 0)
        r[i] += (1 / gap) * (own.rest(i, j) * own.rest(j, i));
  }
  return r;
}

}  // namespace seam
