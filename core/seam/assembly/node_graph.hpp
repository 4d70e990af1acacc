// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "seam/base/communicator.hpp"
#include "seam/linear/matrix.hpp"

namespace seam {

/// Which nodes couple with which, and where the dense block of a pair of nodes stands in the matrix. Rows of
/// nodes owned elsewhere are assembled here too, behind the owned ones, and sent to their owner.
class NodeGraph {
 public:
  /// A node with active unknowns: owned ones first, then ghosts.
  struct Node {
    int size = 0;  ///< unknowns
    int owner = 0;
    int first = 0;           ///< local number of its first unknown
    long long equation = 0;  ///< global number of its first unknown
    friend bool operator==(const Node&, const Node&) = default;
  };
  /// Nodes of every element, one after the other.
  struct Elements {
    std::vector<std::size_t> start{0};
    std::vector<int> node;
  };

  /// Builds the pattern and allocates the matrix. Collective.
  void build(const Communicator& communicator, std::vector<Node> nodes, int owned, const Elements& elements,
             Matrix& matrix);

  [[nodiscard]] const Node& node(int n) const { return nodes_[n]; }
  /// Position of the first entry of block (row, column), and the length of the row's scalar rows.
  /// The pair must be coupled.
  struct BlockEntries {
    std::size_t first;
    std::size_t row_length;
  };
  [[nodiscard]] BlockEntries place(int row, int column) const {
    std::size_t low = start_[row], high = start_[row + 1];
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (column_[middle] <= column ? low : high) = middle;
    }
    return {value_start_[row] + static_cast<std::size_t>(offset_[low]),
            static_cast<std::size_t>(row_length_[row])};
  }

  /// Sends the rows assembled for other ranks to their owners, who add them. Collective.
  void collect_matrix(Matrix& matrix) const;
  /// The same for a vector over owned and ghost unknowns.
  void collect_vector(std::vector<double>& local) const;

 private:
  void couple(const Elements& elements);
  void exchange_rows(const Communicator& communicator);
  void lay_out();
  void allocate(Matrix& matrix);

  Communicator communicator_;
  int owned_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::size_t> start_;  ///< [row node + 1] into column_ and offset_
  std::vector<int> column_;         ///< column nodes, ascending per row
  std::vector<int> offset_;         ///< of the block in the scalar row
  std::vector<std::size_t> value_start_;
  std::vector<int> row_length_;
  // Rows for other ranks.
  std::vector<std::vector<int>> sent_nodes_;         ///< ghost row nodes, per owner
  std::vector<std::vector<std::size_t>> received_;   ///< positions in the matrix, per sender
  std::vector<std::vector<int>> received_unknowns_;  ///< first unknown and size pairs, per sender
};

}  // namespace seam
