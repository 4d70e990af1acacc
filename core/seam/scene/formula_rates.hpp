// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "seam/base/jet.hpp"

namespace mu {
class Parser;
}

namespace seam {

/// A formula of variables that change with time, evaluated with its rates: what muParser has compiled is run
/// on jets in place of numbers.
/// @param parser with a compiled expression of `variables`, in muParser's order of their addresses
/// @param first the address of the first variable of the parser, the others follow it
/// @return nothing where the formula uses a function whose derivatives are not known here
std::optional<Jet> evaluate_jet(const mu::Parser& parser, const std::array<Jet, 4>& variables,
                                const double* first);

}  // namespace seam
