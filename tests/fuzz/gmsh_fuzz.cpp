// SPDX-License-Identifier: BSD-3-Clause
// No text, however broken, may do more to the Gmsh reader than make it throw an Error.
#include <cstddef>
#include <cstdint>
#include <string>

#include "seam/base/diagnostics.hpp"
#include "seam/mesh/input/mesh_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const seam::MeshData mesh =
        seam::read_gmsh_text(std::string(reinterpret_cast<const char*>(data), size), "fuzz.msh");
    seam::validate_mesh(mesh, "fuzz.msh");
  } catch (const seam::Error&) {
  }
  return 0;
}
