// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/preconditioner.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "seam/base/diagnostics.hpp"
#include "seam/preconditioner/library.hpp"

namespace seam {
namespace {

/// Looked for beside the library that this code is in, and nowhere else.
const PreconditionerLibrary* load_library() {
  Dl_info self{};
  dladdr(reinterpret_cast<const void*>(&make_multigrid), &self);
  const std::filesystem::path file =
      std::filesystem::path(self.dli_fname ? self.dli_fname : "").parent_path() /
      "libseam_preconditioners.so";
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* entry = library ? dlsym(library, "seam_preconditioner_library") : nullptr;
  if (!entry)
    throw Error(
        fmt::format("the library of preconditioners cannot be loaded: {}\nIterative solvers need it; it "
                    "is installed with Seam. Install Seam anew, or use `linear: direct`",
                    dlerror()));
  return reinterpret_cast<decltype(&seam_preconditioner_library)>(entry)();
}

const PreconditionerLibrary& library() {
  static const PreconditionerLibrary* const loaded = load_library();
  return *loaded;
}

/// [direction][node]
std::vector<std::vector<double>> by_direction(const EquationUnknown& unknown, int dimension) {
  const std::size_t nodes = unknown.rows.size() / static_cast<std::size_t>(unknown.components);
  std::vector<std::vector<double>> result(dimension, std::vector<double>(nodes));
  for (int d = 0; d < dimension; ++d)
    for (std::size_t n = 0; n < nodes; ++n) result[d][n] = unknown.coordinates[n * dimension + d];
  return result;
}

}  // namespace

Teuchos::RCP<TpetraOperator> make_multigrid(const Teuchos::RCP<TpetraMatrix>& matrix,
                                            const EquationUnknown& unknown, int dimension) {
  return library().multigrid(
      matrix, {unknown.components, near_nullspace(unknown, dimension), by_direction(unknown, dimension)});
}

Teuchos::RCP<TpetraOperator> make_incomplete_lu(const Teuchos::RCP<TpetraMatrix>& own,
                                                const Teuchos::RCP<const TpetraMap>& rows, int fill) {
  return library().incomplete_lu(own, rows, fill);
}

}  // namespace seam
