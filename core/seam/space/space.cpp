// SPDX-License-Identifier: BSD-3-Clause
#include "seam/space/space.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "seam/mesh/lagrange.hpp"

namespace seam {
namespace {

/// Gives equal keys equal numbers, ascending from `first` in the order of the keys.
template <std::size_t n>
int number_entities(const std::vector<std::array<int, n>>& keys, int first, std::vector<int>& number) {
  std::vector<int> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] < keys[b]; });
  number.resize(keys.size());
  int next = first - 1;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || keys[order[k]] != keys[order[k - 1]]) ++next;
    number[order[k]] = next;
  }
  return next + 1;
}

}  // namespace

Space::Space(const Mesh& mesh, int order, int sets)
    : mesh_(&mesh), order_(order), nodes_per_cell_(topology(mesh.type()).nodes(order)), sets_(sets) {
  number_locally(global_cell_nodes(mesh.whole()));
  add_sets();
  place_nodes();
  build_halo();
}

/// Global node numbers of all cells of the undistributed mesh.
std::vector<int> Space::global_cell_nodes(const MeshData& whole) {
  const CellTopology& cell = topology(whole.type);
  const int geometry_nodes = whole.nodes_per_cell(), count = whole.cell_count();
  global_bound_ = whole.node_count();
  if (order_ == whole.order) return whole.cells;

  std::vector<int> all(static_cast<std::size_t>(count) * nodes_per_cell_);
  const auto geometry = [&](int c, int a) {
    return whole.cells[static_cast<std::size_t>(c) * geometry_nodes + a];
  };
  for (int c = 0; c < count; ++c)
    for (int a = 0; a < cell.vertices; ++a)
      all[static_cast<std::size_t>(c) * nodes_per_cell_ + a] = geometry(c, a);
  if (order_ == 1) return all;

  // Order 2 on straight cells: one node per edge, per quadrilateral face, per quadrilateral or hexahedral
  // cell.
  int slot = cell.vertices;
  std::vector<int> number;
  std::vector<std::array<int, 2>> edges;
  for (int c = 0; c < count; ++c)
    for (const auto& [v, w] : cell.edges) {
      const auto [low, high] = std::minmax({geometry(c, v), geometry(c, w)});
      edges.push_back({low, high});
    }
  global_bound_ = number_entities(edges, global_bound_, number);
  const int edge_count = static_cast<int>(cell.edges.size());
  for (int c = 0; c < count; ++c)
    for (int e = 0; e < edge_count; ++e)
      all[static_cast<std::size_t>(c) * nodes_per_cell_ + slot + e] =
          number[static_cast<std::size_t>(c) * edge_count + e];
  slot += edge_count;

  if (cell.face_type == CellType::quadrilateral) {
    std::vector<std::array<int, 4>> faces;
    for (int c = 0; c < count; ++c)
      for (const auto& face : cell.faces) {
        std::array<int, 4> key{geometry(c, face[0]), geometry(c, face[1]), geometry(c, face[2]),
                               geometry(c, face[3])};
        std::sort(key.begin(), key.end());
        faces.push_back(key);
      }
    global_bound_ = number_entities(faces, global_bound_, number);
    const int face_count = static_cast<int>(cell.faces.size());
    for (int c = 0; c < count; ++c)
      for (int f = 0; f < face_count; ++f)
        all[static_cast<std::size_t>(c) * nodes_per_cell_ + slot + f] =
            number[static_cast<std::size_t>(c) * face_count + f];
    slot += face_count;
  }
  if (slot < nodes_per_cell_)
    for (int c = 0; c < count; ++c)
      all[static_cast<std::size_t>(c) * nodes_per_cell_ + slot] = global_bound_++;
  return all;
}

void Space::number_locally(const std::vector<int>& all_cell_nodes) {
  const auto& cell_owner = mesh_->owner_of_global_cell();
  std::vector<int> node_owner(global_bound_, -1);
  for (std::size_t c = 0; c < cell_owner.size(); ++c)
    for (int a = 0; a < nodes_per_cell_; ++a) {
      int& owner = node_owner[all_cell_nodes[c * nodes_per_cell_ + a]];
      if (owner < 0 || cell_owner[c] < owner) owner = cell_owner[c];
    }
  const int rank = mesh_->communicator().rank();
  std::vector<int> present;
  for (int c = 0; c < mesh_->cells(); ++c) {
    const auto first =
        all_cell_nodes.begin() + static_cast<std::ptrdiff_t>(mesh_->global_cell(c)) * nodes_per_cell_;
    present.insert(present.end(), first, first + nodes_per_cell_);
  }
  cell_nodes_ = present;
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
  std::stable_partition(present.begin(), present.end(), [&](int node) { return node_owner[node] == rank; });
  global_ = std::move(present);
  for (int i = 0; i < nodes(); ++i) {
    local_of_global_[global_[i]] = i;
    owner_.push_back(node_owner[global_[i]]);
    owned_nodes_ += owner_[i] == rank ? 1 : 0;
  }
  for (int& node : cell_nodes_) node = local_of_global_.at(node);
}

/// Repeats the owned nodes and the ghosts for every further set.
void Space::add_sets() {
  const int owned = owned_nodes_, count = nodes();
  const std::vector<int> global = global_, owner = owner_;
  const auto append = [&](int first, int last, int set) {
    for (int n = first; n < last; ++n) {
      global_.push_back(global[n] + set * global_bound_);
      owner_.push_back(owner[n]);
    }
  };
  global_.clear();
  owner_.clear();
  for (int set = 0; set < sets_; ++set) append(0, owned, set);
  for (int set = 0; set < sets_; ++set) append(owned, count, set);
  for (int& node : cell_nodes_)
    if (node >= owned) node += (sets_ - 1) * owned;
  owned_nodes_ = sets_ * owned;
  ghost_nodes_ = sets_ * (count - owned);
  global_bound_ *= sets_;
  for (int n = 0; n < nodes(); ++n) local_of_global_[global_[n]] = n;
}

void Space::place_nodes() {
  const CellTopology& cell = topology(mesh_->type());
  const int dim = mesh_->dimension();
  ShapeTable shapes;
  tabulate(mesh_->type(), mesh_->order(), cell.node_coordinates.data(), nodes_per_cell_, false, shapes);
  position_.assign(static_cast<std::size_t>(nodes()) * dim, 0.0);
  for (int c = 0; c < mesh_->cells(); ++c)
    for (int a = 0; a < nodes_per_cell_; ++a)
      for (int d = 0; d < dim; ++d) {
        double x = 0;
        for (int b = 0; b < shapes.nodes; ++b) x += shapes.value_at(a)[b] * mesh_->geometry(c)[b * dim + d];
        for (int set = 0; set < sets_; ++set)
          position_[static_cast<std::size_t>(in_set(cell_nodes(c)[a], set)) * dim + d] = x;
      }
}

void Space::build_halo() {
  halo_ = Halo(mesh_->communicator(), owned_nodes_, {global_.begin() + owned_nodes_, global_.end()},
               {owner_.begin() + owned_nodes_, owner_.end()},
               [&](int global) { return local_of_global_.at(global); });
}

int Space::local_node(int global) const {
  const auto found = local_of_global_.find(global);
  return found == local_of_global_.end() ? -1 : found->second;
}

void Space::add_foreign(const std::vector<ForeignNode>& foreign) {
  for (const ForeignNode& node : foreign) {
    if (!local_of_global_.try_emplace(node.global, nodes()).second) continue;
    global_.push_back(node.global);
    owner_.push_back(node.owner);
    position_.insert(position_.end(), node.position, node.position + mesh_->dimension());
  }
  build_halo();
}

}  // namespace seam
