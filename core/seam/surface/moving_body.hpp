// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "seam/plugin/registry.hpp"
#include "seam/surface/body.hpp"

namespace seam {

/// A body of given shape and rigid motion, as a scene describes it by the keys `body` and `motion`.
class MovingBody {
 public:
  /// @throws Error when a shape that is a function of space is given a motion
  MovingBody(const Parameters& parameters, const Registry& types);
  /// Adds the two keys.
  static void declare(Schema& schema);
  [[nodiscard]] MovingSurface surface(const BodySetting& setting) const;

 private:
  Parameters parameters_;
  std::shared_ptr<const BodyShape> shape_;
};

}  // namespace seam
