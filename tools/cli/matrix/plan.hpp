// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "seam/scene/scene.hpp"

namespace seam::cli {

/// A scene with some of its values replaced, as one process or several run it.
struct Variant {
  std::vector<std::string> values;  ///< by key of `vary`
  std::string name;                 ///< "n=8 solver.linear=krylov ranks=2"; empty for the scene as it stands
  std::vector<std::string> set;     ///< values of `--set`
  int ranks = 1;
  std::optional<int> resume_ranks;  ///< on which a run goes on that was ended in the middle of its time
  std::string known;                ///< why it falls short today, "" when it is to pass
  std::string problem;              ///< why the scene cannot be read so, "" when it can
};

/// Variants that must leave the same series.
struct Agreement {
  std::string over;                 ///< the keys in which they differ, for reports
  std::vector<std::string> series;  ///< none: all; a vector's name stands for its components
  Location series_where;
  double within = 0;                             ///< relative to a series' largest value
  std::vector<std::vector<std::size_t>> groups;  ///< of variants, at least two in each
};

/// What a scene's `matrix` block asks for; without one, the scene as it stands.
struct MatrixPlan {
  std::filesystem::path scene;
  std::string tier;               ///< "" of a scene that cannot be read
  bool is_named = false;          ///< by itself, not found in a folder: it is run whatever its tier
  std::vector<std::string> keys;  ///< of `vary`, for readers
  double steps = 1;               ///< about how many a run takes
  double middle = 0;              ///< of the scene's time, s
  std::size_t checks = 0;
  std::vector<Variant> variants;
  std::vector<Agreement> agreements;
};

/// Lists the variants, and reads the scene with the values of each.
/// @param set values of `--set`, which hold for all variants
/// @throws Error with the place of what is wrong in the block: a key that leads nowhere, a value with which
/// no variant can be read, a restart of a scene that has no time, a condition or an agreement that holds for
/// nothing
MatrixPlan plan_matrix(const std::filesystem::path& scene_file, const std::vector<std::string>& set);

/// "agreement over ranks", and of which series.
std::string describe(const Agreement& agreement);

/// Whether a column of series.csv is the series of that name, or a component of it.
bool is_series(const std::string& column, const std::string& name);

/// @throws Error with the place of a series that an agreement names and no column is
void require_series(const MatrixPlan& plan, const std::vector<std::string>& columns);

}  // namespace seam::cli
