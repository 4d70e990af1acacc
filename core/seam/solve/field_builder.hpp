// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "seam/assembly/domains.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// Collects what a physics declares and turns it into domains of the problem.
class FieldBuilder final : public FieldSetup {
 public:
  FieldBuilder(FieldEntry& entry,
               std::vector<std::pair<std::shared_ptr<IntegrationDomain>, std::vector<BoundTerm>>>& domains)
      : entry_(entry), domains_(domains) {}
  /// Hands the collected terms over.
  void finish();

  [[nodiscard]] int dimension() const override { return entry_.shape->dimension(); }
  [[nodiscard]] const std::string& field_name() const override { return entry_.name; }
  [[nodiscard]] std::vector<std::string> boundaries() const override;
  [[nodiscard]] int boundary_axis(const std::string& boundary) const override;
  void publish(const std::string& constant, double value) override;
  void publish(const std::string& name, std::shared_ptr<const Law> law) override;
  void divide(const std::vector<std::pair<std::vector<std::string>, Location>>& names) override;
  void within(int region, const std::function<void()>& add) override;
  void add_cell_term(std::shared_ptr<const Term> term, std::vector<std::string> operands) override;
  void add_uncut_cell_term(std::shared_ptr<const Term> term, std::vector<std::string> operands) override;
  void add_boundary_term(const std::string& boundary, std::shared_ptr<const Term> term,
                         std::vector<std::string> operands) override;
  void add_surface_term(std::shared_ptr<const Term> term, std::vector<std::string> operands,
                        const std::string& name) override;
  void add_interior_face_term(std::shared_ptr<const Term> term, std::vector<Operand> operands) override;
  void add_ghost_face_term(GhostFaces faces, std::shared_ptr<const Term> term,
                           std::vector<Operand> operands) override;
  void fix_level(const std::string& unknown, double value, std::vector<std::string> open_boundaries) override;
  void prescribe(const std::string& boundary, const std::string& unknown, int component, Expression value,
                 const Location& where) override;
  void give(const std::string& unknown, int component, Expression value) override;
  void set_initial(const std::string& unknown, int component, Expression value) override;
  void set_initial_rate(const std::string& unknown, int component, Expression value) override;
  void add_output(const std::string& name, std::shared_ptr<const Term> quantity,
                  std::vector<std::string> operands) override;
  void add_integral(const std::string& name, std::shared_ptr<const Term> quantity,
                    std::vector<std::string> operands) override;
  void add_boundary_quantity(const std::string& name, std::shared_ptr<const Term> quantity,
                             std::vector<std::string> operands) override;
  [[nodiscard]] Moments moments() const override;

 private:
  [[noreturn]] void refuse(const std::string& what) const;
  void require_term(const Term* term, bool is_quantity) const;
  /// A component of one of the field's unknowns: its place in the block.
  [[nodiscard]] Field::ComponentRange component_place(const std::string& unknown, int component) const;
  /// With the region in which it holds on these sides.
  [[nodiscard]] BoundTerm bind(std::shared_ptr<const Term> term, std::vector<Operand> operands,
                               int sides = 1) const;
  void add_quantity(std::vector<FieldQuantity>& list, const std::string& name,
                    std::shared_ptr<const Term> quantity, const std::vector<std::string>& operands) const;
  FieldEntry& entry_;
  int region_ = -1;  ///< that what is added holds in, -1 for all
  std::vector<std::pair<std::shared_ptr<IntegrationDomain>, std::vector<BoundTerm>>>& domains_;
  /// By where they live and the degree of the quadrature.
  std::map<std::pair<CellDomain::Cells, int>, std::vector<BoundTerm>> cell_terms_;
  std::map<std::pair<std::string, int>, std::vector<BoundTerm>> boundary_terms_;
  std::map<std::pair<std::string, int>, std::vector<BoundTerm>> surface_terms_;  ///< by their own name
  std::map<std::pair<InteriorFaceDomain::Faces, int>, std::vector<BoundTerm>> face_terms_;
};

/// Degree a quadrature on the cells of `field` must integrate exactly for this term.
int cell_degree(const Field& field, const Term& term);

/// Nodes of a block on a named boundary (all of them for ""): local numbers, ascending.
std::vector<int> boundary_nodes(const Field& field, int block, const std::string& boundary);

}  // namespace seam
