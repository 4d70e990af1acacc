// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "seam/base/communicator.hpp"
#include "seam/base/diagnostics.hpp"

namespace seam {

/// What rank 0 has, on all ranks. Collective.
inline std::string from_root(const Communicator& communicator, const std::string& text) {
  std::vector<char> bytes;
  if (communicator.rank() == 0) bytes.assign(text.begin(), text.end());
  const std::vector<char> all = communicator.gather_all(bytes);
  return {all.begin(), all.end()};
}

/// The different ones of the ranks' texts that are not empty, in the order of the ranks, one a line.
/// Collective.
inline std::string distinct_texts(const Communicator& communicator, const std::string& mine) {
  std::vector<char> bytes(mine.begin(), mine.end());
  bytes.push_back('\0');
  std::vector<std::string> distinct;
  std::string current, all;
  for (const char c : communicator.gather_all(bytes)) {
    if (c != '\0') {
      current += c;
      continue;
    }
    if (!current.empty() && std::find(distinct.begin(), distinct.end(), current) == distinct.end())
      distinct.push_back(current);
    current.clear();
  }
  for (const std::string& text : distinct) all += (all.empty() ? "" : "\n") + text;
  return all;
}

/// Calls an action that may fail on some ranks only, as writing to a disk may. Collective; the action itself
/// must not be.
/// @throws Failure on all ranks, with what the ranks said, when the action threw on any
template <class Failure = Error>
void all_or_none(const Communicator& communicator, const std::function<void()>& action) {
  if (communicator.size() == 1) return action();
  std::string problem;
  try {
    action();
  } catch (const std::exception& error) {
    problem = error.what();
    if (problem.empty()) problem = "an error without a message";
  }
  if (!communicator.any(!problem.empty())) return;
  throw Failure(distinct_texts(communicator, problem));
}

}  // namespace seam
