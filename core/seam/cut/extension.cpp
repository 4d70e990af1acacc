// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/extension.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "seam/assembly/domains.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/state/state_store.hpp"
#include "seam/term/kernel_term.hpp"

namespace seam {
namespace {

/// In diameters of a cell: states reach along thinner films however many cells come alive there.
constexpr double thin_film = 0.1;
/// Smaller pivots are zeros.
constexpr double rounding = 1e-14;

/// Jumps of the normal derivatives of a scalar between the two cells of a face.
struct DerivativeJumps {
  using first = Scalar<0>;
  using second = Scalar<1>;
  using Reads = Slots<NormalDerivative<first>, NormalDerivative<second>, SecondNormalDerivative<first>,
                      SecondNormalDerivative<second>>;
  using Tests = Reads;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T slope = s.normal_derivative(first{}) - s.normal_derivative(second{});
    const T curvature = x.cell_size * x.cell_size *
                        (s.second_normal_derivative(first{}) - s.second_normal_derivative(second{}));
    r.normal_derivative(first{}) += slope;
    r.normal_derivative(second{}) -= slope;
    r.second_normal_derivative(first{}) += curvature;
    r.second_normal_derivative(second{}) -= curvature;
  }
};

/// Nodal numbers to be extended: what the time scheme reads of a step's start and its prediction, and what
/// others keep at the nodes.
struct Numbers {
  std::vector<double>* values;
  int size;   ///< of a node
  int first;  ///< column of the right-hand sides
};

std::vector<Numbers> numbers_on(const Field& field, const Space& space) {
  std::vector<Numbers> all;
  int first = 0;
  for (StateArray<double>* state : field.state().extended_on(space))
    for (std::vector<double>& level : state->all_levels()) {
      all.push_back({&level, state->size(), first});
      first += state->size();
    }
  return all;
}

struct MatrixEntry {
  int row, column;  ///< global nodes
  double value;
};
struct KnownPart {
  int row;
  int column;  ///< of the right-hand sides
  double value;
};

}  // namespace

/// The equations of new nodes, and what known ones contribute to them.
struct Extension::System {
  std::vector<Numbers> numbers;
  std::vector<MatrixEntry> matrix;
  std::vector<KnownPart> right_side;
  std::map<int, int> index;  ///< global node -> row

  /// Of the matrix' entries on all ranks; 1 where there are none.
  [[nodiscard]] double largest(const Communicator& communicator) const {
    double value = 0;
    for (const MatrixEntry& entry : matrix) value = std::max(value, std::abs(entry.value));
    value = communicator.max(value);
    return value > 0 ? value : 1;
  }

  /// Everything that all ranks contribute, on every rank.
  void gather(const Communicator& communicator) {
    matrix = communicator.gather_all(matrix);
    right_side = communicator.gather_all(right_side);
    for (const MatrixEntry& entry : matrix) index.emplace(entry.row, 0);
    int count = 0;
    for (auto& [node, row] : index) row = count++;
  }

  /// [row][column of the right-hand sides]; empty when the known nodes do not determine the new ones.
  [[nodiscard]] Eigen::MatrixXd solve() const {
    const int columns = numbers.back().first + numbers.back().size;
    const int rows = static_cast<int>(index.size());
    if (rows == 0) return {};  // no face joins them to any
    std::vector<Eigen::Triplet<double>> triplets;
    for (const MatrixEntry& entry : matrix)
      triplets.emplace_back(index.at(entry.row), index.at(entry.column), entry.value);
    Eigen::SparseMatrix<double> equations(rows, rows);
    equations.setFromTriplets(triplets.begin(), triplets.end());
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(rows, columns);
    for (const KnownPart& entry : right_side) right(index.at(entry.row), entry.column) += entry.value;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(equations);
    if (factor.info() != Eigen::Success ||
        factor.vectorD().minCoeff() <= rounding * factor.vectorD().maxCoeff())
      return {};
    return factor.solve(right);
  }
};

Extension::Extension(Field& field) : field_(&field) {}
Extension::~Extension() = default;

void Extension::extend() {
  for (int b = 0; b < static_cast<int>(field_->blocks().size()); ++b)
    if (!field_->blocks()[b].given) extend_block(b);
}

bool Extension::is_film(int cell) const {
  const CutMesh* cut = field_->cut();
  if (cut == nullptr || cut->state(cell) != CellState::cut) return false;
  const double thickness = 2 * cut->wet_volume(cell) / cut->interface_area(cell);
  return thickness < thin_film * field_->mesh().diameter(cell);
}

std::vector<std::pair<int, int>> Extension::films(int number) const {
  const Block& block = field_->blocks()[number];
  const Mesh& mesh = field_->mesh();
  int lost = -1;
  std::vector<std::pair<int, int>> films;
  for (int c = 0; c < mesh.owned_cells(); ++c) {
    if (!field_->active_cells()[c]) continue;
    for (int p = 0; p < field_->parts(c); ++p) {
      if (block.knows_any(field_->cell_nodes(number, c, p))) continue;
      if (is_film(c))
        films.emplace_back(c, p);
      else
        lost = mesh.global_cell(c);
    }
  }
  lost = mesh.communicator().max(lost);
  if (lost >= 0)
    throw StepRefused(fmt::format(
        "field '{}': a body uncovers cell {} in one step, which no known state reaches: it moves too far for "
        "the step, or fluid begins where none was near, as between a boundary and a body that leaves "
        "it: let it begin with a gap there",
        field_->name(), lost));
  return films;
}

Field& Extension::carrier(int order) {
  auto& carrier = carriers_[order - 1];
  if (!carrier)
    carrier = std::make_unique<Field>("extension", field_->mesh(),
                                      std::vector<Unknown>{{"w", 1, order, 0, ""}}, field_->sets());
  return *carrier;
}

void Extension::assemble(const Block& block, Field& carrier, System& system) {
  const InteriorFaceDomain faces(carrier, 2 * block.space->order());
  ElementEvaluator evaluator(faces, {{make_term(DerivativeJumps{}), {Operand{0, "w"}, Operand{1, "w"}}}});
  const Space& space = *block.space;
  const int per_cell = space.nodes_per_cell();
  const auto is_new = [&](int node) { return !block.known[node]; };
  for (int f = 0; f < faces.size(); ++f) {
    const int* nodes[2] = {faces.nodes(f, 0, 0), faces.nodes(f, 1, 0)};
    if (std::none_of(nodes[0], nodes[0] + per_cell, is_new) &&
        std::none_of(nodes[1], nodes[1] + per_cell, is_new))
      continue;
    evaluator.compute(f, TimePoint{}, true);
    for (const auto& row : evaluator.side_blocks())
      for (const auto& column : evaluator.side_blocks())
        for (int a = 0; a < per_cell; ++a)
          for (int b = 0; b < per_cell && is_new(nodes[row.side][a]); ++b)
            add(block, nodes[row.side][a], nodes[column.side][b],
                evaluator.matrix()[static_cast<std::size_t>(row.offset + a) * evaluator.size() +
                                   column.offset + b],
                system);
  }
}

void Extension::add(const Block& block, int row, int column, double value, System& system) {
  const Space& space = *block.space;
  if (!block.known[column]) {
    system.matrix.push_back({space.global_node(row), space.global_node(column), value});
    return;
  }
  for (const Numbers& n : system.numbers)
    for (int c = 0; c < n.size; ++c)
      system.right_side.push_back({space.global_node(row), n.first + c,
                                   -value * (*n.values)[static_cast<std::size_t>(column) * n.size + c]});
}

std::vector<std::pair<int, int>> Extension::active_parts() const {
  std::vector<std::pair<int, int>> all;
  for (int c = 0; c < field_->mesh().owned_cells(); ++c)
    for (int p = 0; p < field_->parts(c) && field_->active_cells()[c] != 0; ++p) all.emplace_back(c, p);
  return all;
}

void Extension::add_means(int number, const std::vector<std::pair<int, int>>& parts, double weight,
                          System& system) {
  const Block& block = field_->blocks()[number];
  const int per_cell = block.space->nodes_per_cell();
  for (const auto& [cell, part] : parts) {
    const int* nodes = field_->cell_nodes(number, cell, part);
    for (int a = 0; a < per_cell; ++a)
      for (int b = 0; b < per_cell && !block.known[nodes[a]]; ++b) {
        if (a == b) continue;
        add(block, nodes[a], nodes[a], weight, system);
        add(block, nodes[a], nodes[b], -weight, system);
      }
  }
}

void Extension::add_rest(int number, const std::vector<std::pair<int, int>>& parts, double weight,
                         System& system) {
  const Block& block = field_->blocks()[number];
  for (const auto& [cell, part] : parts) {
    const int* nodes = field_->cell_nodes(number, cell, part);
    for (int a = 0; a < block.space->nodes_per_cell(); ++a)
      if (!block.known[nodes[a]]) add(block, nodes[a], nodes[a], weight, system);
  }
}

void Extension::extend_block(int number) {
  Block& block = field_->blocks()[number];
  const Space& space = *block.space;
  const Communicator& communicator = field_->mesh().communicator();
  bool any_new = false;
  for (int n = 0; n < space.owned_nodes(); ++n) any_new = any_new || (block.active[n] && !block.known[n]);
  if (communicator.any(any_new)) {
    const std::vector<std::pair<int, int>> unreached = films(number);
    Field& scalar = carrier(space.order());
    scalar.set_layout(field_->layout());
    scalar.occupy(field_->active_cells(), field_->cut());
    for (const Help help : {Help::none, Help::means, Help::rest}) {
      // Few nodes come alive in a step: every rank solves for all of them, and all get the same bits.
      System system;
      system.numbers = numbers_on(*field_, space);
      assemble(block, scalar, system);
      const double weight = system.largest(communicator);
      add_means(number, unreached, weight, system);
      // Where a pocket opens that hangs on to the rest by a node or two, jumps do not say what its other
      // nodes are: there they become like those of their cells. Small, so that it decides only what the jumps
      // leave open.
      if (help != Help::none) add_means(number, active_parts(), 1e-3 * weight, system);
      // A film that opens where nothing of the field was is at rest.
      if (help == Help::rest) add_rest(number, unreached, 1e-6 * weight, system);
      system.gather(communicator);
      if (set_states(block, system)) break;
      if (help == Help::rest)
        throw StepRefused(
            fmt::format("field '{}': known states do not determine those of {} nodes that came alive",
                        field_->name(), system.index.size()));
    }
  }
  block.known = block.active;
}

bool Extension::set_states(const Block& block, const System& system) {
  const Space& space = *block.space;
  const Eigen::MatrixXd values = system.solve();
  bool complete = values.rows() > 0;
  for (int n = 0; n < space.owned_nodes() && complete; ++n) {
    if (!block.active[n] || block.known[n]) continue;
    const auto found = system.index.find(space.global_node(n));
    complete = found != system.index.end();
    if (!complete) break;
    for (const Numbers& of : system.numbers)
      for (int c = 0; c < of.size; ++c)
        (*of.values)[static_cast<std::size_t>(n) * of.size + c] = values(found->second, of.first + c);
  }
  if (space.mesh().communicator().any(!complete)) return false;
  for (const Numbers& of : system.numbers) space.halo().update(*of.values, of.size);
  return true;
}

}  // namespace seam
