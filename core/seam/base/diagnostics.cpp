// SPDX-License-Identifier: BSD-3-Clause
#include "seam/base/diagnostics.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace seam {

namespace {

std::string lower_case(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

/// Number of insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  std::iota(previous.begin(), previous.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before[j - 2] + 1);
      }
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

}  // namespace

std::string Location::text() const {
  std::string result = file;
  if (line > 0) result += (result.empty() ? "line " : ":") + std::to_string(line);
  if (line > 0 && column > 0) result += ":" + std::to_string(column);
  return result;
}

std::string Diagnostic::text() const {
  const std::string place = where.text();
  const std::string kind = severity == Severity::error ? "error: " : "warning: ";
  return (place.empty() ? "" : place + ": ") + kind + message;
}

Error::Error(const Location& where, const std::string& message)
    : std::runtime_error(Diagnostic{Diagnostic::Severity::error, where, message}.text()) {}

void Diagnostics::error(Location where, std::string message) {
  entries_.push_back({Diagnostic::Severity::error, std::move(where), std::move(message)});
  // A file with so many errors is no scene at all; to find the rest, with hints, could take minutes.
  constexpr std::size_t enough = 200;
  if (entries_.size() >= enough) throw Error(text());
}

void Diagnostics::warning(Location where, std::string message) {
  entries_.push_back({Diagnostic::Severity::warning, std::move(where), std::move(message)});
}

bool Diagnostics::has_errors() const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::error; });
}

std::string Diagnostics::text() const {
  std::vector<Diagnostic> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.where.file, a.where.line, a.where.column) <
           std::tie(b.where.file, b.where.line, b.where.column);
  });
  // Nobody reads on beyond this; a file that is no scene at all would fill the screen.
  const std::size_t shown = std::min<std::size_t>(sorted.size(), 50);
  std::string result;
  for (std::size_t i = 0; i < shown; ++i) result += (result.empty() ? "" : "\n") + sorted[i].text();
  if (shown < sorted.size()) result += "\n... and " + std::to_string(sorted.size() - shown) + " more";
  return result;
}

void Diagnostics::throw_if_errors() const {
  if (has_errors()) throw Error(text());
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  // A third of the letters may be wrong; beyond that a guess misleads more than it helps. Long input is
  // nobody's misspelling and would cost quadratic time.
  if (name.empty() || name.size() > 100) return "";
  const std::string wanted = lower_case(name);
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > 2 * name.size() + 4) continue;
    const std::size_t distance = edit_distance(wanted, lower_case(candidate));
    if (distance < best_distance && distance < std::max(name.size(), candidate.size())) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace seam
