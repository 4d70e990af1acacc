// SPDX-License-Identifier: BSD-3-Clause
#include "weak_condition.hpp"

#include <limits>

#include "seam/interface/adjoint.hpp"

namespace seam::fluid {
namespace {

constexpr double usual_penalty = 35;  ///< thesis 3.5 to 7.4

}  // namespace

void declare_weak_condition(Schema& schema) {
  schema.number("slip_length", "Navier's: 0 is no slip, .inf leaves the tangential traction alone")
      .unit("m")
      .otherwise("0")
      .at_least(0)
      .or_infinite();
  schema.vector_expression("wall_traction", "Tangential traction on the fluid that the slip comes on top of")
      .unit("Pa")
      .optional();
  declare_adjoint(schema);
  Schema penalty("Factors of Nitsche's penalty, thesis (3.26), (3.27).");
  penalty.number("normal", "For the velocity across the boundary").otherwise("35").above(0);
  penalty.number("tangential", "For the velocity along it").otherwise("35").above(0);
  schema.object("penalty", "Factors of Nitsche's penalty", penalty).otherwise("{}");
}

WeakVelocity weak_condition(const Parameters& parameters, const Flow& flow,
                            std::vector<Expression> velocity) {
  WeakVelocity weak{flow,
                    std::move(velocity),
                    {},
                    parameters.number("slip_length"),
                    adjoint_of(parameters),
                    parameters.object("penalty").number("normal"),
                    parameters.object("penalty").number("tangential")};
  if (parameters.has("wall_traction")) weak.traction = parameters.vector_expression("wall_traction");
  return weak;
}

WeakVelocity weak_slip(const Flow& flow, int dimension) {
  return {flow,
          std::vector<Expression>(dimension),
          {},
          std::numeric_limits<double>::infinity(),
          1,
          usual_penalty,
          usual_penalty};
}

}  // namespace seam::fluid
