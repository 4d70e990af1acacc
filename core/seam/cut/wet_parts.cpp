// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/wet_parts.hpp"

#include <algorithm>
#include <map>

#include "seam/base/disjoint_sets.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/cut/geometry.hpp"
#include "seam/cut/slivers.hpp"

namespace seam {
namespace {

using namespace cutting;

struct LabelVolume {
  int label;
  double volume, largest;
};

}  // namespace

bool CutMesh::is_wet(int cell, int face) const {
  if (state_[cell] != CellState::cut) return state_[cell] == CellState::wet;
  const CutCell& cut = geometry_->at(cell);
  if ((cut.dry_faces >> face & 1U) != 0) return false;
  double area = 0;
  for (const SideSimplex& w : cut.wet)
    if (w.face == face) area += w.area;
  return area > 0;
}

WetParts CutMesh::find_parts() const {
  const auto& neighbour = geometry_->outline.neighbour;
  const int faces = static_cast<int>(topology(mesh_->type()).faces.size());
  DisjointSets sets(mesh_->cells());
  for (int c = 0; c < mesh_->cells(); ++c)
    for (int f = 0; f < faces; ++f) {
      const int other = neighbour[c][f];
      if (other > c && is_wet(c, f) && state_[other] != CellState::body) sets.unite(c, other);
    }
  // The lowest global number in a part, first of what is local, then spread until no rank learns anything
  // new.
  std::vector<int> label(mesh_->cells());
  for (int c = 0; c < mesh_->cells(); ++c) label[c] = mesh_->global_cell(c);
  const auto lower = [&](int cell, int value) {
    int& mine = label[sets.root(cell)];
    const bool changed = value < mine;
    mine = std::min(mine, value);
    return changed;
  };
  for (int c = 0; c < mesh_->cells(); ++c) lower(c, mesh_->global_cell(c));
  for (bool changed = true; changed; changed = mesh_->communicator().any(changed)) {
    changed = false;
    geometry_->ghosts.update([&](int c) { return label[sets.root(c)]; },
                             [&](int c, int value) {
                               if (state_[c] != CellState::body) changed = lower(c, value) || changed;
                             });
  }
  std::map<int, LabelVolume> shares;
  for (int c = 0; c < mesh_->owned_cells(); ++c) {
    if (state_[c] == CellState::body) continue;
    const double whole = geometry_->outline.volume(c);
    LabelVolume& share =
        shares.try_emplace(label[sets.root(c)], LabelVolume{label[sets.root(c)], 0, 0}).first->second;
    share.volume += state_[c] == CellState::cut ? wet_volume(c) : whole;
    share.largest = std::max(share.largest, whole);
  }
  std::vector<LabelVolume> mine;
  for (const auto& [key, share] : shares) mine.push_back(share);
  shares.clear();
  for (const LabelVolume& s : mesh_->communicator().gather_all(mine)) {
    LabelVolume& share = shares.try_emplace(s.label, LabelVolume{s.label, 0, 0}).first->second;
    share.volume += s.volume;
    share.largest = std::max(share.largest, s.largest);
  }
  WetParts parts;
  std::map<int, int> number;
  for (const auto& [key, share] : shares) {
    number[key] = static_cast<int>(parts.volume.size());
    parts.volume.push_back(share.volume);
    parts.cells.push_back(share.volume / share.largest);
  }
  for (int c = 0; c < mesh_->cells(); ++c)
    parts.part.push_back(state_[c] == CellState::body ? -1 : number.at(label[sets.root(c)]));
  return parts;
}

double CutMesh::drop(const std::vector<int>& cells) {
  double volume = 0;
  std::vector<char> dropped(mesh_->cells(), 0);
  for (const int c : cells) {
    if (state_[c] == CellState::body) continue;
    dropped[c] = 1;
    if (c < mesh_->owned_cells())
      volume += state_[c] == CellState::cut ? wet_volume(c) : geometry_->outline.volume(c);
  }
  drop_cells(geometry_->outline, dropped, geometry_->cells, state_);
  number_cut_cells();
  return mesh_->communicator().sum(volume);
}

}  // namespace seam
