// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace seam::cli {

/// What a file holds; of the type `discarded` where there is none, or it is no JSON.
inline nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in, nullptr, false);
}

}  // namespace seam::cli
