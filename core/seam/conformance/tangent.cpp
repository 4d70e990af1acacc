// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/tangent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "seam/assembly/assembler.hpp"
#include "seam/assembly/element.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/conformance/finite_difference.hpp"
#include "seam/field/field.hpp"
#include "seam/linear/linear_solver.hpp"
#include "seam/term/term_name.hpp"

namespace seam {
namespace {

/// The rows of one unknown.
struct UnknownRows {
  std::string name;
  std::vector<int> rows;
};

std::vector<UnknownRows> rows_of_unknowns(const Problem& problem, const Assembler& assembler) {
  std::vector<UnknownRows> result;
  for (const FieldEntry& entry : problem.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      UnknownRows& rows = result.emplace_back(UnknownRows{entry.name + "." + unknown.name, {}});
      const Field::ComponentRange place = entry.field->place(unknown.name);
      for (int node = 0; node < entry.field->blocks()[place.block].space->owned_nodes(); ++node)
        for (int c = 0; c < place.components; ++c)
          if (const int row = assembler.row(*entry.field, place.block, node, place.offset + c); row >= 0)
            rows.rows.push_back(row);
    }
  return result;
}

double norm_on(const std::vector<int>& rows, const std::vector<double>& x) {
  double sum = 0;
  for (const int r : rows) sum += x[r] * x[r];
  return std::sqrt(sum);
}

/// Distance between neighbouring nodes, roughly; 1 for a single node.
double cell_size(const Space& space) {
  const int dim = space.mesh().dimension();
  double extent = 0;
  for (int d = 0; d < dim; ++d) {
    double low = INFINITY, high = -INFINITY;
    for (int node = 0; node < space.nodes(); ++node) {
      low = std::min(low, space.position(node)[d]);
      high = std::max(high, space.position(node)[d]);
    }
    extent = std::max(extent, high - low);
  }
  return extent > 0 ? extent / std::pow(space.nodes(), 1.0 / dim) : 1.0;
}

double scale_of(const Field& field, const Unknown& unknown) {
  const Field::ComponentRange place = field.place(unknown.name);
  const Block& block = field.blocks()[place.block];
  if (unknown.role == UnknownRole::motion) return cell_size(*block.space);
  if (unknown.scale > 0) return unknown.scale;
  double most = 0;
  for (std::size_t node = 0; node < static_cast<std::size_t>(block.space->nodes()); ++node)
    for (int c = 0; c < place.components; ++c)
      most = std::max(most, std::abs(block.now.value[node * block.size + place.offset + c]));
  // Where the scene leaves an unknown at zero (or at rounding), its size is anybody's guess.
  return most > 1e-12 ? most : 1.0;
}

void free_prescribed(Problem& problem, const TimePoint& at) {
  for (FieldEntry& entry : problem.fields()) {
    entry.levels.clear();  // with a cut they would come back
    for (Block& block : entry.field->blocks()) std::fill(block.prescribed.begin(), block.prescribed.end(), 0);
  }
  problem.update_spaces(at);  // what was prescribed may be tied
  problem.assembler().rebuild();
}

/// Moves every unknown by up to 3 % of its scale, so that no derivative is zero by symmetry.
void shake(Problem& problem, const TimePoint& at) {
  std::mt19937 generator(20232);
  std::uniform_real_distribution<double> part(-0.03, 0.03);
  const std::vector<double> scales = unknown_scales(problem);
  std::vector<double> move(problem.assembler().matrix().rows, 0.0);
  const auto unknowns = rows_of_unknowns(problem, problem.assembler());
  for (std::size_t u = 0; u < unknowns.size(); ++u)
    for (const int r : unknowns[u].rows) move[r] = scales[u] * part(generator);
  // Ties whose coefficients depend on the state are met after some more iterations of their own.
  const std::vector<double> nothing(move.size(), 0.0);
  for (int k = 0; k < 6; ++k) {
    problem.assembler().add_increment(k == 0 ? move : nothing, 1.0);
    problem.update_rates(at);
    if (problem.update_spaces(at) == SpaceChange::unknowns) break;
  }
}

/// The unknown whose equations differ most.
TangentError worst_block(const std::vector<UnknownRows>& unknowns, const std::vector<double>& difference,
                         const std::vector<double>& exact, const std::vector<double>& magnitude) {
  std::vector<double> error(exact.size());
  for (std::size_t i = 0; i < error.size(); ++i) error[i] = difference[i] - exact[i];
  TangentError worst;
  for (const UnknownRows& equations : unknowns) {
    const double size = norm_on(equations.rows, error);
    // Blocks without effect on their equations are measured against what the equations hold anyway.
    const double scale = std::max(norm_on(equations.rows, exact), 1e-6 * norm_on(equations.rows, magnitude));
    const double relative = size == 0 ? 0.0 : worse(0, size / scale);
    if (relative >= worst.relative) worst = {relative, "equations of " + equations.name};
  }
  return worst;
}

/// Whether what is assembled says nothing.
bool is_zero(const Assembler& assembler, const Communicator& communicator) {
  const auto some = [](double v) { return v != 0; };
  const Array<double>& derivatives = assembler.matrix().value;
  return !communicator.any(std::ranges::any_of(assembler.magnitude(), some) ||
                           std::any_of(derivatives.begin(), derivatives.begin() + derivatives.size, some));
}

ConformanceCheck tangent_check(const std::string& name, const TangentError& error) {
  const bool passed = error.relative <= tangent_tolerance;
  return conformance_check("tangent: " + name, passed,
                           fmt::format("{:.1e} relative, at most {:.0e}{}", error.relative, tangent_tolerance,
                                       passed ? "" : "; worst in the " + error.block));
}

}  // namespace

std::vector<double> unknown_scales(const Problem& problem) {
  std::vector<double> scales;
  for (const FieldEntry& entry : problem.fields())
    for (const Unknown& unknown : entry.field->unknowns()) scales.push_back(scale_of(*entry.field, unknown));
  return scales;
}

TangentError tangent_error(Problem& problem, Assembler& assembler, const TimePoint& at, bool spaces_follow) {
  constexpr int directions = 3;
  // A term alone knows of no relations.
  const bool alone = &assembler != &problem.assembler();
  if (alone) problem.update_rates(at, false);
  const StateStore::Snapshot here = problem.state().snapshot(at.time);
  assembler.assemble(at, true);
  const std::vector<double> magnitude = assembler.magnitude();
  const auto unknowns = rows_of_unknowns(problem, assembler);
  const std::vector<double> scales = unknown_scales(problem);
  std::mt19937 generator(20233);
  std::uniform_real_distribution<double> part(-1, 1);
  // The problem's own assembler is rebuilt with the spaces.
  const auto follow = [&] {
    if (spaces_follow && alone) assembler.rebuild();
    if (spaces_follow && alone) problem.update_rates(at, false);
  };
  TangentError worst;
  for (std::size_t u = 0; u < unknowns.size(); ++u)
    for (int k = 0; k < directions; ++k) {
      std::vector<double> direction(assembler.matrix().rows, 0.0), exact(direction.size());
      // What is tied follows.
      for (const int r : unknowns[u].rows)
        if (const double move = scales[u] * part(generator); !assembler.is_tied(r)) direction[r] = move;
      if (spaces_follow) {
        problem.state().restore(here);
        problem.update_spaces(at);
        follow();
        assembler.assemble(at, true);
      }
      multiply(assembler.matrix(), direction, exact);
      const auto residual_at = [&](double step) {
        problem.state().restore(here);
        if (spaces_follow) problem.update_spaces(at);  // and with them the numbering of the direction
        assembler.add_increment(direction, step);
        problem.update_rates(at, !alone);
        if (spaces_follow && problem.update_spaces(at) == SpaceChange::unknowns)
          return std::vector<double>(direction.size(), std::nan(""));
        follow();
        assembler.assemble(at, false);
        return assembler.residual();
      };
      TangentError best{std::numeric_limits<double>::infinity(), ""};
      for (const double step : difference_steps) {
        const std::vector<double> difference = central_difference(residual_at, step);
        TangentError error = worst_block(unknowns, difference, exact, magnitude);
        if (error.relative < best.relative || best.block.empty()) best = std::move(error);
        if (best.relative <= 0.01 * tangent_tolerance) break;
      }
      if (best.relative > worst.relative) worst = {best.relative, best.block + " by " + unknowns[u].name};
    }
  problem.state().restore(here);
  if (spaces_follow) problem.update_spaces(at);
  return worst;
}

std::vector<ConformanceCheck> check_tangents(Problem& problem, const TimePoint& when) {
  TimePoint at = when;
  // As momentum it is differentiated to leading order in the angles of a step.
  at.inertia_as_momentum = false;
  free_prescribed(problem, at);
  shake(problem, at);
  std::vector<ConformanceCheck> checks{
      tangent_check("whole system", tangent_error(problem, problem.assembler(), at, true))};
  std::vector<Field*> fields;
  for (FieldEntry& entry : problem.fields()) fields.push_back(entry.field.get());
  for (const Problem::DomainTerms& integrated : problem.domains())
    for (const BoundTerm& term : integrated.second) {
      const std::shared_ptr<IntegrationDomain>& domain = integrated.first;
      const std::string name = fmt::format("{} on {}", term_name(*term.term), domain->description());
      if (problem.communicator().sum(static_cast<double>(domain->size())) == 0) {
        checks.push_back({"tangent: " + name, ConformanceCheck::Outcome::skipped,
                          "nowhere in the state that the scene has half-way"});
        continue;
      }
      const auto check = [&](const std::string& how, ElementEvaluator::Role role, bool moves) {
        Assembler alone(fields, problem.communicator());
        alone.add(domain, {term}, role);
        alone.rebuild();
        alone.assemble(at, true);
        if (is_zero(alone, problem.communicator()))
          checks.push_back(
              {"tangent: " + name + how, ConformanceCheck::Outcome::skipped,
               "not exercised: in the state that the scene has half-way, shaken, it gives nothing"});
        else
          checks.push_back(tangent_check(name + how, tangent_error(problem, alone, at, moves)));
      };
      check("", ElementEvaluator::Role::integrate_at_rest, false);
      if (domain->movers().empty() ||
          !term.term->signature(fields.front()->mesh().dimension()).follows_motion)
        continue;
      check(" as it moves", ElementEvaluator::Role::integrate, true);
    }
  return checks;
}

}  // namespace seam
