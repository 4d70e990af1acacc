// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/node_graph.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace seam {

void NodeGraph::build(const Communicator& communicator, std::vector<Node> nodes, int owned,
                      const Elements& elements, Matrix& matrix) {
  communicator_ = communicator;
  const std::vector<Node> old_nodes = std::exchange(nodes_, std::move(nodes));
  const std::vector<std::size_t> old_start = std::exchange(start_, {});
  const std::vector<int> old_column = std::exchange(column_, {});
  owned_ = owned;
  couple(elements);
  exchange_rows(communicator);
  allocate(matrix);
  // A body that moves within its cells changes the elements, but rarely what they couple.
  if (communicator.any(nodes_ != old_nodes || start_ != old_start || column_ != old_column))
    ++matrix.pattern_version;
}

/// Fills start_ and column_ with what this rank's own elements couple.
void NodeGraph::couple(const Elements& elements) {
  const int n = static_cast<int>(nodes_.size());
  std::vector<std::size_t> of_node(n + 1, 0);
  for (const int node : elements.node) ++of_node[node + 1];
  for (int i = 0; i < n; ++i) of_node[i + 1] += of_node[i];
  std::vector<int> element_of(elements.node.size());
  {
    auto next = of_node;
    for (std::size_t e = 0; e + 1 < elements.start.size(); ++e)
      for (std::size_t k = elements.start[e]; k < elements.start[e + 1]; ++k)
        element_of[next[elements.node[k]]++] = static_cast<int>(e);
  }
  std::vector<int> seen_by(n, -1);
  start_.assign(1, 0);
  column_.clear();
  for (int row = 0; row < n; ++row) {
    // An owned row without any element still gets its diagonal, so that the solver can name it.
    if (row < owned_) {
      seen_by[row] = row;
      column_.push_back(row);
    }
    for (std::size_t k = of_node[row]; k < of_node[row + 1]; ++k) {
      const std::size_t e = element_of[k];
      for (std::size_t m = elements.start[e]; m < elements.start[e + 1]; ++m)
        if (const int node = elements.node[m]; seen_by[node] != row) {
          seen_by[node] = row;
          column_.push_back(node);
        }
    }
    std::sort(column_.begin() + static_cast<std::ptrdiff_t>(start_.back()), column_.end());
    start_.push_back(column_.size());
  }
}

/// Sends the rows of ghosts to their owners and merges what arrives; columns this rank has not met become
/// foreign nodes.
void NodeGraph::exchange_rows(const Communicator& communicator) {
  const int ranks = communicator.size();
  sent_nodes_.assign(ranks, {});
  received_unknowns_.assign(ranks, {});
  received_.assign(ranks, {});
  if (ranks == 1) return;

  std::vector<std::vector<long long>> out(ranks);
  for (int row = owned_; row < static_cast<int>(nodes_.size()); ++row) {
    if (start_[row] == start_[row + 1]) continue;
    auto& message = out[nodes_[row].owner];
    sent_nodes_[nodes_[row].owner].push_back(row);
    message.push_back(nodes_[row].equation);
    message.push_back(static_cast<long long>(start_[row + 1] - start_[row]));
    for (std::size_t k = start_[row]; k < start_[row + 1]; ++k) {
      message.push_back(nodes_[column_[k]].equation);
      message.push_back(nodes_[column_[k]].size);
    }
  }
  const auto in = communicator.exchange(out);

  std::unordered_map<long long, int> known;
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) known[nodes_[i].equation] = i;
  std::vector<std::pair<long long, int>> foreign;
  const auto for_each_row = [&](auto&& on_row) {
    for (int r = 0; r < ranks; ++r)
      for (std::size_t at = 0; at < in[r].size(); at += 2 + 2 * static_cast<std::size_t>(in[r][at + 1]))
        on_row(r, in[r].data() + at);
  };
  for_each_row([&](int, const long long* row) {
    for (long long k = 0; k < row[1]; ++k)
      if (!known.contains(row[2 + 2 * k]))
        foreign.emplace_back(row[2 + 2 * k], static_cast<int>(row[3 + 2 * k]));
  });
  std::sort(foreign.begin(), foreign.end());
  foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());
  const int held = static_cast<int>(nodes_.size());
  for (const auto& [equation, size] : foreign) {
    known[equation] = static_cast<int>(nodes_.size());
    nodes_.push_back({size, -1, nodes_.back().first + nodes_.back().size, equation});
  }

  std::vector<std::vector<int>> extra(owned_);
  for_each_row([&](int, const long long* row) {
    auto& columns = extra[known.at(row[0])];
    for (long long k = 0; k < row[1]; ++k) columns.push_back(known.at(row[2 + 2 * k]));
  });
  std::vector<std::size_t> start{0};
  std::vector<int> column;
  column.reserve(column_.size());
  for (int row = 0; row < held; ++row) {
    column.insert(column.end(), column_.begin() + static_cast<std::ptrdiff_t>(start_[row]),
                  column_.begin() + static_cast<std::ptrdiff_t>(start_[row + 1]));
    if (row < owned_ && !extra[row].empty()) {
      column.insert(column.end(), extra[row].begin(), extra[row].end());
      const auto first = column.begin() + static_cast<std::ptrdiff_t>(start.back());
      std::sort(first, column.end());
      column.erase(std::unique(first, column.end()), column.end());
    }
    start.push_back(column.size());
  }
  start_ = std::move(start);
  column_ = std::move(column);

  // Where the entries that will arrive belong.
  lay_out();
  for_each_row([&](int rank, const long long* row) {
    const int mine = known.at(row[0]);
    received_unknowns_[rank].push_back(nodes_[mine].first);
    received_unknowns_[rank].push_back(nodes_[mine].size);
    for (int i = 0; i < nodes_[mine].size; ++i)
      for (long long k = 0; k < row[1]; ++k) {
        const BlockEntries at = place(mine, known.at(row[2 + 2 * k]));
        for (long long j = 0; j < row[3 + 2 * k]; ++j)
          received_[rank].push_back(at.first + at.row_length * static_cast<std::size_t>(i) +
                                    static_cast<std::size_t>(j));
      }
  });
}

/// Places the blocks of every row one after the other.
void NodeGraph::lay_out() {
  value_start_.assign(1, 0);
  offset_.resize(column_.size());
  row_length_.clear();
  for (std::size_t row = 0; row + 1 < start_.size(); ++row) {
    int length = 0;
    for (std::size_t k = start_[row]; k < start_[row + 1]; ++k) {
      offset_[k] = length;
      length += nodes_[column_[k]].size;
    }
    row_length_.push_back(length);
    value_start_.push_back(value_start_.back() + static_cast<std::size_t>(length) * nodes_[row].size);
  }
}

void NodeGraph::allocate(Matrix& matrix) {
  lay_out();
  const int unknowns = owned_ == 0 ? 0 : nodes_[owned_ - 1].first + nodes_[owned_ - 1].size;
  matrix.allocate(unknowns, value_start_[owned_], value_start_.back());
  std::size_t next = 0;
  int r = 0;
  for (int row = 0; row < owned_; ++row)
    for (int i = 0; i < nodes_[row].size; ++i) {
      for (std::size_t k = start_[row]; k < start_[row + 1]; ++k)
        for (int j = 0; j < nodes_[column_[k]].size; ++j)
          matrix.column[next++] = nodes_[column_[k]].first + j;
      matrix.row_start[++r] = next;
    }
  matrix.column_global.clear();
  for (const Node& node : nodes_)
    for (int i = 0; i < node.size; ++i) matrix.column_global.push_back(node.equation + i);
}

void NodeGraph::collect_matrix(Matrix& matrix) const {
  if (communicator_.size() == 1) return;
  std::vector<std::vector<double>> out(sent_nodes_.size());
  for (std::size_t r = 0; r < sent_nodes_.size(); ++r)
    for (const int node : sent_nodes_[r])
      out[r].insert(out[r].end(), matrix.value.begin() + value_start_[node],
                    matrix.value.begin() + value_start_[node + 1]);
  const auto in = communicator_.exchange(out);
  for (std::size_t r = 0; r < in.size(); ++r)
    for (std::size_t k = 0; k < in[r].size(); ++k) matrix.value[received_[r][k]] += in[r][k];
}

void NodeGraph::collect_vector(std::vector<double>& local) const {
  if (communicator_.size() == 1) return;
  std::vector<std::vector<double>> out(sent_nodes_.size());
  for (std::size_t r = 0; r < sent_nodes_.size(); ++r)
    for (const int node : sent_nodes_[r])
      for (int i = 0; i < nodes_[node].size; ++i) out[r].push_back(local[nodes_[node].first + i]);
  const auto in = communicator_.exchange(out);
  for (std::size_t r = 0; r < in.size(); ++r) {
    std::size_t k = 0;
    for (std::size_t m = 0; m < received_unknowns_[r].size(); m += 2)
      for (int i = 0; i < received_unknowns_[r][m + 1]; ++i)
        local[received_unknowns_[r][m] + i] += in[r][k++];
  }
}

}  // namespace seam
