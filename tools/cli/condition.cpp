// SPDX-License-Identifier: BSD-3-Clause
#include "condition.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "seam/scene/expression.hpp"

namespace seam::cli {
namespace {

bool is_number(const std::string& text, const std::map<std::string, double>& parameters) {
  try {
    evaluate_constant(text, parameters);
    return true;
  } catch (const Error&) {
    return false;
  }
}

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_in_name(char c) {
  return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.';
}

}  // namespace

Condition::Condition(const Vary& vary, const std::map<std::string, double>& parameters, std::string text,
                     Location where, std::string what)
    : text_(std::move(text)), where_(std::move(where)), what_(std::move(what)) {
  for (std::size_t k = 0; k < vary.keys.size(); ++k) {
    keys_[vary.keys[k].label] = keys_[vary.keys[k].path] = k;
    for (const std::string& value : vary.keys[k].values)
      if (!is_number(value, parameters)) words_.emplace(value, words_.size());
  }
}

bool Condition::holds(const std::vector<std::string>& values,
                      const std::map<std::string, double>& parameters) const {
  try {
    return evaluate_constant(in_numbers(values), parameters) != 0;
  } catch (const Error& error) {
    const std::string unknown = unknown_name(parameters);
    throw Error(where_, fmt::format("{}: '{}': {}", what_, text_, unknown.empty() ? error.what() : unknown));
  }
}

std::size_t Condition::known_at(std::size_t at) const {
  std::size_t longest = 0;
  const auto look = [&](const std::string& name) {
    if (name.empty() || text_.compare(at, name.size(), name) != 0) return;
    const bool goes_on = at + name.size() < text_.size() && is_in_name(text_[at + name.size()]);
    if (!goes_on || !is_in_name(name.back())) longest = std::max(longest, name.size());
  };
  for (const auto& entry : keys_) look(entry.first);
  for (const auto& entry : words_) look(entry.first);
  return longest;
}

std::vector<std::string> Condition::pieces() const {
  std::vector<std::string> all;
  for (std::size_t at = 0; at < text_.size();) {
    // Keys and words may hold anything, as `a-b` or `{type: cip}` do.
    std::size_t size = known_at(at);
    if (size == 0)
      while (at + size < text_.size() && is_in_name(text_[at + size])) ++size;
    all.push_back(text_.substr(at, std::max<std::size_t>(1, size)));
    at += all.back().size();
  }
  return all;
}

std::string Condition::unknown_name(const std::map<std::string, double>& parameters) const {
  std::vector<std::string> known;
  for (const auto& entry : keys_) known.push_back(entry.first);
  for (const auto& entry : words_) known.push_back(entry.first);
  for (const auto& entry : parameters) known.push_back(entry.first);
  const std::vector<std::string> all = pieces();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool is_function = k + 1 < all.size() && all[k + 1] == "(";
    if (!begins_name(all[k].front()) || is_function || all[k] == "pi" ||
        std::ranges::find(known, all[k]) != known.end())
      continue;
    const std::string guess = nearest_name(all[k], known);
    return fmt::format("'{}' is no key of `vary`, no word that one takes, and no parameter.{} There are: {}",
                       all[k], guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess),
                       fmt::join(known, ", "));
  }
  return "";
}

std::string Condition::in_numbers(const std::vector<std::string>& values) const {
  std::string result;
  for (const std::string& piece : pieces()) {
    const auto key = keys_.find(piece);
    if (key != keys_.end())
      result += number_of(values[key->second]);
    else
      result += words_.contains(piece) ? number_of(piece) : piece;
  }
  return result;
}

std::string Condition::number_of(const std::string& value) const {
  // No value that is a number in a scene is as large as those that stand for words.
  constexpr double first_word = 1e200;
  const auto word = words_.find(value);
  return word == words_.end() ? "(" + value + ")" : fmt::format("{}", first_word * (word->second + 1));
}

}  // namespace seam::cli
