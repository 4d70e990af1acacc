// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/term/term.hpp"

namespace seam {

/// The name of a term's kernel, as its author wrote it, for messages.
std::string term_name(const Term& term);

}  // namespace seam
