// SPDX-License-Identifier: BSD-3-Clause
#include "seam/surface/moving_body.hpp"

#include <fmt/format.h>

#include <cmath>

#include "seam/base/diagnostics.hpp"

namespace seam {
namespace {

/// A rigid motion given as functions of time.
class Motion {
 public:
  explicit Motion(const Parameters& p)
      : translation_(p.has("translation") ? p.vector_expression("translation") : std::vector<Expression>{}),
        angle_(p.expression("rotation")),
        about_(p.has("about") ? p.vector("about") : std::vector<double>(3, 0.0)),
        axis_(p.vector("axis")) {}
  static Schema schema() {
    Schema s("A rigid motion: a rotation, then a translation.");
    s.vector_expression("translation", "displacement as a function of t").unit("m").optional();
    s.expression("rotation", "angle as a function of t, counter-clockwise about the axis")
        .unit("rad")
        .otherwise("0");
    s.vector("about", "a point on the axis; default the origin").unit("m").optional();
    s.vector("axis", "direction of the axis, in space").entries(3).otherwise("[0, 0, 1]");
    return s;
  }
  void apply(Surface& surface, double time) const {
    const double origin[3] = {0, 0, 0};
    const int dim = surface.dimension;
    const double angle = angle_(origin, dim, time);
    for (int k = 0; k < surface.point_count(); ++k) {
      double* x = &surface.points[static_cast<std::size_t>(k) * dim];
      rotate(x, dim, angle);
      for (int d = 0; d < dim && !translation_.empty(); ++d) x[d] += translation_[d](origin, dim, time);
    }
  }

 private:
  /// Rodrigues' formula; in the plane the axis is the third one.
  void rotate(double* x, int dim, double angle) const {
    if (angle == 0) return;
    double k[3] = {0, 0, 1}, r[3] = {0, 0, 0};
    const double length = std::hypot(axis_[0], axis_[1], axis_[2]);
    for (int d = 0; d < 3 && dim == 3; ++d) k[d] = axis_[d] / length;
    for (int d = 0; d < dim; ++d) r[d] = x[d] - about_[d];
    const double along = k[0] * r[0] + k[1] * r[1] + k[2] * r[2];
    for (int d = 0; d < dim; ++d) {
      const int e = (d + 1) % 3, f = (d + 2) % 3;
      x[d] = about_[d] + r[d] * std::cos(angle) + (k[e] * r[f] - k[f] * r[e]) * std::sin(angle) +
             k[d] * along * (1 - std::cos(angle));
    }
  }
  std::vector<Expression> translation_;
  Expression angle_;
  std::vector<double> about_, axis_;
};

}  // namespace

MovingBody::MovingBody(const Parameters& parameters, const Registry& types)
    : parameters_(parameters), shape_(types.create<BodyShape>("body", parameters.object("body"))) {
  if (shape_->is_in_space() && parameters.has("motion"))
    throw Error(parameters.where("motion"),
                fmt::format("a body '{}' is a function of space and takes no motion; write t into its own "
                            "expression",
                            parameters.object("body").type()));
}

void MovingBody::declare(Schema& schema) {
  schema.typed("body", "The shape of the body", "body");
  schema.object("motion", "How it moves; at rest without it", Motion::schema()).optional();
}

MovingSurface MovingBody::surface(const BodySetting& setting) const {
  MovingSurface shape = shape_->surface(setting);
  if (!parameters_.has("motion")) return shape;
  return [shape = std::move(shape), motion = Motion(parameters_.object("motion"))](double time) {
    Surface moved = shape(time);
    motion.apply(moved, time);
    return moved;
  };
}

}  // namespace seam
