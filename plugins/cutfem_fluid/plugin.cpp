// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "couplings.hpp"
#include "fluid.hpp"

SEAM_PLUGIN(registry) {
  using namespace seam;
  fluid::declare_stabilisations(registry);
  fluid::declare_couplings(registry);
  registry.add<Physics>(
      "field", "cutfem_fluid", fluid::Fluid::schema(),
      [](const Parameters& p, const Registry& r) { return std::make_unique<fluid::Fluid>(p, r); });
}
