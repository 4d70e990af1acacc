// SPDX-License-Identifier: BSD-3-Clause
// A descriptor with one member changed, and no function to register anything. Its constructor ends the
// process, so the tests fail when code of an incompatible plugin runs.
#include <cstdlib>

#include "seam/plugin/descriptor.hpp"

#ifndef ABI_MAJOR
#define ABI_MAJOR seam::plugin_abi_major
#endif
#ifndef ABI_MINOR
#define ABI_MINOR seam::plugin_abi_minor
#endif
#ifndef FINGERPRINT
#define FINGERPRINT SEAM_FINGERPRINT
#endif

extern "C" {
[[gnu::section(".note.seam"), gnu::aligned(4),
  gnu::visibility("default")]] extern const seam::PluginNote seam_plugin_note;
}
constinit const seam::PluginNote seam_plugin_note{.descriptor = {.abi_major = ABI_MAJOR,
                                                                 .abi_minor = ABI_MINOR,
                                                                 .size = sizeof(seam::PluginDescriptor),
                                                                 .name = SEAM_PLUGIN_NAME,
                                                                 .version = SEAM_PLUGIN_VERSION,
                                                                 .licence = SEAM_PLUGIN_LICENSE,
                                                                 .requires_plugins = SEAM_PLUGIN_REQUIRES,
                                                                 .fingerprint = FINGERPRINT,
                                                                 .provides = SEAM_PLUGIN_PROVIDES}};

namespace {
struct EndsTheProcess {
  EndsTheProcess() {
    // The macros differ where a test defines them.
    // NOLINTNEXTLINE(misc-redundant-expression)
    const bool compatible = ABI_MAJOR == seam::plugin_abi_major && ABI_MINOR <= seam::plugin_abi_minor &&
                            std::string(FINGERPRINT) == SEAM_FINGERPRINT;
    if (!compatible) std::abort();
  }
};
const EndsTheProcess at_load;
}  // namespace
