// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cut_interface.hpp"

#include "seam/cut/cut_boundary.hpp"

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

}  // namespace seam
