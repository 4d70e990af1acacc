// SPDX-License-Identifier: BSD-3-Clause
#include "golden.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace seam_test {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t i = 0; !from.empty() && (i = text.find(from, i)) != std::string::npos; i += to.size()) {
    text.replace(i, from.size(), to);
  }
  return text;
}

void check_golden(const std::string& text, const std::filesystem::path& file) {
  if (std::getenv("SEAM_UPDATE_GOLDEN")) {
    std::ofstream(file) << text << '\n';
    return;
  }
  INFO("expected text: " << file);
  CHECK(text + "\n" == read_text(file));
}

}  // namespace seam_test
