// SPDX-License-Identifier: BSD-3-Clause
// A descriptor with one member changed, and no function to register anything. Its constructor ends the
// process, so the tests fail when code of an incompatible plugin runs.
#include <cstdlib>
#include <string>

#include "seam/plugin/descriptor.hpp"
#include "seam/plugin/fingerprint.hpp"
#include "seam/plugin/headers.hpp"

#ifndef ABI_MAJOR
#define ABI_MAJOR seam::plugin_abi_major
#endif
#ifndef ABI_MINOR
#define ABI_MINOR seam::plugin_abi_minor
#endif
#ifndef HEADERS
#define HEADERS SEAM_HEADERS
#endif
#ifndef SIZE
#define SIZE sizeof(seam::PluginDescriptor)
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
                                                                 .size = SIZE,
                                                                 .name = SEAM_PLUGIN_NAME,
                                                                 .version = SEAM_PLUGIN_VERSION,
                                                                 .licence = SEAM_PLUGIN_LICENSE,
                                                                 .requires_plugins = SEAM_PLUGIN_REQUIRES,
                                                                 .fingerprint = FINGERPRINT,
                                                                 .provides = SEAM_PLUGIN_PROVIDES,
                                                                 .headers = HEADERS}};

namespace {
struct EndsTheProcess {
  EndsTheProcess() {
    const seam::PluginDescriptor& own = seam_plugin_note.descriptor;
    const bool compatible =
        own.abi_major == seam::plugin_abi_major && own.abi_minor <= seam::plugin_abi_minor &&
        std::string(own.fingerprint) == SEAM_FINGERPRINT &&
        (own.abi_minor < seam::plugin_abi_minor || std::string(own.headers) == SEAM_HEADERS);
    if (!compatible) std::abort();
  }
};
const EndsTheProcess at_load;
}  // namespace
