// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/scene_doubts.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "seam/assembly/element.hpp"
#include "seam/assembly/ties.hpp"
#include "seam/cut/overlap.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam {
namespace {

class Doubts {
 public:
  explicit Doubts(const SceneAtStart& scene) : at_(scene) {}

  std::vector<Diagnostic> find() {
    look_for_nothing();
    look_for_overlap();
    for (const auto& [name, interface] : at_.built.interfaces) add_body(name, *interface);
    look_at_pairs();
    look_at_times();
    for (const auto& [name, probe] : at_.scene.root.object("output").map("probes"))
      look_at_probe(name, probe);
    for (const Parameters& coupling : at_.scene.root.list("coupling")) {
      look_at_wall(coupling);
      look_for_reaction(coupling);
    }
    for (const Parameters& constraint : at_.scene.root.list("constraints"))
      if (constraint.type() == "periodic") look_at_periodic(constraint);
    for (const auto& [name, field] : at_.scene.root.map("fields")) look_at_mass(name, field);
    return std::move(found_);
  }

 private:
  struct Body {
    std::string name, field;
    const Interface* interface;
    const Mesh* mesh;
  };

  void warn(Location where, std::string message) {
    found_.push_back({Diagnostic::Severity::warning, std::move(where), std::move(message)});
  }

  void look_for_nothing() {
    const Communicator& communicator = at_.built.problem->communicator();
    for (const auto& [name, parts] : at_.built.problem->interfaces()) {
      const std::string& interface_name = name;
      // Contact finds what is opposite when it comes near.
      const auto of_first = [&, &first = parts.front()](const FieldEntry& entry) {
        return entry.field.get() == first.domain->fields().front() && entry.cut;
      };
      if (std::ranges::none_of(at_.built.problem->fields(), of_first)) continue;
      // Without a coupling its elements are not looked for, which is told elsewhere.
      if (std::ranges::none_of(at_.scene.root.list("coupling"), [&](const Parameters& coupling) {
            return coupling.has("on") && coupling.text("on") == interface_name;
          }))
        continue;
      long long facets = 0;
      for (const InterfacePart& part : parts) facets += part.domain->size();
      if (communicator.sum(facets) == 0)
        warn(at_.scene.where("interfaces", name),
             fmt::format(
                 "nothing of the interface '{}' lies in its field: what it describes is outside of the "
                 "mesh, or covers all of it",
                 name));
    }
    for (const FieldEntry& entry : at_.built.problem->fields()) {
      const auto& active = entry.field->active_cells();
      const bool any = std::any_of(active.begin(), active.begin() + entry.mesh->owned_cells(),
                                   [](char is_active) { return is_active != 0; });
      if (!communicator.any(any))
        warn(at_.scene.where("fields", entry.name),
             fmt::format("bodies cover all of the field '{}': it has no unknowns", entry.name));
    }
  }

  /// Contact that begins with bodies in each other.
  void look_for_overlap() {
    for (const InterfaceMeasure& measure : at_.built.problem->measures()) {
      const auto series = at_.first.series.find(measure.interface + ".gap");
      if (measure.name != "gap" || series == at_.first.series.end()) continue;
      const double gap = series->second.front();
      double size = 0;
      for (const Field* field :
           at_.built.problem->interfaces().at(measure.interface).front().domain->fields())
        for (int c = 0; c < field->mesh().owned_cells(); ++c)
          size = std::max(size, field->mesh().diameter(c));
      size = at_.built.problem->communicator().max(size);
      if (gap < -0.1 * size)
        warn(at_.scene.where("interfaces", measure.interface),
             fmt::format("bodies overlap by {:.3g} m at the start, where '{}' is to keep them apart", -gap,
                         measure.interface));
    }
  }

  void add_body(const std::string& name, const Interface& interface) {
    const std::string field = interface.fields().front();
    for (const FieldEntry& entry : at_.built.problem->fields())
      // In parallel nobody holds the whole mesh.
      if (entry.name == field && entry.cut && at_.built.problem->communicator().size() == 1)
        bodies_.push_back({name, field, &interface, entry.mesh.get()});
  }
  [[nodiscard]] std::optional<Surface> surface(const Body& body, double time) const {
    return body.interface->body({*body.mesh, meshes_}, time);
  }

  void look_at_pairs() {
    std::vector<std::optional<Surface>> surfaces;
    for (const Body& body : bodies_) surfaces.push_back(surface(body, at_.start));
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
        if (!surfaces[i] || !surfaces[j] || bodies_[i].field != bodies_[j].field) continue;
        if (const auto at = vertex_inside(*surfaces[i], *surfaces[j]))
          warn(at_.scene.where("interfaces", bodies_[j].name),
               fmt::format(
                   "the bodies of '{}' and '{}' overlap, as at ({:.6g}): they count as one where they do, "
                   "and if one moves, it goes through the other",
                   bodies_[i].name, bodies_[j].name, fmt::join(*at, ", ")));
      }
  }

  void look_at_reaction(const std::string& name, const Parameters& probe) {
    const std::vector<std::string> on = probe.names("on");
    const auto& fields = at_.built.problem->fields();
    const auto entry = std::ranges::find(fields, probe.text("field"), &FieldEntry::name);
    if (entry == fields.end()) return;
    const auto holds = [&](const PrescribedCondition& condition) {
      return condition.boundary.empty() || std::ranges::find(on, condition.boundary) != on.end();
    };
    if (std::ranges::none_of(entry->conditions, holds))
      warn(probe.where("on"),
           fmt::format("nothing is prescribed on {}, so that nothing holds the field '{}' there: the "
                       "reaction '{}' is that of other conditions at shared nodes, or 0",
                       fmt::join(on, ", "), entry->name, name));
  }

  /// Checks and statistics that look where the run does not come to.
  void look_at_times() {
    const double slack = 1e-9 * (at_.end - at_.start);
    const auto look_at = [&](const Parameters& p, const std::string& key, double least, double most) {
      if (!p.has(key) || (p.number(key) >= least - slack && p.number(key) <= most + slack)) return;
      warn(p.where(key),
           fmt::format("`{}: {:.6g}` lies outside of the run, which goes from t = {:.6g} to {:.6g}: "
                       "there is no number then",
                       key, p.number(key), at_.start, at_.end));
    };
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const Parameters& check : at_.scene.root.list("checks")) look_at(check, "at", at_.start, at_.end);
    for (const auto& [name, p] : at_.scene.root.object("output").map("statistics")) {
      look_at(p, "from", -infinite, at_.end);
      look_at(p, "to", at_.start, infinite);
    }
  }

  /// A point in a body has nothing of the field around it.
  void look_at_probe(const std::string& name, const Parameters& probe) {
    if (probe.has("field") && probe.text("quantity") == "reaction" && probe.has("on"))
      look_at_reaction(name, probe);
    if (!probe.has("field") || !probe.has("at")) return;
    const std::vector<double> at = probe.vector("at");
    for (const Body& body : bodies_) {
      if (body.field != probe.text("field")) continue;
      const std::optional<Surface> around = surface(body, at_.start);
      if (around && is_inside(*around, at.data()))
        warn(probe.where("at"),
             fmt::format(
                 "the point of the probe '{}' lies in the body of '{}' at the start: what is recorded there "
                 "is not the field '{}'",
                 name, body.name, body.field));
    }
  }

  /// A force per mass and a velocity at the start are nothing to a body without mass.
  void look_at_mass(const std::string& name, const Parameters& field) {
    if (field.type() != "solid" && field.type() != "rigid_body") return;  // others have several masses
    const auto has_mass = [](const Parameters& of) { return of.has("density") && of.number("density") > 0; };
    if (has_mass(field)) return;
    if (field.type() == "solid" && field.has("regions") &&
        std::ranges::any_of(field.list("regions"), has_mass))
      return;
    const auto warn_of = [&](Location where, const std::string& what) {
      warn(std::move(where), fmt::format("field '{}' has no `density`, so that {}", name, what));
    };
    if (field.has("body_force") && std::ranges::any_of(field.vector_expression("body_force"), may_act))
      warn_of(field.where("body_force"), "its `body_force`, a force per mass, does nothing");
    if (!field.has("initial")) return;
    const Parameters& initial = field.object("initial");
    for (const char* key : {"velocity", "rotation_rate"})
      if ((key == std::string("velocity") || field.type() == "rigid_body") && initial.has(key))
        warn_of(initial.where(key), fmt::format("it does not go on with the `{}` that it starts with", key));
  }

  /// Whether a component of a load is not 0 at all times.
  static bool may_act(const Expression& component) {
    const double nowhere[3] = {};
    return !component.is_constant() || component(nowhere, 3, 0) != 0;
  }

  /// Where a field goes on there is no boundary that a condition could be for.
  void look_at_periodic(const Parameters& constraint) {
    if (!constraint.names("unknowns").empty()) return;  // others have conditions
    const std::vector<std::string> joined = constraint.names("boundaries");
    const auto& fields = at_.scene.root.map("fields");
    const auto field =
        std::ranges::find(fields, constraint.text("field"), &std::pair<std::string, Parameters>::first);
    if (field == fields.end() || !field->second.has("boundary")) return;
    const std::vector<Parameters>* conditions = nullptr;
    try {
      conditions = &field->second.list("boundary");
    } catch (const std::logic_error&) {
      return;  // something else of this name
    }
    for (const Parameters& condition : *conditions)
      for (const std::string& on : condition.names("on"))
        if (std::ranges::find(joined, on) != joined.end())
          warn(condition.where("on"),
               fmt::format("boundary '{}' of field '{}' is periodic ({}), and has this condition: what it "
                           "prescribes holds on both sides, and what it applies acts within the field; "
                           "leave one of them out",
                           on, field->first, constraint.where().text()));
  }

  /// Contact that pushes one body alone pushes two that look at each other, and one that nothing moves needs
  /// no push.
  void look_for_reaction(const Parameters& coupling) {
    const bool is_one_sided =
        coupling.has("acts_on") ? coupling.text("acts_on") == "own" : coupling.has("surface_stiffness");
    const Interface* interface = coupling.has("on") ? interface_of(coupling) : nullptr;
    if (!is_one_sided || interface == nullptr) return;
    const std::vector<std::string> fields = interface->fields();
    if (fields.size() < 2) return;  // beside an obstacle
    const std::string &own = fields[fields.size() - 2], &other = fields.back();
    for (const Parameters& back : at_.scene.root.list("coupling")) {
      const Interface* looks = back.has("on") ? interface_of(back) : nullptr;
      if (looks == nullptr || back.type() != coupling.type()) continue;
      const std::vector<std::string> those = looks->fields();
      if (those.size() > 1 && those[those.size() - 2] == other && those.back() == own) return;
    }
    if (!moves(other)) return;
    warn(coupling.where("on"),
         fmt::format("'{0}' is pushed by contact with '{1}', and nothing pushes '{1}' back, which is free to "
                     "move: momentum is lost; add an interface on which '{1}' looks at '{0}', with a "
                     "coupling of the same kind",
                     own, other));
  }

  [[nodiscard]] const Interface* interface_of(const Parameters& coupling) const {
    for (const auto& [name, interface] : at_.built.interfaces)
      if (name == coupling.text("on")) return interface.get();
    return nullptr;
  }

  /// Whether some unknown that moves a field is free, or tied to one that is. Collective.
  [[nodiscard]] bool moves(const std::string& name) const {
    Problem& problem = *at_.built.problem;
    const auto& entries = problem.fields();
    std::vector<const Block*> blocks;  // as ties count them
    for (const FieldEntry& entry : entries)
      for (const Block& block : entry.field->blocks()) blocks.push_back(&block);
    const auto is_free = [&](const Block& block, int node, int component) {
      return !block.given && !block.prescribed[static_cast<std::size_t>(node) * block.size + component];
    };
    std::set<std::pair<const Block*, std::size_t>> held;  // by what they are tied to
    for (const Ties::Resolved& tie : problem.ties(time_point(at_.start, 0, 1))) {
      const auto number = [&](const UnknownPlace& place) {
        return static_cast<std::size_t>(blocks[place.block]->space->local_node(place.node));
      };
      const bool follows = std::ranges::any_of(tie.to, [&](const TiedTo& to) {
        return !to.unknown.is_clock() &&
               is_free(*blocks[to.unknown.block], static_cast<int>(number(to.unknown)), to.unknown.component);
      });
      const Block* block = blocks[tie.unknown.block];
      if (!follows) held.emplace(block, number(tie.unknown) * block->size + tie.unknown.component);
    }
    bool any = false;
    const auto entry = std::ranges::find(entries, name, &FieldEntry::name);
    for (const Unknown& unknown : entry->field->unknowns()) {
      if (unknown.role != UnknownRole::motion) continue;
      const auto [number, offset, components] = entry->field->place(unknown.name);
      const Block& block = entry->field->blocks()[number];
      for (int node = 0; node < block.space->owned_nodes(); ++node)
        for (int c = offset; c < offset + components; ++c)
          any |= is_free(block, node, c) &&
                 !held.contains({&block, static_cast<std::size_t>(node) * block.size + c});
    }
    return problem.communicator().any(any);
  }

  /// A wall that moves one way and says another velocity lets fluid through.
  void look_at_wall(const Parameters& coupling) {
    if (!coupling.has("velocity")) return;
    const auto body = std::ranges::find(bodies_, coupling.text("on"), &Body::name);
    if (body == bodies_.end()) return;
    const std::vector<Expression>* given = nullptr;
    try {
      given = &coupling.vector_expression("velocity");
    } catch (const std::logic_error&) {
      return;  // something else of this name
    }
    const std::vector<Expression>& velocity = *given;
    constexpr int times = 5;
    const double span = at_.end - at_.start, step = 1e-6 * span;
    for (int k = 0; k < times; ++k) {
      const double t = at_.start + (k + 0.5) / times * span;
      const auto before = surface(*body, t - step), after = surface(*body, t + step);
      if (!before || !after || before->points.size() != after->points.size()) return;
      const std::size_t dim = before->dimension;
      double largest = 0, most = 0;
      for (std::size_t v = 0; v < before->points.size(); v += dim) {
        double rate = 0, difference = 0;
        std::vector<double> x(dim);
        for (std::size_t d = 0; d < dim; ++d) x[d] = 0.5 * (before->points[v + d] + after->points[v + d]);
        for (std::size_t d = 0; d < dim; ++d) {
          const double moved = (after->points[v + d] - before->points[v + d]) / (2 * step);
          rate += moved * moved;
          difference += std::pow(velocity[d](x.data(), static_cast<int>(dim), t) - moved, 2);
        }
        largest = std::max(largest, std::sqrt(rate));
        most = std::max(most, std::sqrt(difference));
      }
      if (largest == 0 || most < 0.1 * largest) continue;
      warn(coupling.where("velocity"),
           fmt::format(
               "at t = {:.4g} the body of '{}' moves by up to {:.4g} m/s, and `velocity` differs from that "
               "by up to {:.4g} m/s: the fluid does not follow the wall",
               t, body->name, largest, most));
      return;
    }
  }

  const SceneAtStart& at_;
  const MeshFinder meshes_ = at_.built.mesh_finder();
  std::vector<Body> bodies_;
  std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> scene_doubts(const SceneAtStart& scene) { return Doubts(scene).find(); }

}  // namespace seam
