// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "seam/record/evaluate.hpp"
#include "seam/record/results.hpp"

namespace seam {

/// Something recorded at every step under one or more names.
class Probe {
 public:
  /// Collective. @param parameters an entry of a scene's output.probes
  Probe(std::string name, const Parameters& parameters, Problem& problem);
  /// Appends the present values to `results`: `name`, or `name.x`, `name.y`, ... for several components.
  /// Collective.
  void record(Problem& problem, const TimePoint& at, Results& results) const;

 private:
  void choose_quantity(const Parameters& parameters, const FieldEntry& entry, const Problem& problem);
  [[nodiscard]] std::vector<double> evaluate(Problem& problem, const TimePoint& at) const;
  std::string name_;
  Location where_;  ///< of the component, else of the probe
  std::string field_;
  std::string quantity_name_;
  NamedQuantity quantity_;
  std::vector<std::string> boundaries_;
  std::optional<ProbePoint> point_;
  std::string interface_;
  bool force_ = false;
  std::optional<std::array<double, 3>> moment_about_;
  bool reaction_ = false;
  const HoldsField* holding_ = nullptr;  ///< whose force it is
  std::string exerted_;                  ///< the unknown that a reaction holds, or that a force works on
  std::string component_;                ///< "", "x", "y", "z" or "magnitude"
};

/// The unknown whose reaction is recorded on boundaries: the first one of the field that is prescribed there;
/// where none is, the first one.
[[nodiscard]] std::string unknown_of_reaction(const FieldEntry& entry,
                                              const std::vector<std::string>& boundaries);

/// Whether a series is what is recorded under a name, or a component of it.
[[nodiscard]] bool is_series_of(const std::string& series, const std::string& name);

/// Appends the integrals that each field's physics declares, as `field.name`, or `field.name.x`,
/// `field.name.y`, ... for several components. Collective.
void record_integrals(Problem& problem, const TimePoint& at, Results& results);

}  // namespace seam
