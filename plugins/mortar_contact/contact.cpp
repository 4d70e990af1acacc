// SPDX-License-Identifier: BSD-3-Clause
#include "contact.hpp"

#include <fmt/format.h>

#include <array>
#include <type_traits>

#include "contact_law.hpp"
#include "multiplier.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/physics/stress_law.hpp"
#include "seam/term/kernel_term.hpp"

namespace seam::mortar {
namespace {

using Slave = Vector<0>;
using Pressure = Scalar<1>;
using Master = Vector<2>;

/// The pressure p on the slave's surface as it is deformed, with its outward normal n:
///
///   <du - du', (p + q) n> - <dp, g> - <grad dp, s grad p>
///
/// du' at the point opposite, g the gap. q is 0, or the pressure in the pores of a porous body where that is
/// also the pressure of what fills gaps: p is then what contact adds to it, the multiplier of thesis (5.13)
/// less f of (5.10). What the rest makes up about a node, minus its weighted gap, becomes an equation by the
/// contact law.
///
/// The last term, of gradients along the surface, is for nodes that next to nothing lies opposite to, as
/// beyond the edge of a body: what holds their pressure vanishes with the square of what is left of a face,
/// this one with what is left, so that their pressure becomes that of the nodes beside them, and nothing
/// changes at once where an edge passes a node. s, m^4/N in the plane, is of the order of the size of cells
/// to the third over the stiffness of the bodies.
template <int sides, bool filled>
struct Pressed {
  using InPores = Scalar<sides + 1>;
  template <class... More>
  using ReadsWith = Slots<Gradient<Slave>, Value<Pressure>, Gradient<Pressure>, More...>;
  using Reads = std::conditional_t<filled, ReadsWith<Value<InPores>>, ReadsWith<>>;
  template <class... More>
  using TestsWith = Slots<Value<Slave>, Value<Pressure>, Gradient<Pressure>, More...>;
  using Tests = std::conditional_t<sides == 2, TestsWith<Value<Master>>, TestsWith<>>;
  static constexpr int movers = sides;
  double smoothing;  ///< s over the square of a cell's diameter and its trace size, 1/Pa

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    T pressure = s.value(Pressure{});
    if constexpr (filled) pressure += s.value(InPores{});
    r.value(Slave{}) += pressure * x.normal;
    if constexpr (sides == 2) r.value(Master{}) -= pressure * x.normal;
    r.value(Pressure{}) -= T(x.gap);
    const Mat<dim, dim, T> to_rest = inverse(identity<dim>() + s.gradient(Slave{}));
    const Vec<dim, T> gradient = transpose(to_rest) * s.gradient(Pressure{});
    const Vec<dim, T> along = gradient - dot(gradient, x.normal) * x.normal;
    r.gradient(Pressure{}) -= (smoothing * x.cell_size * x.cell_size * x.trace_size) * (to_rest * along);
  }
};

enum class Number {
  gap,       ///< m
  overlap,   ///< m, negative
  touches,   ///< 1 or 0
  pressure,  ///< Pa
  force      ///< on the slave, a component, Pa
};

/// A number at a point of contact.
template <int sides, bool filled>
struct State {
  using InPores = Scalar<sides + 1>;
  using Reads =
      std::conditional_t<filled, Slots<Value<Pressure>, Value<InPores>>,
                         std::conditional_t<sides == 2, Slots<Value<Slave>, Value<Pressure>, Value<Master>>,
                                            Slots<Value<Slave>, Value<Pressure>>>>;
  static constexpr int values(int) { return 1; }
  Number number;
  int component;
  double rounding;  ///< of a pressure, Pa

  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    const double pressure = s.value(Pressure{});
    double pores = 0;
    if constexpr (filled) pores = s.value(InPores{});
    switch (number) {
      case Number::gap:
        *value = x.gap;
        break;
      case Number::overlap:
        *value = std::min(x.gap, 0.0);
        break;
      case Number::touches:
        *value = pressure > rounding ? 1 : 0;
        break;
      case Number::pressure:
        *value = pressure;
        break;
      case Number::force:
        *value = -(pressure + pores) * x.normal[component];
    }
  }
};

/// The stiffness of a body, or of the skeleton of one, at rest, Pa; 0 where it has no stress.
double modulus(const CouplingSides& sides, int side, int dimension) {
  for (const char* name : {"stress", "elastic", "skeleton"})
    if (const auto law = sides.law(side, name)) return stiffness_at_rest(*law, dimension);
  return 0;
}

/// Of the largest cell, m. Collective.
double cell_size(const Mesh& mesh) {
  double largest = 0;
  for (int c = 0; c < mesh.owned_cells(); ++c) largest = std::max(largest, mesh.diameter(c));
  return mesh.communicator().max(largest);
}

/// What `make` makes of the number of bodies that deform and of whether gaps are filled.
template <class Make>
auto choose(std::size_t bodies, bool filled, const Make& make) {
  using One = std::integral_constant<int, 1>;
  using Two = std::integral_constant<int, 2>;
  if (bodies == 1) return filled ? make(One{}, std::true_type{}) : make(One{}, std::false_type{});
  return filled ? make(Two{}, std::true_type{}) : make(Two{}, std::false_type{});
}

class MortarContact final : public Coupling {
 public:
  MortarContact(const Parameters& parameters, const Registry& registry)
      : parameters_(parameters),
        pressure_(parameters.text("on") + ".pressure"),
        law_(registry.create<ContactLaw>("contact_law", parameters.object("law"))) {}

  static Schema schema() {
    Schema s(
        "A body that touches another one or an obstacle, without friction: an unknown pressure on its "
        "surface "
        "keeps the gap from closing beyond zero, in the mean about each of its nodes.");
    s.reference("on",
                "Interface of type contact or obstacle: the body that looks, the slave, carries the pressure",
                "interface")
        .of_types({"contact", "obstacle"});
    s.typed("law", "What pressure and gap have to do with each other at a node", "contact_law")
        .otherwise("unilateral");
    s.boolean("filled",
              "Gaps of porous bodies are filled with fluid at the pressure in the pores, of the slave if it "
              "has some, "
              "and bodies part where their pressure on each other falls to it, thesis (5.10). Otherwise gaps "
              "are empty")
        .otherwise("true");
    s.number(
         "smoothing",
         "Gaps in the mean about a node are zero but for this, times the slope of the pressure's slope, the "
         "size of a cell to the third, over the stiffness of the bodies: of higher order than the error of "
         "displacements. With 0, contact with an edge of the other body may not be solvable")
        .otherwise("0.02")
        .at_least(0);
    s.number(
         "complementarity",
         "Weight of gaps beside pressures in deciding which nodes touch, over the body's stiffness by the "
         "size of its cells. Answers do not depend on it; with large ones, what an iteration leaves of gaps "
         "counts for "
         "more than pressures")
        .otherwise("1e-4")
        .above(0);
    return s;
  }

  [[nodiscard]] std::vector<Unknown> unknowns(int side, int,
                                              const std::vector<Unknown>& of_field) const override {
    // Of order 2 some functions are negative here and there: the mean gap about a node would say nothing.
    std::vector<Unknown> result = multiplier(pressure_, 1, 1, side, of_field);
    for (Unknown& unknown : result) {
      unknown.law = law_->rows(stiffness_);
      unknown.multiplier_of = "displacement";
    }
    return result;
  }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    require_displacements(sides);
    if (sides.fields.size() == 2 && sides.fields[0] == sides.fields[1])
      throw Error(
          parameters_.where("on"),
          fmt::format("field '{}' touches itself there, where it is not known which of its parts is to "
                      "carry the pressure; use the coupling `contact`, by Nitsche's method",
                      sides.fields[0]->name()));
    // Laws of the bodies are known only now, long after that of the unknown has been asked for.
    *stiffness_ = parameters_.number("complementarity") * stiffness_of(sides);
    return {{choose(sides.fields.size(), filling(sides) >= 0,
                    [smoothing = parameters_.number("smoothing") * compliance_of(sides)](
                        auto bodies, auto filled) { return make_term(Pressed<bodies, filled>{smoothing}); }),
             operands(sides)}};
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    const double rounding = 1e-12 * stiffness_of(sides) * cell_size(sides.fields[0]->mesh());
    const auto measure = [&](const std::string& name, Number number, MeasureOf of, int component = 0) {
      auto quantity = choose(sides.fields.size(), filling(sides) >= 0, [&](auto bodies, auto filled) {
        return make_quantity(State<bodies, filled>{number, component, rounding});
      });
      return Measure{name, {{std::move(quantity), operands(sides)}}, of};
    };
    std::vector<Measure> result{measure("gap", Number::gap, MeasureOf::least),
                                measure("overlap", Number::overlap, MeasureOf::norm),
                                measure("area", Number::touches, MeasureOf::integral),
                                measure("pressure", Number::pressure, MeasureOf::greatest)};
    constexpr std::array<const char*, 3> axis{".x", ".y", ".z"};
    const int dim = parameters_.dimension();
    for (int c = 0; c < dim; ++c)
      result.push_back(measure(std::string("force") + axis[c], Number::force, MeasureOf::integral, c));
    return result;
  }

 private:
  /// What gaps are multiplied by to stand beside pressures, Pa/m.
  [[nodiscard]] double stiffness_of(const CouplingSides& sides) const {
    for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side)
      if (const double found = modulus(sides, side, parameters_.dimension()); found > 0)
        return found / cell_size(sides.fields[side]->mesh());
    throw Error(parameters_.where("on"),
                "both bodies are rigid, or give no stress, so that nothing says where the pressure between "
                "them acts; one of them has to deform");
  }
  /// Of all bodies that deform, 1/Pa.
  [[nodiscard]] double compliance_of(const CouplingSides& sides) const {
    double result = 0;
    for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side)
      if (const double found = modulus(sides, side, parameters_.dimension()); found > 0) result += 1 / found;
    return result;
  }
  /// The side whose pores fill gaps; -1 for none.
  [[nodiscard]] int filling(const CouplingSides& sides) const {
    for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side)
      if (parameters_.boolean("filled") && sides.law(side, "pores")) return side;
    return -1;
  }
  [[nodiscard]] std::vector<Operand> operands(const CouplingSides& sides) const {
    std::vector<Operand> result{{0, "displacement"}, {0, pressure_}};
    if (sides.fields.size() == 2) result.push_back({1, "displacement"});
    if (const int side = filling(sides); side >= 0) result.push_back({side, "pressure"});
    return result;
  }
  Parameters parameters_;
  std::string pressure_;  ///< name of the unknown
  std::unique_ptr<ContactLaw> law_;
  std::shared_ptr<double> stiffness_ = std::make_shared<double>(1);  ///< of gaps beside pressures, Pa/m
};

/// Bodies do not overlap and do not hold on to each other: gap and pressure are not negative, and one of them
/// is zero (thesis (5.11), (5.12) without a pore pressure).
struct Unilateral {
  template <class T>
  T operator()(const T& pressure, const T& gap, double stiffness) const {
    return plain(pressure) - stiffness * plain(gap) >= 0 ? gap : pressure / stiffness;
  }
};

}  // namespace

void declare_contact(Registry& registry) {
  registry.add<ContactLaw>(
      "contact_law", "unilateral",
      Schema("Bodies press on each other where they touch, and part freely, without friction."),
      [](const Parameters&, const Registry&) { return make_contact_law(Unilateral{}); });
  registry.add<Coupling>(
      "coupling", "mortar_contact", MortarContact::schema(),
      [](const Parameters& p, const Registry& types) { return std::make_unique<MortarContact>(p, types); });
  registry.publishes(
      "coupling", "mortar_contact",
      {{Published::As::quantity, "pressure", "Pa", "between the bodies, on the one that carries it"},
       {Published::As::series, "gap", "m",
        "least gap; below 0 an overlap, infinite where nothing is opposite"},
       {Published::As::series, "overlap", "m m^((d-1)/2)", "L2 norm of the overlap"},
       {Published::As::series, "area", "m^(d-1)", "under pressure"},
       {Published::As::series, "pressure", "Pa", "greatest pressure"},
       {Published::As::series, "force.x", "N", "force on the body that carries the pressure"},
       {Published::As::series, "force.y", "N", "force on the body that carries the pressure"},
       {Published::As::series, "force.z", "N", "force on the body that carries the pressure"}});
}

}  // namespace seam::mortar
