// SPDX-License-Identifier: BSD-3-Clause
#include <Ifpack2_AdditiveSchwarz.hpp>
#include <Ifpack2_Factory.hpp>

#include "seam/linear/preconditioner.hpp"

namespace seam {
namespace {

/// The diagonal block of rows and columns [first, first + count) of every rank.
Teuchos::RCP<TpetraMatrix> diagonal_block(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                                          const EquationBlock& block) {
  const auto map = Teuchos::rcp(new TpetraMap(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                                              block.count, 0, system->getComm()));
  // Block-local equation numbers of all columns, ghosts included; -1 outside the block.
  Tpetra::Vector<long long, int, long long> mine(system->getDomainMap()), all(system->getColMap());
  mine.putScalar(-1);
  {
    auto data = mine.getDataNonConst();
    for (int r = 0; r < block.count; ++r) data[block.first + r] = map->getGlobalElement(r);
  }
  if (const auto importer = system->getGraph()->getImporter(); !importer.is_null())
    all.doImport(mine, *importer, Tpetra::INSERT);
  else
    all = mine;
  const auto number = all.getData();
  Teuchos::ArrayRCP<std::size_t> lengths(block.count);
  for (int r = 0; r < block.count; ++r)
    for (std::size_t k = a.row_start[block.first + r]; k < a.row_start[block.first + r + 1]; ++k)
      lengths[r] += number[a.column[k]] >= 0 ? 1 : 0;
  auto result = Teuchos::rcp(new TpetraMatrix(map, lengths(), Tpetra::StaticProfile));
  std::vector<long long> columns;
  std::vector<double> values;
  for (int r = 0; r < block.count; ++r) {
    columns.clear();
    values.clear();
    for (std::size_t k = a.row_start[block.first + r]; k < a.row_start[block.first + r + 1]; ++k)
      if (number[a.column[k]] >= 0) {
        columns.push_back(number[a.column[k]]);
        values.push_back(a.value[k]);
      }
    result->insertGlobalValues(map->getGlobalElement(r), static_cast<int>(columns.size()), values.data(),
                               columns.data());
  }
  result->fillComplete(map, map);
  return result;
}

}  // namespace

Teuchos::RCP<TpetraOperator> make_incomplete_lu(const Teuchos::RCP<TpetraMatrix>& matrix, int fill) {
  Ifpack2::Factory factory;
  const Teuchos::RCP<const Tpetra::RowMatrix<double, int, long long>> rows = matrix;
  auto result = factory.create<Tpetra::RowMatrix<double, int, long long>>("SCHWARZ", rows);
  Teuchos::ParameterList parameters;
  parameters.set("schwarz: inner preconditioner name", "RILUK");
  parameters.set("schwarz: overlap level", matrix->getComm()->getSize() > 1 ? 1 : 0);
  parameters.sublist("schwarz: inner preconditioner parameters").set("fact: iluk level-of-fill", fill);
  result->setParameters(parameters);
  result->initialize();
  result->compute();
  return result;
}

BlockGaussSeidel::BlockGaussSeidel(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                                   const std::vector<EquationBlock>& blocks, bool multigrid, int fill)
    : system_(system) {
  for (const EquationBlock& block : blocks) {
    const auto matrix = blocks.size() == 1 ? system : diagonal_block(system, a, block);
    // Small blocks (a rigid body's motion) and mixed ones are left to the factorisation.
    const bool coarsen = multigrid && matrix->getGlobalNumRows() > 2000 &&
                         (block.unknowns_per_node == block.dimension || block.unknowns_per_node == 1);
    parts_.push_back({block.first, block.count, matrix->getRowMap(),
                      coarsen ? make_multigrid(matrix, block) : make_incomplete_lu(matrix, fill)});
  }
}

void BlockGaussSeidel::apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double alpha,
                             double beta) const {
  TpetraVector solution(getDomainMap(), x.getNumVectors()), residual(x, Teuchos::Copy);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    if (p > 0) {
      Tpetra::deep_copy(residual, x);
      system_->apply(solution, residual, Teuchos::NO_TRANS, -1.0, 1.0);
    }
    TpetraVector in(part.map, x.getNumVectors()), out(part.map, x.getNumVectors());
    for (std::size_t v = 0; v < x.getNumVectors(); ++v) {
      const auto from = residual.getData(v);
      auto to = in.getDataNonConst(v);
      std::copy_n(from.begin() + part.first, part.count, to.begin());
    }
    part.inverse->apply(in, out);
    for (std::size_t v = 0; v < x.getNumVectors(); ++v) {
      const auto from = out.getData(v);
      auto to = solution.getDataNonConst(v);
      std::copy_n(from.begin(), part.count, to.begin() + part.first);
    }
  }
  y.update(alpha, solution, beta);
}

}  // namespace seam
