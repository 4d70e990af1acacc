// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/scene/scene.hpp"

namespace seam {

struct YamlNode;

/// Replaces values of a scene's tree, in this order.
/// @throws Error naming the key path that leads nowhere, or the value that is no YAML
void apply_overrides(YamlNode& root, const Overrides& overrides);

}  // namespace seam
