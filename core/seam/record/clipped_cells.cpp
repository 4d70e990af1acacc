// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/clipped_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "seam/cut/cell_map.hpp"
#include "seam/mesh/lagrange.hpp"

namespace seam {
namespace {

using cutting::CellMap;
using cutting::Vector;

/// Of a cell's diameter: corners that lie closer together are the same but for rounding.
constexpr double same_point = 1e-11;

/// Numbers of points by their positions.
class PointNumbers {
 public:
  explicit PointNumbers(double resolution) : resolution_(resolution) {}
  /// The number under which an equal position was added, or -1.
  [[nodiscard]] int find(const Vector& x) const {
    const Key middle = key(x);
    // Equal positions may be rounded to different sides, hence the neighbours.
    for (int offset = 0; offset < 27; ++offset) {
      Key near = middle;
      for (int d = 0, rest = offset; d < 3; ++d, rest /= 3) near[d] += rest % 3 - 1;
      if (const auto found = number_.find(near); found != number_.end()) return found->second;
    }
    return -1;
  }
  void add(const Vector& x, int number) { number_.emplace(key(x), number); }

 private:
  using Key = std::array<long long, 3>;
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::size_t hash = 0;
      for (const long long x : k) hash = hash * 0x9e3779b97f4a7c15ULL + static_cast<std::size_t>(x);
      return hash;
    }
  };
  [[nodiscard]] Key key(const Vector& x) const {
    return {std::llround(x[0] / resolution_), std::llround(x[1] / resolution_),
            std::llround(x[2] / resolution_)};
  }
  double resolution_;
  std::unordered_map<Key, int, Hash> number_;
};

double smallest_diameter(const Mesh& mesh) {
  double smallest = mesh.diameter(0);
  for (int c = 1; c < mesh.cells(); ++c) smallest = std::min(smallest, mesh.diameter(c));
  return smallest;
}

Vector vector_of(const double* x, int dimension) {
  Vector result{};
  std::copy_n(x, dimension, result.begin());
  return result;
}

}  // namespace

ClippedCells::ClippedCells(const Field& field, const Space& space) : space_(&space) {
  const Mesh& mesh = space.mesh();
  const CutMesh& cut = *field.cut();
  if (mesh.cells() == 0) return;
  const int dim = mesh.dimension(), per_cell = space.nodes_per_cell();
  const double resolution = same_point * smallest_diameter(mesh);
  PointNumbers numbers(resolution);
  const auto add_nodes = [&](const int* nodes) {
    for (int a = 0; a < per_cell; ++a) numbers.add(vector_of(space.position(nodes[a]), dim), nodes[a]);
  };
  const bool shared = field.sets() == 1;
  for (const int c : cut.cut_cells())
    if (shared) add_nodes(space.cell_nodes(c));
  std::vector<double> corners;
  ShapeTable table;
  for (const int c : cut.cut_cells())
    for (int part = 0; part < field.parts(c); ++part) {
      if (c >= mesh.owned_cells() || !field.active_cells()[c]) continue;
      const int* nodes = field.cell_nodes(space, c, part);
      if (!shared) {
        numbers = PointNumbers(resolution);
        add_nodes(nodes);
      }
      cut.wet_simplices(c, corners, part);
      const CellMap map(mesh, c);
      for (std::size_t k = 0; k < corners.size(); k += dim) {
        const Vector x = vector_of(&corners[k], dim);
        int number = numbers.find(x);
        if (number < 0) {
          number = space.nodes() + static_cast<int>(nodes_.size());
          numbers.add(x, number);
          points.insert(points.end(), x.begin(), x.begin() + dim);
          nodes_.push_back(nodes);
          tabulate(mesh.type(), space.order(), map.to_reference(x).data(), 1, false, table);
          shape_value_.insert(shape_value_.end(), table.value.begin(), table.value.begin() + per_cell);
        }
        simplices.push_back(number);
      }
      background.resize(simplices.size() / (dim + 1), c);
    }
}

void ClippedCells::append_values(int components, std::vector<double>& values) const {
  const int per_cell = space_->nodes_per_cell();
  values.resize(static_cast<std::size_t>(space_->nodes() + nodes_.size()) * components);
  for (std::size_t p = 0; p < nodes_.size(); ++p) {
    double* value = &values[(space_->nodes() + p) * components];
    for (int a = 0; a < per_cell; ++a) {
      const double* nodal = &values[static_cast<std::size_t>(nodes_[p][a]) * components];
      for (int k = 0; k < components; ++k) value[k] += shape_value_[p * per_cell + a] * nodal[k];
    }
  }
}

}  // namespace seam
