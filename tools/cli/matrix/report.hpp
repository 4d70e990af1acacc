// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "variant_run.hpp"

namespace seam::cli {

/// How many variants there are of each verdict.
struct MatrixCount {
  std::size_t ok = 0, known = 0, failed = 0, not_run = 0;
};
MatrixCount count(const std::vector<VariantResult>& results);

/// "ok    scene: variant (3 findings, 2.31 s)", and below it what does not hold.
/// @param is_pending what it must agree with is not known yet
std::string as_text(const VariantResult& result, bool is_pending = false);

/// A page with a table, a row each, and below it what does not hold.
/// @param circumstances machine, commit, command and the like, by name
std::string as_markdown(const std::vector<VariantResult>& results,
                        const std::vector<std::pair<std::string, std::string>>& circumstances);

/// An array of rows.
nlohmann::json as_json(const std::vector<VariantResult>& results);

/// JUnit's XML, as Jenkins publishes its schema: a suite for each scene, a case for each thing that was
/// looked at in a variant. What was declared to fall short is skipped.
std::string as_junit(const std::vector<VariantResult>& results);

}  // namespace seam::cli
