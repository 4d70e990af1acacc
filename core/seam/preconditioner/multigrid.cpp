// SPDX-License-Identifier: BSD-3-Clause
// Compiled as C++17: Teuchos' validators, which MueLu includes, are not valid C++20.
#include <MueLu_CreateTpetraPreconditioner.hpp>

#include "seam/preconditioner/library.hpp"

namespace seam {
namespace {

/// @param vectors [vector][entry]
Teuchos::RCP<TpetraVector> to_tpetra(const Teuchos::RCP<const TpetraMap>& map,
                                     const std::vector<std::vector<double>>& vectors) {
  auto result = Teuchos::rcp(new TpetraVector(map, vectors.size()));
  for (std::size_t v = 0; v < vectors.size(); ++v)
    std::copy(vectors[v].begin(), vectors[v].end(), result->getDataNonConst(v).begin());
  return result;
}

Teuchos::RCP<TpetraVector> coordinates_of(const GridOfUnknown& unknown,
                                          const Teuchos::RCP<const TpetraMap>& rows) {
  const std::size_t nodes = unknown.coordinates.front().size();
  const auto map = Teuchos::rcp(
      new TpetraMap(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), nodes, 0, rows->getComm()));
  return to_tpetra(map, unknown.coordinates);
}

/// Whether smoothers for symmetric matrices serve: of what this and other ranks own, entries and those
/// opposite to them differ by no more than a tenth. Collective.
bool is_nearly_symmetric(const TpetraMatrix& matrix) {
  const auto rows = matrix.getLocalMatrixHost();
  double squares = 0, differences = 0;
  for (int r = 0; r < rows.numRows(); ++r)
    for (auto k = rows.graph.row_map(r); k < rows.graph.row_map(r + 1); ++k) {
      const int c = rows.graph.entries(k);
      if (c >= rows.numRows() || c == r) continue;
      double opposite = 0;
      for (auto m = rows.graph.row_map(c); m < rows.graph.row_map(c + 1); ++m)
        if (rows.graph.entries(m) == r) opposite = rows.values(m);
      squares += rows.values(k) * rows.values(k);
      differences += (rows.values(k) - opposite) * (rows.values(k) - opposite);
    }
  const double mine[] = {squares, differences};
  double all[2];
  Teuchos::reduceAll(*matrix.getComm(), Teuchos::REDUCE_SUM, 2, mine, all);
  return all[1] <= 0.01 * all[0];
}

}  // namespace

Teuchos::RCP<TpetraOperator> build_multigrid(const Teuchos::RCP<TpetraMatrix>& matrix,
                                             const GridOfUnknown& unknown) {
  Teuchos::ParameterList parameters;
  parameters.set("verbosity", "none");
  parameters.set("multigrid algorithm", "sa");
  parameters.set("number of equations", unknown.components);
  parameters.set("max levels", 10);
  parameters.set("coarse: max size", 800);
  auto& smoother = parameters.sublist("smoother: params");
  if (is_nearly_symmetric(*matrix)) {
    parameters.set("smoother: type", "CHEBYSHEV");
    smoother.set("chebyshev: degree", 3);
    smoother.set("chebyshev: ratio eigenvalue", 20.0);
  } else {
    parameters.set("smoother: type", "RELAXATION");
    smoother.set("relaxation: type", "Symmetric Gauss-Seidel");
    smoother.set("relaxation: sweeps", 2);
  }
  parameters.set("aggregation: type", "uncoupled");
  // On stretched cells aggregates must follow the strong couplings. What is strong is told by distances:
  // entries of elasticity and of products of matrices do not tell.
  parameters.set("aggregation: drop scheme", "distance laplacian");
  parameters.set("aggregation: drop tol", 0.02);
  if (matrix->getComm()->getSize() > 1) {
    // KLU2 returns wrong solutions on several ranks: let one rank own the coarsest level.
    parameters.set("repartition: enable", true);
    parameters.set("repartition: partitioner", "zoltan2");
    parameters.set("repartition: start level", 1);
    parameters.set("repartition: min rows per proc", 1000);
    parameters.sublist("repartition: params").set("algorithm", "multijagged");
  }
  auto& user = parameters.sublist("user data");
  user.set("Coordinates", coordinates_of(unknown, matrix->getRowMap()));
  user.set("Nullspace", to_tpetra(matrix->getRowMap(), unknown.near_nullspace));
  const Teuchos::RCP<TpetraOperator> as_operator = matrix;
  return MueLu::CreateTpetraPreconditioner<double, int, long long>(as_operator, parameters);
}

}  // namespace seam
