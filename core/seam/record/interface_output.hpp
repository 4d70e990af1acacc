// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "seam/output/results_folder.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// Writes what couplings measure point by point, as `interfaces/INTERFACE-STEP.csv`. Columns are the time;
/// where the trace of the first side is taken, m (of a closed point of a body in a fluid: the nearest wet
/// one); the place in the mesh of the second side, `body_x`, `body_y`, `body_z`, m; the point's weight,
/// m^(d-1); and one per measure and component. A measure has no value (nan) at points of a part of the
/// interface that does not count for it.
class InterfaceOutput {
 public:
  InterfaceOutput(const Problem& problem, ResultsFolder& folder);
  /// True when some coupling measures something.
  /// Collective. @throws FileError on all ranks
  void write(long step_number, const TimePoint& at) const;

 private:
  using Domain = std::shared_ptr<const IntegrationDomain>;
  struct Column {
    std::string name;
    std::map<Domain, std::vector<BoundTerm>> quantities;  ///< their sum
    int components = 1;
  };
  struct Interface {
    int dimension = 2;
    std::vector<Domain> domains;
    std::vector<Column> columns;
  };
  void write_table(const std::string& name, long step_number, double time,
                   const std::vector<double>& table) const;
  [[nodiscard]] static std::vector<double> rows(const Interface& interface, const TimePoint& at);
  Communicator communicator_;
  ResultsFolder* folder_;
  std::map<std::string, Interface> interfaces_;
};

}  // namespace seam
