// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/contact_interface.hpp"

#include <fmt/ranges.h>

#include "seam/contact/contact_domain.hpp"
#include "seam/contact/embedded_surface.hpp"
#include "seam/cut/cut_boundary.hpp"

namespace seam {
namespace {

void declare_window(Schema& s) {
  s.number("reach", "How far apart surfaces are seen to face each other; default two of the body's cells")
      .unit("m")
      .above(0)
      .optional();
  s.number("depth",
           "How far they may have overlapped, less than the thickness of what may touch; default half of the "
           "body's largest cell, or of its smallest where it may touch itself")
      .unit("m")
      .above(0)
      .optional();
}

/// The keys of a surface that looks at another one. @param own the key that names the body
void declare_surfaces(Schema& s, const std::string& own) {
  s.names("boundaries", "Parts of the boundary of `" + own + "`; default all")
      .naming("boundary:" + own)
      .otherwise("[]");
  s.names("opposite", "Parts of the boundary of `to`; default all").naming("boundary:to").otherwise("[]");
  declare_window(s);
}

/// Cells of a surface differ in size: the smallest one behind it says how deep another may safely be.
ContactWindow window(const Parameters& parameters, const BodySurface& surface, bool with_itself) {
  double smallest = std::numeric_limits<double>::max(), largest = 0;
  for (int g = 0; g < surface.group_count(); ++g) {
    smallest = std::min(smallest, surface.cell(g).diameter);
    largest = std::max(largest, surface.cell(g).diameter);
  }
  const double reach = parameters.has("reach") ? parameters.number("reach") : 2 * largest;
  const double depth = (with_itself ? smallest : largest) / 2;
  return {reach, parameters.has("depth") ? parameters.number("depth") : depth};
}

std::shared_ptr<const BodySurface> body_surface(const Parameters& parameters, const std::string& key,
                                                const std::string& boundaries, InterfaceSetup& setup,
                                                int side, const std::vector<Backing>& backing = {}) {
  const std::string displacement = setup.displacement(side);
  if (displacement.empty())
    throw Error(parameters.where(key),
                fmt::format("field '{}' has no displacement, so that it has no surface that moves",
                            parameters.text(key)));
  return std::make_shared<const BodySurface>(*setup.sides[side], parameters.names(boundaries), displacement,
                                             backing);
}

struct Surfaces {
  std::shared_ptr<const BodySurface> own, other;
  ContactWindow range;
};
/// @param side of the body; the other one's is the next @param own the key that names the body
Surfaces surfaces(const Parameters& parameters, const std::string& own, InterfaceSetup& setup, int side,
                  const std::vector<Backing>& backing = {}) {
  Surfaces result{body_surface(parameters, own, "boundaries", setup, side, backing), nullptr, {}};
  const bool with_itself = setup.sides[side] == setup.sides[side + 1];
  const bool same = with_itself && parameters.names("boundaries") == parameters.names("opposite");
  result.other = same ? result.own : body_surface(parameters, "to", "opposite", setup, side + 1);
  result.range = window(parameters, *result.own, with_itself);
  return result;
}

/// Beyond the traces' own degree, for a pressure that sets in within a facet.
constexpr int pressure_degree = 2;

}  // namespace

Schema ContactInterface::schema() {
  Schema s("A deforming body's surface and what lies opposite to it, on another body or on itself.");
  s.reference("from", "The body whose points look for opposite ones", "field");
  s.reference("to", "The body on which these are; may be the same", "field");
  declare_surfaces(s, "from");
  return s;
}

std::vector<InterfacePart> ContactInterface::build(InterfaceSetup& setup) const {
  const Surfaces both = surfaces(parameters_, "from", setup, 0);
  return {{"", std::make_shared<ContactDomain>(both.own, both.other, MovingSurface{}, both.range,
                                               setup.degree + setup.extra_degree + pressure_degree)}};
}

Schema ObstacleInterface::schema() {
  Schema s("A deforming body's surface and what lies opposite to it on a rigid body of given motion.");
  s.reference("from", "The body whose points look for opposite ones", "field");
  s.names("boundaries", "Parts of its boundary; default all").naming("boundary:from").otherwise("[]");
  MovingBody::declare(s);
  declare_window(s);
  return s;
}

std::vector<InterfacePart> ObstacleInterface::build(InterfaceSetup& setup) const {
  const auto own = body_surface(parameters_, "from", "boundaries", setup, 0);
  const MeshFinder meshes = [&](const std::string& name) { return setup.mesh(name); };
  return {{"", std::make_shared<ContactDomain>(
                   own, nullptr, obstacle_.surface({setup.sides[0]->mesh(), meshes}),
                   window(parameters_, *own, false), setup.degree + setup.extra_degree + pressure_degree)}};
}

NonMatchingInterface::NonMatchingInterface(const Parameters& parameters) : parameters_(parameters) {
  for (const char* key : {"fields", "boundaries"})
    if (parameters_.names(key).size() != 2)
      throw Error(parameters_.where(key),
                  fmt::format("found {} names; an interface of type non_matching lies between two fields and "
                              "has a boundary of each",
                              parameters_.names(key).size()));
  if (fields()[0] == fields()[1])
    throw Error(
        parameters_.where("fields"),
        fmt::format(
            "found '{}' twice; an interface of type non_matching lies between two fields. Boundaries of "
            "one field are tied by the constraint `tied` or `periodic`",
            fields()[0]));
}

Schema NonMatchingInterface::schema() {
  Schema s(
      "Two boundaries that lie on each other in the reference configuration, whose faces need not coincide.");
  s.names("fields", "The two fields; the first one's points look for opposite ones").naming("field");
  s.names("boundaries", "A boundary of the first field's mesh and one of the second's");
  return s;
}

std::vector<InterfacePart> NonMatchingInterface::build(InterfaceSetup& setup) const {
  std::vector<std::shared_ptr<const BodySurface>> surface;
  for (int side = 0; side < 2; ++side) {
    Field& field = *setup.sides[side];
    const auto& known = field.mesh().boundaries();
    if (!known.contains(boundaries(side).front())) {
      std::vector<std::string> names;
      for (const auto& entry : known) names.push_back(entry.first);
      throw Error(parameters_.where("boundaries"),
                  fmt::format("mesh '{}' of field '{}' has no boundary '{}'; it has: {}", field.mesh().name(),
                              field.name(), boundaries(side).front(), fmt::join(names, ", ")));
    }
    const auto unknown = std::ranges::find_if(field.unknowns(), [&](const Unknown& u) {
      return u.order == field.mesh().order() && !u.given && !u.boundaries;
    });
    if (unknown == field.unknowns().end())
      throw Error(
          parameters_.where("fields"),
          fmt::format("the mesh of field '{}' has order {}, and so has none of its unknowns; give the "
                      "mesh the order of one",
                      field.name(), field.mesh().order()));
    surface.push_back(std::make_shared<const BodySurface>(field, boundaries(side), unknown->name));
  }
  // Curved boundaries of different meshes are chords that lie apart by less than this.
  double largest = 0;
  for (const auto& one : surface)
    for (int g = 0; g < one->group_count(); ++g) largest = std::max(largest, one->cell(g).diameter);
  const auto domain = std::make_shared<ContactDomain>(
      surface[0], surface[1], ContactWindow{largest / 2, largest / 2}, setup.degree + setup.extra_degree);
  domain->follow(0);
  if (setup.sides[0]->mesh().communicator().sum(static_cast<double>(domain->size())) == 0)
    throw Error(
        parameters_.where("boundaries"),
        fmt::format("boundary '{}' of field '{}' and boundary '{}' of field '{}' do not lie on each other: "
                    "no point of the first one has one of the second opposite to it, nearer than {:.3g} m, "
                    "half a cell",
                    boundaries(0).front(), setup.sides[0]->name(), boundaries(1).front(),
                    setup.sides[1]->name(), largest / 2));
  return {{"", domain}};
}

Schema EmbeddedContactInterface::schema() {
  Schema s("A deforming body's surface, cut out of a field's mesh, and what lies opposite to it.");
  s.reference("field", "The field outside the bodies", "field");
  s.reference("body", "The body whose surface it is", "field");
  s.reference("to", "The body that it may come to touch; may be the same", "field");
  declare_surfaces(s, "body");
  declare_backing(s, "body");
  return s;
}

std::vector<InterfacePart> EmbeddedContactInterface::build(InterfaceSetup& setup) const {
  const Surfaces both = surfaces(parameters_, "body", setup, 1, backing_of(parameters_));
  FieldCut& cut = setup.cut(0);
  const int number = cut.add_body([own = both.own](double) { return own->now(); }, both.own->body().name());
  if (setup.sides[1]->law("pores", 0)) cut.keep_at(number);
  const auto surface = std::make_shared<EmbeddedSurface>(*setup.sides[0], cut, number, both.own, both.other,
                                                         both.range, facet_degree(setup));
  const auto part = [&](EmbeddedSurface::Zone which) {
    return std::make_shared<EmbeddedZone>(surface, which);
  };
  return {{"free", part(EmbeddedSurface::free)},
          {"near", part(EmbeddedSurface::near)},
          {"closed", part(EmbeddedSurface::closed), false},
          {"shut", part(EmbeddedSurface::shut), false},
          {"covered", part(EmbeddedSurface::covered), false}};
}

void register_contact(Registry& registry) {
  registry.add<Interface>(
      "interface", "contact", ContactInterface::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<ContactInterface>(p); });
  registry.add<Interface>(
      "interface", "non_matching", NonMatchingInterface::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<NonMatchingInterface>(p); });
  registry.add<Interface>("interface", "obstacle", ObstacleInterface::schema(),
                          [](const Parameters& p, const Registry& types) {
                            return std::make_unique<ObstacleInterface>(p, types);
                          });
  registry.add<Interface>(
      "interface", "embedded_contact", EmbeddedContactInterface::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<EmbeddedContactInterface>(p); });
}

}  // namespace seam
