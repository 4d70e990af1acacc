// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/plugin/registry.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

/// JSON Schema (draft 7) of a scene with all types of the registry, for editors that complete and check YAML.
std::string json_schema(const Schema& scene, const Registry& registry);

}  // namespace seam
