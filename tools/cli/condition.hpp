// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "vary.hpp"

namespace seam::cli {

/// Which variants a condition such as `solver.linear == krylov && ranks > 1` holds for: an expression of the
/// scene's parameters that may also name keys of `vary`, and words that these take.
class Condition {
 public:
  /// @param parameters of the scene: values that are expressions of these are numbers
  /// @param what "matrix.leave_out", for messages
  Condition(const Vary& vary, const std::map<std::string, double>& parameters, std::string text,
            Location where, std::string what);

  /// @param values by key of `vary`
  /// @param parameters of the scene with these values
  /// @throws Error with the condition's place when it cannot be evaluated
  [[nodiscard]] bool holds(const std::vector<std::string>& values,
                           const std::map<std::string, double>& parameters) const;

 private:
  /// The text with keys and words replaced by numbers.
  [[nodiscard]] std::string in_numbers(const std::vector<std::string>& values) const;
  /// Length of the longest key or word that stands at this place of the text; 0 for none.
  [[nodiscard]] std::size_t known_at(std::size_t at) const;
  /// Keys, words, names, numbers, and what stands between them, character by character.
  [[nodiscard]] std::vector<std::string> pieces() const;
  /// A number for a value: itself, or one that stands for the word.
  [[nodiscard]] std::string number_of(const std::string& value) const;
  /// What nobody knows in the text, and what is known; "" where all is.
  [[nodiscard]] std::string unknown_name(const std::map<std::string, double>& parameters) const;

  std::string text_;
  Location where_;
  std::string what_;
  std::map<std::string, std::size_t> keys_;  ///< by label and by path
  std::map<std::string, int> words_;         ///< values that are no numbers, by themselves
};

}  // namespace seam::cli
