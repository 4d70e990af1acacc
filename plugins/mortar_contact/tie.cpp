// SPDX-License-Identifier: BSD-3-Clause
#include "tie.hpp"

#include <array>

#include "multiplier.hpp"
#include "pores.hpp"
#include "seam/field/field.hpp"
#include "seam/term/kernel_term.hpp"

namespace seam::mortar {
namespace {

using Slave = Vector<0>;
using Traction = Vector<1>;
using Master = Vector<2>;

/// Holds two bodies together by the traction t on the slave side, per area at rest: with u the slave's
/// displacement and u' that of the point opposite to it at rest,
///
///   -<du - du', t> - <dt, u - u'>.
///
/// Popp, Mortar methods for computational contact mechanics and general interface problems (2012), 3.2; the
/// traction has the opposite sign of his multiplier.
struct Tied {
  using Reads = Slots<Value<Slave>, Value<Traction>, Value<Master>>;
  using Tests = Reads;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, T> traction = s.value(Traction{});
    r.value(Slave{}) -= traction;
    r.value(Master{}) += traction;
    r.value(Traction{}) -= s.value(Slave{}) - s.value(Master{});
  }
};

/// u - u', m.
struct Apart {
  using Reads = Tied::Reads;
  static constexpr int values(int dim) { return dim; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const Vec<dim, double> jump = s.value(Slave{}) - s.value(Master{});
    std::copy(jump.c.begin(), jump.c.end(), value);
  }
};

/// A component of the traction, Pa.
struct Component {
  using Reads = Tied::Reads;
  static constexpr int values(int) { return 1; }
  int number;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = s.value(Traction{})[number];
  }
};

class MortarTie final : public Coupling {
 public:
  explicit MortarTie(const Parameters& parameters)
      : parameters_(parameters),
        traction_(parameters.text("on") + ".traction"),
        pressure_(parameters.text("on") + ".pressure") {}

  static Schema schema() {
    Schema s(
        "Bodies that are grown together though their meshes do not match: an unknown traction on the first "
        "one's boundary keeps them from moving apart, in the mean about each of its nodes.");
    s.reference("on", "Interface of type non_matching: its first field carries the traction", "interface")
        .of_types({"non_matching"});
    s.boolean("sealed", "Of two porous bodies: nothing seeps from one to the other. To a solid nothing does")
        .otherwise("false");
    return s;
  }

  [[nodiscard]] std::vector<Unknown> unknowns(int side, int dimension,
                                              const std::vector<Unknown>& of_field) const override {
    std::vector<Unknown> result = multiplier(traction_, dimension, 2, side, of_field);
    for (Unknown& unknown : result) unknown.multiplier_of = "displacement";
    // Of no use where the other body is no porous one: then nothing speaks of it.
    const auto is_there = [&](const char* name) {
      return std::ranges::count(of_field, name, &Unknown::name) > 0;
    };
    if (is_there("velocity") && is_there("pressure") && !parameters_.boolean("sealed"))
      for (Unknown& unknown : multiplier(pressure_, 1, 1, side, of_field))
        result.push_back(std::move(unknown));
    return result;
  }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    require_displacements(sides);
    std::vector<SideTerm> result{{make_term(Tied{}), operands()}};
    if (opens(sides)) {
      result.push_back({make_term(pores(sides), pore_degree), pore_operands()});
      return result;
    }
    for (int side = 0; side < 2; ++side)
      if (sides.law(side, "pores"))
        result.push_back({make_term(SealedPores{side == 0 ? 1.0 : -1.0}, pore_degree),
                          {{side, "displacement"}, {side, "velocity"}, {side, "pressure"}}});
    return result;
  }

  [[nodiscard]] std::vector<Brought> brings(const CouplingSides& sides) const override {
    std::vector<Brought> result;
    for (int side = 0; side < 2; ++side)
      if (sides.law(side, "pores")) result.push_back({side, "seepage"});
    return result;
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    std::vector<Measure> result{{"apart", {{make_quantity(Apart{}), operands()}}}};
    constexpr std::array<const char*, 3> axis{".x", ".y", ".z"};
    for (int c = 0; c < parameters_.dimension(); ++c)
      result.push_back(
          {std::string("force") + axis[c], {{make_quantity(Component{c}), operands()}}, MeasureOf::integral});
    if (opens(sides))
      result.push_back(
          {"seepage", {{make_quantity(Seeping{pores(sides)}), pore_operands()}}, MeasureOf::integral});
    return result;
  }

 private:
  /// Degree that porosity and area add to integrands.
  static constexpr int pore_degree = 4;
  /// Whether pores meet pores.
  [[nodiscard]] bool opens(const CouplingSides& sides) const {
    return sides.law(0, "pores") && sides.law(1, "pores") && !parameters_.boolean("sealed");
  }
  static TiedPores pores(const CouplingSides& sides) {
    return {sides.law(0, "pores"), sides.law(1, "pores")};
  }
  [[nodiscard]] std::vector<Operand> pore_operands() const {
    return {{0, "displacement"}, {0, "velocity"}, {0, "pressure"}, {0, pressure_},
            {1, "displacement"}, {1, "velocity"}, {1, "pressure"}};
  }
  [[nodiscard]] std::vector<Operand> operands() const {
    return {{0, "displacement"}, {0, traction_}, {1, "displacement"}};
  }
  Parameters parameters_;
  std::string traction_, pressure_;  ///< names of the unknowns
};

}  // namespace

void declare_tie(Registry& registry) {
  registry.add<Coupling>("coupling", "mortar_tie", MortarTie::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<MortarTie>(p); });
  registry.publishes(
      "coupling", "mortar_tie",
      {{Published::As::quantity, "traction", "Pa", "on the first field's body, per area at rest"},
       {Published::As::quantity, "pressure", "Pa", "in the pores, of two porous bodies"},
       {Published::As::series, "apart", "m m^((d-1)/2)", "L2 norm of the difference of the displacements"},
       {Published::As::series, "seepage", "m^d/s",
        "fluid that passes out of the first field's pores into the other's"},
       {Published::As::series, "force.x", "N", "force through the tie on the first field's body"},
       {Published::As::series, "force.y", "N", "force through the tie on the first field's body"},
       {Published::As::series, "force.z", "N", "force through the tie on the first field's body"}});
}

}  // namespace seam::mortar
