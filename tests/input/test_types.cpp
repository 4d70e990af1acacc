// SPDX-License-Identifier: BSD-3-Clause
#include "test_types.hpp"

namespace seam_test {

using namespace seam;

namespace {

Schema bar_schema() {
  Schema boundary("What is prescribed on a part of the boundary.");
  boundary.names("on", "boundaries").naming("boundary");
  boundary.vector_expression("traction", "dead load").unit("Pa").optional();
  boundary.vector_expression("displacement", "prescribed components; null leaves one free")
      .unit("m")
      .optional();
  Schema schema("An elastic body, for the tests.");
  schema.reference("mesh", "its mesh", "mesh");
  schema.number("density", "mass per volume").unit("kg/m^3").above(0).otherwise("1");
  schema.typed("material", "how it deforms", "material");
  schema.choice("strain", "strain measure", {"small", "large"}).otherwise("large");
  schema.integer("order", "of the shape functions").at_least(1).at_most(2).otherwise("1");
  schema.list("boundary", "conditions", boundary).otherwise("[]");
  return schema;
}

Schema steel_schema() {
  Schema schema("A linear elastic material.");
  schema.number("young", "Young's modulus").unit("Pa").above(0);
  schema.number("poisson", "Poisson's ratio").at_least(0).below(0.5).otherwise("0");
  return schema;
}

Schema glue_schema() {
  Schema schema("Bonds the fields of an interface.");
  schema.reference("on", "where", "interface");
  schema.number("penalty", "stiffness of the bond").above(0).otherwise("100");
  return schema;
}

Schema tie_schema() {
  Schema schema("Where two bodies touch.");
  schema.names("fields", "the bodies").naming("field");
  return schema;
}

void add(Registry& registry, const std::string& kind, const std::string& name, Schema schema) {
  registry.add<Thing>(kind, name, std::move(schema),
                      [](const Parameters&, const Registry&) { return std::make_unique<Thing>(); });
}

Schema coat_schema() {
  Schema part("A part of it.");
  part.names("on", "of the body's boundary").naming("boundary:body");
  Schema schema("A layer on a body.");
  schema.reference("body", "what it is on", "field");
  schema.list("parts", "of the layer", part);
  return schema;
}

}  // namespace

void register_coat(Registry& registry) { add(registry, "interface", "coat", coat_schema()); }

void register_test_types(Registry& registry) {
  add(registry, "field", "bar", bar_schema());
  add(registry, "material", "steel", steel_schema());
  add(registry, "material", "rigid", Schema("Does not deform."));
  add(registry, "interface", "tie", tie_schema());
  add(registry, "coupling", "glue", glue_schema());
  add(registry, "linear_solver", "auto", Schema("A factorisation."));
}

}  // namespace seam_test
