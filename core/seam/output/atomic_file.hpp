// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace seam {

/// Writes a text file so that a reader (or a crash) never meets half of it: to a temporary file beside it,
/// which then takes its name.
/// @throws Error naming the file and the system's reason
void write_text_atomically(const std::string& path, const std::string& text);

}  // namespace seam
