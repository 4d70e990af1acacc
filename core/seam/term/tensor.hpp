// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "seam/term/fad.hpp"

namespace seam {

/// A vector of `n` scalars of type T (double or an automatic differentiation type).
template <int n, class T>
struct Vec {
  std::array<T, n> c{};

  T& operator[](int i) { return c[i]; }
  const T& operator[](int i) const { return c[i]; }
  template <class S>
  Vec& operator+=(const Vec<n, S>& o) {
    for (int i = 0; i < n; ++i) c[i] += o[i];
    return *this;
  }
  template <class S>
  Vec& operator-=(const Vec<n, S>& o) {
    for (int i = 0; i < n; ++i) c[i] -= o[i];
    return *this;
  }
};

/// A second-order tensor, `rows` x `columns`; a gradient has the derivative's direction as column.
template <int rows, int columns, class T>
struct Mat {
  std::array<T, rows * columns> c{};

  T& operator()(int i, int j) { return c[i * columns + j]; }
  const T& operator()(int i, int j) const { return c[i * columns + j]; }
  template <class S>
  Mat& operator+=(const Mat<rows, columns, S>& o) {
    for (int i = 0; i < rows * columns; ++i) c[i] += o.c[i];
    return *this;
  }
  template <class S>
  Mat& operator-=(const Mat<rows, columns, S>& o) {
    for (int i = 0; i < rows * columns; ++i) c[i] -= o.c[i];
    return *this;
  }
};

/// The scalar type of a sum or product. Materialised, so that no expression template of an AD type outlives
/// its operands.
template <class A, class B>
struct Promote {
  using type = A;
};
template <class B>
requires(!std::is_same_v<B, double>) struct Promote<double, B> {
  using type = B;
};
template <class A, class B>
using promote = typename Promote<A, B>::type;

template <int n, class A, class B>
Vec<n, promote<A, B>> operator+(const Vec<n, A>& a, const Vec<n, B>& b) {
  Vec<n, promote<A, B>> r;
  for (int i = 0; i < n; ++i) r[i] = a[i] + b[i];
  return r;
}
template <int n, class A, class B>
Vec<n, promote<A, B>> operator-(const Vec<n, A>& a, const Vec<n, B>& b) {
  Vec<n, promote<A, B>> r;
  for (int i = 0; i < n; ++i) r[i] = a[i] - b[i];
  return r;
}
template <int n, class T>
Vec<n, T> operator-(const Vec<n, T>& a) {
  Vec<n, T> r;
  for (int i = 0; i < n; ++i) r[i] = -a[i];
  return r;
}
template <int n, class S, class T>
Vec<n, promote<S, T>> operator*(const S& s, const Vec<n, T>& a) {
  Vec<n, promote<S, T>> r;
  for (int i = 0; i < n; ++i) r[i] = s * a[i];
  return r;
}
/// A number, of any scalar type.
template <class S>
concept IsScalar = !requires(const S& s) {
  s.c;
};
template <int n, class S, class T>
requires IsScalar<S> Vec<n, promote<S, T>>
operator*(const Vec<n, T>& a, const S& s) { return s * a; }
template <int n, class S, class T>
requires IsScalar<S> Vec<n, promote<S, T>>
operator/(const Vec<n, T>& a, const S& s) { return (1.0 / s) * a; }
template <int n, class A, class B>
promote<A, B> dot(const Vec<n, A>& a, const Vec<n, B>& b) {
  promote<A, B> r = a[0] * b[0];
  for (int i = 1; i < n; ++i) r += a[i] * b[i];
  return r;
}

template <class A, class B>
Vec<3, promote<A, B>> cross(const Vec<3, A>& a, const Vec<3, B>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

template <int m, int n, class A, class B>
Mat<m, n, promote<A, B>> operator+(const Mat<m, n, A>& a, const Mat<m, n, B>& b) {
  Mat<m, n, promote<A, B>> r;
  for (int i = 0; i < m * n; ++i) r.c[i] = a.c[i] + b.c[i];
  return r;
}
template <int m, int n, class A, class B>
Mat<m, n, promote<A, B>> operator-(const Mat<m, n, A>& a, const Mat<m, n, B>& b) {
  Mat<m, n, promote<A, B>> r;
  for (int i = 0; i < m * n; ++i) r.c[i] = a.c[i] - b.c[i];
  return r;
}
template <int m, int n, class S, class T>
Mat<m, n, promote<S, T>> operator*(const S& s, const Mat<m, n, T>& a) {
  Mat<m, n, promote<S, T>> r;
  for (int i = 0; i < m * n; ++i) r.c[i] = s * a.c[i];
  return r;
}
template <int m, int n, class S, class T>
requires IsScalar<S> Mat<m, n, promote<S, T>>
operator*(const Mat<m, n, T>& a, const S& s) { return s * a; }
template <int m, int n, class S, class T>
requires IsScalar<S> Mat<m, n, promote<S, T>>
operator/(const Mat<m, n, T>& a, const S& s) { return (1.0 / s) * a; }
template <int m, int k, int n, class A, class B>
Mat<m, n, promote<A, B>> operator*(const Mat<m, k, A>& a, const Mat<k, n, B>& b) {
  Mat<m, n, promote<A, B>> r;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      r(i, j) = a(i, 0) * b(0, j);
      for (int l = 1; l < k; ++l) r(i, j) += a(i, l) * b(l, j);
    }
  return r;
}
template <int m, int n, class A, class B>
Vec<m, promote<A, B>> operator*(const Mat<m, n, A>& a, const Vec<n, B>& b) {
  Vec<m, promote<A, B>> r;
  for (int i = 0; i < m; ++i) {
    r[i] = a(i, 0) * b[0];
    for (int j = 1; j < n; ++j) r[i] += a(i, j) * b[j];
  }
  return r;
}

template <int n>
Mat<n, n, double> identity() {
  Mat<n, n, double> r;
  for (int i = 0; i < n; ++i) r(i, i) = 1.0;
  return r;
}
template <int m, int n, class T>
Mat<n, m, T> transpose(const Mat<m, n, T>& a) {
  Mat<n, m, T> r;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) r(j, i) = a(i, j);
  return r;
}
template <int n, class T>
T trace(const Mat<n, n, T>& a) {
  T r = a(0, 0);
  for (int i = 1; i < n; ++i) r += a(i, i);
  return r;
}
template <int n, class T>
Mat<n, n, T> sym(const Mat<n, n, T>& a) {
  Mat<n, n, T> r;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) r(i, j) = 0.5 * (a(i, j) + a(j, i));
  return r;
}
/// The double contraction a : b.
template <int m, int n, class A, class B>
promote<A, B> inner(const Mat<m, n, A>& a, const Mat<m, n, B>& b) {
  promote<A, B> r = a.c[0] * b.c[0];
  for (int i = 1; i < m * n; ++i) r += a.c[i] * b.c[i];
  return r;
}
/// Lengths, with derivatives 0 where they are 0.
template <int n, class T>
T norm(const Vec<n, T>& a) {
  return safe_sqrt(dot(a, a));
}
template <int m, int n, class T>
T norm(const Mat<m, n, T>& a) {
  return safe_sqrt(inner(a, a));
}
/// What is left of a tensor of three dimensions without its mean.
template <class T>
Mat<3, 3, T> deviator(const Mat<3, 3, T>& a) {
  Mat<3, 3, T> r = a;
  const T mean = (1.0 / 3) * trace(a);
  for (int i = 0; i < 3; ++i) r(i, i) -= mean;
  return r;
}
template <int m, int n, class A, class B>
Mat<m, n, promote<A, B>> outer(const Vec<m, A>& a, const Vec<n, B>& b) {
  Mat<m, n, promote<A, B>> r;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) r(i, j) = a[i] * b[j];
  return r;
}

/// The cofactor tensor: det(a) a^-T.
template <class T>
Mat<2, 2, T> cofactor(const Mat<2, 2, T>& a) {
  Mat<2, 2, T> r;
  r(0, 0) = a(1, 1);
  r(0, 1) = -a(1, 0);
  r(1, 0) = -a(0, 1);
  r(1, 1) = a(0, 0);
  return r;
}
template <class T>
Mat<3, 3, T> cofactor(const Mat<3, 3, T>& a) {
  Mat<3, 3, T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      r(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
  return r;
}
/// The determinant, given the cofactor tensor.
template <int n, class T>
T determinant(const Mat<n, n, T>& a, const Mat<n, n, T>& cof) {
  T r = a(0, 0) * cof(0, 0);
  for (int j = 1; j < n; ++j) r += a(0, j) * cof(0, j);
  return r;
}
template <int n, class T>
T determinant(const Mat<n, n, T>& a) {
  return determinant(a, cofactor(a));
}
template <int n, class T>
Mat<n, n, T> inverse(const Mat<n, n, T>& a) {
  const Mat<n, n, T> cof = cofactor(a);
  const T factor = 1.0 / determinant(a, cof);
  Mat<n, n, T> r;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) r(i, j) = factor * cof(j, i);
  return r;
}

}  // namespace seam
