// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace seam {

/// The whole contents of a mesh file.
/// @throws Error when it does not exist, is no file or cannot be read
std::string read_text(const std::string& path);

}  // namespace seam
