// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "seam/assembly/domains.hpp"
#include "seam/contact/opposite_points.hpp"
#include "seam/contact/passage.hpp"
#include "seam/cut/field_cut.hpp"
#include "seam/interface/begins_steps.hpp"
#include "seam/interface/cell_constant.hpp"
#include "seam/interface/cell_constants.hpp"
#include "seam/surface/body_surface.hpp"

namespace seam {

/// All of a body's surface in a field that it is cut out of, where it may come to touch another surface, or
/// itself: the consistent pair of domain and interface of thesis 6.2.1.2. Every point of the surface is
/// in exactly one of five zones. What the field's mesh has of the surface is wet; there, a point may have an
/// opposite one or not. The rest, inside of the other body or in a part of the field too small to be kept, is
/// closed where it has an opposite point, or shut where nothing at all of the surface is wet; else it is
/// covered, as by a wall that the field ends at.
class EmbeddedSurface {
 public:
  /// @param number of the body among those that cut the field's mesh
  /// @param degree to integrate exactly, as the field's cells count it
  EmbeddedSurface(Field& field, const FieldCut& cut, int number, std::shared_ptr<const BodySurface> own,
                  std::shared_ptr<const BodySurface> other, ContactWindow window, int degree);

  enum Zone { free, near, closed, shut, covered };
  static constexpr int zone_count = 5;

  /// Points that share the cells on all sides. Of closed ones side 0, the field, and sides 3 and 4, the two
  /// bodies, are met elsewhere, at the nearest wet point: there field and bodies are evaluated for the closed
  /// part (extension of thesis 6.3.3). That point moves with the facets of both bodies there. Shut points
  /// have the two bodies, covered ones the own body alone. Of a shut point's gap the film that counts as
  /// closed is taken off: nothing but the other body holds this one there.
  struct Element {
    CutPoints outside, own, other, own_edge, other_edge;
    int group = -1, other_group = -1, own_edge_group = -1, other_edge_group = -1;
    std::vector<double> normal, gap;  ///< normal: out of the field, into the body
    double trace_size = 0;
    PointMotion motion;
  };
  [[nodiscard]] const std::vector<Element>& elements(Zone zone) const { return elements_[zone]; }

  /// Finds all points anew. Collective. @return true when elements are others than before
  /// @throws StepRefused when the surface has passed through the other one, so that no contact is seen
  bool follow();
  void begin_step() { passage_.begin_step(other_->now()); }

  [[nodiscard]] Field& field() const { return *field_; }
  [[nodiscard]] const BodySurface& own() const { return *own_; }
  [[nodiscard]] const BodySurface& other() const { return *other_; }

 private:
  /// A stretch of a facet, or its share, that is wet.
  struct Wet {
    int facet;
    Moves<2, 1> from, to;  ///< in the plane, as the facet moves
    double area;
  };
  /// A wet point that a closed one may take its field's trace from.
  struct Edge {
    cutting::Vector position;
    int rank, part, element, point;
  };
  struct ClosedPoint {
    OppositePoints::Hit hit;
    OppositePoints::Stretch stretch;  ///< that it lies in, in the plane
    double weight;
  };
  struct CoveredPoint {
    int facet;
    std::array<double, 2> on_facet;
    double weight;
    Moves<2, 1> from = 0.0, to = 1.0;  ///< in the plane: of the stretch that it lies in
  };
  /// What is not wet.
  struct Dry {
    std::vector<ClosedPoint> closed;
    std::vector<CoveredPoint> covered;
  };
  struct Key {
    int outside_cell, outside_part, group, other_group, own_edge_group, other_edge_group;
    friend bool operator==(const Key&, const Key&) = default;
  };
  static std::vector<double> divide(int facet, double from, double to, const OppositePoints& opposite,
                                    std::vector<OppositePoints::Break>& moving);
  template <int dim>
  void add_wet(int cell, int part, const OppositePoints& opposite);
  void add_dry(const OppositePoints& opposite);
  void find_dry(int facet, const std::vector<Wet>& wet, const OppositePoints& opposite, Dry& dry) const;
  void find_dry_in_space(int facet, const std::vector<Wet>& wet, const OppositePoints& opposite,
                         Dry& dry) const;
  void add_closed(const std::vector<ClosedPoint>& points, const OppositePoints& opposite);
  void refuse_passed(int facet, const double* on_facet, const OppositePoints& opposite) const;
  template <int dim>
  void add_closed_point(const ClosedPoint& point, const std::vector<Edge>& edges,
                        const OppositePoints& opposite);
  template <int dim>
  void add_shut(const std::vector<ClosedPoint>& points, const OppositePoints& opposite);
  /// The element of a zone without the field for a point on a facet; null where another rank has it.
  Element* element_beside(Zone zone, int facet, int other_facet);
  template <int dim>
  void add_covered(const std::vector<CoveredPoint>& points, const Surface& now);
  /// @param span two ends of a wet stretch @param inner ends of stretches that are no ends of pieces
  static OppositePoints::Stretch stretch_at(int facet, const double* span,
                                            const std::vector<OppositePoints::Break>& inner,
                                            const OppositePoints& opposite);
  static void follow_ends(const OppositePoints::Hit& hit, OppositePoints::Stretch stretch,
                          const OppositePoints& opposite, MovingPair<2>& pair, MovingPoint<2, 2>& point);
  template <int dim, int facets>
  void add_motion(Element& element, int facet, const MovingPoint<dim, facets>& point,
                  std::size_t moves) const;
  void add_edge(Element& element, const Element& source, std::size_t point) const;
  template <int dim>
  void add_partner(Element& element, const OppositePoints::Hit& hit, const MovingPair<dim>& pair,
                   std::size_t moves) const;
  [[nodiscard]] static Key key_of(const Element& element);
  [[nodiscard]] std::vector<Key> keys() const;
  [[nodiscard]] int dimension() const { return field_->mesh().dimension(); }

  Field* field_;
  const FieldCut* cut_;
  int number_, degree_;
  std::shared_ptr<const BodySurface> own_, other_;
  ContactWindow window_;
  double closed_film_ = 0;  ///< m, the thickness of a film of the field that has closed
  Passage passage_;
  const Quadrature* rule_;  ///< on closed facets
  std::array<std::vector<Element>, zone_count> elements_;
  std::vector<Wet> wet_;                         ///< of this rank
  std::array<std::vector<Edge>, 2> wet_points_;  ///< of this rank, free and near
};

/// One of the zones as a domain of integration.
class EmbeddedZone final : public IntegrationDomain, public BeginsSteps {
 public:
  EmbeddedZone(std::shared_ptr<EmbeddedSurface> surface, EmbeddedSurface::Zone zone);
  [[nodiscard]] int size() const override { return static_cast<int>(surface_->elements(zone_).size()); }
  [[nodiscard]] std::vector<Field*> fields() const override;
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] const std::vector<Operand>& movers() const override { return movers_; }
  [[nodiscard]] int swept_side() const override { return zone_ < EmbeddedSurface::closed ? 0 : -1; }
  /// The first part finds the points of all.
  bool follow(double time) override;
  void begin_step(double from) override;
  int add_constant(int side, std::shared_ptr<const CellConstant> constant, int region) override;
  void forget_constants(bool new_step) override;
  [[nodiscard]] std::string description() const override;

 private:
  /// Whether the field is met, here or elsewhere; else side 0 is the own body once more.
  [[nodiscard]] bool meets_field() const { return zone_ < EmbeddedSurface::shut; }
  std::shared_ptr<EmbeddedSurface> surface_;
  EmbeddedSurface::Zone zone_;
  std::vector<Operand> movers_;
  struct Constant {
    int side, number;
  };
  std::vector<Constant> constants_;
  mutable CellConstants of_own_, of_other_;  ///< computed when they are asked for
};

}  // namespace seam
