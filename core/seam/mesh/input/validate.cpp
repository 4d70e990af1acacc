// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>

#include "seam/mesh/input/mesh_input.hpp"

namespace seam {

namespace {

constexpr int reported = 10;

/// Gathers the offenders of one kind; all of them are counted, the first ones described.
class Offenders {
 public:
  template <class Describe>
  void add(Describe&& describe) {
    if (count_++ < reported) lines_.push_back(describe());
  }
  void throw_if_any(const std::string& origin, const std::string& what, const std::string& hint) const {
    if (count_ == 0) return;
    std::string message = fmt::format("{} {}", count_, what);
    for (const auto& line : lines_) message += "\n  " + line;
    if (count_ > reported) message += fmt::format("\n  ... and {} more", count_ - reported);
    if (!hint.empty()) message += "\n  hint: " + hint;
    throw Error(Location{origin}, message);
  }

 private:
  long count_ = 0;
  std::vector<std::string> lines_;
};

/// Gradients of the Lagrange shape functions at the second-order nodes of a cell, [node at][direction][node
/// of]. Tensor cells are products of one-dimensional functions, simplices polynomials of barycentric
/// coordinates.
class Gradients {
 public:
  Gradients(const CellTopology& t, int order)
      : t_(t), order_(order), nodes_(t.nodes(order)), points_(t.nodes(2)) {
    values_.reserve(static_cast<std::size_t>(points_) * t.dimension * nodes_);
    for (int q = 0; q < points_; ++q)
      for (int k = 0; k < t.dimension; ++k)
        for (int a = 0; a < nodes_; ++a)
          values_.push_back(is_simplex(t_.type) ? in_simplex(q, k, a) : in_tensor(q, k, a));
  }
  [[nodiscard]] int points() const { return points_; }
  [[nodiscard]] const double* at(int point, int direction) const {
    return &values_[(static_cast<std::size_t>(point) * t_.dimension + direction) * nodes_];
  }

 private:
  [[nodiscard]] const double* place(int node) const { return &t_.node_coordinates[node * t_.dimension]; }

  /// Lagrange function of the node at c (0, 1/2 or 1) and its slope.
  [[nodiscard]] std::array<double, 2> line(double c, double x) const {
    if (order_ == 1) return c < 0.5 ? std::array{1 - x, -1.0} : std::array{x, 1.0};
    if (c < 0.25) return {(1 - x) * (1 - 2 * x), 4 * x - 3};
    if (c > 0.75) return {x * (2 * x - 1), 4 * x - 1};
    return {4 * x * (1 - x), 4 - 8 * x};
  }
  [[nodiscard]] double in_tensor(int q, int k, int a) const {
    double product = 1;
    for (int i = 0; i < t_.dimension; ++i) product *= line(place(a)[i], place(q)[i])[i == k ? 1 : 0];
    return product;
  }

  [[nodiscard]] double in_simplex(int q, int k, int a) const {
    const auto barycentric = [&](int v) {
      const double* x = place(q);
      return v == 0 ? 1 - std::accumulate(x, x + t_.dimension, 0.0) : x[v - 1];
    };
    const auto slope = [&](int v) { return v == 0 ? -1.0 : (v - 1 == k ? 1.0 : 0.0); };
    if (order_ == 1) return slope(a);
    if (a < t_.vertices) return (4 * barycentric(a) - 1) * slope(a);
    const auto [v, w] = t_.edges[a - t_.vertices];
    return 4 * (barycentric(v) * slope(w) + slope(v) * barycentric(w));
  }

  const CellTopology& t_;
  int order_, nodes_, points_;
  std::vector<double> values_;
};

class Validation {
 public:
  Validation(const MeshData& mesh, const std::string& origin, const std::vector<long long>& numbers)
      : m_(mesh), origin_(origin), numbers_(numbers), t_(topology(mesh.type)), n_(t_.nodes(mesh.order)) {}

  void run() const {
    sizes();
    node_numbers();
    dangling_nodes();
    coordinates();
    repeated_cells();
    shapes();
    faces();
    groups();
  }

 private:
  [[nodiscard]] const int* cell(int c) const { return &m_.cells[static_cast<std::size_t>(c) * n_]; }
  [[nodiscard]] const double* node(int a) const {
    return &m_.coordinates[static_cast<std::size_t>(a) * m_.dimension];
  }

  /// A node's number in the file.
  [[nodiscard]] long long number(int a) const {
    return a >= 0 && a < static_cast<int>(numbers_.size()) ? numbers_[a] : a;
  }
  [[nodiscard]] std::vector<long long> numbers(const int* from, const int* to) const {
    std::vector<long long> result;
    std::transform(from, to, std::back_inserter(result), [&](int a) { return number(a); });
    return result;
  }
  /// A file that numbers its nodes numbers its elements, too: of cells it is not known how.
  [[nodiscard]] std::string name_of(int c) const {
    return numbers_.empty() ? fmt::format("cell {}", c) : std::string("the cell");
  }
  /// A cell as a user finds it again: number, nodes, place.
  [[nodiscard]] std::string describe(int c) const {
    std::array<double, 3> centre{};
    for (int v = 0; v < t_.vertices; ++v)
      for (int i = 0; i < m_.dimension; ++i) centre[i] += node(cell(c)[v])[i] / t_.vertices;
    return fmt::format("{} (nodes {}) around ({:.6g})", name_of(c),
                       fmt::join(numbers(cell(c), cell(c) + t_.vertices), " "),
                       fmt::join(centre.begin(), centre.begin() + m_.dimension, ", "));
  }

  void sizes() const {
    if (m_.cells.empty()) throw Error(Location{origin_}, "the mesh has no cells");
    if (m_.dimension != t_.dimension || m_.coordinates.size() % m_.dimension || m_.cells.size() % n_)
      throw Error(Location{origin_},
                  fmt::format("{} coordinates and {} cell nodes do not make whole {}s of order {} "
                              "in {} dimensions",
                              m_.coordinates.size(), m_.cells.size(), name(m_.type), m_.order, m_.dimension));
  }

  void node_numbers() const {
    Offenders bad;
    const int count = m_.node_count();
    for (int c = 0; c < m_.cell_count(); ++c)
      for (int a = 0; a < n_; ++a)
        if (const int number = cell(c)[a]; number < 0 || number >= count)
          bad.add([&] { return fmt::format("cell {} names node {}", c, number); });
    bad.throw_if_any(origin_,
                     fmt::format("cell node(s) outside the mesh, which has nodes 0 to {}:", count - 1), "");
  }

  void dangling_nodes() const {
    std::vector<bool> used(m_.node_count());
    for (const int a : m_.cells) used[a] = true;
    Offenders bad;
    for (int a = 0; a < m_.node_count(); ++a)
      if (!used[a])
        bad.add([&] {
          return fmt::format("node {} at ({:.6g})", number(a),
                             fmt::join(node(a), node(a) + m_.dimension, ", "));
        });
    bad.throw_if_any(origin_, "dangling node(s), which belong to no cell:",
                     "they would be unknowns without an equation; in Gmsh, save the physical groups only "
                     "(Mesh.SaveAll = 0)");
  }

  void coordinates() const {
    Offenders bad;
    for (int a = 0; a < m_.node_count(); ++a)
      if (!std::all_of(node(a), node(a) + m_.dimension, [](double x) { return std::isfinite(x); }))
        bad.add([&] { return fmt::format("node {}", number(a)); });
    bad.throw_if_any(origin_, "node(s) with coordinates that are not finite numbers:", "");
  }

  void repeated_cells() const {
    const int v = t_.vertices;
    std::vector<int> keys, by_key(m_.cell_count());
    keys.reserve(by_key.size() * v);
    for (int c = 0; c < m_.cell_count(); ++c) {
      keys.insert(keys.end(), cell(c), cell(c) + v);
      std::sort(keys.end() - v, keys.end());
    }
    const auto key = [&](int c) { return keys.begin() + static_cast<std::ptrdiff_t>(c) * v; };
    std::iota(by_key.begin(), by_key.end(), 0);
    std::sort(by_key.begin(), by_key.end(), [&](int a, int b) {
      const auto order = std::lexicographical_compare_three_way(key(a), key(a) + v, key(b), key(b) + v);
      return order != 0 ? order < 0 : a < b;
    });
    Offenders bad;
    for (std::size_t i = 1; i < by_key.size(); ++i)
      if (std::equal(key(by_key[i]), key(by_key[i]) + v, key(by_key[i - 1])))
        bad.add([&] {
          return fmt::format("{} repeats {}", describe(by_key[i]),
                             numbers_.empty() ? name_of(by_key[i - 1]) : "another one");
        });
    bad.throw_if_any(
        origin_, "cell(s) that are there twice:",
        "remove the copies; Gmsh's format 2.2 writes a cell once per physical group, so put each cell "
        "in one group or save format 4.1");
  }

  /// Smallest Jacobian determinant over the samples, relative to the cube of the diameter.
  [[nodiscard]] double relative_determinant(int c, const Gradients& gradients) const {
    const int dim = m_.dimension;
    double smallest = std::numeric_limits<double>::infinity(), size = 0;
    for (int a = 1; a < n_; ++a)
      for (int i = 0; i < dim; ++i)
        size = std::max(size, std::abs(node(cell(c)[a])[i] - node(cell(c)[0])[i]));
    if (size == 0) return 0;
    for (int q = 0; q < gradients.points(); ++q) {
      std::array<std::array<double, 3>, 3> j{};
      j[2][2] = dim == 2 ? 1 : 0;
      for (int k = 0; k < dim; ++k)
        for (int a = 0; a < n_; ++a)
          for (int i = 0; i < dim; ++i)
            j[k][i] += (node(cell(c)[a])[i] - node(cell(c)[0])[i]) / size * gradients.at(q, k)[a];
      const double determinant = j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                                 j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                                 j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
      smallest = std::min(smallest, determinant);
    }
    return smallest;
  }

  void shapes() const {
    // Below this the map to the reference cell loses all digits; slivers above it are the user's choice.
    constexpr double degenerate = 1e-13;
    const Gradients gradients(t_, m_.order);
    Offenders inverted, flat;
    for (int c = 0; c < m_.cell_count(); ++c) {
      const double d = relative_determinant(c, gradients);
      if (d < -degenerate)
        inverted.add([&] { return fmt::format("{}: Jacobian {:.3g} of its size", describe(c), d); });
      else if (!(d > degenerate))
        flat.add([&] { return describe(c); });
    }
    inverted.throw_if_any(origin_, "inverted cell(s) (the Jacobian is negative somewhere in them):",
                          m_.dimension == 2
                              ? "cells must be numbered counter-clockwise and be convex; in Gmsh, "
                                "turn the surface (ReverseMesh) or its curve loop"
                              : "check the order of the nodes and the shape of the cells; in Gmsh, "
                                "use ReverseMesh or optimise the mesh");
    flat.throw_if_any(origin_, "degenerate cell(s) (without area or volume somewhere in them):",
                      "remove them or merge their nodes");
  }

  void faces() const {
    struct Key {
      std::array<int, 4> nodes;
      int cell;
      bool operator<(const Key& o) const { return std::tie(nodes, cell) < std::tie(o.nodes, o.cell); }
    };
    std::vector<Key> keys;
    keys.reserve(static_cast<std::size_t>(m_.cell_count()) * t_.faces.size());
    for (int c = 0; c < m_.cell_count(); ++c)
      for (const auto& face : t_.faces) {
        Key key{{-1, -1, -1, -1}, c};
        for (std::size_t v = 0; v < face.size(); ++v) key.nodes[v] = cell(c)[face[v]];
        std::sort(key.nodes.begin(), key.nodes.end());
        keys.push_back(key);
      }
    std::sort(keys.begin(), keys.end());
    Offenders bad;
    for (std::size_t i = 2; i < keys.size(); ++i)
      if (keys[i].nodes == keys[i - 2].nodes)
        bad.add([&] {
          const auto first =
              std::find_if(keys[i].nodes.begin(), keys[i].nodes.end(), [](int a) { return a >= 0; });
          const auto nodes = numbers(&*first, keys[i].nodes.data() + keys[i].nodes.size());
          if (!numbers_.empty()) return fmt::format("face with nodes {}", fmt::join(nodes, " "));
          return fmt::format("face with nodes {} of cells {}, {} and {}", fmt::join(nodes, " "),
                             keys[i - 2].cell, keys[i - 1].cell, keys[i].cell);
        });
    bad.throw_if_any(origin_, "face(s) that more than two cells share:",
                     "cells overlap or several parts are glued at one face; check the geometry");
  }

  void groups() const {
    for (const auto& [group, faces] : m_.boundaries)
      for (const CellFace& f : faces)
        if (f.cell < 0 || f.cell >= m_.cell_count() || f.face < 0 ||
            f.face >= static_cast<int>(t_.faces.size()))
          throw Error(Location{origin_},
                      fmt::format("boundary '{}' names face {} of cell {}, which does not exist", group,
                                  f.face, f.cell));
    for (const auto& [group, cells] : m_.regions)
      for (const int c : cells)
        if (c < 0 || c >= m_.cell_count())
          throw Error(Location{origin_},
                      fmt::format("region '{}' names cell {}, which does not exist", group, c));
  }

  const MeshData& m_;
  const std::string& origin_;
  const std::vector<long long>& numbers_;
  const CellTopology& t_;
  int n_;
};

}  // namespace

void validate_mesh(const MeshData& mesh, const std::string& origin, const std::vector<long long>& numbers) {
  Validation(mesh, origin, numbers).run();
}

}  // namespace seam
