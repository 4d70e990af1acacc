// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "seam/mesh/mesh_data.hpp"

/// A mesh from the YAML text of one entry of a scene's `meshes`. Validation errors are thrown as they are
/// shown.
seam::MeshData mesh_from_yaml(const std::string& yaml, int dimension);

/// Area or volume by quadrature over the isoparametric cells.
double volume(const seam::MeshData& mesh);

/// Length or area of a boundary, and the integral of its outward normal.
struct Surface {
  double area = 0;
  double normal[3] = {0, 0, 0};
};
Surface surface(const seam::MeshData& mesh, const std::string& boundary);

/// The message of the Error that `action` throws; "" when it throws none.
std::string error_of(const std::function<void()>& action);

/// A folder of its own for one test, removed at its end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::string path(const std::string& file) const { return (folder_ / file).string(); }
  /// Writes a file and gives its path.
  [[nodiscard]] std::string write(const std::string& file, const std::string& text) const;

 private:
  std::filesystem::path folder_;
};

std::string contents(const std::string& path);
