// SPDX-License-Identifier: BSD-3-Clause
// What a surface sees of itself.
#include "seam/contact/opposite_points.hpp"

#include <catch2/catch.hpp>

#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

using namespace seam;

namespace {

/// Two cells beside each other whose upper sides are those of a notch, as steep as 2 to 1.
std::unique_ptr<Mesh> notched() {
  MeshData data;
  data.coordinates = {-1, -1, 0, -1, 1, -1, -1, 2, 0, 0, 1, 2};
  data.cells = {0, 1, 4, 3, 1, 2, 5, 4};
  return std::make_unique<Mesh>("notch", std::make_shared<MeshData>(data), Communicator());
}

}  // namespace

TEST_CASE("the two sides of a notch are no surfaces that touch") {
  const auto mesh = notched();
  Field body("body", *mesh, {{"displacement", 2, 1, 0, "m"}});
  const BodySurface surface(body, {}, "displacement");
  Surface twin = surface.now();
  const OppositePoints itself(surface, &surface, surface.now(), twin, {5, 0.1}),
      another(surface, nullptr, surface.now(), twin, {5, 0.1});
  int seen = 0;
  for (int facet = 0; facet < surface.now().facet_count(); ++facet)
    for (const double share : {0.1, 0.5, 0.9}) {
      CHECK_FALSE(itself.find(facet, &share));
      seen += another.find(facet, &share) ? 1 : 0;
    }
  // Taken for two bodies they see each other, but for what looks out over the far edge.
  CHECK(seen == 4);
}
