// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_test.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "seam/mesh/input/mesh_input.hpp"
#include "seam/mesh/lagrange.hpp"
#include "seam/mesh/quadrature.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/scene/validate.hpp"

using namespace seam;

MeshData mesh_from_yaml(const std::string& yaml, int dimension) {
  const Registry registry;
  Diagnostics diagnostics;
  ValidationContext context{.registry = registry,
                            .diagnostics = diagnostics,
                            .dimension = dimension,
                            .parameters = {},
                            .folder = ".",
                            .files_must_exist = true,
                            .provider = {},
                            .used_plugins = {}};
  const Parameters p = validate(parse_yaml(yaml, "scene.yaml"), mesh_schema(), context, "meshes.m");
  diagnostics.throw_if_errors();
  return load_mesh(p);
}

namespace {

/// Columns of the Jacobian at one point: derivative of position by each reference coordinate.
struct Columns {
  double x[3][3] = {};
};

Columns jacobian(const MeshData& mesh, int cell, const ShapeTable& shapes, int point) {
  Columns j;
  const int n = shapes.nodes, dim = mesh.dimension;
  for (int k = 0; k < dim; ++k)
    for (int a = 0; a < n; ++a)
      for (int i = 0; i < dim; ++i)
        j.x[k][i] += shapes.gradient_at(point)[k * shapes.stride + a] *
                     mesh.coordinates[static_cast<std::size_t>(mesh.cells[cell * n + a]) * dim + i];
  return j;
}

void cross(const double* a, const double* b, double* c) {
  for (int i = 0; i < 3; ++i) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

}  // namespace

double volume(const MeshData& mesh) {
  const Quadrature& rule = quadrature(mesh.type, 6);
  ShapeTable shapes;
  tabulate(mesh.type, mesh.order, rule.points.data(), rule.count(), false, shapes);
  double sum = 0;
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int q = 0; q < rule.count(); ++q) {
      Columns j = jacobian(mesh, c, shapes, q);
      if (mesh.dimension == 2) j.x[2][2] = 1;
      double n[3];
      cross(j.x[0], j.x[1], n);
      sum += rule.weights[q] * (n[0] * j.x[2][0] + n[1] * j.x[2][1] + n[2] * j.x[2][2]);
    }
  return sum;
}

Surface surface(const MeshData& mesh, const std::string& boundary) {
  Surface s;
  const CellTopology& t = topology(mesh.type);
  const Quadrature& rule = quadrature(t.face_type, 6);
  const int dim = mesh.dimension, on = dim - 1;
  for (const CellFace& f : mesh.boundaries.at(boundary))
    for (int q = 0; q < rule.count(); ++q) {
      double in_cell[3], corner[3], tip[3], tangents[2][3] = {{0, 0, 0}, {0, 0, 1}};
      face_to_cell(t, f.face, &rule.points[q * on], in_cell);
      ShapeTable shapes;
      tabulate(mesh.type, mesh.order, in_cell, 1, false, shapes);
      const Columns j = jacobian(mesh, f.cell, shapes, 0);
      // Tangents in physical space: the cell's Jacobian times the (affine) map from face to cell.
      for (int k = 0; k < on; ++k) {
        double zero[2] = {0, 0}, unit[2] = {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0};
        face_to_cell(t, f.face, zero, corner);
        face_to_cell(t, f.face, unit, tip);
        for (int i = 0; i < dim; ++i) {
          tangents[k][i] = 0;
          for (int m = 0; m < dim; ++m) tangents[k][i] += j.x[m][i] * (tip[m] - corner[m]);
        }
      }
      double n[3];
      cross(tangents[0], tangents[1], n);
      s.area += rule.weights[q] * std::hypot(n[0], n[1], n[2]);
      for (int i = 0; i < 3; ++i) s.normal[i] += rule.weights[q] * n[i];
    }
  return s;
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "seam_mesh_XXXXXX").string();
  folder_ = mkdtemp(pattern.data());
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string TemporaryFolder::write(const std::string& file, const std::string& text) const {
  std::ofstream(path(file), std::ios::binary) << text;
  return path(file);
}

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
