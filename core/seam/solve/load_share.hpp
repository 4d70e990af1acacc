// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "seam/solve/problem.hpp"

namespace seam {

struct Block;

/// Lets what acts on a static problem act in part: from 0, where its start is a solution, to 1, all of it. Of
/// each equation's residual R(u), whatever makes it, loads, inflows or bodies that press, that of the start
/// u0 is left out in part, and what is prescribed goes from its value at the start to its own:
///
///   R(u) - (1 - share) R(u0) = 0,   u = u0 + share (g - u0) where g is prescribed.
///
/// (The homotopy of Newton's method, Allgower and Georg, Introduction to Numerical Continuation Methods,
/// 2003, 1.1.) Relations hold as a whole. With its end all of it acts again. All calls are collective.
class LoadShare {
 public:
  /// The problem is at the start of its step, whose prescribed values are known.
  LoadShare(Problem& problem, const TimePoint& at);
  ~LoadShare();
  LoadShare(const LoadShare&) = delete;
  LoadShare& operator=(const LoadShare&) = delete;
  void set(double share);

 private:
  /// One value that is prescribed from the start on.
  struct Given {
    Block* block;
    std::size_t unknown;
    double start, end;
  };
  Problem& problem_;
  std::vector<Given> given_;
};

}  // namespace seam
