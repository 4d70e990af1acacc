// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "seam/interface/cell_constant.hpp"
#include "seam/physics/stress_law.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam::fsci {

/// lambda_e of thesis (3.20), (3.31), Pa/m: the largest eigenvalue of A x = lambda B x on a body's cell with
///   A: <D_du[sigma n], D_Du[sigma n]> over all faces of the cell on the interface, the normal held,
///   B: (grad0 du, D_Du[P]) over the cell.
/// It bounds the traction of a displacement on the interface by its energy in the cell. What moves the cell
/// rigidly has neither and is taken out.
class TraceEigenvalue final : public CellConstant {
 public:
  TraceEigenvalue(std::shared_ptr<const Law> law, Refresh refresh)
      : law_(std::move(law)), refresh_(refresh) {}
  [[nodiscard]] Refresh refresh() const override { return refresh_; }
  /// @throws StepRefused when the cell's stiffness is not positive: it buckles
  [[nodiscard]] double compute(const CellTrace& cell) const override;

 private:
  std::shared_ptr<const Law> law_;
  Refresh refresh_;
};

/// Adds the key `scaling`: which deformation the eigenvalues are those of.
void declare_scaling(Schema& schema, const std::string& otherwise);
[[nodiscard]] CellConstant::Refresh scaling_of(const Parameters& parameters);

}  // namespace seam::fsci
