// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "rotation.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/term/kernel_term.hpp"

/// Springs and dashpots between rigid bodies, in the point of a Link. All is computed in space; in the plane
/// bodies turn about the third axis.
namespace seam::solid {

/// What kernels read of the body on a side, and test with.
template <bool in_space, int side>
struct BodyOf {
  static constexpr int first = side * (in_space ? 3 : 2);
  using translation = Vector<first>;
  using rotation = Rotation<first + 1>;
  using orientation = OrientationOf<first + 2>;
  using Tests = Slots<Value<translation>, Value<rotation>>;
};

template <class... A, class... B>
Slots<A..., B...> joined(Slots<A...>, Slots<B...>);

/// @tparam damped whether rates count: what has neither mass nor dashpots has none
template <bool in_space, bool damped, int side>
struct ReadsOfBody {
  using Body = BodyOf<in_space, side>;
  using translation = typename Body::translation;
  using rotation = typename Body::rotation;
  using Values = Slots<Value<translation>, Value<rotation>>;
  using Rates = std::conditional_t<damped, Slots<Rate<translation>, Rate<rotation>>, Slots<>>;
  using Start =
      std::conditional_t<in_space, Slots<OldValue<rotation>, OldValue<typename Body::orientation>>, Slots<>>;
  using type = decltype(joined(joined(Values{}, Rates{}), Start{}));
};

/// The slots of all bodies of a link.
template <bool in_space, bool damped, int bodies>
struct LinkSlots {
  using Reads = typename ReadsOfBody<in_space, damped, 0>::type;
  using Tests = typename BodyOf<in_space, 0>::Tests;
};
template <bool in_space, bool damped>
struct LinkSlots<in_space, damped, 2> {
  using Reads = decltype(joined(typename ReadsOfBody<in_space, damped, 0>::type{},
                                typename ReadsOfBody<in_space, damped, 1>::type{}));
  using Tests =
      decltype(joined(typename BodyOf<in_space, 0>::Tests{}, typename BodyOf<in_space, 1>::Tests{}));
};

/// How a body is placed and moves; the ground does not.
template <class T>
struct Placed {
  Vec<3, T> translation, velocity;
  Vec<3, T> spin;  ///< angular velocity in the body's axes, rad/s
  Quaternion<T> orientation = turned(no_rotation, Vec<3, T>{});
  Quaternion<T> old_orientation = orientation;  ///< at the start of the step
  T angle{0.0};                                 ///< in the plane, any number of turns
};

template <bool in_space, bool damped, int bodies, int side, int dim, class T, class Trial>
Placed<T> placed(const Trial& s) {
  Placed<T> body;
  if constexpr (side < bodies) {
    using Body = BodyOf<in_space, side>;
    const typename Body::translation translation;
    const typename Body::rotation rotation;
    const auto moved = s.value(translation);
    for (int i = 0; i < dim; ++i) body.translation[i] = moved[i];
    if constexpr (in_space) {
      body.orientation = orientation_of(s, rotation, typename Body::orientation{});
      body.old_orientation = s.old_value(typename Body::orientation{});
    } else {
      body.angle = s.value(rotation);
      Vec<3, T> turn;
      turn[2] = body.angle;
      body.orientation = turned(no_rotation, turn);
    }
    if constexpr (damped) {
      const auto rate = s.rate(translation);
      for (int i = 0; i < dim; ++i) body.velocity[i] = rate[i];
      if constexpr (in_space)
        body.spin = s.rate(rotation);
      else
        body.spin[2] = s.rate(rotation);
    }
  }
  return body;
}

template <bool in_space, bool damped, int bodies, int dim, class T, class Spring, class Trial>
auto state_of(const Spring& spring, const Trial& s) {
  return spring.template state<in_space, T>(
      {placed<in_space, damped, bodies, 0, dim, T>(s), placed<in_space, damped, bodies, 1, dim, T>(s)});
}

/// Adds the moment on a body about its own axes, with the sign of the residual.
template <bool in_space, int side, int dim, class T, class Test>
void add_moment(Test& r, const Vec<3, T>& moment) {
  const typename BodyOf<in_space, side>::rotation rotation;
  if constexpr (in_space)
    r.value(rotation) -= moment;
  else
    r.value(rotation) -= moment[2];
}

/// A spring and a dashpot side by side, along the line between a point of either body. Of points that
/// coincide in the reference position (rest length 0) they act in all directions.
struct LineSpring {
  double stiffness, damping, rest_length;     ///< N/m, N s/m, m
  std::array<Vec<3, double>, 2> centre, arm;  ///< of the bodies, and from it; reference position, m

  /// What the spring does where the bodies are.
  template <class T>
  struct State {
    std::array<Mat<3, 3, T>, 2> turn;
    std::array<Vec<3, T>, 2> lever;  ///< from the centres to the middle of the line
    Vec<3, T> force;                 ///< on the first body, N
    T length, tension, energy;       ///< m, N, J; tension along the line
  };
  /// @throws StepRefused where the ends of a spring with a length meet
  template <bool in_space, class T>
  [[nodiscard]] State<T> state(const std::array<Placed<T>, 2>& body) const {
    State<T> r;
    std::array<Vec<3, T>, 2> end;
    for (int k = 0; k < 2; ++k) {
      r.turn[k] = rotation_tensor(body[k].orientation);
      r.lever[k] = r.turn[k] * arm[k];
      end[k] = r.lever[k] + centre[k] + body[k].translation;
    }
    const Vec<3, T> way = end[1] - end[0];
    // Forces act in the middle: then they have no moment, whatever their direction.
    for (int k = 0; k < 2; ++k) r.lever[k] += (k == 0 ? 0.5 : -0.5) * way;
    const auto velocity = [&](int k) {
      return body[k].velocity + cross(r.turn[k] * body[k].spin, r.lever[k]);
    };
    const Vec<3, T> rate = velocity(1) - velocity(0);
    const T square = dot(way, way);
    if (rest_length == 0) {
      r.force = stiffness * way + damping * rate;
      r.length = plain(square) > 0 ? sqrt_of(square) : T(0.0);
      r.tension = plain(square) > 0 ? dot(r.force, way) / r.length : T(0.0);
      r.energy = 0.5 * stiffness * square;
      return r;
    }
    if (!(plain(square) > 1e-20 * rest_length * rest_length))
      throw StepRefused("the ends of a spring meet: it has no direction there");
    r.length = sqrt_of(square);
    r.tension = stiffness * (r.length - rest_length) + damping * dot(way, rate) / r.length;
    r.force = (r.tension / r.length) * way;
    r.energy = 0.5 * stiffness * (r.length - rest_length) * (r.length - rest_length);
    return r;
  }

 private:
  template <class T>
  static T sqrt_of(const T& x) {
    using std::sqrt;
    return sqrt(x);
  }
};

/// The force of a spring on the bodies of a link, and its moments about their centres.
template <bool in_space, bool damped, int bodies>
struct SpringForce {
  using Reads = typename LinkSlots<in_space, damped, bodies>::Reads;
  using Tests = typename LinkSlots<in_space, damped, bodies>::Tests;
  LineSpring spring;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if constexpr ((dim == 3) == in_space) {
      const auto state = state_of<in_space, damped, bodies, dim, T>(spring, s);
      pull<0>(state, state.force, r);
      if constexpr (bodies == 2) pull<1>(state, -state.force, r);
    }
  }

 private:
  template <int side, class T, int dim>
  static void pull(const LineSpring::State<T>& state, const Vec<3, T>& force, Test<dim, T, Tests>& r) {
    Vec<dim, T> in_field;
    for (int i = 0; i < dim; ++i) in_field[i] = force[i];
    r.value(typename BodyOf<in_space, side>::translation{}) -= in_field;
    add_moment<in_space, side, dim>(r, transpose(state.turn[side]) * cross(state.lever[side], force));
  }
};

/// A spring and a dashpot side by side against turns of two bodies relative to each other. In space about an
/// axis that is fixed in both, or against all of a turn; up to a whole turn.
struct TurnSpring {
  double stiffness, damping, rest_angle;  ///< N m, N m s, rad
  std::optional<Vec<3, double>> axis;     ///< in space: in the reference position, of length 1
  std::string where = {};                 ///< in the scene

  template <class T>
  struct State {
    std::array<Vec<3, T>, 2> moment;  ///< on the bodies, about their own axes, N m
    T angle, total, energy;           ///< rad; N m, of spring and dashpot; J
  };
  /// @throws StepRefused where in space they have come to turn by more than a whole turn
  template <bool in_space, class T>
  [[nodiscard]] State<T> state(const std::array<Placed<T>, 2>& body) const {
    State<T> r;
    if constexpr (!in_space) {
      r.angle = body[0].angle - body[1].angle;
      along(r, body[0].spin[2] - body[1].spin[2]);
      r.moment[0][2] = -r.total;
      r.moment[1][2] = r.total;
    } else {
      // The first body in the axes of the second one.
      const Quaternion<T> q = product(inverse(body[1].orientation), body[0].orientation);
      const Quaternion<T> old = product(inverse(body[1].old_orientation), body[0].old_orientation);
      if (axis)
        about_axis(r, q, old, body);
      else
        against_all(r, q, old, body);
    }
    return r;
  }

 private:
  [[nodiscard]] std::string name() const { return "the `torsional_spring` at " + where; }
  /// Moment and energy of an angle. @param rate of it
  template <class T>
  void along(State<T>& r, const T& rate) const {
    const T beyond = r.angle - rest_angle;
    r.total = stiffness * beyond + damping * rate;
    r.energy = 0.5 * stiffness * beyond * beyond;
  }
  /// The angle is 2 atan2(v . n, w) of the quaternion (v, w); moments are what it does in virtual turns of
  /// the bodies, so that those on both balance wherever the axes point.
  template <class T>
  void about_axis(State<T>& r, const Quaternion<T>& q, const Quaternion<T>& old,
                  const std::array<Placed<T>, 2>& body) const {
    using std::atan2;
    Vec<3, T> v;
    for (int i = 0; i < 3; ++i) v[i] = q[i];
    const T w = q[3], along_axis = dot(v, *axis), square = w * w + along_axis * along_axis;
    r.angle = 2.0 * atan2(along_axis, w);
    const T before = 2.0 * atan2(dot(Vec<3, T>{{old[0], old[1], old[2]}}, *axis), old[3]);
    require_within_a_turn<T>({{before}}, {{r.angle}}, name());
    Vec<3, T> normal;
    for (int i = 0; i < 3; ++i) normal[i] = T((*axis)[i]);
    const Vec<3, T> across = cross(normal, v), straight = w * normal;
    const std::array<Vec<3, T>, 2> change{(1.0 / square) * (w * (straight + across) + along_axis * v),
                                          (-1.0 / square) * (w * (straight - across) + along_axis * v)};
    along(r, dot(change[0], body[0].spin) + dot(change[1], body[1].spin));
    for (int k = 0; k < 2; ++k) r.moment[k] = -r.total * change[k];
  }
  /// The rotation vector is the same in the axes of both bodies.
  template <class T>
  void against_all(State<T>& r, const Quaternion<T>& q, const Quaternion<T>& old,
                   const std::array<Placed<T>, 2>& body) const {
    using std::sqrt;
    const Mat<3, 3, T> turn = rotation_tensor(q);
    const Vec<3, T> angles = counted_rotation_vector(q);
    require_within_a_turn(counted_rotation_vector(old), angles, name());
    r.moment[0] = -(stiffness * angles + damping * (body[0].spin - transpose(turn) * body[1].spin));
    r.moment[1] = -(turn * r.moment[0]);
    const T square = dot(angles, angles), size = dot(r.moment[0], r.moment[0]);
    r.angle = plain(square) > 0 ? sqrt(square) : T(0.0);
    r.total = plain(size) > 0 ? sqrt(size) : T(0.0);
    r.energy = 0.5 * stiffness * square;
  }
};

/// The moments of a spring against turns.
template <bool in_space, bool damped, int bodies>
struct SpringMoment {
  using Reads = typename LinkSlots<in_space, damped, bodies>::Reads;
  using Tests = typename LinkSlots<in_space, damped, bodies>::Tests;
  TurnSpring spring;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if constexpr ((dim == 3) == in_space) {
      const auto state = state_of<in_space, damped, bodies, dim, T>(spring, s);
      add_moment<in_space, 0, dim>(r, state.moment[0]);
      if constexpr (bodies == 2) add_moment<in_space, 1, dim>(r, state.moment[1]);
    }
  }
};

/// A number of what a spring does.
template <class Spring, bool in_space, bool damped, int bodies>
struct SpringNumber {
  using Reads = typename LinkSlots<in_space, damped, bodies>::Reads;
  static constexpr int values(int) { return 1; }
  Spring spring;
  double Spring::template State<double>::*number;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    if constexpr ((dim == 3) == in_space)
      *value = state_of<in_space, damped, bodies, dim, double>(spring, s).*number;
  }
};

}  // namespace seam::solid
