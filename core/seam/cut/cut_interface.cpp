// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cut_interface.hpp"

#include "seam/cut/cut_boundary.hpp"
#include "seam/cut/embedded_interface.hpp"
#include "seam/cut/level_set.hpp"

namespace seam {

Schema CutInterface::schema() {
  Schema s("The boundary of a body of given shape and motion, cut out of a field's mesh.");
  s.reference("field", "The field that lies outside the body", "field");
  MovingBody::declare(s);
  return s;
}

std::optional<Surface> CutInterface::body(const BodySetting& setting, double time) const {
  return body_.surface(setting)(time);
}

std::vector<InterfacePart> CutInterface::build(InterfaceSetup& setup) const {
  Field& field = *setup.sides[0];
  const MeshFinder meshes = [&](const std::string& name) { return setup.mesh(name); };
  FieldCut& cut = setup.cut(0);
  return {{"", std::make_shared<CutBoundary>(field, cut, cut.add_body(body_.surface({field.mesh(), meshes})),
                                             facet_degree(setup))}};
}

void register_cut(Registry& registry) {
  registry.add<Interface>(
      "interface", "cut", CutInterface::schema(),
      [](const Parameters& p, const Registry& types) { return std::make_unique<CutInterface>(p, types); });
  registry.add<Interface>(
      "interface", "embedded", EmbeddedInterface::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<EmbeddedInterface>(p); });
  register_level_set(registry);
}

}  // namespace seam
