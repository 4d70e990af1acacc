// SPDX-License-Identifier: BSD-3-Clause
// Compiled as C++17: Teuchos' validators, which Zoltan2 includes, are not valid C++20.
#include "seam/mesh/partition.hpp"

#include <Zoltan2_BasicVectorAdapter.hpp>
#include <Zoltan2_PartitioningProblem.hpp>
#include <algorithm>
#include <numeric>

#include "seam/linear/kokkos.hpp"

namespace seam {

std::vector<int> partition_points(int dimension, const std::vector<double>& points,
                                  const std::vector<double>& weights, int parts) {
  const int count = static_cast<int>(points.size()) / dimension;
  std::vector<int> part(count, 0);
  if (parts == 1) return part;

  start_kokkos();
  // Every rank solves the same small problem, so no answer needs to travel.
  using Adapter = Zoltan2::BasicVectorAdapter<Zoltan2::BasicUserTypes<double, int, long long>>;
  std::vector<long long> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  const std::vector<double> equal(weights.empty() ? count : 0, 1.0);
  const double* weight = weights.empty() ? equal.data() : weights.data();
  const double* z = dimension == 3 ? points.data() + 2 : nullptr;
  const double* y = dimension >= 2 ? points.data() + 1 : nullptr;
  Adapter adapter(count, ids.data(), points.data(), y, z, dimension, dimension, dimension, true, weight, 1);
  Teuchos::ParameterList parameters;
  parameters.set("algorithm", "multijagged");
  parameters.set("num_global_parts", parts);
  parameters.set("imbalance_tolerance", 1.02);
  Zoltan2::PartitioningProblem<Adapter> problem(&adapter, &parameters,
                                                Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)));
  problem.solve();
  const int* found = problem.getSolution().getPartListView();
  std::copy(found, found + count, part.begin());
  return part;
}

}  // namespace seam
