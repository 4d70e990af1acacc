// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "seam/term/kernel_term.hpp"

/// Kernels that are written in space, on the mesh of a field that moves: integrals are taken over the mesh as
/// it was, with derivatives, rates, normals and measures mapped to where it is. The tangent has the mesh's
/// displacement among its unknowns (arbitrary Lagrangian-Eulerian formulation, thesis 2.2.4).
namespace seam {

namespace detail {

template <class S, class... R>
struct WithSlots {
  using type = S;
};
template <class... A, class R, class... More>
struct WithSlots<Slots<A...>, R, More...>
    : WithSlots<std::conditional_t<(std::is_same_v<A, R> || ...), Slots<A...>, Slots<A..., R>>, More...> {};

/// What must be read to map one read of a kernel: a rate at a place needs the gradient and the mesh's rate.
template <class S, class Mesh, class R, bool in_space>
struct WithMapped {
  static constexpr bool is_rate = R::level == Level::rate && R::shape == Shape::value;
  static_assert(!in_space || is_rate || (R::level == Level::now && R::shape <= Shape::gradient),
                "a kernel on a moving mesh reads values, gradients and rates of values");
  using type = typename std::conditional_t<
      in_space && is_rate, WithSlots<S, Gradient<typename R::operand>, Rate<Mesh>>, WithSlots<S>>::type;
};
template <class Kernel, class Mesh, int in_space, class S, class... R>
struct MappedReads {
  using type = typename WithSlots<S, Value<Mesh>, Gradient<Mesh>>::type;
};
template <class Kernel, class Mesh, int in_space, class S, class R, class... More>
struct MappedReads<Kernel, Mesh, in_space, S, R, More...>
    : MappedReads<Kernel, Mesh, in_space,
                  typename WithMapped<S, Mesh, R, (R::operand::index < in_space)>::type, More...> {};
template <class Kernel>
struct TestsOf {
  using type = Slots<>;
};
template <class Kernel>
requires requires { typename Kernel::Tests; }
struct TestsOf<Kernel> {
  using type = typename Kernel::Tests;
};
template <class Kernel, class Mesh, int in_space, class S>
struct MappedReadsOf;
template <class Kernel, class Mesh, int in_space, class... R>
struct MappedReadsOf<Kernel, Mesh, in_space, Slots<R...>>
    : MappedReads<Kernel, Mesh, in_space, Slots<R...>, R...> {};

}  // namespace detail

/// How a mesh that is displaced by the unknown Mesh maps a point of its reference configuration.
template <int dim, class T>
struct MeshMap {
  Mat<dim, dim, T> inverse;  ///< F^-1
  Vec<dim, T> position;      ///< m
  Vec<dim, T> normal;        ///< unit normal, zero inside a cell
  T measure;                 ///< volume, or area on a boundary, over that in the reference configuration

  MeshMap(const Point<dim>& x, const Vec<dim, T>& displacement, const Mat<dim, dim, T>& gradient) {
    using std::sqrt;
    Mat<dim, dim, T> f = gradient;
    for (int i = 0; i < dim; ++i) f(i, i) += 1.0;
    const Mat<dim, dim, T> cofactor = seam::cofactor(f);
    const T volume = determinant(f, cofactor);
    inverse = (1.0 / volume) * transpose(cofactor);
    position = x.position + displacement;
    measure = volume;
    if (dot(x.normal, x.normal) == 0) return;
    normal = cofactor * x.normal;
    measure = sqrt(dot(normal, normal));
    normal = (1.0 / measure) * normal;
  }
};

/// A kernel, of a term or of a quantity, on a moving mesh. Its operands below `in_space` live on that mesh,
/// those above (a body's) stay in the reference configuration of their own.
/// @tparam Mesh operand that displaces the mesh, Vector<k>; none of the kernel's own
template <class Kernel, class Mesh, int in_space>
struct OnMovingMesh {
  using Inner = typename Kernel::Reads;
  using Reads = typename detail::MappedReadsOf<Kernel, Mesh, in_space, Inner>::type;
  using Tests = typename detail::TestsOf<Kernel>::type;
  Kernel kernel;
  /// Of a quantity that is integrated: 1; of one whose square is: 1/2; of one that is only looked at: 0.
  double power_of_measure = 1;

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const MeshMap<dim, T> map(x, s.value(Mesh{}), s.gradient(Mesh{}));
    const auto input = mapped<dim, T>(map, s);
    std::array<T, static_cast<std::size_t>(Tests::size(dim))> output{};
    Test<dim, T, Tests> test{output.data()};
    const Trial<dim, T, Inner> trial{input.data()};
    if constexpr (detail::FollowsMotion<Kernel, dim, T>)
      kernel.template operator()<dim, T>(moved<dim, T>(x, map), trial, test);
    else
      kernel.template operator()<dim, T>(moved<dim, double>(x, map), trial, test);
    Tests::for_each([&]<class R>(R) {
      constexpr int from = Tests::template offset<R>(dim), components = R::operand::components(dim);
      if constexpr (R::shape == Shape::gradient && R::operand::index < in_space)
        pull_back<dim, components>(map, &output[from], r.data + from);
      else
        for (int i = 0; i < R::size(dim); ++i) r.data[from + i] += map.measure * output[from + i];
    });
  }
  static constexpr int values(int dim) requires requires { Kernel::values(2); }
  { return Kernel::values(dim); }
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    const MeshMap<dim, double> map(x, s.value(Mesh{}), s.gradient(Mesh{}));
    const auto input = mapped<dim, double>(map, s);
    kernel.template operator()<dim>(moved<dim, double>(x, map), Trial<dim, double, Inner>{input.data()},
                                    value);
    const double factor = std::pow(map.measure, power_of_measure);
    for (int i = 0; i < Kernel::values(dim); ++i) value[i] *= factor;
  }

 private:
  /// What the kernel reads.
  template <int dim, class T>
  static auto mapped(const MeshMap<dim, T>& map, const Trial<dim, T, Reads>& s) {
    std::array<T, static_cast<std::size_t>(std::max(Inner::size(dim), 1))> input;
    Inner::for_each([&]<class R>(R) {
      constexpr int to = Inner::template offset<R>(dim), components = R::operand::components(dim);
      const T* from = s.data + Reads::template offset<R>(dim);
      if constexpr (R::operand::index >= in_space || (R::shape == Shape::value && R::level == Level::now)) {
        std::copy_n(from, R::size(dim), &input[to]);
      } else if constexpr (R::shape == Shape::gradient) {
        push_forward<dim, components>(map, from, &input[to]);
      } else {
        rate_at_place<dim, T, R>(map, s, &input[to]);
      }
    });
    return input;
  }
  /// The mesh's point passes the place with the mesh's velocity.
  template <int dim, class T, class R>
  static void rate_at_place(const MeshMap<dim, T>& map, const Trial<dim, T, Reads>& s, T* rate) {
    constexpr int components = R::operand::components(dim);
    T gradient[components * dim];
    push_forward<dim, components>(map, s.data + Reads::template offset<Gradient<typename R::operand>>(dim),
                                  gradient);
    const T* speed = s.data + Reads::template offset<Rate<Mesh>>(dim);
    for (int c = 0; c < components; ++c) {
      rate[c] = s.data[Reads::template offset<R>(dim) + c];
      for (int i = 0; i < dim; ++i) rate[c] -= gradient[c * dim + i] * speed[i];
    }
  }
  template <int dim, int components, class T>
  static void push_forward(const MeshMap<dim, T>& map, const T* reference, T* gradient) {
    for (int c = 0; c < components; ++c)
      for (int i = 0; i < dim; ++i) {
        gradient[c * dim + i] = reference[c * dim] * map.inverse(0, i);
        for (int j = 1; j < dim; ++j) gradient[c * dim + i] += reference[c * dim + j] * map.inverse(j, i);
      }
  }
  /// Adds the coefficient of a test function's gradient.
  template <int dim, int components, class T>
  static void pull_back(const MeshMap<dim, T>& map, const T* coefficient, T* result) {
    for (int c = 0; c < components; ++c)
      for (int i = 0; i < dim; ++i) {
        const T scaled = map.measure * coefficient[c * dim + i];
        for (int j = 0; j < dim; ++j) result[c * dim + j] += scaled * map.inverse(j, i);
      }
  }
  /// The point where it is now, with derivatives (G = T) or without.
  template <int dim, class G, class T>
  static Point<dim, G> moved(const Point<dim>& x, const MeshMap<dim, T>& map) {
    Point<dim, G> now;
    for (int i = 0; i < dim; ++i) {
      if constexpr (std::is_same_v<G, T>) {
        now.position[i] = map.position[i];
        now.normal[i] = map.normal[i];
      } else {
        now.position[i] = plain(map.position[i]);
        now.normal[i] = plain(map.normal[i]);
      }
      now.partner_position[i] = x.partner_position[i];
    }
    now.cell_size = x.cell_size;
    now.trace_size = x.trace_size;
    now.gap = x.gap;
    now.constant = x.constant;
    now.time = x.time;
    now.step = x.step;
    now.theta = x.theta;
    return now;
  }
};

/// The term of a kernel on a moving mesh. Mapped integrands are no polynomials: one degree more.
template <class Mesh, int in_space, class Kernel>
std::shared_ptr<const Term> make_moving_term(Kernel kernel, int extra_degree = 0) {
  return make_term(OnMovingMesh<Kernel, Mesh, in_space>{std::move(kernel)}, extra_degree + 1);
}

/// The same of a quantity.
/// @param power_of_measure see OnMovingMesh
template <class Mesh, int in_space, class Kernel>
std::shared_ptr<const Term> make_moving_quantity(Kernel kernel, double power_of_measure) {
  return make_quantity(OnMovingMesh<Kernel, Mesh, in_space>{std::move(kernel), power_of_measure});
}

}  // namespace seam
