// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "seam/base/error_list.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/run/scene_builder.hpp"
#include "seam/solve/field_builder.hpp"

namespace seam {
namespace {

class SceneConstraintSetup final : public ConstraintSetup {
 public:
  explicit SceneConstraintSetup(Problem& problem) : problem_(problem) {}
  [[nodiscard]] Field& field(const std::string& name) const override { return *problem_.field(name).field; }
  [[nodiscard]] std::vector<int> boundary_nodes(const Field& field, int block,
                                                const std::string& boundary) const override {
    if (boundary.empty()) throw Error("a boundary without a name");
    return seam::boundary_nodes(field, block, boundary);
  }
  void close(const Field& field, const std::string& boundary) override {
    for (LevelCondition& level : problem_.field(field.name()).levels)
      std::erase(level.open_boundaries, boundary);
  }

 private:
  Problem& problem_;
};

}  // namespace

void build_constraints(const Scene& scene, const Registry& registry, BuiltScene& built) {
  ErrorList errors(built.problem->communicator());
  SceneConstraintSetup setup(*built.problem);
  for (const Parameters& parameters : scene.root.list("constraints"))
    errors.attempt([&] {
      auto constraint = registry.create<Constraint>("constraint", parameters);
      const std::string plugin = plugin_of(*constraint);
      call_plugin(
          parameters.where(), [&] { return fmt::format("constraint '{}'{}", parameters.type(), plugin); },
          [&] { constraint->build(setup); });
      built.problem->add_constraint(std::move(constraint), parameters.where());
    });
  errors.throw_if_any();
}

}  // namespace seam
