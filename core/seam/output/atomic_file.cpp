// SPDX-License-Identifier: BSD-3-Clause
#include "seam/output/atomic_file.hpp"

#include "seam/output/safe_file.hpp"

namespace seam {

void write_text_atomically(const std::string& path, const std::string& text) { write_whole_file(path, text); }

}  // namespace seam
