// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "seam/base/diagnostics.hpp"
#include "seam/cut/level_set.hpp"
#include "seam/surface/body.hpp"

namespace seam {
namespace {

/// The zero surface of a function at the time asked for last.
class ZeroSurface {
 public:
  ZeroSurface(const Mesh& background, const Parameters& p)
      : background_(&background), value_(p.expression("value")), where_(p.where("value")) {}

  const Surface& operator()(double time) {
    // Newton's method asks for the same time again and again.
    if (time != time_) find(time);
    return surface_;
  }

 private:
  void find(double time) {
    const int dim = background_->dimension();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto value = [&](const double* x) {
      const double result = value_(x, dim, time);
      low = std::min(low, result);
      high = std::max(high, result);
      return result;
    };
    try {
      surface_ = level_set_surface(*background_, value);
    } catch (const Error& error) {
      throw Error(where_, error.what());
    }
    if (surface_.facet_count() == 0) {
      const Communicator& communicator = background_->communicator();
      low = -communicator.max(-low);
      high = communicator.max(high);
      throw Error(where_,
                  fmt::format("the level set has no change of sign on mesh '{}' at t = {:.6g}: its "
                              "values there lie between {:.6g} and {:.6g}; it must be negative inside "
                              "the body and positive outside, with at least one node on either side",
                              background_->name(), time, low, high));
    }
    time_ = time;
  }

  const Mesh* background_;
  Expression value_;
  Location where_;
  double time_ = std::numeric_limits<double>::quiet_NaN();
  Surface surface_;
};

/// The places where a function is negative, as fine as the mesh out of which they are cut.
class LevelSet final : public BodyShape {
 public:
  explicit LevelSet(const Parameters& p) : p_(p) {}
  static Schema schema() {
    Schema s("Where a function is negative; taken as linear between the nodes and centres of cells.");
    s.expression("value", "negative inside the body, positive outside, of x, y, z and t");
    return s;
  }
  [[nodiscard]] MovingSurface surface(const BodySetting& setting) const override {
    return [zero = ZeroSurface(setting.background, p_)](double time) mutable { return zero(time); };
  }
  [[nodiscard]] bool is_in_space() const override { return true; }

 private:
  Parameters p_;
};

}  // namespace

void register_level_set(Registry& registry) {
  registry.add<BodyShape>("body", "level_set", LevelSet::schema(),
                          [](const Parameters& p, const Registry&) { return std::make_unique<LevelSet>(p); });
}

}  // namespace seam
