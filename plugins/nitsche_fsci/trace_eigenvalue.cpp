// SPDX-License-Identifier: BSD-3-Clause
#include "trace_eigenvalue.hpp"

#include <Eigen/Dense>

#include "seam/base/diagnostics.hpp"
#include "solid_sided.hpp"

namespace seam::fsci {
namespace {

/// Rows (or columns) of the gradient [component][direction] that each nodal displacement makes, at a point.
template <int dim>
Eigen::MatrixXd gradient_operator(const CellTrace& cell, const CellPoints& points, int q) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(dim * dim, dim * cell.nodes);
  for (int a = 0; a < cell.nodes; ++a)
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result(i * dim + j, a * dim + i) =
            points.shape_gradient[(static_cast<std::size_t>(q) * cell.nodes + a) * dim + j];
  return result;
}

/// The derivative of P + p J F^-T at constant p = -tr(sigma)/dim, [component][direction] twice: the stiffness
/// of a body on all sides of which its own mean pressure acts. That of P alone is not positive for moderate
/// pressure already, when a piece cut free would turn or buckle under the dead forces of its surroundings.
template <int dim>
Eigen::Matrix<double, dim * dim, dim * dim, Eigen::RowMajor> pressed_tangent(const Law& law,
                                                                             const double* gradient) {
  using Square = Eigen::Matrix<double, dim, dim, Eigen::RowMajor>;
  Square stress;
  Eigen::Matrix<double, dim * dim, dim * dim, Eigen::RowMajor> result;
  law.evaluate(dim, gradient, stress.data(), result.data(), nullptr);
  const Square f = Eigen::Map<const Square>(gradient) + Square::Identity();
  const Square inverse = f.inverse();
  const double scale = stress.cwiseProduct(f).sum() / dim;  // J tr(sigma)/dim
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
          result(i * dim + j, k * dim + l) -=
              scale * (inverse(j, i) * inverse(l, k) - inverse(l, i) * inverse(j, k));
  return result;
}

template <int dim>
Eigen::MatrixXd stiffness(const Law& law, const CellTrace& cell) {
  constexpr int n = dim * dim;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(dim * cell.nodes, dim * cell.nodes);
  for (int q = 0; q < cell.volume.count(); ++q) {
    const auto tangent = pressed_tangent<dim>(law, &cell.volume.gradient[static_cast<std::size_t>(q) * n]);
    const Eigen::MatrixXd g = gradient_operator<dim>(cell, cell.volume, q);
    result += cell.volume.weight[q] * g.transpose() * tangent * g;
  }
  return result;
}

template <int dim>
Eigen::MatrixXd tractions(const Law& law, const CellTrace& cell) {
  constexpr int n = dim * dim;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(dim * cell.nodes, dim * cell.nodes);
  for (int q = 0; q < cell.faces.count(); ++q) {
    Mat<dim, dim, Fad<n>> gradient;
    Vec<dim, double> normal;
    for (int k = 0; k < n; ++k)
      gradient.c[k] = Fad<n>(cell.faces.gradient[static_cast<std::size_t>(q) * n + k], k);
    for (int i = 0; i < dim; ++i) normal[i] = cell.faces.normal[static_cast<std::size_t>(q) * dim + i];
    const Vec<dim, Fad<n>> traction = body_traction<dim, Fad<n>>(law, gradient, normal);
    Eigen::Matrix<double, dim, n> derivative;
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < n; ++k) derivative(i, k) = traction[i].d[k];
    const Eigen::MatrixXd d = derivative * gradient_operator<dim>(cell, cell.faces, q);
    result += cell.faces.weight[q] * d.transpose() * d;
  }
  return result;
}

/// Translations and small rotations of the nodes, orthonormal columns.
template <int dim>
Eigen::MatrixXd rigid_motions(const CellTrace& cell) {
  constexpr int rotations = dim == 2 ? 1 : 3;
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(dim * cell.nodes, dim + rotations);
  Eigen::Matrix<double, dim, 1> centre = Eigen::Matrix<double, dim, 1>::Zero();
  const auto node = [&](int a) {
    return Eigen::Map<const Eigen::Matrix<double, dim, 1>>(&cell.position[static_cast<std::size_t>(a) * dim]);
  };
  for (int a = 0; a < cell.nodes; ++a) centre += node(a) / cell.nodes;
  for (int a = 0; a < cell.nodes; ++a) {
    const Eigen::Matrix<double, dim, 1> arm = node(a) - centre;
    for (int i = 0; i < dim; ++i) modes(a * dim + i, i) = 1;
    for (int k = 0; k < rotations; ++k) {
      const int i = dim == 2 ? 0 : k, j = dim == 2 ? 1 : (k + 1) % 3;
      modes(a * dim + i, dim + k) = -arm[j];
      modes(a * dim + j, dim + k) = arm[i];
    }
  }
  return Eigen::HouseholderQR<Eigen::MatrixXd>(modes).householderQ() *
         Eigen::MatrixXd::Identity(modes.rows(), modes.cols());
}

template <int dim>
double largest_eigenvalue(const Law& law, const CellTrace& cell) {
  const Eigen::MatrixXd a = tractions<dim>(law, cell);
  Eigen::MatrixXd b = stiffness<dim>(law, cell);
  const Eigen::MatrixXd rigid = rigid_motions<dim>(cell);
  b += (b.trace() / static_cast<double>(b.rows())) * rigid * rigid.transpose();
  if (Eigen::LLT<Eigen::MatrixXd>(b).info() != Eigen::Success)
    throw StepRefused("the stiffness of a cell on the interface is not positive: it buckles");
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, b, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

}  // namespace

double TraceEigenvalue::compute(const CellTrace& cell) const {
  return cell.dimension == 2 ? largest_eigenvalue<2>(*law_, cell) : largest_eigenvalue<3>(*law_, cell);
}

void declare_scaling(Schema& schema, const std::string& otherwise) {
  schema
      .choice(
          "scaling",
          "Where a body's stress counts: which deformation of its cells scales the penalty, thesis (3.31): "
          "that in each iteration, at the start of each step, or none",
          {"iteration", "step", "once"})
      .otherwise(otherwise);
}

CellConstant::Refresh scaling_of(const Parameters& parameters) {
  const std::string& scaling = parameters.text("scaling");
  if (scaling == "once") return CellConstant::Refresh::once;
  return scaling == "step" ? CellConstant::Refresh::step : CellConstant::Refresh::iteration;
}

}  // namespace seam::fsci
