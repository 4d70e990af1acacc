// SPDX-License-Identifier: BSD-3-Clause
// Any text is either a scene or an error.
#include <cstddef>
#include <cstdint>
#include <string>

#include "seam/plugin/plugin_host.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/scene/scene.hpp"
#include "test_types.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const seam::Registry types = [] {
    seam::Registry registry;
    seam_test::register_test_types(registry);
    return registry;
  }();
  seam::Registry registry = types;
  seam::PluginHost host({});
  try {
    const seam::Scene scene =
        seam::parse_scene_text({reinterpret_cast<const char*>(data), size}, "fuzz.yaml", {}, host, registry);
    seam::check_mesh_names(scene, registry, {{"box", {{"x_min"}, {}}}});
  } catch (const seam::Error&) {
  }
  return 0;
}
