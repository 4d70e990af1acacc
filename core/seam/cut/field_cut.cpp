// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/field_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "seam/assembly/together.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/cut/part_sets.hpp"
#include "seam/cut/sound_surfaces.hpp"
#include "seam/state/state_store.hpp"

namespace seam {
namespace {

/// In cells: parts of less volume are dropped.
constexpr double smallest_kept = 2;

}  // namespace

FieldCut::~FieldCut() = default;

FieldCut::Decision FieldCut::decision(int cell) const { return static_cast<Decision>(decision_.now()[cell]); }

void FieldCut::hold() {
  held_.now() = active_;
  field_->keep_cut_faces(true);
}

FieldCut::FieldCut(Field& field)
    : field_(&field),
      mesh_(field.mesh()),
      active_(field.mesh().cells(), 1),
      decision_(field.state().add<char>({field.name() + "/cut/decision", cells_of(field.mesh())})),
      held_(field.state().add<char>({field.name() + "/cut/held", cells_of(field.mesh())})),
      extension_(field) {
  field.remember_cut_faces();
  field.state().on_return([this](double time) { return_to(time); });
  if (field.sets() > 1) sets_ = std::make_unique<PartSets>(field);
}

int FieldCut::add_body(Body body, const std::string& of) {
  bodies_.push_back(std::move(body));
  fields_of_bodies_.push_back(of);
  return static_cast<int>(bodies_.size()) - 1;
}

/// False after a failed step was rewound: then nodes known at its start may be inactive in the present cut.
bool FieldCut::states_match() const {
  bool match = field_->layout() == layout_;
  for (const Block& block : field_->blocks()) match = match && (block.given || block.known == block.active);
  return !field_->mesh().communicator().any(!match);
}

bool FieldCut::update(double time) {
  std::vector<Surface> surfaces;
  together(field_->mesh().communicator(), [&] {
    for (const Body& body : bodies_) surfaces.push_back(body(time));
  });
  if (time != time_) decided_ = false;
  time_ = time;
  const bool decides = !decided_;
  if (decides) {
    std::ranges::fill(held_.now(), 0);
    field_->keep_cut_faces(false);
  }
  if (surfaces == surfaces_ && (!decides || (is_first_cut_ && !is_filling_)) && states_match()) {
    decided_ = true;
    return false;
  }
  const std::vector<char> before = decision_.now();
  cut(surfaces);
  decided_ = true;
  surfaces_ = std::move(surfaces);
  is_first_cut_ = decides;
  dropped_volume_ = mesh_.drop(decides ? decide() : follow_decision());
  if (decides) warn_of_doubts();
  if (decides) area_.clear();
  for (const int c : mesh_.cut_cells()) area_.try_emplace(c, mesh_.interface_area(c));
  for (int c = 0; c < field_->mesh().cells(); ++c)
    active_[c] = mesh_.state(c) != CellState::body || held_.now()[c] != 0 ? 1 : 0;
  uncover(before);
  if (sets_) choose_sets();
  field_->occupy(active_, &mesh_);
  extension_.extend();
  return true;
}

/// What cannot be cut at the start is a mistake; later it is where an iteration, or a step, went astray.
void FieldCut::cut(const std::vector<Surface>& surfaces) {
  if (!was_cut_) refuse_unsound_surfaces(field_->mesh(), surfaces, fields_of_bodies_);
  try {
    mesh_.cut(surfaces);
  } catch (const PluginFault&) {
    throw;
  } catch (const Error& error) {
    if (!was_cut_) throw;
    surfaces_.clear();
    throw StepRefused(error.what());
  }
  was_cut_ = true;
}

void FieldCut::return_to(double time) {
  const auto is_made = [](char decision) { return static_cast<Decision>(decision) != Decision::none; };
  decided_ = field_->mesh().communicator().any(std::ranges::any_of(decision_.now(), is_made));
  time_ = time;
  surfaces_.clear();  // the mesh is cut anew, whatever it was cut by last
}

/// @param before what had been decided of each cell before this cut
void FieldCut::uncover(const std::vector<char>& before) {
  std::vector<int> fresh;
  for (int c = 0; c < field_->mesh().cells(); ++c) {
    const auto last = static_cast<Decision>(before[c]);
    if (active_[c] != 0 && last != Decision::none && last != Decision::kept) fresh.push_back(c);
  }
  field_->state().uncover(field_->mesh(), fresh);
}

void FieldCut::choose_sets() {
  mesh_.separate_parts();
  const std::shared_ptr<const PartLayout> before = field_->layout();
  const std::shared_ptr<PartLayout> now = sets_->find(mesh_, active_);
  warn_of_shared_sets();
  for (const Surface& surface : surfaces_) now->body_points.push_back(surface.points);
  if (before) {
    check_motion(*before);
    carry_over(*field_, *before, *now, mesh_);
  }
  layout_ = now;
  field_->set_layout(layout_);
  accept_states(!before);
}

/// Says it once in a run, on one rank.
void FieldCut::warn(const std::string& kind, const std::string& message) {
  if (warned_.insert(kind).second && field_->mesh().communicator().rank() == 0)
    fmt::print(stderr, "warning: field '{}': {}\n", field_->name(), message);
}

void FieldCut::warn_of_doubts() {
  for (const CutMesh::Doubt& doubt : mesh_.doubts()) warn(doubt.kind, doubt.message);
}

void FieldCut::warn_of_shared_sets() {
  const Communicator& communicator = field_->mesh().communicator();
  std::vector<std::array<double, 3>> where = sets_->shared();
  if (!communicator.any(!where.empty()) || warned_.contains("shared")) return;
  where = communicator.gather_all(where);
  const auto first = *std::min_element(where.begin(), where.end());
  warn(
      "shared",
      fmt::format(
          "bodies part it into more than {} parts around one node, first near ({:.6g}, {:.6g}, {:.6g}); some "
          "of them share unknowns there, so that they leak into each other; use smaller cells there",
          field_->sets(), first[0], first[1], first[2]));
}

/// Parts of a cell are recognised by where they lie, as long as a body moves by less than half a cell.
void FieldCut::check_motion(const PartLayout& before) const {
  const Mesh& mesh = field_->mesh();
  const std::size_t dim = mesh.dimension();
  double width = std::numeric_limits<double>::max();
  for (int c = 0; c < mesh.cells(); ++c)
    if (before.count(c) > 1 || mesh_.parts(c) > 1)
      for (const auto& [a, b] : topology(mesh.type()).edges) {
        double square = 0;
        for (std::size_t d = 0; d < dim; ++d)
          square += std::pow(mesh.geometry(c)[a * dim + d] - mesh.geometry(c)[b * dim + d], 2);
        width = std::min(width, std::sqrt(square));
      }
  double most = 0;
  for (std::size_t b = 0; b < surfaces_.size(); ++b) {
    const std::vector<double>& now = surfaces_[b].points;
    // A level set has other points at every time.
    if (before.body_points[b].size() != now.size()) continue;
    for (std::size_t k = 0; k < now.size(); k += dim) {
      double square = 0;
      for (std::size_t d = 0; d < dim; ++d) square += std::pow(now[k + d] - before.body_points[b][k + d], 2);
      most = std::max(most, std::sqrt(square));
    }
  }
  if (most > 0.5 * mesh.communicator().min(width))
    throw StepRefused(
        fmt::format("field '{}': a body that divides its cells moves by {:.3g} m in one "
                    "step, more than half a cell; the step is too long for its motion",
                    field_->name(), most));
}

/// Of a part none of whose nodes is known, as one that is about to be closed off, second-rate states are
/// taken: there is nothing that they could be extended from.
/// @param at_start whatever the nodes have is such a state
void FieldCut::accept_states(bool at_start) {
  for (int b = 0; b < static_cast<int>(field_->blocks().size()); ++b) {
    Block& block = field_->blocks()[b];
    const std::vector<char> known = block.known;
    const auto is_second_rate = [&](int n) {
      return known[n] == known_if_needed || (at_start && known[n] == 0);
    };
    std::replace(block.known.begin(), block.known.end(), known_if_needed, char{0});
    for (int c = 0; c < field_->mesh().cells(); ++c)
      for (int p = 0; p < field_->parts(c) && active_[c] != 0; ++p) {
        const int* nodes = field_->cell_nodes(b, c, p);
        const int* end = nodes + block.space->nodes_per_cell();
        if (std::any_of(nodes, end, [&](int n) { return known[n] == 1; })) continue;
        std::for_each(nodes, end, [&](int n) {
          if (is_second_rate(n)) block.known[n] = 1;
        });
      }
    block.space->halo().update(block.known, 1);
  }
}

bool FieldCut::has_state(int cell) const {
  for (int b = 0; b < static_cast<int>(field_->blocks().size()); ++b) {
    const Block& block = field_->blocks()[b];
    for (int p = 0; p < field_->parts(cell) && !block.given; ++p) {
      if (block.knows_any(field_->cell_nodes(b, cell, p))) return true;
    }
  }
  return false;
}

double FieldCut::trace_size(int cell) const {
  constexpr double least_area = 0.25;  // of a cell's face
  const double volume = mesh_.cell_volume(cell), dim = field_->mesh().dimension();
  return volume / std::max(area_.at(cell), least_area * std::pow(volume, (dim - 1) / dim));
}

/// Per part: whether what it holds can leave.
std::vector<char> FieldCut::open_parts(const WetParts& parts, const std::vector<double>& thickness) const {
  std::vector<double> faces(thickness.size(), 0.0);
  CutRule rule;
  for (const std::string& name : open_boundaries_)
    for (const CellFace& face : field_->mesh().boundary(name)) {
      const int part = parts.part[face.cell];
      if (part < 0 || face.cell >= field_->mesh().owned_cells()) continue;
      if (mesh_.state(face.cell) == CellState::cut) {
        mesh_.face_rule(face.cell, face.face, 1, rule);
        if (rule.count() == 0) continue;
      }
      ++faces[part];
    }
  field_->mesh().communicator().sum(faces);
  std::vector<char> open;
  for (std::size_t part = 0; part < faces.size(); ++part)
    open.push_back(faces[part] > 0 || thickness[part] > closed_film ? 1 : 0);
  return open;
}

/// Per part that a body which lets it drain bounds: how thick it is where it is thickest, in diameters of a
/// cell; else 0. That need not be where the body is: beside a mesh line the film lies in the cells behind it.
std::vector<double> FieldCut::draining_thickness(const WetParts& parts) const {
  std::vector<double> thickness(parts.volume.size(), 0.0), bounded(thickness);
  if (draining_.empty()) return thickness;
  InterfaceRule surface;
  for (int c = 0; c < field_->mesh().owned_cells(); ++c) {
    const int part = parts.part[c];
    if (part < 0) continue;
    double here = 1;
    if (mesh_.state(c) == CellState::cut) {
      mesh_.interface_rule(c, 1, surface);
      if (std::ranges::any_of(surface.body, [&](int body) { return draining_.contains(body); }))
        bounded[part] = 1;
      const double area = std::accumulate(surface.weight.begin(), surface.weight.end(), 0.0);
      here = 2 * mesh_.wet_volume(c) / std::max(field_->mesh().diameter(c) * area, mesh_.cell_volume(c));
    }
    thickness[part] = std::max(thickness[part], here);
  }
  field_->mesh().communicator().max(thickness);
  field_->mesh().communicator().max(bounded);
  for (std::size_t part = 0; part < thickness.size(); ++part) thickness[part] *= bounded[part];
  return thickness;
}

/// How many owned cells of each part the last decision, if any, made this.
std::vector<double> FieldCut::count(Decision made, const WetParts& parts) const {
  std::vector<double> cells(parts.volume.size(), 0.0);
  for (int c = 0; c < field_->mesh().owned_cells(); ++c)
    if (parts.part[c] >= 0 && decision(c) == made) ++cells[parts.part[c]];
  field_->mesh().communicator().sum(cells);
  return cells;
}

/// The cells to be dropped, and for later cuts what becomes of all others. There is no state that a dropped
/// part could start from: however much it grows it stays out until it joins a kept one, from which it is then
/// filled, one layer of cells a step. A film that drains into a body starts from rest when it opens again.
std::vector<int> FieldCut::decide() {
  const WetParts parts = mesh_.find_parts();
  const std::vector<double> thickness = draining_thickness(parts);
  const std::vector<char> open = open_parts(parts, thickness);
  const std::vector<double> kept = count(Decision::kept, parts), dropped = count(Decision::dropped, parts);
  std::vector<int> cells;
  bool waits = false;
  const auto decide_on = [&](int c, Decision decision) { decision_.now()[c] = static_cast<char>(decision); };
  for (int c = 0; c < field_->mesh().cells(); ++c) {
    const int part = parts.part[c];
    decide_on(c, Decision::body);
    if (part < 0) continue;
    const bool is_large = parts.cells[part] >= smallest_kept || open[part];
    const bool is_reached =
        dropped[part] == 0 || thickness[part] > open_film || (kept[part] > 0 && has_state(c));
    decide_on(c, is_large && is_reached ? Decision::kept : Decision::dropped);
    if (decision(c) == Decision::kept) continue;
    cells.push_back(c);
    waits = waits || (is_large && kept[part] > 0);
  }
  is_filling_ = field_->mesh().communicator().any(waits);
  return cells;
}

/// Cells that were dropped, also where a body has opened them to a kept part; and all of a part that has
/// moved on from dropped cells, or is new and small. No known state would reach it.
std::vector<int> FieldCut::follow_decision() const {
  const WetParts parts = mesh_.find_parts();
  const std::vector<char> open = open_parts(parts, draining_thickness(parts));
  const std::vector<double> kept = count(Decision::kept, parts), dropped = count(Decision::dropped, parts);
  std::vector<int> cells;
  for (int c = 0; c < field_->mesh().cells(); ++c) {
    const int part = parts.part[c];
    if (part < 0) continue;
    const bool is_small = parts.cells[part] < smallest_kept && !open[part];
    if (decision(c) == Decision::dropped || (kept[part] == 0 && (dropped[part] > 0 || is_small)))
      cells.push_back(c);
  }
  return cells;
}

}  // namespace seam
