// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "seam/field/field.hpp"

namespace seam {

/// Extends the states of a field smoothly to nodes that have just come alive: of all extensions, the one with
/// the smallest jumps of normal derivatives across the faces around the new nodes. First derivatives weigh 1,
/// second ones h^2 (thesis (3.10), (3.11)). A thin film that opens between bodies, or between a body and the
/// border, may come alive over many cells at once: in those that no known node reaches, values are like those
/// of their neighbours, and 0 where the whole film is one that nothing known touches. What a film was before
/// matters little beside what closes or opens it.
class Extension {
 public:
  explicit Extension(Field& field);
  ~Extension();

  /// Gives values to all nodes that are active and not known, in the present and the old states alike; then
  /// exactly the active nodes are known. Collective.
  /// @throws StepRefused when an active cell consists of new nodes only and is no thin film: the body
  /// uncovered more than a layer of cells
  void extend();

 private:
  struct System;
  /// (cell, part) of owned cells that consist of new nodes only.
  /// @throws StepRefused unless they are thin films
  [[nodiscard]] std::vector<std::pair<int, int>> films(int block) const;
  [[nodiscard]] bool is_film(int cell) const;
  [[nodiscard]] std::vector<std::pair<int, int>> active_parts() const;
  static void assemble(const Block& block, Field& carrier, System& system);
  static void add(const Block& block, int row, int column, double value, System& system);
  /// Makes new nodes of these parts of cells like the others there.
  void add_means(int block, const std::vector<std::pair<int, int>>& parts, double weight, System& system);
  /// Draws new nodes of these parts of cells to 0.
  void add_rest(int block, const std::vector<std::pair<int, int>>& parts, double weight, System& system);
  /// What decides where the jumps leave something open.
  enum class Help { none, means, rest };
  /// @return false when the system does not determine all new nodes
  static bool set_states(const Block& block, const System& system);
  [[nodiscard]] Field& carrier(int order);
  void extend_block(int block);
  Field* field_;
  std::unique_ptr<Field> carriers_[2];  ///< a scalar field per order, on the same mesh
};

}  // namespace seam
