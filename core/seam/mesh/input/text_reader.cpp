// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/text_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace seam {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }

/// Text for a message: short, and nothing but printable characters of ASCII.
std::string shown(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string result;
  for (const char c : text.substr(0, most)) result += c >= 32 && c < 127 ? c : '?';
  return text.size() > most ? result + "..." : result;
}

template <class Number>
bool parse(std::string_view word, Number& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

void TextReader::fail_at(int line, const std::string& message) const {
  throw Error(Location{name_, line, 0}, message);
}

bool TextReader::at_end() {
  while (at_ < text_.size() && is_blank(text_[at_]))
    if (text_[at_++] == '\n') ++line_;
  return at_ == text_.size();
}

std::string_view TextReader::word(const char* what) {
  if (at_end()) fail(fmt::format("the file ends where {} was expected; it seems to be truncated", what));
  const std::size_t from = at_;
  while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
  return text_.substr(from, at_ - from);
}

std::string_view TextReader::rest_of_line() {
  const std::size_t from = at_, end = std::min(text_.find('\n', at_), text_.size());
  at_ = std::min(end + 1, text_.size());
  if (end < text_.size()) ++line_;
  std::string_view rest = text_.substr(from, end - from);
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
  return rest;
}

long long TextReader::integer(const char* what) {
  const std::string_view w = word(what);
  long long value = 0;
  if (!parse(w, value)) fail(fmt::format("'{}' where {} was expected (a whole number)", shown(w), what));
  return value;
}

long long TextReader::integer(const char* what, long long lowest, long long highest) {
  const long long value = integer(what);
  if (value < lowest || value > highest)
    fail(fmt::format("{} is {}; expected a number from {} to {}", what, value, lowest, highest));
  return value;
}

double TextReader::number(const char* what) {
  const std::string_view w = word(what);
  double value = 0;
  if (!parse(w, value) || !std::isfinite(value))
    fail(fmt::format("'{}' where {} was expected (a finite number)", shown(w), what));
  return value;
}

std::size_t TextReader::count(const char* what, std::size_t least_bytes) {
  const long long value = integer(what);
  const std::size_t left = text_.size() - at_;
  if (value < 0 || static_cast<unsigned long long>(value) > left / least_bytes)
    fail(fmt::format(
        "{} is {}, but the {} characters left in the file cannot hold that many; it is truncated or "
        "broken",
        what, value, left));
  return static_cast<std::size_t>(value);
}

std::string TextReader::quoted(const char* what) {
  const int line = line_;
  const std::string_view rest = rest_of_line();
  if (rest.size() < 2 || rest.front() != '"' || rest.back() != '"')
    fail_at(line, fmt::format("'{}' where {} was expected (in double quotes)", shown(rest), what));
  return std::string(rest.substr(1, rest.size() - 2));
}

void TextReader::skip_past(std::string_view line) {
  const int from = line_;
  while (at_ < text_.size())
    if (rest_of_line() == line) return;
  fail_at(from, fmt::format(
                    "the file ends without the {} that belongs to the section here; it seems to be truncated",
                    line));
}

}  // namespace seam
