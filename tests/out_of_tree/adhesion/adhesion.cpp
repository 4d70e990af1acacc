// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"
#include "seam/plugins/mortar_contact/contact_law.hpp"

namespace {

using namespace seam;

/// Bodies hold on to each other: they part where the pressure would fall below minus the strength. While they
/// are nearer than the reach they go on pulling with that, and further away they do nothing (Dugdale 1960).
struct Adhesion {
  double strength, reach;
  template <class T>
  T operator()(const T& pressure, const T& gap, double stiffness) const {
    const T beyond = pressure + strength;
    if (plain(beyond) - stiffness * plain(gap) > 0) return gap;
    return (plain(gap) < reach ? beyond : pressure) / stiffness;
  }
};

}  // namespace

SEAM_PLUGIN(registry) {
  Schema schema("Bodies hold on to each other up to a strength, and pull with it as long as they are near.");
  schema.number("strength", "Tension at which they part").unit("Pa").above(0);
  schema.number("reach", "Gap from which on they do not act on each other").unit("m").above(0);
  registry.add<mortar::ContactLaw>(
      "contact_law", "adhesion", schema, [](const Parameters& p, const Registry&) {
        return mortar::make_contact_law(Adhesion{p.number("strength"), p.number("reach")});
      });
}
