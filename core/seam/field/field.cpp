// SPDX-License-Identifier: BSD-3-Clause
#include "seam/field/field.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "seam/base/diagnostics.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/surface_nodes.hpp"
#include "seam/state/state_store.hpp"

namespace seam {

namespace {

using Boundaries = std::optional<std::vector<std::string>>;

/// What the states of a block are called, without their levels.
std::string states_of(const std::string& field, bool given, int order, const Boundaries& boundaries) {
  return fmt::format("{}/{}order {}{}", field, given ? "given, " : "", order,
                     boundaries ? fmt::format(" on [{}]", fmt::join(*boundaries, ", ")) : "");
}
std::string states_of(const std::string& field, const Block& block) {
  return states_of(field, block.given, block.space->order(), block.boundaries);
}

/// Unknowns that will share a block.
struct Shared {
  int order;
  bool given;
  Boundaries boundaries;
  std::vector<int> components, time_order;
};

}  // namespace

Field::~Field() = default;

std::vector<char>* Field::cut_faces(bool wet) const {
  StateArray<char>* faces = wet ? wet_cut_faces_ : cut_faces_;
  return faces != nullptr ? &faces->now() : nullptr;
}

Block::Block(const States& states, std::unique_ptr<Space>&& on)
    : space(std::move(on)),
      now{states.value.now(), states.rate.now(), states.second_rate.now()},
      old{states.value.old(), states.rate.old(), states.second_rate.old()},
      known(states.known.now()) {}

Block::Block(StateStore& store, const std::string& name, std::unique_ptr<Space> on, bool is_given,
             std::vector<int> components_of_unknowns, std::vector<int> time_orders)
    : Block(
          [&]() -> States {
            const auto nodes = nodes_of(*on);
            const int numbers = static_cast<int>(time_orders.size());
            const auto add = [&](const char* level) -> StateArray<double>& {
              return store.add<double>({name + "/" + level, nodes, numbers, 2, WhenUncovered::extended});
            };
            return {add("value"), add("rate"), add("second rate"),
                    store.add<char>({name + "/known", nodes}, 1)};
          }(),
          std::move(on)) {
  size = static_cast<int>(time_orders.size());
  given = is_given;
  components = std::move(components_of_unknowns);
  time_order = std::move(time_orders);
}

Field::Field(std::string name, const Mesh& mesh, std::vector<Unknown> unknowns, int sets)
    : state_(std::make_unique<StateStore>()),
      name_(std::move(name)),
      mesh_(&mesh),
      unknowns_(std::move(unknowns)),
      active_cells_(mesh.cells(), 1),
      sets_(sets) {
  state_->keep(layout_);
  std::vector<Shared> shared;
  for (const Unknown& unknown : unknowns_) {
    const auto found = std::ranges::find_if(shared, [&](const Shared& s) {
      return s.order == unknown.order && s.given == unknown.given && s.boundaries == unknown.boundaries;
    });
    const auto b = static_cast<int>(found - shared.begin());
    if (found == shared.end()) shared.push_back({unknown.order, unknown.given, unknown.boundaries, {}, {}});
    places_.push_back({b, static_cast<int>(shared[b].time_order.size()), unknown.components});
    shared[b].components.push_back(unknown.components);
    shared[b].time_order.insert(shared[b].time_order.end(), unknown.components, unknown.time_order);
  }
  for (Shared& s : shared) {
    Block& block = blocks_.emplace_back(*state_, states_of(name_, s.given, s.order, s.boundaries),
                                        std::make_unique<Space>(mesh, s.order, sets), s.given,
                                        std::move(s.components), std::move(s.time_order));
    block.boundaries = std::move(s.boundaries);
    if (block.boundaries) block.surface_share = surface_shares(*block.space, *block.boundaries);
    resize(block);
    if (block.boundaries) mark_surface(block);
  }
}

/// Unknowns of a surface are active on it alone.
void Field::mark_surface(Block& block) {
  for (int node = 0; node < block.space->nodes(); ++node)
    if (block.surface_share[node] == 0 || block.left_out[node] != 0) block.active[node] = 0;
}

void Field::leave_out(int block, const std::vector<int>& nodes) {
  Block& of = blocks_[block];
  for (const int node : nodes) of.left_out[node] = 1;
  of.space->halo().update(of.left_out, 1);
  of.beside_left_out = nodes_beside(*of.space, *of.boundaries, of.left_out);
  mark_surface(of);
}

void Field::show_left_out() {
  for (Block& block : blocks_) {
    if (!block.boundaries) continue;
    for (std::size_t node = 0; node < block.beside_left_out.size(); ++node)
      for (int c = 0; c < block.size && !block.beside_left_out[node].empty(); ++c) {
        double sum = 0;
        for (const int other : block.beside_left_out[node])
          sum += block.now.value[static_cast<std::size_t>(other) * block.size + c];
        block.now.value[node * block.size + c] =
            sum / static_cast<double>(block.beside_left_out[node].size());
      }
    block.space->halo().update(block.now.value, block.size);
  }
}

/// Gives every node of the space a place in the block's arrays; new ones start active, free and at zero.
void Field::resize(Block& block) const {
  for (AnyState* state : state_->states())
    if (state->on().are_nodes_of(*block.space)) state->resize();
  const std::size_t n = static_cast<std::size_t>(block.space->nodes()) * block.size;
  block.active.resize(block.space->nodes(), block.given ? 0 : 1);
  block.prescribed.resize(n, 0);
  if (block.boundaries) {
    block.surface_share.resize(block.space->nodes(), 0.0);
    block.left_out.resize(block.space->nodes(), 0);
  }
  for (auto* level : {&block.prescribed_value, &block.prescribed_rate, &block.prescribed_second_rate})
    level->resize(n, 0.0);
}

void Field::keep_momentum() {
  for (Block& block : blocks_) {
    if (block.momentum_of != nullptr || block.given) continue;
    const auto add = [&](const char* what, int levels) -> StateArray<double>& {
      return state_->add<double>(
          {states_of(name_, block) + "/" + what, nodes_of(*block.space), block.size, levels});
    };
    StateArray<double>& rate = add("rate of handed momentum", 2);
    block.now.momentum_rate = &rate.now();
    block.old.momentum_rate = &rate.old();
    block.momentum_of = &add("whose momentum", 1).now();
  }
}

void Field::keep_mean_rates() {
  for (Block& block : blocks_) {
    const auto add = [&](const char* level) -> StateArray<double>& {
      return state_->add<double>({states_of(name_, block) + "/" + level, nodes_of(*block.space), block.size,
                                  2, WhenUncovered::extended});
    };
    StateArray<double>&mean = add("mean rate"), &second = add("mean second rate");
    block.now.mean_rate = &mean.now();
    block.now.mean_second_rate = &second.now();
    block.old.mean_rate = &mean.old();
    block.old.mean_second_rate = &second.old();
  }
}

void Field::remember_cut_faces() {
  const auto add = [&](const char* kind) -> StateArray<char>* {
    StateDeclaration faces{fmt::format("{}/cut/{} faces", name_, kind), interior_faces_of(*mesh_)};
    faces.lasts_a_step = true;
    return &state_->add<char>(std::move(faces));
  };
  cut_faces_ = add("all");
  wet_cut_faces_ = add("wet");
}

void Field::add_foreign(int block, const std::vector<Space::ForeignNode>& nodes) {
  Block& of = blocks_[block];
  of.space->add_foreign(nodes);
  resize(of);
  if (!of.boundaries) return;
  of.space->halo().update(of.surface_share, 1);
  of.space->halo().update(of.left_out, 1);
  mark_surface(of);
}

int Field::order() const {
  int order = 1;
  for (const Block& block : blocks_) order = std::max(order, block.space->order());
  return order;
}

Field::ComponentRange Field::place(const std::string& unknown) const {
  std::vector<std::string> names;
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    if (unknowns_[u].name == unknown) return places_[u];
    names.push_back(unknowns_[u].name);
  }
  throw Error(
      fmt::format("field '{}' has no unknown '{}'; it has: {}", name_, unknown, fmt::join(names, ", ")));
}

double Field::constant(const std::string& name) const {
  const auto found = constants_.find(name);
  if (found != constants_.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : constants_) names.push_back(entry.first);
  throw Error(
      fmt::format("field '{}' has no constant '{}'; it has: {}", name_, name, fmt::join(names, ", ")));
}

void Field::occupy(std::vector<char> cell_is_active, const CutMesh* cut) {
  active_cells_ = std::move(cell_is_active);
  cut_ = cut;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = blocks_[b];
    if (block.given) continue;
    std::fill(block.active.begin(), block.active.end(), 0);
    for (int c = 0; c < mesh_->cells(); ++c)
      for (int p = 0; p < parts(c) && active_cells_[c]; ++p) {
        const int* nodes = cell_nodes(static_cast<int>(b), c, p);
        for (int a = 0; a < block.space->nodes_per_cell(); ++a) block.active[nodes[a]] = 1;
      }
    if (block.boundaries) mark_surface(block);
    // The owner knows every cell of its nodes; a rank's outermost ghosts do not.
    block.space->halo().update(block.active, 1);
  }
}

bool Field::is_covered(int cell) const {
  return cut_ && active_cells_[cell] && cut_->state(cell) == CellState::body;
}

bool Field::is_cut(int cell) const {
  return cut_ && active_cells_[cell] && cut_->state(cell) != CellState::wet;
}

}  // namespace seam
