// SPDX-License-Identifier: BSD-3-Clause
#include "seam/base/policy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace seam {
namespace {

Policy& of_this_process() {
  static Policy policy;
  return policy;
}

const std::map<std::string, double Limits::*>& limits_by_name() {
  static const std::map<std::string, double Limits::*> names{{"cells", &Limits::cells},
                                                             {"facets", &Limits::facets},
                                                             {"unknowns", &Limits::unknowns},
                                                             {"file_bytes", &Limits::file_bytes},
                                                             {"mesher_seconds", &Limits::mesher_seconds},
                                                             {"mesher_bytes", &Limits::mesher_bytes},
                                                             {"seconds", &Limits::seconds}};
  return names;
}

}  // namespace

Limits Limits::strict() {
  Limits limits;
  limits.cells = 1e6;
  limits.facets = 1e5;
  limits.unknowns = 3e6;
  limits.file_bytes = 1e8;
  limits.seconds = 3600;
  return limits;
}

const Policy& policy() { return of_this_process(); }

void set_policy(const Policy& policy) { of_this_process() = policy; }

void set_limit(Limits& limits, const std::string& name, double value) {
  const auto& names = limits_by_name();
  const auto found = names.find(name);
  if (found == names.end()) {
    std::vector<std::string> known;
    for (const auto& entry : names) known.push_back(entry.first);
    throw Error(fmt::format("there is no limit '{}'; expected one of {}", name, fmt::join(known, ", ")));
  }
  limits.*found->second = value;
}

void require_within(double found, double limit, const char* name, const std::string& what,
                    const Location& where) {
  if (found <= limit) return;
  throw Error(where, fmt::format("found {:.15g} {}, at most {:g} are allowed; take fewer, or raise the "
                                 "limit by --limit {}={:.15g}",
                                 found, what, limit, name, found));
}

bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path top = fs::weakly_canonical(fs::current_path() / folder, code);
  if (code) return false;
  const fs::path real = fs::weakly_canonical(fs::current_path() / path, code);
  if (code) return false;
  const auto [of_top, of_path] = std::ranges::mismatch(top, real);
  return of_top == top.end() || (of_top->empty() && std::next(of_top) == top.end());
}

namespace {

/// Behind spaces of any width, none included, with which programs that read logs let a line begin.
std::size_t first_visible(const std::string& text) {
  static const std::vector<std::string> blanks = [] {
    std::vector<std::string> all{
        " ",           "\xc2\xa0", "\xc2\xad", "\xd8\x9c", "\xe1\x9a\x80", "\xe1\xa0\x8e", "\xe3\x80\x80",
        "\xef\xbb\xbf"};
    for (const int c : {0x80, 0x81, 0x82, 0x83, 0x84, 0x85, 0x86, 0x87, 0x88, 0x89, 0x8a, 0x8b, 0x8c, 0x8d,
                        0x8e, 0x8f, 0xa8, 0xa9, 0xaf})
      all.push_back(std::string("\xe2\x80") + static_cast<char>(c));
    for (int c = 0x9f; c <= 0xaf; ++c) all.push_back(std::string("\xe2\x81") + static_cast<char>(c));
    return all;
  }();
  std::size_t at = 0;
  for (bool found = true; found;) {
    found = false;
    for (const std::string& blank : blanks)
      if (text.compare(at, blank.size(), blank) == 0) {
        at += blank.size();
        found = true;
      }
  }
  return at;
}

}  // namespace

std::string on_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  // C1 control characters, as UTF-8; U+009B begins an escape sequence.
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '\xc2' && static_cast<unsigned char>(text[i + 1]) < 0xa0) text[i] = text[i + 1] = ' ';
  const std::size_t first = first_visible(text);
  if (text.compare(first, 2, "::") == 0) text.insert(first + 1, " ");
  for (std::size_t at = 0; (at = text.find("##[", at)) != std::string::npos;) text.insert(at + 1, " ");
  return text;
}

}  // namespace seam
