// SPDX-License-Identifier: BSD-3-Clause
#include "link.hpp"

#include <fmt/ranges.h>

#include "seam/assembly/element.hpp"
#include "seam/assembly/remote_cells.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/lagrange.hpp"

namespace seam::solid {
namespace {

class LinkDomain final : public IntegrationDomain {
 public:
  explicit LinkDomain(const std::vector<Field*>& sides) : sides_(sides) {
    // The owner of the first body evaluates it.
    here_ = sides_.front()->mesh().owned_cells() > 0;
    for (Field* side : sides_) {
      const auto fetched = fetch_cells(*side, here_ ? std::vector<int>{0} : std::vector<int>{});
      if (here_) bodies_.push_back(fetched.front());
    }
    tabulate(CellType::point, 1, nullptr, 1, false, table_);
  }
  [[nodiscard]] int size() const override { return here_ ? 1 : 0; }
  [[nodiscard]] std::vector<Field*> fields() const override { return sides_; }
  void fill(int, Element& element) const override {
    element.dimension = sides_.front()->mesh().dimension();
    element.points = 1;
    element.weight = {1.0};
    element.normal.clear();
    element.sides.resize(sides_.size());
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      ElementSide& side = element.sides[s];
      bodies_[s].attach(side, *sides_[s]);
      side.table[0] = &table_;
      side.map_geometry();
    }
    element.set_sizes(element.sides.front().diameter, element.sides.front().diameter);
  }
  [[nodiscard]] const int* nodes(int, int side, int block) const override {
    return bodies_[side].nodes[block].data();
  }
  [[nodiscard]] std::string description() const override {
    std::vector<std::string> names;
    for (const Field* side : sides_) names.push_back("'" + side->name() + "'");
    return fmt::format("the link of {}", fmt::join(names, " and "));
  }

 private:
  std::vector<Field*> sides_;
  bool here_ = false;
  std::vector<RemoteCell> bodies_;
  ShapeTable table_;
};

}  // namespace

Link::Link(const Parameters& p) : where_(p.where("fields")), fields_(p.names("fields")) {
  if (fields_.empty() || fields_.size() > 2)
    throw Error(where_, fmt::format("a link holds two rigid bodies together, or one to the ground; found {}",
                                    fields_.size()));
  if (fields_.size() == 2 && fields_[0] == fields_[1])
    throw Error(where_, "a link of '" + fields_[0] + "' with itself");
}

Schema Link::schema() {
  Schema s("Two rigid bodies, or one and the ground, for springs and dashpots between them.");
  s.names("fields", "A `rigid_body`, and the one it is linked to; without, the ground").naming("field");
  return s;
}

std::vector<InterfacePart> Link::build(InterfaceSetup& setup) const {
  for (const Field* side : setup.sides)
    if (side->mesh().type() != CellType::point)
      throw Error(where_, fmt::format("a link is between rigid bodies, and '{}' is none; fix its boundary to "
                                      "one (constraint `rigid` with `on`) and link that",
                                      side->name()));
  return {{"", std::make_shared<LinkDomain>(setup.sides)}};
}

}  // namespace seam::solid
