// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/linear/block_inverse.hpp"
#include "seam/linear/linear_solver.hpp"
#include "seam/plugin/plugin.hpp"

namespace {

using namespace seam;

/// Damped Jacobi sweeps x += damping D^-1 (b - A x), where D has the dense blocks of what the unknowns of a
/// node do to each other.
class NodeJacobi final : public BlockInverse {
 public:
  explicit NodeJacobi(const Parameters& p)
      : sweeps_(static_cast<int>(p.integer("sweeps"))), damping_(p.number("damping")) {}

  void build(const Matrix& matrix, const EquationBlock& equations) override {
    matrix_ = matrix;
    blocks_.clear();
    for (const EquationUnknown& unknown : equations.unknowns)
      for (std::size_t first = 0; first < unknown.rows.size(); first += unknown.components)
        blocks_.push_back(
            invert({&unknown.rows[first], static_cast<std::size_t>(unknown.components)}, equations.field));
  }

  void apply(std::span<const double> b, std::span<double> x) const override {
    std::vector<double> solution(b.size(), 0.0), product(b.size(), 0.0);
    for (int sweep = 0; sweep < sweeps_; ++sweep) {
      if (sweep > 0) multiply(matrix_, solution, product);
      for (const NodeBlock& block : blocks_)
        for (std::size_t i = 0; i < block.rows.size(); ++i)
          for (std::size_t j = 0; j < block.rows.size(); ++j)
            solution[block.rows[i]] += damping_ * block.inverse[i * block.rows.size() + j] *
                                       (b[block.rows[j]] - product[block.rows[j]]);
    }
    std::ranges::copy(solution, x.begin());
  }

 private:
  struct NodeBlock {
    std::vector<int> rows;
    std::vector<double> inverse;  ///< [row][column]
  };

  /// Gauss-Jordan elimination with partial pivoting beside the identity.
  NodeBlock invert(std::span<const int> rows, const std::string& field) const {
    const std::size_t n = rows.size();
    std::vector<double> a(n * n, 0.0), inverse(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      inverse[i * n + i] = 1;
      for (std::size_t k = matrix_.row_start[rows[i]]; k < matrix_.row_start[rows[i] + 1]; ++k)
        for (std::size_t j = 0; j < n; ++j)
          if (matrix_.column[k] == rows[j]) a[i * n + j] = matrix_.value[k];
    }
    for (std::size_t c = 0; c < n; ++c) {
      std::size_t pivot = c;
      for (std::size_t i = c; i < n; ++i)
        if (std::abs(a[i * n + c]) > std::abs(a[pivot * n + c])) pivot = i;
      if (a[pivot * n + c] == 0)
        throw Error(
            "the block inverse `node_jacobi` needs unknowns that resist of themselves at every node; "
            "field '" +
            field + "' has one that does not: take `ilu`, or `schur`");
      for (std::size_t j = 0; j < n; ++j) {
        std::swap(a[c * n + j], a[pivot * n + j]);
        std::swap(inverse[c * n + j], inverse[pivot * n + j]);
      }
      for (std::size_t i = 0; i < n; ++i) {
        const double factor = i == c ? 1 - 1 / a[c * n + c] : a[i * n + c] / a[c * n + c];
        for (std::size_t j = 0; j < n; ++j) {
          a[i * n + j] -= factor * a[c * n + j];
          inverse[i * n + j] -= factor * inverse[c * n + j];
        }
      }
    }
    return {{rows.begin(), rows.end()}, std::move(inverse)};
  }

  int sweeps_;
  double damping_;
  Matrix matrix_;
  std::vector<NodeBlock> blocks_;
};

}  // namespace

void declare_node_jacobi(Registry& registry) {
  Schema schema("Damped Jacobi sweeps over the nodes' unknowns: for fields that resist of themselves.");
  schema.integer("sweeps", "how many").otherwise("4").at_least(1);
  schema.number("damping", "of each").otherwise("0.6").above(0).at_most(1);
  registry.add<BlockInverse>(
      "block_inverse", "node_jacobi", schema,
      [](const Parameters& p, const Registry&) { return std::make_unique<NodeJacobi>(p); });
}
