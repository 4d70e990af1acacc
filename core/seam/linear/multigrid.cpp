// SPDX-License-Identifier: BSD-3-Clause
// Compiled as C++17: Teuchos' validators, which MueLu includes, are not valid C++20.
#include <MueLu_CreateTpetraPreconditioner.hpp>

#include "seam/linear/krylov_solver.hpp"
#include "seam/linear/preconditioner.hpp"

namespace seam {
namespace {

Teuchos::RCP<TpetraVector> coordinates_of(const EquationBlock& block,
                                          const Teuchos::RCP<const TpetraMap>& rows) {
  const int nodes = block.count / block.unknowns_per_node;
  const auto map = Teuchos::rcp(
      new TpetraMap(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), nodes, 0, rows->getComm()));
  auto result = Teuchos::rcp(new TpetraVector(map, block.dimension));
  for (int d = 0; d < block.dimension; ++d) {
    auto data = result->getDataNonConst(d);
    for (int n = 0; n < nodes; ++n)
      data[n] = block.coordinates[static_cast<std::size_t>(n) * block.dimension + d];
  }
  return result;
}

Teuchos::RCP<TpetraVector> near_nullspace_of(const EquationBlock& block,
                                             const Teuchos::RCP<const TpetraMap>& rows) {
  const auto modes = rigid_body_modes(block);
  auto result = Teuchos::rcp(new TpetraVector(rows, modes.size()));
  for (std::size_t m = 0; m < modes.size(); ++m) {
    auto data = result->getDataNonConst(m);
    std::copy(modes[m].begin(), modes[m].end(), data.begin());
  }
  return result;
}

}  // namespace

Teuchos::RCP<TpetraOperator> make_multigrid(const Teuchos::RCP<TpetraMatrix>& matrix,
                                            const EquationBlock& block) {
  Teuchos::ParameterList parameters;
  parameters.set("verbosity", "none");
  parameters.set("multigrid algorithm", "sa");
  parameters.set("number of equations", block.unknowns_per_node);
  parameters.set("max levels", 10);
  parameters.set("coarse: max size", 800);
  auto& smoother = parameters.sublist("smoother: params");
  if (block.symmetric) {
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
  user.set("Coordinates", coordinates_of(block, matrix->getRowMap()));
  if (block.unknowns_per_node == block.dimension)
    user.set("Nullspace", near_nullspace_of(block, matrix->getRowMap()));
  const Teuchos::RCP<TpetraOperator> as_operator = matrix;
  return MueLu::CreateTpetraPreconditioner<double, int, long long>(as_operator, parameters);
}

}  // namespace seam
