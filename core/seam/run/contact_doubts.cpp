// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/contact_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "seam/contact/contact_domain.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam {
namespace {

/// What a coupling is on: a field, a body in it, and what that may touch.
struct InField {
  const Parameters* coupling;
  std::string interface, field, body, to;  ///< to: "" where it is no contact
  const Interface* of;
};

class ContactDoubts {
 public:
  explicit ContactDoubts(const SceneAtStart& scene) : at_(scene) {}

  std::vector<Diagnostic> find() {
    std::vector<InField> all;
    for (const Parameters& coupling : at_.scene.root.list("coupling"))
      for (const auto& [name, interface] : at_.built.interfaces) {
        if (!coupling.has("on") || coupling.text("on") != name) continue;
        const std::vector<std::string> fields = interface->fields();
        if (coupling.type() == "mortar_contact") {
          for (int side = 0; side < static_cast<int>(fields.size()); ++side)
            look_at_pores(coupling, fields[side], interface->boundaries(side),
                          "since contact by itself seals nothing");
          look_at_impacts(coupling, fields);
          look_at_ties(coupling, *interface);
        }
        if (fields.size() < 2 || !is_cut(fields[0])) continue;
        all.push_back(
            {&coupling, name, fields[0], fields[1], fields.size() > 2 ? fields[2] : "", interface.get()});
      }
    for (const auto& [name, parts] : at_.built.problem->interfaces())
      if (const auto* surface = dynamic_cast<const ContactDomain*>(parts.front().domain.get()))
        look_at_surface(name, *surface);
    for (const InField& one : all) {
      look_at_partner(one, all);
      const std::string type = one.coupling->type();
      if (type == "fsi" || type == "contact_in_fluid")
        look_at_pores(*one.coupling, one.body, one.of->boundaries(1),
                      fmt::format("or take `{}`", type == "fsi" ? "fpi" : "porous_contact_in_fluid"));
    }
    return std::move(found_);
  }

 private:
  void warn(Location where, std::string message) {
    found_.push_back({Diagnostic::Severity::warning, std::move(where), std::move(message)});
  }
  [[nodiscard]] bool is_cut(const std::string& field) const {
    const auto& fields = at_.built.problem->fields();
    const auto entry = std::ranges::find(fields, field, &FieldEntry::name);
    return entry != fields.end() && entry->cut;
  }
  [[nodiscard]] bool has_pores(const std::string& field) const {
    const auto& fields = at_.built.problem->fields();
    const auto entry = std::ranges::find(fields, field, &FieldEntry::name);
    return entry != fields.end() && entry->field->law("pores", 0) != nullptr;
  }

  /// Surfaces that do not see all that they are meant to.
  void look_at_surface(const std::string& name, const ContactDomain& surface) {
    const ContactDomain::Sight sight = surface.look(at_.start);
    const Location where = at_.scene.where("interfaces", name);
    if (surface.movers().empty()) {
      // Chords of curved boundaries lie apart by less.
      const double close = 0.1 * sight.depth;
      if (sight.farthest > close)
        warn(where,
             fmt::format(
                 "the boundaries of '{}' lie up to {:.3g} m apart, across which they are joined all the same",
                 name, sight.farthest));
      if (sight.part < 0.999)
        warn(where,
             fmt::format(
                 "{:.3g} % of the first boundary of '{}' has none of the second opposite: it is free there",
                 100 * (1 - sight.part), name));
    } else if (sight.deepest > 0) {
      warn(where, fmt::format("bodies seem to overlap by {:.3g} m at the start, more than the `depth` of "
                              "'{}', {:.3g} m: there they do not see "
                              "each other, and nothing acts between them",
                              sight.deepest, name, sight.depth));
    }
  }

  /// Nothing damps what unknown pressures and the trapezoidal rule do to each other.
  void look_at_impacts(const Parameters& coupling, const std::vector<std::string>& fields) {
    if (!at_.scene.root.has("time")) return;  // static
    const Parameters& time = at_.scene.root.object("time");
    const bool has_mass = std::ranges::any_of(at_.scene.root.map("fields"), [&](const auto& field) {
      return std::ranges::count(fields, field.first) > 0 && field.second.has("density") &&
             field.second.number("density") > 0;
    });
    if (has_mass && !time.boolean("static") && time.text("scheme") == "one_step_theta" &&
        time.number("theta") < 0.55)
      warn(coupling.where("on"), fmt::format("with `theta: {:.3g}` each impact may add energy, without "
                                             "limit; with `scheme: bdf2` none does, of the same order",
                                             time.number("theta")));
  }

  /// Where bodies have one motion already, a pressure has nothing to hold.
  void look_at_ties(const Parameters& coupling, const Interface& interface) {
    for (const Parameters& constraint : at_.scene.root.list("constraints")) {
      if (constraint.type() != "tied" || interface.fields().size() != 2) continue;
      const std::vector<std::string> fields = constraint.names("fields"), on = constraint.names("boundaries");
      for (int first = 0; first < 2; ++first) {
        const auto touches = [&](int side) {
          const std::vector<std::string> named = interface.boundaries(side);
          const int place = side == first ? 0 : 1;
          return fields[place] == interface.fields()[side] &&
                 (named.empty() || std::ranges::count(named, on[place]) > 0);
        };
        if (fields.size() == 2 && on.size() == 2 && touches(0) && touches(1))
          warn(coupling.where("on"), fmt::format("'{}' and '{}' are tied to each other on '{}' and '{}' by a "
                                                 "constraint: what presses between them there is not "
                                                 "determined; leave one of the two out",
                                                 fields[0], fields[1], on[0], on[1]));
      }
    }
  }

  /// A body is no wall for a field that it is not cut out of.
  void look_at_partner(const InField& one, const std::vector<InField>& all) {
    if (one.to.empty() || one.to == one.body) return;
    if (std::ranges::none_of(
            all, [&](const InField& other) { return other.field == one.field && other.body == one.to; })) {
      warn(one.coupling->where("on"),
           fmt::format(
               "'{0}' may touch '{1}', which the field '{2}' knows nothing of: it flows through '{1}', and "
               "bodies that press it out pass through each other; add an interface that cuts '{1}' "
               "out of '{2}', with a coupling",
               one.body, one.to, one.field));
      return;
    }
    if (!has_pores(one.body) || !has_pores(one.to)) return;
    if (std::ranges::none_of(all, [&](const InField& other) {
          return other.coupling->type() == one.coupling->type() && other.body == one.to &&
                 other.to == one.body;
        }))
      warn(one.coupling->where("on"),
           fmt::format(
               "'{0}' and '{1}' are porous, and only '{0}' looks at the other by a `{2}`: half of what "
               "passes between their pores is missing; let '{1}' look at '{0}' in the same way",
               one.body, one.to, one.coupling->type()));
  }

  /// Pores that no condition speaks of are open to a pressure of zero.
  void look_at_pores(const Parameters& coupling, const std::string& body,
                     const std::vector<std::string>& named, const std::string& advice) {
    if (!has_pores(body)) return;
    const auto& scene_fields = at_.scene.root.map("fields");
    const auto field = std::ranges::find(scene_fields, body, &std::pair<std::string, Parameters>::first);
    if (field == scene_fields.end()) return;
    std::set<std::string> said;
    for (const Parameters& condition :
         field->second.has("boundary") ? field->second.list("boundary") : std::vector<Parameters>{})
      for (const char* key : {"seepage", "velocity", "pore_pressure"})
        if (condition.has(key))
          for (const std::string& on : condition.names("on")) said.insert(on);
    const bool all_said = !named.empty() && std::ranges::all_of(named, [&](const std::string& boundary) {
      return said.contains(boundary);
    });
    if (all_said || (named.empty() && !said.empty())) return;
    warn(coupling.where("on"),
         fmt::format(
             "`{}` knows of no pores, and those of '{}' are open to a pressure of 0 there: say `seepage: 0` "
             "on that boundary where it is tight, {}",
             coupling.type(), body, advice));
  }

  const SceneAtStart& at_;
  std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> contact_doubts(const SceneAtStart& scene) { return ContactDoubts(scene).find(); }

}  // namespace seam
