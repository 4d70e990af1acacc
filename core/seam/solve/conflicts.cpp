// SPDX-License-Identifier: BSD-3-Clause
// Boundaries that meet and prescribe different values there.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "seam/cut/field_cut.hpp"
#include "seam/solve/problem.hpp"

namespace seam {
namespace {

struct Conflict {
  int first, second;  ///< conditions
  double first_value, second_value;
  double at[3];
};

/// Of the nodes that this rank owns, one for each two conditions.
std::vector<Conflict> conflicts_of(const FieldEntry& entry, double time) {
  std::vector<Conflict> found;
  struct Claim {
    int condition;
    double value;
  };
  std::map<std::pair<int, int>, std::map<int, Claim>> claims;  // by block and component, by node
  const int dim = entry.mesh->dimension();
  for (int k = 0; k < static_cast<int>(entry.conditions.size()); ++k) {
    const PrescribedCondition& condition = entry.conditions[k];
    const Space& space = *entry.field->blocks()[condition.block].space;
    auto& claimed = claims[{condition.block, condition.component}];
    for (const int node : condition.nodes) {
      if (node >= space.owned_nodes()) continue;
      const double* x = space.position(node);
      const double value = condition.value(x, dim, time);
      const auto [claim, is_new] = claimed.try_emplace(node, Claim{k, value});
      const double before = claim->second.value;
      constexpr double rounding = 1e-12;
      const bool differs = std::abs(before - value) > rounding * (std::abs(before) + std::abs(value));
      const int first = claim->second.condition;
      const bool known =
          std::ranges::any_of(found, [&](const Conflict& c) { return c.first == first && c.second == k; });
      if (!is_new && differs && !known) {
        Conflict& conflict = found.emplace_back(Conflict{first, k, before, value, {}});
        std::copy_n(x, dim, conflict.at);
      }
      claim->second = {k, value};
    }
  }
  return found;
}

/// Conditions on sides of the mesh that a body covers, where it has an interface.
void warn_of_covered(const FieldEntry& entry, const Communicator& communicator,
                     std::vector<Diagnostic>& warnings) {
  if (!entry.cut) return;
  using Face = std::pair<int, int>;
  std::set<Face> covered;
  for (const CellFace& f : entry.cut->mesh().covered_faces()) covered.emplace(f.cell, f.face);
  if (!communicator.any(!covered.empty())) return;
  std::set<std::string> named;
  for (const PrescribedCondition& condition : entry.conditions) {
    if (condition.boundary.empty()) continue;  // holds everywhere
    const std::vector<CellFace>& faces = entry.mesh->boundary(condition.boundary);
    const bool meets =
        std::ranges::any_of(faces, [&](const CellFace& f) { return covered.contains(Face(f.cell, f.face)); });
    if (!communicator.any(meets) || !named.insert(condition.boundary).second) continue;
    warnings.push_back(
        {Diagnostic::Severity::warning, condition.where,
         fmt::format("a body stands on boundary '{}' of field '{}', where '{}' is prescribed: the body's "
                     "interface is there as well, and what is prescribed wins; leave one of them out",
                     condition.boundary, entry.name, condition.unknown)});
  }
}

/// Terms on boundaries where every value that they could change is given.
void warn_of_lost_loads(const FieldEntry& entry, std::vector<Diagnostic>& warnings) {
  std::set<std::string> named;
  for (const auto& [boundary, unknowns] : entry.loads) {
    const PrescribedCondition* last = nullptr;
    const auto is_given = [&, &on = boundary](const std::string& unknown) {
      std::set<int> components;
      for (const PrescribedCondition& condition : entry.conditions)
        if (condition.boundary == on && condition.unknown == unknown) {
          components.insert(condition.component);
          last = &condition;
        }
      return static_cast<int>(components.size()) == entry.field->place(unknown).components;
    };
    if (unknowns.empty() || !std::ranges::all_of(unknowns, is_given) || !named.insert(boundary).second)
      continue;
    warnings.push_back(
        {Diagnostic::Severity::warning, last->where,
         fmt::format(
             "on boundary '{}' of field '{}' all of '{}' is prescribed, so that the other condition there "
             "(a traction, a pressure, an outflow, a support) has no effect; leave one of them out",
             boundary, entry.name, fmt::join(unknowns, "', '"))});
  }
}

}  // namespace

std::vector<Diagnostic> Problem::find_conflicts(double time) const {
  std::vector<Diagnostic> warnings;
  for (const FieldEntry& entry : fields_) {
    warn_of_covered(entry, communicator_, warnings);
    warn_of_lost_loads(entry, warnings);
    std::vector<Conflict> all = communicator_.gather_all(conflicts_of(entry, time));
    const auto pair = [](const Conflict& c) { return std::pair(c.first, c.second); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Conflict& a, const Conflict& b) { return pair(a) < pair(b); });
    all.erase(std::unique(all.begin(), all.end(),
                          [&](const Conflict& a, const Conflict& b) { return pair(a) == pair(b); }),
              all.end());
    for (const Conflict& c : all) {
      const PrescribedCondition &first = entry.conditions[c.first], &second = entry.conditions[c.second];
      warnings.push_back(
          {Diagnostic::Severity::warning, second.where,
           fmt::format(
               "boundaries '{}' and '{}' of field '{}' meet at ({:.6g}) and prescribe different values "
               "of '{}' there, {:.6g} and {:.6g}: what stands last in the scene counts, {:.6g}; the "
               "other condition stands at {}",
               first.boundary, second.boundary, entry.name,
               fmt::join(c.at, c.at + entry.mesh->dimension(), ", "), second.unknown, c.first_value,
               c.second_value, c.second_value, first.where.text())});
    }
  }
  return warnings;
}

}  // namespace seam
