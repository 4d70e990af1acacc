// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/plugin/registry.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

/// The keys of a schema with kind, unit, range, default and meaning, as plain text for a terminal.
std::string explain(const Schema& schema);

/// The same for a type, headed by its name, kind and plugin.
std::string explain(const Registry::Entry& entry, const Registry& registry);

/// All types by kind, one line each.
std::string list_types(const Registry& registry);

}  // namespace seam
