// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "seam/base/diagnostics.hpp"

namespace seam {

/// Reads words and numbers from text, and knows the line it is on. Every failure is an Error with that line.
class TextReader {
 public:
  /// @param text must outlive the reader
  TextReader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  /// Skips blank space; true when nothing else is left.
  bool at_end();
  /// The next word. @param what what is expected, for the message when the text ends here
  std::string_view word(const char* what);
  /// What is left of the current line (and the line break), without blanks at both ends.
  std::string_view rest_of_line();
  long long integer(const char* what);
  long long integer(const char* what, long long lowest, long long highest);
  /// A finite number.
  double number(const char* what);
  /// A number of entries to come. Each takes at least `least_bytes` characters, so a count the text cannot
  /// hold is refused before anything is allocated for it.
  std::size_t count(const char* what, std::size_t least_bytes);
  /// A name in double quotes.
  std::string quoted(const char* what);
  /// Moves behind the next line that consists of this word. @throws Error when there is none
  void skip_past(std::string_view line);

  [[nodiscard]] int line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(int line, const std::string& message) const;

 private:
  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace seam
