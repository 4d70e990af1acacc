// SPDX-License-Identifier: BSD-3-Clause
#include "porous_contact.hpp"

#include <fmt/format.h>

#include "coupling_sides.hpp"
#include "porous_contact_kernels.hpp"
#include "porous_contact_measures.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"
#include "trace_eigenvalue.hpp"

namespace seam::fsci {
namespace {

using SideTerm = Coupling::SideTerm;

const std::vector<Operand> free_operands{
    {0, "velocity"}, {0, "pressure"}, {1, "displacement"}, {1, "velocity"}, {1, "pressure"}};

/// What the terms of a part that faces another body stand for: up to what they speak of.
/// @param edge the side of operand 6, of closed parts; else that of the body itself
std::vector<Operand> facing(std::vector<Operand> result, bool porous, int edge = 1) {
  result.push_back({2, "displacement"});
  if (porous || edge != 1) result.push_back({edge, "displacement"});
  if (porous) result.push_back({2, "pressure"});
  return result;
}

/// The fluid is not met there.
const std::vector<Operand> covered_operands{
    {1, "velocity"}, {1, "pressure"}, {1, "displacement"}, {1, "velocity"}, {1, "pressure"}};

/// A porous body in a fluid that may touch another one.
class PorousContact final : public Coupling {
 public:
  explicit PorousContact(const Parameters& parameters) : parameters_(parameters) {}

  static Schema schema() {
    Schema s(
        "A fluid and a porous body that it flows along, into and out of, and that body's contact without "
        "friction with another one, which lets nothing through or is porous, too: then each of both looks at "
        "the other by a coupling of this type, and what leaves the pores of one enters those of the other. "
        "Where the body's surface is not in the fluid's mesh, it is tight.");
    s.reference("on", "Interface of type embedded_contact: the surface of the porous body", "interface")
        .of_types({"embedded_contact"});
    s.number("alpha",
             "Of Beavers and Joseph: the slip length is sqrt(tr k/3)/alpha, thesis (2.65); .inf is no slip")
        .otherwise("1")
        .above(0)
        .or_infinite();
    s.choice("slip_against",
             "What the fluid slips along: the `mixture` of skeleton and seepage (Beavers and Joseph), or the "
             "`skeleton` (Saffmann)",
             {"mixture", "skeleton"})
        .otherwise("mixture");
    Schema slip(
        "Slip that grows without bound as a gap closes, thesis (7.35): factor reach (reach/gap - 1).");
    slip.number("factor", "kappa_0; 0 leaves only that of the pores until the surfaces touch")
        .otherwise("0.1")
        .at_least(0);
    slip.number("reach", "The gap below which it sets in; default the width of the fluid's cell")
        .unit("m")
        .above(0)
        .optional();
    s.object("near_slip", "Additional slip near the other surface", slip).otherwise("{}");
    s.choice("stress",
             "Against a porous body: whose stress stands for that between the bodies, that of `both`, "
             "weighted, or of one; default both. Against another one it is the porous one's own",
             {"both", "own", "other"})
        .optional();
    Schema seal("How the pores close where the bodies touch.");
    seal.choice("by",
                "`resistance` of a layer that thickens as the gap closes: what pores lose the fluid gets; "
                "`smoothing`: thesis (7.28), which loses part of the seepage; `switch`: open until a point "
                "is dry",
                {"resistance", "smoothing", "switch"})
        .otherwise("resistance");
    seal.number("width", "The gap at which it begins; default a hundredth of the fluid's cell")
        .unit("m")
        .above(0)
        .optional();
    seal.number(
            "dry",
            "Points whose gap at the start of a step was narrower are sealed; between porous bodies, with "
            "the extension `constant`, they are open to each other and not to the film")
        .unit("m")
        .otherwise("0")
        .at_least(0);
    s.object("seal", "How the pores close where the bodies touch; between porous ones they stay open", seal)
        .otherwise("{}");
    s.choice(
         "extension",
         "What the fluid's traction is where the bodies are closed: beyond one cell of the fluid from the "
         "nearest wet point the `pore_pressure`, thesis (7.30), or that of this point, `constant`, (7.29)",
         {"pore_pressure", "constant"})
        .otherwise("constant");
    declare_adjoint(s);
    Schema penalty("Factors of Nitsche's penalty.");
    penalty.number("normal", "For the velocity across the interface, thesis (3.26)").otherwise("35").above(0);
    penalty.number("tangential", "For the velocity along it").otherwise("35").above(0);
    penalty.number("contact", "gamma_0 of contact, thesis (6.17)").otherwise("1").above(0);
    s.object("penalty", "Factors of Nitsche's penalty", penalty).otherwise("{}");
    declare_scaling(s, "once");
    return s;
  }

  /// As `fpi`.
  [[nodiscard]] int extra_degree(int dimension) const override { return dimension == 2 ? 4 : 1; }

  [[nodiscard]] std::vector<Brought> brings(const CouplingSides&) const override { return {{1, "seepage"}}; }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    std::vector<SideTerm> result{{make_term(film<Facing::nothing>(sides), 1), free_operands, {}, "free"},
                                 {make_term(PorousCovered{body(sides)}, 1), covered_operands, {}, "covered"}};
    for (SideTerm& term :
         is_porous(sides, 2) ? contact<Facing::porous>(sides) : contact<Facing::tight>(sides))
      result.push_back(std::move(term));
    return result;
  }

  void check_beside(const std::vector<Neighbour>& all, std::size_t self) const override {
    check_looks(all, self);
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    return is_porous(sides, 2) ? measures_of<Facing::porous>(sides) : measures_of<Facing::tight>(sides);
  }

 private:
  template <Facing facing>
  [[nodiscard]] std::vector<SideTerm> contact(const CouplingSides& sides) const {
    const Places at = places(sides);
    const std::vector<SideConstant> scale = scales(sides);
    return {{make_term(film<facing>(sides), 1), at.near, scale, "near"},
            {make_term(closed<facing>(sides), 1), at.closed, scale, "closed"},
            {make_term(PorousShut<facing>{body(sides), fades()}, 1), at.shut, scale, "shut"}};
  }

  template <Facing facing>
  [[nodiscard]] std::vector<Measure> measures_of(const CouplingSides& sides) const {
    const Places at = places(sides);
    const std::vector<SideConstant> scale = scales(sides);
    const PorousFilm<Facing::nothing> open = film<Facing::nothing>(sides);
    const PorousFilm<facing> near = film<facing>(sides);
    const PorousClosed<facing> dry = closed<facing>(sides);
    const PorousShut<facing> shut{body(sides), fades()};
    const auto wet = [&](FilmNumber number, int component = 0) {
      return std::vector<SideTerm>{
          {make_quantity(FilmMeasure<Facing::nothing>{open, number, component}), free_operands, {}, "free"},
          {make_quantity(FilmMeasure<facing>{near, number, component}), at.near, scale, "near"}};
    };
    const auto touching = [&](TouchNumber number, int component = 0) {
      return std::vector<SideTerm>{
          {make_quantity(NearTouch<facing>{near, number, component}), at.near, scale, "near"},
          {make_quantity(DryTouch<facing, PorousClosed<facing>>{dry, number, component}), at.closed, scale,
           "closed"},
          {make_quantity(DryTouch<facing, PorousShut<facing>>{shut, number, component}), at.shut, scale,
           "shut"}};
    };
    std::vector<Measure> result{{"mismatch_across", wet(FilmNumber::across)},
                                {"mismatch_along", wet(FilmNumber::along)},
                                {"seepage", wet(FilmNumber::seepage), MeasureOf::integral},
                                {"dropped", wet(FilmNumber::dropped), MeasureOf::integral},
                                {"body_outflow", wet(FilmNumber::body), MeasureOf::integral},
                                {"gap", touching(TouchNumber::gap), MeasureOf::least},
                                {"contact_area", touching(TouchNumber::touches), MeasureOf::integral},
                                {"contact_pressure", touching(TouchNumber::pressure), MeasureOf::greatest},
                                {"effective_pressure", touching(TouchNumber::effective), MeasureOf::least}};
    result.push_back(
        {"into_gaps",
         {{make_quantity(IntoGaps<facing, PorousClosed<facing>>{dry}), at.closed, scale, "closed"},
          {make_quantity(IntoGaps<facing, PorousShut<facing>>{shut}), at.shut, scale, "shut"}},
         MeasureOf::integral});
    if constexpr (facing == Facing::porous)
      result.push_back(
          {"seepage_through",
           {{make_quantity(FilmMeasure<facing>{near, FilmNumber::through}), at.near, scale, "near"},
            {make_quantity(SeepageThrough<PorousClosed<facing>>{dry}), at.closed, scale, "closed"},
            {make_quantity(SeepageThrough<PorousShut<facing>>{shut}), at.shut, scale, "shut"}},
           MeasureOf::integral});
    constexpr const char* axis[] = {".x", ".y", ".z"};
    for (int c = 0; c < parameters_.dimension(); ++c) {
      result.push_back(
          {std::string("contact_force") + axis[c], touching(TouchNumber::traction, c), MeasureOf::integral});
      std::vector<SideTerm> all = wet(FilmNumber::traction, c);
      all.push_back({make_quantity(TractionOf<PorousClosed<facing>>{dry, c}), at.closed, scale, "closed"});
      all.push_back({make_quantity(TractionOf<PorousShut<facing>>{shut, c}), at.shut, scale, "shut"});
      result.push_back({std::string("force") + axis[c], std::move(all), MeasureOf::integral});
    }
    return result;
  }

  /// What the operands of the parts that face another body stand for.
  struct Places {
    std::vector<Operand> near, closed, shut;
  };
  [[nodiscard]] static Places places(const CouplingSides& sides) {
    const bool porous = is_porous(sides, 2);
    return {facing(free_operands, porous), facing(free_operands, porous, 3),
            facing(covered_operands, porous)};
  }
  [[nodiscard]] Seal seal() const {
    const Parameters& seal = parameters_.object("seal");
    const std::string& by = seal.text("by");
    return {by == "resistance" ? Seal::Kind::resistance
                               : (by == "switch" ? Seal::Kind::sudden : Seal::Kind::printed),
            seal.has("width") ? seal.number("width") : 0.0, seal.number("dry")};
  }
  [[nodiscard]] PorousSide body(const CouplingSides& sides) const {
    const std::shared_ptr<const Law> pores = sides.law(1, "pores"), mixture = sides.law(1, "mixture");
    if (!pores || !mixture)
      throw Error(
          fmt::format("`porous_contact_in_fluid` needs a porous body; field '{}' does not make known what "
                      "its pores and the "
                      "stress of its mixture are (a porous_solid does)",
                      sides.fields[1]->name()));
    return {{pores, {}, parameters_.text("slip_against") == "skeleton"},
            {mixture, sides.law(2, "mixture"), parameters_.object("penalty").number("contact"), whose(sides)},
            flow_of(sides).viscosity,
            seal()};
  }
  [[nodiscard]] Whose whose(const CouplingSides& sides) const {
    if (!is_porous(sides, 2)) return Whose::own;
    if (!parameters_.has("stress") || parameters_.text("stress") == "both") return Whose::both;
    return parameters_.text("stress") == "own" ? Whose::own : Whose::other;
  }
  template <Facing facing>
  [[nodiscard]] PorousFilm<facing> film(const CouplingSides& sides) const {
    const Parameters& near = parameters_.object("near_slip");
    return {flow_of(sides),
            body(sides),
            Slip{0, near.number("factor"), near.has("reach") ? near.number("reach") : 0.0},
            parameters_.number("alpha"),
            ties_of(parameters_),
            fades()};
  }
  template <Facing facing>
  [[nodiscard]] PorousClosed<facing> closed(const CouplingSides& sides) const {
    return {{flow_of(sides), parameters_.object("penalty").number("normal")}, body(sides), fades()};
  }
  [[nodiscard]] bool fades() const { return parameters_.text("extension") == "pore_pressure"; }
  [[nodiscard]] std::vector<SideConstant> scales(const CouplingSides& sides) const {
    std::vector<SideConstant> result{{1, scale_of(parameters_, sides, 1)}};
    if (is_porous(sides, 2)) result.push_back({2, scale_of(parameters_, sides, 2)});
    return result;
  }
  Parameters parameters_;
};

}  // namespace

void declare_porous_contact(Registry& registry) {
  registry.add<Coupling>(
      "coupling", "porous_contact_in_fluid", PorousContact::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<PorousContact>(p); });
  registry.publishes(
      "coupling", "porous_contact_in_fluid",
      {{Published::As::series, "mismatch_across", "m/s m^((d-1)/2)",
        "L2 norm of what the condition across the interface leaves"},
       {Published::As::series, "mismatch_along", "m/s m^((d-1)/2)",
        "L2 norm of what the condition along it leaves"},
       {Published::As::series, "seepage", "m^d/s", "rate at which fluid enters or leaves the pores"},
       {Published::As::series, "dropped", "m^d/s",
        "rate at which `smoothing` or `switch` lose fluid between film and pores"},
       {Published::As::series, "into_gaps", "m^d/s",
        "rate at which pores fill gaps that open where no fluid is, between porous bodies this look's half"},
       {Published::As::series, "seepage_through", "m^d/s",
        "between porous bodies: this look's half of what leaves the pores for those opposite"},
       {Published::As::series, "body_outflow", "m^d/s", "rate at which the wet surface itself moves out"},
       {Published::As::series, "gap", "m",
        "least gap; below 0 an overlap, infinite where nothing is opposite"},
       {Published::As::series, "contact_area", "m^(d-1)", "in touch"},
       {Published::As::series, "contact_pressure", "Pa", "greatest pressure of contact"},
       {Published::As::series, "effective_pressure", "Pa",
        "where they touch the least of what the skeletons carry, the pressure of contact less that of the "
        "pores; below 0 the pores would push them apart; infinite where nothing touches"},
       {Published::As::series, "contact_force.x", "N", "force of contact on the body"},
       {Published::As::series, "force.x", "N", "force of contact and fluid on the body"},
       {Published::As::series, "contact_force.y", "N", "force of contact on the body"},
       {Published::As::series, "force.y", "N", "force of contact and fluid on the body"},
       {Published::As::series, "contact_force.z", "N", "force of contact on the body"},
       {Published::As::series, "force.z", "N", "force of contact and fluid on the body"}});
}

}  // namespace seam::fsci
