// SPDX-License-Identifier: BSD-3-Clause
// Calls a function that nobody defines.
#include "seam/plugin/plugin.hpp"

extern "C" [[gnu::visibility("default")]] int seam_test_function_that_is_nowhere();

SEAM_PLUGIN(registry) {
  if (seam_test_function_that_is_nowhere() == 0) registry.set_current_plugin("nobody");
}
