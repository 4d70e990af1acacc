// SPDX-License-Identifier: BSD-3-Clause
#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/term/kernel_term.hpp"

namespace {

/// Heat that passes a thin gap: q = transfer (T0 - T1), out of side 0 and into side 1. <dT0 - dT1, q>
struct HeatTransfer {
  using T0 = seam::Scalar<0>;
  using T1 = seam::Scalar<1>;
  using Reads = seam::Slots<seam::Value<T0>, seam::Value<T1>>;
  using Tests = Reads;
  double transfer;  ///< W/(m^2 K)
  template <int dim, class T>
  void operator()(const seam::Point<dim>&, const seam::Trial<dim, T, Reads>& s,
                  seam::Test<dim, T, Tests>& r) const {
    const T q = transfer * (s.value(T0{}) - s.value(T1{}));
    r.value(T0{}) += q;
    r.value(T1{}) -= q;
  }
};

/// Works on any two fields with an unknown of that name: a coupling sees unknowns, never classes of fields.
class HeatTransferCoupling final : public seam::Coupling {
 public:
  explicit HeatTransferCoupling(double transfer) : transfer_(transfer) {}
  std::vector<SideTerm> terms(const seam::CouplingSides& sides) const override {
    // place() throws an error that names field and unknown where there is none.
    for (const seam::Field* field : sides.fields) static_cast<void>(field->place("temperature"));
    return {{seam::make_term(HeatTransfer{transfer_}), {{0, "temperature"}, {1, "temperature"}}}};
  }

 private:
  double transfer_;
};

}  // namespace

void declare_heat_transfer(seam::Registry& registry) {
  seam::Schema s("Heat transfer through the gap between two bodies.");
  s.reference("on", "Interface between the two", "interface");
  s.number("transfer", "Heat flux per temperature difference").unit("W/(m^2 K)").above(0);
  registry.add<seam::Coupling>("coupling", "heat_transfer", s,
                               [](const seam::Parameters& p, const seam::Registry&) {
                                 return std::make_unique<HeatTransferCoupling>(p.number("transfer"));
                               });
}
