// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace seam {

namespace {

using Lattice = std::array<int, 3>;

/// A cell of the grid's pattern: reference coordinates xi sit at corner + sum of xi_k * axes[k] in a brick of
/// unit width.
struct Frame {
  Lattice corner;
  std::array<Lattice, 3> axes;
};

const Frame brick = {{0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

/// Two triangles for each of the two diagonals of a rectangle.
const std::vector<Frame> rising = {{{0, 0, 0}, {{{1, 0, 0}, {1, 1, 0}, {}}}},
                                   {{0, 0, 0}, {{{1, 1, 0}, {0, 1, 0}, {}}}}};
const std::vector<Frame> falling = {{{0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {}}}},
                                    {{1, 1, 0}, {{{-1, 0, 0}, {0, -1, 0}, {}}}}};

/// Kuhn's six tetrahedra, one per order in which a path along the edges visits the three directions. Opposite
/// faces of the brick are cut alike, so that neighbouring bricks fit.
std::vector<Frame> kuhn() {
  std::vector<Frame> frames;
  std::array<int, 3> path = {0, 1, 2};
  do {
    std::array<Lattice, 3> axes{};
    Lattice at = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      ++at[path[k]];
      axes[k] = at;
    }
    // An odd permutation gives a left-handed tetrahedron.
    const int inversions = (path[0] > path[1]) + (path[0] > path[2]) + (path[1] > path[2]);
    if (inversions % 2) std::swap(axes[0], axes[1]);
    frames.push_back({{0, 0, 0}, axes});
  } while (std::next_permutation(path.begin(), path.end()));
  return frames;
}

class Builder {
 public:
  explicit Builder(const Grid& grid) : grid_(grid), topology_(topology(grid.cell)) {
    for (int i = 0; i < topology_.dimension; ++i) {
      const auto& line = grid.lines[i];
      if (line.size() < 2 || !std::is_sorted(line.begin(), line.end(), std::less_equal<>()))
        throw std::logic_error("seam::make_grid: lines must be at least two and increase");
      bricks_[i] = static_cast<int>(line.size()) - 1;
    }
  }

  MeshData build() {
    check_size();
    mesh_.dimension = topology_.dimension;
    mesh_.type = grid_.cell;
    mesh_.order = grid_.order;
    add_nodes();
    for (int k = 0; k < bricks_[2]; ++k)
      for (int j = 0; j < bricks_[1]; ++j)
        for (int i = 0; i < bricks_[0]; ++i)
          for (const Frame& frame : pattern(i, j)) add_cell({i, j, k}, frame);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] const std::vector<Frame>& pattern(int i, int j) const {
    static const std::vector<Frame> tensor = {brick}, tetrahedra = kuhn();
    if (grid_.cell == CellType::tetrahedron) return tetrahedra;
    if (grid_.cell != CellType::triangle) return tensor;
    if (grid_.diagonals == Diagonals::alternating) return (i + j) % 2 ? falling : rising;
    return grid_.diagonals == Diagonals::rising ? rising : falling;
  }

  /// Everything later counts in int: cells times nodes and nodes times coordinates must fit.
  void check_size() const {
    double nodes = 1, cells = static_cast<double>(pattern(0, 0).size());
    for (int i = 0; i < topology_.dimension; ++i) {
      nodes *= static_cast<double>(bricks_[i]) * grid_.order + 1;
      cells *= bricks_[i];
    }
    const double entries = std::max(nodes * topology_.dimension, cells * topology_.nodes(grid_.order));
    if (entries > std::numeric_limits<int>::max())
      throw Error(
          fmt::format("a grid of {:.3g} cells and {:.3g} nodes is larger than a mesh can be (2^31 entries in "
                      "its tables); use fewer cells",
                      cells, nodes));
  }

  [[nodiscard]] double coordinate(int direction, int lattice) const {
    const auto& line = grid_.lines[direction];
    if (grid_.order == 1) return line[lattice];
    return lattice % 2 ? 0.5 * (line[lattice / 2] + line[lattice / 2 + 1]) : line[lattice / 2];
  }

  void add_nodes() {
    const int order = grid_.order, dimension = topology_.dimension;
    for (int i = 0; i < 3; ++i) nodes_[i] = i < dimension ? bricks_[i] * order + 1 : 1;
    mesh_.coordinates.reserve(static_cast<std::size_t>(nodes_[0]) * nodes_[1] * nodes_[2] * dimension);
    for (int k = 0; k < nodes_[2]; ++k)
      for (int j = 0; j < nodes_[1]; ++j)
        for (int i = 0; i < nodes_[0]; ++i) {
          mesh_.coordinates.push_back(coordinate(0, i));
          mesh_.coordinates.push_back(coordinate(1, j));
          if (dimension == 3) mesh_.coordinates.push_back(coordinate(2, k));
        }
  }

  void add_cell(const Lattice& at, const Frame& frame) {
    const int order = grid_.order, dimension = topology_.dimension;
    std::vector<Lattice> places(topology_.nodes(order));
    for (std::size_t a = 0; a < places.size(); ++a) {
      for (int i = 0; i < 3; ++i) {
        double offset = frame.corner[i];
        for (int k = 0; k < dimension; ++k)
          offset += topology_.node_coordinates[a * dimension + k] * frame.axes[k][i];
        places[a][i] = at[i] * order + static_cast<int>(std::lround(offset * order));
      }
      mesh_.cells.push_back((places[a][2] * nodes_[1] + places[a][1]) * nodes_[0] + places[a][0]);
    }
    const int cell = mesh_.cell_count() - 1;
    for (int f = 0; f < static_cast<int>(topology_.faces.size()); ++f) note_sides(places, {cell, f});
  }

  void note_sides(const std::vector<Lattice>& places, CellFace face) {
    static const std::array<std::array<const char*, 2>, 3> names = {
        {{"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}}};
    const auto& vertices = topology_.faces[face.face];
    for (int i = 0; i < topology_.dimension; ++i)
      for (const int end : {0, 1}) {
        const int line = end ? nodes_[i] - 1 : 0;
        if (std::all_of(vertices.begin(), vertices.end(), [&](int v) { return places[v][i] == line; }))
          mesh_.boundaries[names[i][end]].push_back(face);
      }
  }

  const Grid& grid_;
  const CellTopology& topology_;
  Lattice bricks_ = {1, 1, 1}, nodes_ = {1, 1, 1};
  MeshData mesh_;
};

}  // namespace

std::vector<double> graded_lines(double from, double to, int n, double ratio) {
  // Widths w, wq, ..., wq^(n-1) with q^(n-1) = ratio; expm1 keeps the quotient exact near q = 1.
  const double log_q = n > 1 ? std::log(ratio) / (n - 1) : 0.0;
  std::vector<double> lines(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i <= n; ++i) {
    const double fraction =
        log_q == 0.0 ? static_cast<double>(i) / n : std::expm1(i * log_q) / std::expm1(n * log_q);
    lines[i] = from + fraction * (to - from);
  }
  lines[n] = to;
  return lines;
}

MeshData make_grid(const Grid& grid) { return Builder(grid).build(); }

}  // namespace seam
