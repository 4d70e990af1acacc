// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/ties.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "seam/assembly/together.hpp"
#include "seam/field/field.hpp"

namespace seam {
namespace {

/// A line of a tie as it is sent: its head (what is tied), one it is tied to, or a change.
struct Line {
  enum Kind { head, to, change } kind;
  UnknownPlace first, second;
  double a = 0, b = 0;
};

/// Brings all that a block has of nodes of other ranks up to date: some may have come just now.
void update_ghosts(Block& block) {
  const Halo& halo = block.space->halo();
  halo.update(block.active, 1);
  halo.update(block.known, 1);
  halo.update(block.prescribed, block.size);
  for (auto* level : {&block.prescribed_value, &block.prescribed_rate, &block.prescribed_second_rate})
    halo.update(*level, block.size);
  for (NodalState* state : {&block.now, &block.old}) {
    for (auto* level : {&state->value, &state->rate, &state->second_rate}) halo.update(*level, block.size);
    for (auto* level : {state->mean_rate, state->mean_second_rate})
      if (level != nullptr) halo.update(*level, block.size);
  }
}

/// Adds to the entry of the same unknown, or appends.
void add(std::vector<TiedTo>& list, const TiedTo& entry) {
  const auto found =
      std::ranges::find(list, entry.unknown.key(), [](const TiedTo& t) { return t.unknown.key(); });
  if (found == list.end()) {
    list.push_back(entry);
    return;
  }
  found->coefficient += entry.coefficient;
  found->handed += entry.handed;
}

/// "'displacement' in x of field 'skin' at (1, 0.5)"
std::string describe(const auto& blocks, const UnknownPlace& place) {
  const auto& [of, block] = blocks[place.block];
  const Field& field = *of;
  const int dim = field.mesh().dimension();
  std::string name;
  for (const Unknown& unknown : field.unknowns()) {
    const Field::ComponentRange range = field.place(unknown.name);
    const int component = place.component - range.offset;
    if (range.block != block || component < 0 || component >= range.components) continue;
    name = fmt::format("'{}'", unknown.name);
    if (range.components == dim)
      name += fmt::format(" in {}", "xyz"[component]);
    else if (range.components > 1)
      name = fmt::format("component {} of {}", component, name);
  }
  return fmt::format("{} of field '{}' at ({:.6g})", name, field.name(),
                     fmt::join(place.position, place.position + dim, ", "));
}

}  // namespace

Ties::Ties(const std::vector<Field*>& fields) {
  for (Field* field : fields)
    for (std::size_t b = 0; b < field->blocks().size(); ++b) blocks_.push_back({field, static_cast<int>(b)});
}

int Ties::number_of(const Field& field, int block) const {
  const auto found = std::ranges::find_if(
      blocks_, [&](const FieldBlock& b) { return b.field == &field && b.block == block; });
  return static_cast<int>(found - blocks_.begin());
}

UnknownPlace Ties::place(const Field& field, int block, int node, int component) const {
  const Space& space = *field.blocks()[block].space;
  UnknownPlace place{number_of(field, block), space.global_node(node), component, space.owner(node), {}};
  std::copy_n(space.position(node), field.mesh().dimension(), place.position);
  return place;
}

void Ties::tie(const UnknownPlace& unknown, std::vector<TiedTo> to, double constant) {
  added_.push_back({{unknown, std::move(to), constant, {}}, origin_});
}

void Ties::add_change(const UnknownPlace& row, const UnknownPlace& with, double derivative,
                      double by_motion) {
  added_.back().tie.changes.push_back({row, with, derivative, by_motion});
}

void Ties::set_axes(const UnknownPlace& first, const Mat<3, 3, double>& axes) {
  const auto same = [&](const Axes& known) { return known.first.key() == first.key(); };
  if (std::ranges::none_of(axes_, same)) axes_.push_back({first, axes});
}

std::vector<Ties::Resolved> Ties::close() {
  gather();
  for (std::size_t k = 0; k < added_.size(); ++k) {
    const auto [found, is_new] = index_.emplace(added_[k].tie.unknown.key(), k);
    if (is_new) continue;
    throw Error(added_[k].where,
                fmt::format("{} is tied twice; the other tie stands at {}",
                            describe(blocks_, added_[k].tie.unknown), added_[found->second].where.text()));
  }
  std::map<UnknownPlace::Key, char> done;
  for (Added& added : added_) {
    std::vector<const Added*> under_way;
    follow(added, under_way, done);
  }
  return localise();
}

/// The ties of all ranks, on all, in the order of the ranks.
void Ties::gather() {
  const Communicator& communicator = blocks_.front().field->mesh().communicator();
  const int rank = communicator.rank();
  std::erase_if(added_, [&](const Added& added) { return added.tie.unknown.owner != rank; });
  if (communicator.size() == 1) return;
  std::vector<Line> lines;
  std::vector<char> places;  // in the scene, one after the other, each ended by a 0
  for (const Added& added : added_) {
    lines.push_back({Line::head, added.tie.unknown, {}, added.tie.constant});
    for (const TiedTo& to : added.tie.to)
      lines.push_back({Line::to, to.unknown, {}, to.coefficient, to.handed});
    for (const Resolved::Change& change : added.tie.changes)
      lines.push_back({Line::change, change.row, change.with, change.derivative, change.by_motion});
    const std::string where =
        fmt::format("{}\n{}\n{}", added.where.file, added.where.line, added.where.column);
    places.insert(places.end(), where.begin(), where.end());
    places.push_back('\0');
  }
  lines = communicator.gather_all(lines);
  places = communicator.gather_all(places);
  added_.clear();
  const char* place = places.data();
  for (const Line& line : lines) {
    if (line.kind == Line::head) {
      Added& added = added_.emplace_back(Added{{line.first, {}, line.a, {}}, {}});
      const std::string text = place;
      place += text.size() + 1;
      const std::size_t column = text.rfind('\n'), row = text.rfind('\n', column - 1);
      added.where = {text.substr(0, row), std::stoi(text.substr(row + 1)),
                     std::stoi(text.substr(column + 1))};
    } else if (line.kind == Line::to) {
      added_.back().tie.to.push_back({line.first, line.a, line.b});
    } else {
      added_.back().tie.changes.push_back({line.first, line.second, line.a, line.b});
    }
  }
}

/// Replaces what is tied itself among those it is tied to.
void Ties::follow(Added& added, std::vector<const Added*>& under_way,
                  std::map<UnknownPlace::Key, char>& done) {
  if (done.contains(added.tie.unknown.key())) return;
  if (const auto circle = std::ranges::find(under_way, &added); circle != under_way.end())
    throw Error(added.where,
                fmt::format("{} is tied to itself in a circle, by way of the tie at {}",
                            describe(blocks_, added.tie.unknown), under_way.back()->where.text()));
  under_way.push_back(&added);
  Resolved result{added.tie.unknown, {}, added.tie.constant, {}};
  const auto tie_of = [&](const UnknownPlace& place) -> const Resolved* {
    const auto found = index_.find(place.key());
    if (found == index_.end()) return nullptr;
    follow(added_[found->second], under_way, done);
    return &added_[found->second].tie;
  };
  for (const TiedTo& to : added.tie.to) {
    const Resolved* next = tie_of(to.unknown);
    if (next == nullptr) {
      add(result.to, to);
      continue;
    }
    result.constant += to.coefficient * next->constant;
    for (const TiedTo& further : next->to)
      add(result.to, {further.unknown, to.coefficient * further.coefficient, to.handed * further.handed});
    for (const Resolved::Change& change : next->changes)
      result.changes.push_back(
          {change.row, change.with, to.handed * change.derivative, to.handed * change.by_motion});
  }
  for (const Resolved::Change& change : added.tie.changes) {
    const std::vector<TiedTo> itself_row{{change.row, 1, 1}}, itself_with{{change.with, 1, 1}};
    // Its coefficients may depend on its own value, which follows from those of the others.
    const bool itself = change.with.key() == added.tie.unknown.key();
    const Resolved *row = tie_of(change.row), *with = itself ? &result : tie_of(change.with);
    for (const TiedTo& r : row != nullptr ? row->to : itself_row)
      for (const TiedTo& w : with != nullptr ? with->to : itself_with)
        result.changes.push_back({r.unknown, w.unknown, r.handed * change.derivative * w.coefficient,
                                  r.handed * change.by_motion * w.handed});
  }
  added.tie = std::move(result);
  under_way.pop_back();
  done[added.tie.unknown.key()] = 1;
}

/// @throws Error where the scene prescribes the unknown as well
void Ties::require_free(const Added& added) const {
  const UnknownPlace& place = added.tie.unknown;
  const Block& block = blocks_[place.block].field->blocks()[blocks_[place.block].block];
  const int node = block.space->local_node(place.node);
  if (node < 0 || !block.prescribed[static_cast<std::size_t>(node) * block.size + place.component]) return;
  throw Error(added.where,
              describe(blocks_, place) + " is tied here and prescribed by a condition of its field");
}

/// Those of unknowns that this rank holds; the nodes they are tied to become known here.
std::vector<Ties::Resolved> Ties::localise() {
  std::vector<Resolved> result;
  std::vector<std::vector<Space::ForeignNode>> foreign(blocks_.size());
  std::vector<char> concerned(blocks_.size(), 0);
  const auto space_of = [&](int block) -> const Space& {
    return *blocks_[block].field->blocks()[blocks_[block].block].space;
  };
  const auto need = [&](const UnknownPlace& place) {
    if (place.is_clock()) return;
    if (space_of(place.block).local_node(place.node) >= 0) return;
    Space::ForeignNode node{place.node, place.owner, {}};
    std::copy_n(place.position, 3, node.position);
    foreign[place.block].push_back(node);
  };
  together(blocks_.front().field->mesh().communicator(), [&] {
    for (const Added& added : added_) require_free(added);
  });
  for (const Added& added : added_) {
    const auto concerns = [&](const UnknownPlace& place) {
      if (!place.is_clock()) concerned[place.block] = 1;
    };
    for (const TiedTo& to : added.tie.to) concerns(to.unknown);
    for (const Resolved::Change& change : added.tie.changes) {
      concerns(change.row);
      concerns(change.with);
    }
    if (space_of(added.tie.unknown.block).local_node(added.tie.unknown.node) < 0) continue;
    for (const TiedTo& to : added.tie.to) need(to.unknown);
    for (const Resolved::Change& change : added.tie.changes) {
      need(change.row);
      need(change.with);
    }
    result.push_back(added.tie);
  }
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (concerned[b] == 0) continue;
    Field& field = *blocks_[b].field;
    // Without anything to add on any rank the numbers of nodes stay as they are.
    if (field.mesh().communicator().any(!foreign[b].empty())) field.add_foreign(blocks_[b].block, foreign[b]);
    update_ghosts(field.blocks()[blocks_[b].block]);
  }
  return result;
}

}  // namespace seam
