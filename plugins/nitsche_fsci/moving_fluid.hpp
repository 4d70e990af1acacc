// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "conditions.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"
#include "seam/term/moving_mesh.hpp"

/// Couplings of a body with a fluid whose mesh is fitted to it and moves along.
namespace seam::fsci {

/// The fluid's mesh goes where the body goes: k (dd, d - u) with the mesh's displacement d. Only the mesh
/// feels it, an elastic body of Young's modulus 1: k = 1e6/h_Gamma leaves d - u at 1e-6 h_Gamma times its
/// strain.
struct MeshFollowsBody {
  using Mesh = Vector<0>;
  using Body = Vector<1>;
  using Reads = Slots<Value<Mesh>, Value<Body>>;
  using Tests = Slots<Value<Mesh>>;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Mesh{}) += (1e6 / x.trace_size) * (s.value(Mesh{}) - s.value(Body{}));
  }
};

/// Makes the terms and measures of a coupling, with the fluid on side 0 on a mesh that stands or moves. The
/// kernels' operands 0 and 1 are the fluid's, further ones the body's; `count` in all.
template <int count>
class FluidMesh {
 public:
  FluidMesh(const CouplingSides& sides, std::vector<Operand> operands) : operands_(std::move(operands)) {
    for (const Operand& operand : operands_)
      static_cast<void>(sides.fields.at(operand.side)->place(operand.unknown));
    for (const Unknown& unknown : sides.fields[0]->unknowns())
      moves_ = moves_ || unknown.name == "displacement";
    if (moves_) operands_.push_back({0, "displacement"});
  }
  [[nodiscard]] bool moves() const { return moves_; }

  /// The terms of a kernel, and what makes the mesh follow.
  template <class Kernel>
  [[nodiscard]] std::vector<Coupling::SideTerm> terms(Kernel kernel) const {
    if (!moves_) return {{make_term(std::move(kernel), 1), operands_}};
    return {{make_moving_term<Vector<count>, 2>(std::move(kernel), 1), operands_},
            {make_term(MeshFollowsBody{}), {{0, "displacement"}, {1, "displacement"}}}};
  }
  template <class Kernel>
  [[nodiscard]] Coupling::Measure measure(std::string name, Kernel kernel,
                                          MeasureOf of = MeasureOf::norm) const {
    auto quantity =
        moves_ ? make_moving_quantity<Vector<count>, 2>(std::move(kernel), of == MeasureOf::norm ? 0.5 : 1.0)
               : make_quantity(std::move(kernel));
    return {std::move(name), {{std::move(quantity), operands_}}, of};
  }

 private:
  std::vector<Operand> operands_;
  bool moves_ = false;
};

}  // namespace seam::fsci
