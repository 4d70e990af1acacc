// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cell_search.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <limits>

namespace seam::cutting {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Entry = std::pair<Box, int>;

Box box(const Vector& low, const Vector& high) {
  return {Point(low[0], low[1], low[2]), Point(high[0], high[1], high[2])};
}

}  // namespace

struct CellSearch::Tree {
  bg::index::rtree<Entry, bg::index::quadratic<16>> index;
};

CellSearch::CellSearch(const Outline& outline, int cells) : tree_(std::make_unique<Tree>()) {
  std::vector<Entry> entries;
  entries.reserve(cells);
  for (int c = 0; c < cells; ++c) {
    Vector low, high;
    low.fill(std::numeric_limits<double>::max());
    high.fill(std::numeric_limits<double>::lowest());
    for (int s = outline.first_side[c]; s < outline.first_side[c + 1]; ++s)
      for (int k = 0; k < outline.dimension; ++k) {
        const Vector& x = outline.position[outline.sides[s].vertex[k]];
        for (int i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], x[i]);
          high[i] = std::max(high[i], x[i]);
        }
      }
    entries.emplace_back(box(low, high), c);
  }
  tree_->index = decltype(tree_->index)(entries.begin(), entries.end());
}

CellSearch::CellSearch(const std::vector<std::pair<Vector, Vector>>& boxes)
    : tree_(std::make_unique<Tree>()) {
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < boxes.size(); ++k)
    entries.emplace_back(box(boxes[k].first, boxes[k].second), static_cast<int>(k));
  tree_->index = decltype(tree_->index)(entries.begin(), entries.end());
}

CellSearch::~CellSearch() = default;

void CellSearch::find(const Vector& low, const Vector& high, std::vector<int>& cells) const {
  const auto query = bg::index::intersects(box(low, high));
  for (auto entry = tree_->index.qbegin(query); entry != tree_->index.qend(); ++entry)
    cells.push_back(entry->second);
}

}  // namespace seam::cutting
