// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/contact_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

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
        if (coupling.type() == "mortar_contact")
          for (int side = 0; side < static_cast<int>(fields.size()); ++side)
            look_at_pores(coupling, fields[side], interface->boundaries(side),
                          "since contact by itself seals nothing");
        if (fields.size() < 2 || !is_cut(fields[0])) continue;
        all.push_back(
            {&coupling, name, fields[0], fields[1], fields.size() > 2 ? fields[2] : "", interface.get()});
      }
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
