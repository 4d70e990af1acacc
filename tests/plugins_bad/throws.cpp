// SPDX-License-Identifier: BSD-3-Clause
// Fails half way through its registration.
#include <stdexcept>

#include "seam/plugin/plugin.hpp"

namespace {
struct Nothing {};
}  // namespace

SEAM_PLUGIN(registry) {
  registry.add<Nothing>("field", "thrown", seam::Schema(), nullptr);
  throw std::runtime_error("the licence server is on fire");
}
