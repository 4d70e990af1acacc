// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "seam/term/fad.hpp"
#include "seam/term/tensor.hpp"
#include "seam/term/term.hpp"

/// Weak forms written once, at a point.
///
/// A kernel names its operands, lists what it reads and what it tests with, and computes the coefficients of
/// the test functions in one call operator that is a template on dimension and scalar type:
///
///   struct Diffusion {
///     using c = seam::Scalar<0>;                      // operand 0
///     using Reads = seam::Slots<seam::Gradient<c>>;
///     using Tests = seam::Slots<seam::Gradient<c>>;
///     double diffusivity;
///     template <int dim, class T>
///     void operator()(const seam::Point<dim>&, const seam::Trial<dim, T, Reads>& s,
///                     seam::Test<dim, T, Tests>& r) const {
///       r.gradient(c{}) += diffusivity * s.gradient(c{});
///     }
///   };
///
/// A coupling kernel whose points may move with a body takes its point as `const seam::Point<dim, G>&` with a
/// third template parameter G: then position and normal carry derivatives, too, and the tangent is exact
/// where the interface follows the body. With Point<dim> the term's dependence on where its points are is
/// left out.
///
/// Where the points depend on two bodies, as on both sides of a gap, the kernel says so by
/// `static constexpr int movers = 2`. One for which the state at the start of a step is more than a part of
/// rates asks for rates that fit to it by `static constexpr bool fresh_rates = true`.
///
/// The weak form is the sum over all test functions of coefficient times test function (or its gradient),
/// integrated: here (grad dc, D grad c). The tangent follows by automatic differentiation.
namespace seam {

/// Operand number k of a term, a scalar or a vector of the space dimension.
template <int k>
struct Scalar {
  static constexpr int index = k;
  static constexpr int components(int) { return 1; }
};
template <int k>
struct Vector {
  static constexpr int index = k;
  static constexpr int components(int dim) { return dim; }
};
/// Three numbers in any dimension but two (rotation): one in the plane, three in space.
template <int k>
struct Rotation {
  static constexpr int index = k;
  static constexpr int components(int dim) { return dim == 2 ? 1 : 3; }
};

template <class O, Shape s, Level l = Level::now>
struct Read {
  using operand = O;
  static constexpr Shape shape = s;
  static constexpr Level level = l;
  static constexpr int size(int dim) { return O::components(dim) * rows(s, dim); }
};
template <class O>
using Value = Read<O, Shape::value>;
template <class O>
using Gradient = Read<O, Shape::gradient>;
template <class O>
using NormalDerivative = Read<O, Shape::normal_derivative>;
template <class O>
using SecondNormalDerivative = Read<O, Shape::second_normal_derivative>;
template <class O>
using Rate = Read<O, Shape::value, Level::rate>;
template <class O>
using RateGradient = Read<O, Shape::gradient, Level::rate>;
template <class O>
using SecondRate = Read<O, Shape::value, Level::second_rate>;
template <class O>
using OldValue = Read<O, Shape::value, Level::old>;
template <class O>
using OldGradient = Read<O, Shape::gradient, Level::old>;
template <class O>
using OldRate = Read<O, Shape::value, Level::old_rate>;
template <class O>
using OldRateGradient = Read<O, Shape::gradient, Level::old_rate>;

/// A list of reads; knows where each stands in the flat array of a point.
template <class... R>
struct Slots {
  static constexpr int count = sizeof...(R);
  static constexpr int size([[maybe_unused]] int dim) { return (0 + ... + R::size(dim)); }
  template <class Wanted>
  static constexpr int offset(int dim) {
    static_assert((std::is_same_v<Wanted, R> || ...), "the kernel uses a slot that it does not declare");
    int at = 0;
    bool found = false;
    ((found = found || std::is_same_v<Wanted, R>, at += found ? 0 : R::size(dim)), ...);
    return at;
  }
  static std::vector<Slot> list() { return {Slot{R::operand::index, R::shape, R::level}...}; }
  template <class F>
  static void for_each(F&& f) {
    (f(R{}), ...);
  }
};

/// Where the term is evaluated. Geometry is of type G: double where the domain is fixed.
template <int dim, class G = double>
struct Point {
  using Geometry = G;
  Vec<dim, G> position;  ///< m
  Vec<dim, G> normal;    ///< outward unit normal of side 0; zero in cell terms
  double cell_size = 0;  ///< m, diameter of side 0's cell; of the larger cell at a face between two
  /// m, on boundaries and interfaces: volume of side 0's cell over the area of the boundary in it, the length
  /// that scales Nitsche penalties (the whole cell's volume where it is cut). At a face between two cells:
  /// the larger of both volumes over its area.
  double trace_size = 0;
  /// m, on interfaces: the same material point in the reference configuration of side 1's mesh.
  Vec<dim, G> partner_position;
  /// m, to the surface that the point may come to touch, along the normal; negative where it lies behind it.
  G gap = std::numeric_limits<double>::infinity();
  std::array<double, 2> constant{};  ///< of the sides' cells, prepared beforehand for the term (CellConstant)
  double time = 0;                   ///< s, end of the step
  double step = 0;                   ///< s; 0 in a static problem
  double theta = 1;
};

/// The unknowns at a point, as declared in `Reads`.
template <int dim, class T, class Reads>
struct Trial {
  const T* data;

  template <class O>
  auto value(O) const {
    return load<Value<O>>();
  }
  template <class O>
  auto gradient(O) const {
    return load<Gradient<O>>();
  }
  template <class O>
  auto normal_derivative(O) const {
    return load<NormalDerivative<O>>();
  }
  template <class O>
  auto second_normal_derivative(O) const {
    return load<SecondNormalDerivative<O>>();
  }
  template <class O>
  auto rate(O) const {
    return load<Rate<O>>();
  }
  template <class O>
  auto rate_gradient(O) const {
    return load<RateGradient<O>>();
  }
  template <class O>
  auto second_rate(O) const {
    return load<SecondRate<O>>();
  }
  template <class O>
  auto old_value(O) const {
    return load<OldValue<O>>();
  }
  template <class O>
  auto old_gradient(O) const {
    return load<OldGradient<O>>();
  }
  template <class O>
  auto old_rate(O) const {
    return load<OldRate<O>>();
  }
  template <class O>
  auto old_rate_gradient(O) const {
    return load<OldRateGradient<O>>();
  }

 private:
  template <class R>
  auto load() const {
    const T* from = data + Reads::template offset<R>(dim);
    constexpr int n = R::operand::components(dim), m = rows(R::shape, dim);
    if constexpr (R::shape == Shape::gradient && n > 1) {
      Mat<n, m, T> r;
      std::copy_n(from, n * m, r.c.begin());
      return r;
    } else if constexpr (n * m > 1 || std::is_same_v<typename R::operand, Vector<R::operand::index>>) {
      Vec<n * m, T> r;
      std::copy_n(from, n * m, r.c.begin());
      return r;
    } else {
      return T(*from);
    }
  }
};

/// A view on part of the coefficients; `+=` adds a scalar, Vec or Mat of matching size.
template <class T, int n>
struct Coefficients {
  T* data;
  template <class S>
  void operator+=(const S& s) const {
    if constexpr (requires { s.c; }) {
      static_assert(std::tuple_size_v<decltype(s.c)> == n, "sizes of coefficient and test function differ");
      for (int i = 0; i < n; ++i) data[i] += s.c[i];
    } else {
      static_assert(n == 1, "a scalar cannot be the coefficient of a vector");
      *data += s;
    }
  }
  template <class S>
  void operator-=(const S& s) const {
    if constexpr (requires { s.c; }) {
      static_assert(std::tuple_size_v<decltype(s.c)> == n, "sizes of coefficient and test function differ");
      for (int i = 0; i < n; ++i) data[i] -= s.c[i];
    } else {
      static_assert(n == 1, "a scalar cannot be the coefficient of a vector");
      *data -= s;
    }
  }
};

/// The coefficients of the test functions at a point, as declared in `Tests`.
template <int dim, class T, class Tests>
struct Test {
  T* data;

  template <class O>
  auto value(O) {
    return at<Value<O>>();
  }
  template <class O>
  auto gradient(O) {
    return at<Gradient<O>>();
  }
  template <class O>
  auto normal_derivative(O) {
    return at<NormalDerivative<O>>();
  }
  template <class O>
  auto second_normal_derivative(O) {
    return at<SecondNormalDerivative<O>>();
  }

 private:
  template <class R>
  auto at() {
    return Coefficients<T, R::size(dim)>{data + Tests::template offset<R>(dim)};
  }
};

namespace detail {

template <class Reads, class Tests>
Signature signature_of(Reads, Tests, int dim) {
  Signature s{{}, Reads::list(), Tests::list(), {}, 0};
  const auto note = [&]<class R>(R) {
    if (R::operand::index >= static_cast<int>(s.components.size()))
      s.components.resize(R::operand::index + 1, 0);
    s.components[R::operand::index] = R::operand::components(dim);
  };
  Reads::for_each(note);
  Tests::for_each(note);
  for (const Slot& slot : s.inputs) {
    const Slot column{slot.operand, slot.shape, Level::now};
    if (slot.level > Level::second_rate) continue;
    if (std::find(s.columns.begin(), s.columns.end(), column) == s.columns.end()) s.columns.push_back(column);
  }
  return s;
}

template <int dim, class G = double>
Point<dim, G> point(const PointBatch& b, int q) {
  Point<dim, G> p;
  for (int i = 0; i < dim; ++i) {
    p.position[i] = b.position[q * dim + i];
    p.normal[i] = b.normal ? b.normal[q * dim + i] : 0.0;
    if (b.partner_position) p.partner_position[i] = b.partner_position[q * dim + i];
  }
  p.cell_size = b.cell_size[q];
  p.trace_size = b.trace_size[q];
  for (int k = 0; k < 2; ++k)
    if (b.constant[k]) p.constant[k] = b.constant[k][q];
  if (b.gap) p.gap = b.gap[q];
  p.time = b.time;
  p.step = b.step;
  p.theta = b.theta;
  return p;
}

template <class Kernel, int dim, class T>
concept FollowsMotion = requires(const Kernel& kernel, const Point<dim, T>& point,
                                 const Trial<dim, T, typename Kernel::Reads>& trial,
                                 Test<dim, T, typename Kernel::Tests>& test) {
  kernel.template operator()<dim, T>(point, trial, test);
};

/// The bodies whose motion the points depend on.
template <class Kernel>
constexpr int movers_of() {
  if constexpr (requires { Kernel::movers; })
    return Kernel::movers;
  else
    return 1;
}

}  // namespace detail

/// Makes a Term of a kernel.
template <class Kernel>
class KernelTerm final : public Term {
 public:
  /// @param extra_degree polynomial degree of coefficients, such as a body force, on top of the shape
  /// functions'
  explicit KernelTerm(Kernel kernel, int extra_degree = 0)
      : kernel_(std::move(kernel)),
        extra_degree_(extra_degree),
        signatures_{detail::signature_of(Reads{}, Tests{}, 2), detail::signature_of(Reads{}, Tests{}, 3)} {
    for (Signature& signature : signatures_) {
      signature.follows_motion = follows_motion;
      if constexpr (requires { Kernel::fresh_rates; }) signature.fresh_rates = Kernel::fresh_rates;
    }
  }

  [[nodiscard]] const Signature& signature(int dimension) const override {
    return signatures_[dimension - 2];
  }
  [[nodiscard]] int extra_degree() const override { return extra_degree_; }
  void evaluate(const PointBatch& points, double* residual, double* tangent) const override {
    if (points.dimension == 2)
      evaluate_in<2>(points, residual, tangent);
    else
      evaluate_in<3>(points, residual, tangent);
  }

 private:
  using Reads = typename Kernel::Reads;
  using Tests = typename Kernel::Tests;
  static constexpr bool follows_motion = detail::FollowsMotion<Kernel, 2, Fad<1>>;
  static constexpr int movers = detail::movers_of<Kernel>();

  /// First derivative index of a read: reads of one operand and shape share theirs. -1 for old states.
  template <int dim, class R, class... Q>
  static constexpr int derivative_offset(Slots<Q...>) {
    if (R::level > Level::second_rate) return -1;
    int at = 0, result = -1;
    int seen_operand[sizeof...(Q) + 1] = {};
    Shape seen_shape[sizeof...(Q) + 1] = {};
    int seen = 0;
    const auto visit = [&](int operand, Shape shape, Level level, int size) {
      if (level > Level::second_rate) return;
      for (int i = 0; i < seen; ++i)
        if (seen_operand[i] == operand && seen_shape[i] == shape) return;
      if (operand == R::operand::index && shape == R::shape) result = at;
      seen_operand[seen] = operand;
      seen_shape[seen++] = shape;
      at += size;
    };
    (visit(Q::operand::index, Q::shape, Q::level, Q::size(dim)), ...);
    return result;
  }
  template <int dim, class... Q>
  static constexpr int derivative_count(Slots<Q...>) {
    int count = 0;
    ((count = std::max(count, derivative_offset<dim, Q>(Slots<Q...>{}) + Q::size(dim))), ...);
    return count;
  }

  template <int dim>
  void evaluate_in(const PointBatch& points, double* residual, double* tangent) const {
    constexpr int in = Reads::size(dim), out = Tests::size(dim), columns = derivative_count<dim>(Reads{});
    if (!tangent || (columns == 0 && points.moves == 0)) {
      for (int q = 0; q < points.count; ++q) {
        double* r = residual + q * out;
        std::fill_n(r, out, 0.0);
        Test<dim, double, Tests> test{r};
        kernel_.template operator()<dim, double>(detail::point<dim>(points, q),
                                                 Trial<dim, double, Reads>{points.inputs + q * in}, test);
      }
      return;
    }
    if constexpr (follows_motion)
      if (points.moves > 0) return differentiate<dim, columns, movers * dim * dim>(points, residual, tangent);
    if constexpr (columns > 0) differentiate<dim, columns, 0>(points, residual, tangent);
  }

  template <int dim, int columns, int moves>
  void differentiate(const PointBatch& points, double* residual, double* tangent) const {
    constexpr int in = Reads::size(dim), out = Tests::size(dim);
    using T = Fad<columns + moves>;
    for (int q = 0; q < points.count; ++q) {
      T input[std::max(in, 1)], output[out];
      Reads::for_each([&]<class R>(R) {
        constexpr int from = Reads::template offset<R>(dim), first = derivative_offset<dim, R>(Reads{});
        for (int i = 0; i < R::size(dim); ++i) {
          input[from + i] = points.inputs[q * in + from + i];
          if constexpr (first >= 0)
            input[from + i].d[first + i] = points.level_factor[R::operand::index][static_cast<int>(R::level)];
          for (int m = 0; m < moves; ++m)
            input[from + i].d[columns + m] = points.input_change[(q * in + from + i) * moves + m];
        }
      });
      Test<dim, T, Tests> test{output};
      const Trial<dim, T, Reads> trial{input};
      if constexpr (moves > 0)
        kernel_.template operator()<dim, T>(moving_point<dim, T, columns>(points, q), trial, test);
      else
        kernel_.template operator()<dim, T>(detail::point<dim>(points, q), trial, test);
      for (int i = 0; i < out; ++i) {
        residual[q * out + i] = output[i].v;
        std::copy_n(output[i].d, columns + moves, tangent + (q * out + i) * (columns + moves));
      }
    }
  }
  template <int dim, class T, int columns>
  static Point<dim, T> moving_point(const PointBatch& points, int q) {
    Point<dim, T> point = detail::point<dim, T>(points, q);
    for (int i = 0; i < dim; ++i)
      for (int m = 0; m < points.moves; ++m) {
        const int k = (q * dim + i) * points.moves + m;
        point.position[i].d[columns + m] = points.position_change[k];
        point.normal[i].d[columns + m] = points.normal_change[k];
        if (points.partner_change) point.partner_position[i].d[columns + m] = points.partner_change[k];
      }
    if (points.gap_change)
      for (int m = 0; m < points.moves; ++m)
        point.gap.d[columns + m] = points.gap_change[q * points.moves + m];
    return point;
  }

  Kernel kernel_;
  int extra_degree_;
  Signature signatures_[2];
};

template <class Kernel>
std::shared_ptr<const Term> make_term(Kernel kernel, int extra_degree = 0) {
  return std::make_shared<KernelTerm<Kernel>>(std::move(kernel), extra_degree);
}

/// Makes a quantity, something computed at a point that no test function meets, of a kernel:
///
///   struct Jacobian {
///     using u = seam::Vector<0>;
///     using Reads = seam::Slots<seam::Gradient<u>>;
///     static constexpr int values(int) { return 1; }
///     template <int dim>
///     void operator()(const seam::Point<dim>&, const seam::Trial<dim, double, Reads>& s, double* value)
///     const;
///   };
template <class Kernel>
class KernelQuantity final : public Term {
 public:
  KernelQuantity(Kernel kernel, int extra_degree)
      : kernel_(std::move(kernel)), extra_degree_(extra_degree), signatures_{make(2), make(3)} {}
  [[nodiscard]] int extra_degree() const override { return extra_degree_; }
  [[nodiscard]] const Signature& signature(int dimension) const override {
    return signatures_[dimension - 2];
  }
  void evaluate(const PointBatch& points, double* values, double*) const override {
    if (points.dimension == 2)
      evaluate_in<2>(points, values);
    else
      evaluate_in<3>(points, values);
  }

 private:
  using Reads = typename Kernel::Reads;
  static Signature make(int dim) {
    Signature s = detail::signature_of(Reads{}, Slots<>{}, dim);
    s.values = Kernel::values(dim);
    return s;
  }
  template <int dim>
  void evaluate_in(const PointBatch& points, double* values) const {
    for (int q = 0; q < points.count; ++q)
      kernel_.template operator()<dim>(detail::point<dim>(points, q),
                                       Trial<dim, double, Reads>{points.inputs + q * Reads::size(dim)},
                                       values + q * Kernel::values(dim));
  }
  Kernel kernel_;
  int extra_degree_;
  Signature signatures_[2];
};

/// @param extra_degree that it adds to squares of unknowns; counts where a boundary quantity is integrated
template <class Kernel>
std::shared_ptr<const Term> make_quantity(Kernel kernel, int extra_degree = 0) {
  return std::make_shared<KernelQuantity<Kernel>>(std::move(kernel), extra_degree);
}

}  // namespace seam
