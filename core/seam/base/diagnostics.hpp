// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace seam {

/// Where something stands in an input file. Line and column count from 1; 0 means unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;

  /// "file:line:column", without the parts that are unknown.
  [[nodiscard]] std::string text() const;
};

/// One thing that is wrong (or doubtful) in the input.
struct Diagnostic {
  enum class Severity { error, warning };
  Severity severity = Severity::error;
  Location where;
  std::string message;

  [[nodiscard]] std::string text() const;
};

/// Anything the user can mend: a broken input, a plugin that does not load, a system without solution.
/// what() holds one line per diagnostic: where, what was found, what was expected, what to do.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  Error(const Location& where, const std::string& message);
};

/// A step that cannot be taken as it is, but perhaps a shorter one: it is rewound and halved.
class StepRefused : public Error {
 public:
  using Error::Error;
};

/// Collects errors and warnings, so that several are reported at once.
class Diagnostics {
 public:
  /// @throws Error holding text() when there are 200 entries: then to go on is of no use.
  void error(Location where, std::string message);
  void warning(Location where, std::string message);
  [[nodiscard]] bool has_errors() const;
  [[nodiscard]] const std::vector<Diagnostic>& all() const { return entries_; }
  /// All entries (at most 50), sorted by place, one per line.
  [[nodiscard]] std::string text() const;
  /// Throws an Error holding text() if there is at least one error.
  void throw_if_errors() const;

 private:
  std::vector<Diagnostic> entries_;
};

/// The candidate closest to `name` by edit distance, or "" when none is close enough to be meant.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace seam
