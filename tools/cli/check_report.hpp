// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "seam/run/session.hpp"

namespace seam::cli {

/// What a scene is, after Session::require_held(): `fields` with their unknowns, `recorded` series with
/// units (null where nobody declares one), `unknowns`, `memory_bytes`, `seconds_per_step`. Collective.
nlohmann::json describe_contents(const Registry& registry, Session& session);

/// The same for people.
std::string contents_as_text(const nlohmann::json& contents);

/// The lines of a message, "file:line:column: error: ...", each as an object with `severity`, `file`, `line`,
/// `column` (null where unknown) and `message`.
nlohmann::json diagnostics_as_json(const std::string& messages);

}  // namespace seam::cli
