// SPDX-License-Identifier: BSD-3-Clause
#include "coupling_sides.hpp"

#include <fmt/format.h>

#include <cmath>

#include "seam/field/field.hpp"
#include "trace_eigenvalue.hpp"

namespace seam::fsci {

Flow flow_of(const CouplingSides& sides) {
  const Field& fluid = *sides.fields[0];
  return {fluid.constant("density"), fluid.constant("viscosity"), fluid.constant("convection") != 0};
}

Ties ties_of(const Parameters& parameters) {
  const Parameters& penalty = parameters.object("penalty");
  return {adjoint_of(parameters), penalty.number("normal"), penalty.number("tangential")};
}

void declare_jump(Schema& jumps, const std::string& key, const std::string& of, const std::string& unit,
                  bool tensor) {
  const std::string rows = tensor ? ", row by row" : "";
  Schema s("A difference.");
  s.vector_expression("fluid", "Where the point is" + rows).unit(unit).entries(tensor ? -1 : 0).optional();
  s.vector_expression("body", "To be subtracted, at the body's material point" + rows)
      .unit(unit)
      .entries(tensor ? -1 : 0)
      .optional();
  jumps.object(key, of, s).optional();
}

Jump jump_of(const Parameters& jumps, const std::string& key, bool tensor) {
  Jump jump;
  if (!jumps.has(key)) return jump;
  const Parameters& given = jumps.object(key);
  if (given.has("fluid")) jump.fluid = given.vector_expression("fluid");
  if (given.has("body")) jump.body = given.vector_expression("body");
  const auto dim = static_cast<std::size_t>(jumps.dimension()), components = tensor ? dim * dim : dim;
  for (const auto* side : {&jump.fluid, &jump.body})
    if (!side->empty() && side->size() != components)
      throw Error(given.where(), fmt::format("found {} entries, expected {}", side->size(), components));
  return jump;
}

std::shared_ptr<const Law> law_of(const CouplingSides& sides, int side) {
  static_cast<void>(sides.fields.at(side)->place("displacement"));
  std::shared_ptr<const Law> law = sides.law(side, "stress");
  if (!law)
    throw Error(fmt::format(
        "the coupling needs bodies that make their stress known; field '{}' does not (a solid "
        "does, unless its formulation is mixed; contact of a porous one is `porous_contact_in_fluid`)",
        sides.fields[side]->name()));
  return law;
}

namespace {

/// What a rigid body has instead of the stiffness of its cells.
class GivenStiffness final : public CellConstant {
 public:
  explicit GivenStiffness(double stiffness) : stiffness_(stiffness) {}
  [[nodiscard]] Refresh refresh() const override { return Refresh::once; }
  [[nodiscard]] double compute(const CellTrace&) const override { return stiffness_; }

 private:
  double stiffness_;  ///< Pa/m
};

bool is_rigid(const CouplingSides& sides, int side) {
  static_cast<void>(sides.fields.at(side)->place("displacement"));
  return sides.fields[side]->has_constant("rigid");
}

}  // namespace

bool is_porous(const CouplingSides& sides, int side) { return sides.law(side, "mixture") != nullptr; }

std::shared_ptr<const CellConstant> scale_of(const Parameters& parameters, const CouplingSides& sides,
                                             int side) {
  if (is_rigid(sides, side))
    return std::make_shared<GivenStiffness>(
        parameters.has("surface_stiffness") ? parameters.number("surface_stiffness") : 0.0);
  return std::make_shared<TraceEigenvalue>(
      is_porous(sides, side) ? sides.law(side, "skeleton") : law_of(sides, side), scaling_of(parameters));
}

void declare_stress(Schema& schema) {
  schema
      .choice("stress",
              "Whose stress stands for that between the bodies: that of `both`, weighted, or of one",
              {"both", "own", "other"})
      .otherwise("both");
}

void declare_surface_stiffness(Schema& schema) {
  schema.number("surface_stiffness", "Between two rigid bodies: pressure per overlap")
      .unit("Pa/m")
      .above(0)
      .optional();
}

namespace {

using Neighbour = Coupling::Neighbour;

/// The couplings of the same type that look from the other body back at this one's.
std::vector<const Neighbour*> looks_back(const std::vector<Neighbour>& all, std::size_t self) {
  std::vector<const Neighbour*> result;
  std::vector<std::string> fields = all[self].fields;
  if (fields.size() < 2) return result;  // a rigid obstacle does not look back
  std::swap(fields.back(), fields[fields.size() - 2]);
  for (const Neighbour& other : all)
    if (other.parameters.type() == all[self].parameters.type() && other.fields == fields)
      result.push_back(&other);
  return result;
}

void check_stresses(const Neighbour& self, const std::vector<const Neighbour*>& back) {
  const Parameters& mine = self.parameters;
  const auto whose_of = [](const Parameters& p) { return p.has("stress") ? p.text("stress") : "both"; };
  const std::string whose = whose_of(mine);
  if (whose == "both") return;
  for (const Neighbour* other : back) {
    if (whose_of(other->parameters) != whose) continue;
    throw Error(
        mine.where("stress"),
        fmt::format("`stress: {}` on both looks of '{}' and '{}' at each other: each body is told "
                    "that {} stress is the right one, and forces do not balance; write `own` in one "
                    "of the two couplings and `other` in the other one, or `both` in both. The other "
                    "one stands at {}",
                    whose, self.fields.back(), self.fields[self.fields.size() - 2],
                    whose == "own" ? "its own" : "the other's", other->parameters.where("stress").text()));
  }
}

/// Each rigid body is pushed with the stiffness of its own look: a difference is a force out of nothing. Of
/// bodies that may touch at several places one of the looks back has to agree.
void check_stiffnesses(const Neighbour& self, const std::vector<const Neighbour*>& back) {
  const Parameters& mine = self.parameters;
  const auto acts_back = [](const Parameters& p) { return p.has("acts_on") && p.text("acts_on") == "both"; };
  if (!mine.has("surface_stiffness")) return;
  const double stiffness = mine.number("surface_stiffness");
  const Parameters* differs = nullptr;
  for (const Neighbour* other : back) {
    const Parameters& p = other->parameters;
    if (!p.has("surface_stiffness") || (acts_back(mine) && acts_back(p))) continue;
    constexpr double rounding = 1e-12;
    if (std::abs(p.number("surface_stiffness") - stiffness) <= rounding * stiffness) return;
    differs = &p;
  }
  if (differs == nullptr) return;
  throw Error(
      mine.where("surface_stiffness"),
      fmt::format(
          "a `surface_stiffness` of {:.6g} Pa/m where '{}' looks at '{}', and of {:.6g} Pa/m where that "
          "looks back, at {}: each body is pushed with its own, so that forces do not balance and "
          "energy comes from nothing; expected the same in both",
          stiffness, self.fields[self.fields.size() - 2], self.fields.back(),
          differs->number("surface_stiffness"), differs->where("surface_stiffness").text()));
}

}  // namespace

void check_looks(const std::vector<Neighbour>& all, std::size_t self) {
  const std::vector<const Neighbour*> back = looks_back(all, self);
  check_stresses(all[self], back);
  check_stiffnesses(all[self], back);
}

BodyPull body_pull(const Parameters& parameters, const CouplingSides& sides, int own, int other,
                   double penalty) {
  const bool own_rigid = is_rigid(sides, own), other_rigid = other < 0 || is_rigid(sides, other);
  const bool stiff = parameters.has("surface_stiffness");
  if (own_rigid && other_rigid) {
    if (!stiff)
      throw Error(parameters.where(),
                  "two bodies that are rigid have no stress that would hold them apart: give a "
                  "`surface_stiffness`, the pressure per overlap");
    return {nullptr, nullptr, 1, Whose::own};
  }
  if (stiff)
    throw Error(parameters.where("surface_stiffness"),
                "`surface_stiffness` is for two rigid bodies; here one deforms, and its stiffness counts");
  if (other_rigid) return {law_of(sides, own), nullptr, penalty, Whose::own};
  if (own_rigid)
    return {nullptr, is_porous(sides, other) ? sides.law(other, "mixture") : law_of(sides, other), penalty,
            Whose::other};
  const std::string& name = parameters.text("stress");
  if (is_porous(sides, other)) {
    if (name != "other")
      throw Error(
          parameters.where("stress"),
          fmt::format("the stress between a body and the porous one '{}' is that of the porous one: write "
                      "`stress: other`",
                      sides.fields[other]->name()));
    return {nullptr, sides.law(other, "mixture"), penalty, Whose::other};
  }
  const Whose whose = name == "both" ? Whose::both : (name == "own" ? Whose::own : Whose::other);
  return {law_of(sides, own), law_of(sides, other), penalty, whose};
}

}  // namespace seam::fsci
