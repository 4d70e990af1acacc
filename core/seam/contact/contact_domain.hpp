// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "seam/assembly/domains.hpp"
#include "seam/contact/opposite_points.hpp"
#include "seam/contact/passage.hpp"
#include "seam/interface/begins_steps.hpp"
#include "seam/interface/cell_constant.hpp"
#include "seam/interface/cell_constants.hpp"
#include "seam/surface/body_surface.hpp"

namespace seam {

/// The points of a body's surface that have another surface opposite to them, in its current configuration or
/// for good in that at rest. An element is a facet of this rank's cells with those points that share the cell
/// opposite.
class ContactDomain final : public IntegrationDomain, public BeginsSteps {
 public:
  /// @param other null where the opposite surface is given
  /// @param obstacle the given surface; unused otherwise
  /// @param degree to integrate exactly on a facet
  ContactDomain(std::shared_ptr<const BodySurface> own, std::shared_ptr<const BodySurface> other,
                MovingSurface obstacle, ContactWindow window, int degree);
  /// Of two surfaces that lie on each other at rest.
  ContactDomain(std::shared_ptr<const BodySurface> own, std::shared_ptr<const BodySurface> other,
                ContactWindow window, int degree);
  [[nodiscard]] int size() const override { return static_cast<int>(elements_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override;
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] const std::vector<Operand>& movers() const override { return movers_; }
  /// @throws StepRefused when the surfaces have passed through each other
  bool follow(double time) override;
  void begin_step(double from) override {
    if (passage_) passage_->begin_step(opposite_at(from));
  }
  int add_constant(int side, std::shared_ptr<const CellConstant> constant, int region) override;
  void forget_constants(bool new_step) override;
  [[nodiscard]] std::string description() const override;
  /// What the surface sees.
  struct Sight {
    double part;      ///< of it has something opposite
    double farthest;  ///< m, of that
    double deepest;   ///< m, by which a part of it that sees nothing seems to be inside of the other body; 0:
                      ///< none
    double depth;     ///< m, that the window looks back
  };
  /// @param time s, of the surface opposite. Collective
  [[nodiscard]] Sight look(double time) const;

 private:
  struct PairPoints {
    int facet, group, opposite_group;
    CutPoints own, opposite;
    std::vector<double> normal, gap;
    PointMotion motion;
  };
  struct Pairing {
    int facet, opposite_group;
    friend bool operator==(const Pairing&, const Pairing&) = default;
  };
  [[nodiscard]] Surface opposite_at(double time) const { return other_ ? other_->now() : obstacle_(time); }
  [[nodiscard]] bool is_at_rest() const { return passage_ == nullptr; }
  void measure_cells();
  [[nodiscard]] OppositePoints look_from(double time) const;
  void add_facet(const OppositePoints& opposite, int facet);
  template <int dim>
  void add_point(const OppositePoints::Hit& hit, double weight, const MovingPair<dim>& moving);
  PairPoints& points_of(int facet, int opposite_group);

  std::shared_ptr<const BodySurface> own_, other_;
  MovingSurface obstacle_;
  ContactWindow window_;
  std::unique_ptr<Passage> passage_;  ///< null where surfaces are at rest
  bool is_found_ = false;             ///< of surfaces at rest: what is opposite
  const Quadrature* rule_;
  std::vector<int> facets_;           ///< of this rank's cells
  std::map<int, double> trace_size_;  ///< of these: volume of the cell over the area of its face, m
  std::vector<Operand> movers_;
  std::vector<PairPoints> elements_;
  struct Constant {
    int side, number;
  };
  std::vector<Constant> constants_;
  mutable std::vector<CellConstants> of_side_;  ///< computed when they are asked for
};

}  // namespace seam
