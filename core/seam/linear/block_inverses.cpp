// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>

#include "seam/linear/block_inverse.hpp"
#include "seam/linear/preconditioner.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {
namespace {

/// Up to so many equations, as those of a rigid body, are left to the factorisation.
constexpr long long small = 800;

/// One of Trilinos' operators, chosen by what the equations are.
class OperatorInverse final : public BlockInverse {
 public:
  enum class Use { factorisation, multigrid, schur };
  OperatorInverse(Use use, int fill) : use_(use), fill_(fill) {}
  void build(const Matrix& a, const EquationBlock& equations) override {
    const auto& unknowns = equations.unknowns;
    const auto constrains = [](const EquationUnknown& u) { return u.role == UnknownRole::constraint; };
    const bool large = a.global_rows > small;
    if (use_ == Use::schur && large && unknowns.size() > 1 &&
        std::ranges::count_if(unknowns, constrains) == 1) {
      operator_ = make_simple(a, equations, fill_);
    } else if (use_ != Use::factorisation && large && unknowns.size() == 1) {
      operator_ = make_multigrid(tpetra_view(a), unknowns.front(), equations.dimension);
    } else {
      const auto view = tpetra_view(a);
      std::vector<int> rows(a.rows);
      std::iota(rows.begin(), rows.end(), 0);
      const Selection all(*view, std::move(rows));
      operator_ = make_incomplete_lu(all.own_submatrix(a), all.map(), fill_);
    }
  }
  void apply(std::span<const double> b, std::span<double> x) const override {
    TpetraVector in(operator_->getDomainMap(), 1), out(operator_->getRangeMap(), 1);
    std::ranges::copy(b, in.getDataNonConst(0).begin());
    operator_->apply(in, out);
    std::ranges::copy(out.getData(0), x.begin());
  }

 private:
  Use use_;
  int fill_;
  Teuchos::RCP<TpetraOperator> operator_;
};

}  // namespace

void register_block_inverses(Registry& registry) {
  const auto add = [&](const std::string& name, const std::string& summary, OperatorInverse::Use use) {
    Schema schema(summary);
    schema.integer("fill", "Levels of fill-in of incomplete factorisations")
        .otherwise("0")
        .at_least(0)
        .at_most(5);
    registry.add<BlockInverse>("block_inverse", name, schema, [use](const Parameters& p, const Registry&) {
      return std::make_unique<OperatorInverse>(use, static_cast<int>(p.integer("fill")));
    });
  };
  add("ilu", "An incomplete factorisation of what each rank owns (Ifpack2).",
      OperatorInverse::Use::factorisation);
  add("multigrid",
      "Smoothed aggregation (MueLu) for a field of one unknown, an incomplete factorisation for others and "
      "for small ones.",
      OperatorInverse::Use::multigrid);
  add("schur",
      "A Schur complement (SIMPLE) for an unknown that constrains the field's others, as a pressure does: "
      "multigrid for it and for what displaces points, an incomplete factorisation for a velocity. Fields "
      "without are treated as by `multigrid`.",
      OperatorInverse::Use::schur);
}

}  // namespace seam
