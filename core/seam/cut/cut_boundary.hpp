// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/assembly/domains.hpp"
#include "seam/assembly/remote_cells.hpp"
#include "seam/cut/field_cut.hpp"
#include "seam/interface/interface.hpp"

namespace seam {

/// Degree to integrate on facets that lie askew in the cells of a side: tensor cells count the degree of
/// their functions per direction, and along an oblique facet two directions add up. What couplings ask for
/// beyond it counts as is.
int facet_degree(const InterfaceSetup& setup, int side = 0);

/// The part of a body's surface that bounds a field whose mesh it cuts, piece by piece. Side 0 is that field.
class CutBoundary : public IntegrationDomain {
 public:
  /// @param cut the bodies that cut the field's mesh
  /// @param body its number among them
  /// @param degree to integrate exactly along a facet
  CutBoundary(Field& field, const FieldCut& cut, int body, int degree);
  [[nodiscard]] int size() const override { return static_cast<int>(groups_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return {field_}; }
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] std::string description() const override;
  void update(const Field& field) override;

 protected:
  /// All points in one cell that share a group.
  struct PointGroup : CutPoints {
    int group = 0;
    std::vector<double> normal;  ///< [point][dimension], out of the field
    CutPoints partner;           ///< of side 1
    double trace_size = 0;
    PointMotion motion;  ///< where the domain has movers
  };
  /// Points of facets of different groups belong to different elements.
  [[nodiscard]] virtual int group(int facet) const {
    (void)facet;
    return 0;
  }
  /// Sets up side 1 of a piece. @param points of the rule that belong to it
  /// @param motion of the rule's points; empty unless the domain has movers
  virtual void add_partner(PointGroup& piece, const InterfaceRule& rule, const InterfaceMotion& motion,
                           const std::vector<int>& points) const {
    (void)piece, (void)rule, (void)motion, (void)points;
  }
  [[nodiscard]] const PointGroup& piece(int index) const { return groups_[index]; }

 private:
  void add_groups(int cell, int part, const InterfaceRule& rule, const InterfaceMotion& motion);
  Field* field_;
  const FieldCut* cut_;
  int body_, degree_;
  std::vector<PointGroup> groups_;
};

}  // namespace seam
