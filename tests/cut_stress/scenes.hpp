// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <string>
#include <vector>

#include "cut/cut_test.hpp"

/// Where bodies are put against the lines of the unit square's or cube's mesh.
struct Scene {
  std::string kind;
  std::vector<seam::Surface> bodies;  ///< two at most; of two the second one is convex
};

/// Draws positions. Cells are 1/n wide.
class Draw {
 public:
  Draw(unsigned long seed, unsigned long index, int n) : random_(seed * 1000003 + index), n_(n) {}
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned long>(count)); }
  bool chance(double share) { return unit() < share; }
  double cell() const { return 1.0 / n_; }
  /// A number from `low` to `high`, evenly in its logarithm.
  double scale(double low, double high) { return low * std::pow(high / low, unit()); }
  /// 0, or 1e-16 to 1e-1 of a cell with either sign; not where rounding decides what is flush.
  double distance();
  /// A line of the mesh, moved by a distance.
  double line() { return below(n_ + 1) * cell() + distance(); }
  double place() { return chance(0.5) ? line() : -0.2 + 1.4 * unit(); }
  std::mt19937_64& random() { return random_; }

 private:
  std::mt19937_64 random_;
  int n_;
};

Scene draw_scene(int dimension, Draw& draw);
