// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "load.hpp"
#include "options.hpp"

namespace seam::picture {

/// Draws the bodies into the PNG file.
/// @throws Error when the file cannot be written
void render(const std::vector<Body>& bodies, const Options& options);

}  // namespace seam::picture
