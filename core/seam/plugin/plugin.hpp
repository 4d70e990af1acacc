// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What a plugin's source includes. Use it together with the CMake function seam_add_plugin(), which defines
/// the name, version, licence, required plugins and provided types that the descriptor carries:
///
///     SEAM_PLUGIN(registry) {
///       registry.add<seam::Term>("kind", "name", schema(), [](const seam::Parameters& p, const
///       seam::Registry&) {...});
///     }

#include "seam/plugin/descriptor.hpp"
#include "seam/plugin/fingerprint.hpp"
#include "seam/plugin/headers.hpp"
#include "seam/plugin/registry.hpp"

// NOLINTBEGIN(bugprone-macro-parentheses): the argument is the name of a parameter.
// The note is an exported symbol, so that no linker drops it as unused.
#define SEAM_PLUGIN(registry)                                                                                \
  extern "C" {                                                                                               \
  [[gnu::section(".note.seam"), gnu::aligned(4),                                                             \
    gnu::visibility("default")]] extern const seam::PluginNote seam_plugin_note;                             \
  [[gnu::visibility("default")]] void seam_plugin_declare(seam::Registry& registry);                         \
  }                                                                                                          \
  constinit const seam::PluginNote seam_plugin_note{.descriptor = {.size = sizeof(seam::PluginDescriptor),   \
                                                                   .name = SEAM_PLUGIN_NAME,                 \
                                                                   .version = SEAM_PLUGIN_VERSION,           \
                                                                   .licence = SEAM_PLUGIN_LICENSE,           \
                                                                   .requires_plugins = SEAM_PLUGIN_REQUIRES, \
                                                                   .fingerprint = SEAM_FINGERPRINT,          \
                                                                   .provides = SEAM_PLUGIN_PROVIDES,         \
                                                                   .headers = SEAM_HEADERS}};                \
  void seam_plugin_declare(seam::Registry& registry)
// NOLINTEND(bugprone-macro-parentheses)
