// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/assembly/evaluator.hpp"

namespace seam {

/// "the term 'Diffusion' of pipe.temperature on cells of field 'pipe' of plugin 'heat'", for messages.
std::string describe(const BoundTerm& bound, const IntegrationDomain& domain);

/// Whether the unknowns that a term was given are those that its kernel speaks of: how many, with how many
/// components, and with the rates that it reads.
/// @throws PluginFault which says what does not fit
void check_binding(const BoundTerm& bound, const IntegrationDomain& domain);

}  // namespace seam
