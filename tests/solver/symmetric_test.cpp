// SPDX-License-Identifier: BSD-3-Clause
// Functions of symmetric tensors: identities, and derivatives against differences, where eigenvalues differ,
// lie close to each other and coincide.
#include "seam/term/symmetric.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace seam;

namespace {

template <int n>
using Tensor = Mat<n, n, double>;

template <int n>
Tensor<n> symmetric(const double* entry) {
  Tensor<n> a;
  for (int i = 0, k = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j, ++k) a(i, j) = a(j, i) = entry[k];
  return a;
}

/// A tensor that depends on two numbers, with given eigenvalues where they are 0.
template <int n>
struct Path {
  Tensor<n> start, by_x, by_y;
  template <class T>
  Mat<n, n, T> at(const T& x, const T& y) const {
    Mat<n, n, T> a;
    for (int i = 0; i < n * n; ++i) a.c[i] = start.c[i] + x * by_x.c[i] + y * by_y.c[i] + x * y * by_x.c[i];
    return a;
  }
};

template <int n>
Path<n> path(const std::array<double, n>& eigenvalues) {
  const double entries[] = {0.7, 0.3, -0.4, 0.2, 0.5, 0.1}, others[] = {-0.2, 0.6, 0.3, 0.4, -0.1, 0.8};
  // Axes of some tensor.
  const Tensor<n> some = symmetric<n>(others);
  Tensor<n> axes;
  double ignored[n];
  symmetric_eigen(n, some.c.data(), ignored, axes.c.data());
  Tensor<n> diagonal;
  for (int i = 0; i < n; ++i) diagonal(i, i) = eigenvalues[i];
  return {axes * (diagonal * transpose(axes)), symmetric<n>(entries), symmetric<n>(others)};
}

template <int n>
double difference(const Tensor<n>& a, const Tensor<n>& b) {
  const Tensor<n> d = a - b;
  return std::sqrt(inner(d, d));
}

template <class G>
auto slope(const G& g) {
  constexpr double h = 1e-3;
  return (1 / (12 * h)) * (8.0 * (g(h) - g(-h)) + (g(-2 * h) - g(2 * h)));
}

/// The parts of a tensor of numbers that carry derivatives.
template <int n, class T, class Part>
auto parts(const Mat<n, n, T>& a, const Part& part) {
  Mat<n, n, std::decay_t<decltype(part(a.c[0]))>> r;
  for (int i = 0; i < n * n; ++i) r.c[i] = part(a.c[i]);
  return r;
}

using One = Fad<2>;
using Two = Fad<2, One>;
using Three = Fad<2, Two>;

template <class T>
std::array<T, 2> inputs(double x, double y) {
  if constexpr (std::is_same_v<T, double>) {
    return {x, y};
  } else {
    using Inner = std::decay_t<decltype(T().v)>;
    const auto in = inputs<Inner>(x, y);
    return {T(in[0], 0), T(in[1], 1)};
  }
}

/// All derivatives up to the third of f(a(x, y)) are differences of those of one order less.
template <int n, class F>
void check_derivatives(const std::array<double, n>& eigenvalues, const F& f) {
  const Path<n> a = path<n>(eigenvalues);
  const auto value = [&]<class T>(T, double x, double y) {
    const auto in = inputs<T>(x, y);
    return f(a.at(in[0], in[1]));
  };
  const auto three = value(Three{}, 0, 0);
  const double scale = 1 + std::sqrt(inner(value(0.0, 0, 0), value(0.0, 0, 0)));
  CHECK(difference<n>(parts(three, [](const auto& v) { return v.v.v.v; }), value(0.0, 0, 0)) < 1e-13 * scale);
  for (int i = 0; i < 2; ++i) {
    const auto first = [&](double h) { return value(0.0, i == 0 ? h : 0, i == 0 ? 0 : h); };
    CHECK(difference<n>(parts(three, [&](const auto& v) { return v.v.v.d[i]; }), slope(first)) <
          1e-7 * scale);
    for (int j = 0; j < 2; ++j) {
      const auto second = [&](double h) {
        return parts(value(One{}, j == 0 ? h : 0, j == 0 ? 0 : h), [&](const auto& v) { return v.d[i]; });
      };
      CHECK(difference<n>(parts(three, [&](const auto& v) { return v.v.d[j].d[i]; }), slope(second)) <
            1e-7 * scale);
      for (int k = 0; k < 2; ++k) {
        const auto third = [&](double h) {
          return parts(value(Two{}, k == 0 ? h : 0, k == 0 ? 0 : h),
                       [&](const auto& v) { return v.d[j].d[i]; });
        };
        CHECK(difference<n>(parts(three, [&](const auto& v) { return v.d[k].d[j].d[i]; }), slope(third)) <
              1e-6 * scale);
      }
    }
  }
}

template <int n>
void check_all(const std::array<double, n>& eigenvalues) {
  CAPTURE(n, eigenvalues[0], eigenvalues[1], eigenvalues[n - 1]);
  check_derivatives<n>(eigenvalues, [](const auto& a) { return exponential(a); });
  check_derivatives<n>(eigenvalues, [](const auto& a) { return logarithm(a); });
  check_derivatives<n>(eigenvalues, [](const auto& a) { return power(a, -1.3); });
}

}  // namespace

TEST_CASE("exponential, logarithm and powers of a tensor belong to each other") {
  for (const std::array<double, 3>& of :
       {std::array<double, 3>{0.5, 1.7, 3.1}, {0.9, 1, 1.1}, {2, 2, 5}, {1, 1, 1}, {1e-6, 1, 1e6}}) {
    const Tensor<3> a = path<3>(of).start;
    CHECK(difference<3>(exponential(logarithm(a)), a) < 1e-12 * of[2]);
    CHECK(difference<3>(power(a, 0.5) * power(a, 0.5), a) < 1e-12 * of[2]);
    CHECK(difference<3>(power(a, 2), a * a) < 1e-12 * of[2] * of[2]);
    Tensor<3> sum = identity<3>(), part = identity<3>();
    for (int k = 1; k < 60 && of[2] < 10; ++k) sum += part = (1.0 / k) * (part * a);
    if (of[2] < 10) CHECK(difference<3>(exponential(a), sum) < 1e-12 * std::exp(of[2]));
  }
}

TEST_CASE("derivatives of tensor functions are those of differences, whether eigenvalues coincide or not") {
  check_all<3>({0.5, 1.7, 3.1});
  check_all<3>({1.2, 1.25, 2});
  check_all<3>({1.2, 1.2, 2});
  check_all<3>({1.2, 1.2 + 1e-9, 2});
  check_all<3>({1.3, 1.3 + 1e-4, 1.3 - 1e-5});
  check_all<3>({1, 1, 1});
  check_all<2>({0.6, 2});
  check_all<2>({1, 1});
}

TEST_CASE("eigenvalues are roots of their polynomial, and change as differences say") {
  const std::array<double, 3> of{0.5, 1.7, 3.1};
  const Path<3> a = path<3>(of);
  const auto at = [&]<class T>(T, double x, double y) {
    const auto in = inputs<T>(x, y);
    return eigenvalues(a.at(in[0], in[1]));
  };
  const Vec<3, Two> found = at(Two{}, 0, 0);
  for (int e = 0; e < 3; ++e) {
    CHECK(found[e].v.v == Approx(of[e]).epsilon(1e-14));
    for (int i = 0; i < 2; ++i) {
      const auto first = [&](double h) { return at(0.0, i == 0 ? h : 0, i == 0 ? 0 : h)[e]; };
      CHECK(found[e].v.d[i] == Approx(slope(first)).epsilon(1e-8));
      CHECK(found[e].d[i].v == Approx(found[e].v.d[i]).epsilon(1e-14));
      for (int j = 0; j < 2; ++j) {
        const auto second = [&](double h) { return at(One{}, j == 0 ? h : 0, j == 0 ? 0 : h)[e].d[i]; };
        CHECK(found[e].d[j].d[i] == Approx(slope(second)).epsilon(1e-7).margin(1e-8));
      }
    }
  }
}
