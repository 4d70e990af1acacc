// SPDX-License-Identifier: BSD-3-Clause
#include "spring.hpp"

#include <algorithm>

#include "link.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"
#include "seam/mesh/mesh.hpp"
#include "spring_kernels.hpp"

namespace seam::solid {
namespace {

template <class Spring, bool in_space, bool damped, int bodies>
struct KernelOf;
template <bool in_space, bool damped, int bodies>
struct KernelOf<LineSpring, in_space, damped, bodies> {
  using type = SpringForce<in_space, damped, bodies>;
};
template <bool in_space, bool damped, int bodies>
struct KernelOf<TurnSpring, in_space, damped, bodies> {
  using type = SpringMoment<in_space, damped, bodies>;
};

int dimension_of(const CouplingSides& sides) { return sides.fields.front()->mesh().dimension(); }

/// Calls f.operator()<in_space, damped, bodies>() for what a link has.
template <class F>
auto for_link(const CouplingSides& sides, bool damped, const F& f) {
  const auto in = [&]<bool in_space>() {
    const auto of = [&]<int bodies>() {
      return damped ? f.template operator()<in_space, true, bodies>()
                    : f.template operator()<in_space, false, bodies>();
    };
    return sides.fields.size() == 2 ? of.template operator()<2>() : of.template operator()<1>();
  };
  return dimension_of(sides) == 3 ? in.template operator()<true>() : in.template operator()<false>();
}

std::vector<Operand> operands_of(const CouplingSides& sides) {
  std::vector<Operand> operands;
  for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side) {
    operands.push_back({side, "translation"});
    operands.push_back({side, "rotation"});
    if (dimension_of(sides) == 3) operands.push_back({side, "orientation"});
  }
  return operands;
}

/// What springs of either kind give the scene.
template <class Spring>
class SpringCoupling : public Coupling {
 public:
  explicit SpringCoupling(const Parameters& parameters) : parameters_(parameters) {}
  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    const Spring of = spring(sides);
    return for_link(sides, of.damping > 0, [&]<bool in_space, bool damped, int bodies>() {
      using Kernel = typename KernelOf<Spring, in_space, damped, bodies>::type;
      return std::vector<SideTerm>{{make_term(Kernel{of}), operands_of(sides)}};
    });
  }
  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    const Spring of = spring(sides);
    std::vector<Measure> all;
    for (const auto& [name, number] : numbers())
      for_link(sides, of.damping > 0,
               [&, &name = name, &number = number]<bool in_space, bool damped, int bodies>() {
                 const SpringNumber<Spring, in_space, damped, bodies> quantity{of, number};
                 all.push_back({name, {{make_quantity(quantity), operands_of(sides)}}, MeasureOf::integral});
               });
    return all;
  }

 protected:
  using Number = double Spring::template State<double>::*;
  [[nodiscard]] virtual Spring spring(const CouplingSides& sides) const = 0;
  /// Names of what is recorded.
  [[nodiscard]] virtual std::vector<std::pair<std::string, Number>> numbers() const = 0;
  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] Vec<3, double> vector(const std::string& key) const {
    Vec<3, double> r;
    std::ranges::copy(parameters_.vector(key), r.c.begin());
    return r;
  }
  static void declare_strength(Schema& s, const std::string& stiffness, const std::string& damping) {
    s.reference("on", "The `link` of the bodies", "interface");
    s.number("stiffness", "Of the spring").unit(stiffness).otherwise("0").at_least(0);
    s.number("damping", "Of the dashpot beside it").unit(damping).otherwise("0").at_least(0);
  }

 private:
  Parameters parameters_;
};

class LineCoupling final : public SpringCoupling<LineSpring> {
 public:
  using SpringCoupling::SpringCoupling;
  static Schema schema() {
    Schema s("A spring and a dashpot side by side, along the line between a point of either body.");
    declare_strength(s, "N/m", "N s/m");
    s.vector("at", "Point of the first body, in the reference position").unit("m");
    s.vector("to_at",
             "Point of the second body or of the ground, in the reference position; where it is that of the "
             "first, spring and dashpot act in all directions")
        .unit("m");
    s.number("rest_length", "Without force; default the distance in the reference position")
        .unit("m")
        .optional()
        .at_least(0);
    return s;
  }

 private:
  [[nodiscard]] LineSpring spring(const CouplingSides& sides) const override {
    const Parameters& p = parameters();
    LineSpring r{p.number("stiffness"), p.number("damping"), 0, {}, {}};
    const char* keys[] = {"at", "to_at"};
    const int dim = dimension_of(sides);
    std::array<Vec<3, double>, 2> end;
    for (int k = 0; k < 2; ++k) {
      end[k] = vector(keys[k]);
      if (k < static_cast<int>(sides.fields.size()))
        std::copy_n(sides.fields[k]->mesh().whole().coordinates.begin(), dim, r.centre[k].c.begin());
      r.arm[k] = end[k] - r.centre[k];
    }
    const Vec<3, double> way = end[1] - end[0];
    double length = std::sqrt(dot(way, way));
    if (length <= 1e-12 * std::sqrt(dot(end[0], end[0]) + dot(end[1], end[1]))) length = 0;
    r.rest_length = p.has("rest_length") ? p.number("rest_length") : length;
    if (length == 0 && r.rest_length > 0)
      throw Error(p.where("rest_length"),
                  "a spring between points that coincide has no direction; its `rest_length` is 0");
    return r;
  }
  [[nodiscard]] std::vector<std::pair<std::string, Number>> numbers() const override {
    using State = LineSpring::State<double>;
    return {{"length", &State::length}, {"tension", &State::tension}, {"spring_energy", &State::energy}};
  }
};

class TurnCoupling final : public SpringCoupling<TurnSpring> {
 public:
  using SpringCoupling::SpringCoupling;
  static Schema schema() {
    Schema s("A spring and a dashpot side by side, against turns of two bodies relative to each other.");
    declare_strength(s, "N m", "N m s");
    s.vector("axis",
             "In space, in the reference position: only turns about it count, up to a turn; default all")
        .optional();
    s.number("rest_angle", "Without moment: the first body's angle less the second one's")
        .unit("rad")
        .otherwise("0");
    return s;
  }

 private:
  [[nodiscard]] TurnSpring spring(const CouplingSides& sides) const override {
    const Parameters& p = parameters();
    TurnSpring r{p.number("stiffness"), p.number("damping"), p.number("rest_angle"), {}, p.where().text()};
    const int dim = dimension_of(sides);
    if (dim == 2 && p.has("axis")) throw Error(p.where("axis"), "in the plane bodies turn about no `axis`");
    if (p.has("axis")) {
      const Vec<3, double> axis = vector("axis");
      const double length = std::sqrt(dot(axis, axis));
      if (!(length > 0)) throw Error(p.where("axis"), "the axis of a spring has no direction");
      r.axis = (1 / length) * axis;
    }
    if (dim == 3 && !p.has("axis") && r.rest_angle != 0)
      throw Error(p.where("rest_angle"), "an angle in space needs its `axis`");
    return r;
  }
  [[nodiscard]] std::vector<std::pair<std::string, Number>> numbers() const override {
    using State = TurnSpring::State<double>;
    return {{"angle", &State::angle}, {"moment", &State::total}, {"torsional_energy", &State::energy}};
  }
};

template <class Type>
void declare(Registry& registry, const std::string& name) {
  registry.add<Coupling>("coupling", name, Type::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<Type>(p); });
}

}  // namespace

void declare_springs(Registry& registry) {
  registry.add<Interface>("interface", "link", Link::schema(),
                          [](const Parameters& p, const Registry&) { return std::make_unique<Link>(p); });
  declare<LineCoupling>(registry, "spring");
  registry.publishes(
      "coupling", "spring",
      {{Published::As::series, "length", "m", "between the ends"},
       {Published::As::series, "tension", "N", "of spring and dashpot; below 0 where they push"},
       {Published::As::series, "spring_energy", "J", "of the spring"}});
  declare<TurnCoupling>(registry, "torsional_spring");
  registry.publishes("coupling", "torsional_spring",
                     {{Published::As::series, "angle", "rad", "the first body's less the second one's"},
                      {Published::As::series, "moment", "N m", "of spring and dashpot, against the angle"},
                      {Published::As::series, "torsional_energy", "J", "of the spring"}});
}

}  // namespace seam::solid
