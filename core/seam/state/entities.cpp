// SPDX-License-Identifier: BSD-3-Clause
#include "seam/state/entities.hpp"

#include <stdexcept>

#include "seam/mesh/mesh.hpp"
#include "seam/space/space.hpp"

namespace seam {
namespace {

class Nodes final : public Entities {
 public:
  explicit Nodes(const Space& space) : space_(&space) {}
  [[nodiscard]] std::string name() const override { return "node"; }
  [[nodiscard]] const Communicator& communicator() const override { return space_->mesh().communicator(); }
  [[nodiscard]] int owned() const override { return space_->owned_nodes(); }
  [[nodiscard]] int count() const override { return space_->nodes(); }
  [[nodiscard]] int global(int local) const override { return space_->global_node(local); }
  [[nodiscard]] int global_bound() const override { return space_->global_bound(); }
  [[nodiscard]] bool are_nodes_of(const Space& space) const override { return &space == space_; }

 private:
  const Space* space_;
};

/// Cells, or the points in them one cell after the other.
class CellPoints final : public Entities {
 public:
  CellPoints(const Mesh& mesh, int points, std::string name)
      : mesh_(&mesh), points_(points), name_(std::move(name)) {}
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] const Communicator& communicator() const override { return mesh_->communicator(); }
  [[nodiscard]] int owned() const override { return mesh_->owned_cells() * points_; }
  [[nodiscard]] int count() const override { return mesh_->cells() * points_; }
  [[nodiscard]] int global(int local) const override {
    return mesh_->global_cell(local / points_) * points_ + local % points_;
  }
  [[nodiscard]] int global_bound() const override {
    return static_cast<int>(mesh_->owner_of_global_cell().size()) * points_;
  }
  [[nodiscard]] std::pair<int, int> in_cell(const Mesh& mesh, int cell) const override {
    if (&mesh != mesh_) return {0, 0};
    return {cell * points_, (cell + 1) * points_};
  }

 private:
  const Mesh* mesh_;
  int points_;
  std::string name_;
};

class InteriorFaces final : public Entities {
 public:
  explicit InteriorFaces(const Mesh& mesh) : mesh_(&mesh) {}
  [[nodiscard]] std::string name() const override { return "interior face"; }
  [[nodiscard]] const Communicator& communicator() const override { return mesh_->communicator(); }
  [[nodiscard]] int owned() const override { return count(); }
  [[nodiscard]] int count() const override { return static_cast<int>(mesh_->interior_faces().size()); }
  [[nodiscard]] int global(int) const override { throw no_numbers(); }
  [[nodiscard]] int global_bound() const override { throw no_numbers(); }

 private:
  static std::logic_error no_numbers() {
    return std::logic_error("interior faces have no global numbers: what they keep lasts for a step");
  }
  const Mesh* mesh_;
};

class Run final : public Entities {
 public:
  explicit Run(const Communicator& communicator) : communicator_(communicator) {}
  [[nodiscard]] std::string name() const override { return "run"; }
  [[nodiscard]] const Communicator& communicator() const override { return communicator_; }
  [[nodiscard]] int owned() const override { return communicator_.rank() == 0 ? 1 : 0; }
  [[nodiscard]] int count() const override { return 1; }
  [[nodiscard]] int global(int local) const override { return local; }
  [[nodiscard]] int global_bound() const override { return 1; }

 private:
  Communicator communicator_;
};

}  // namespace

std::shared_ptr<const Entities> nodes_of(const Space& space) { return std::make_shared<Nodes>(space); }
std::shared_ptr<const Entities> cells_of(const Mesh& mesh) {
  return std::make_shared<CellPoints>(mesh, 1, "cell");
}
std::shared_ptr<const Entities> points_of_cells(const Mesh& mesh, int points) {
  return std::make_shared<CellPoints>(mesh, points, "point of a cell");
}
std::shared_ptr<const Entities> interior_faces_of(const Mesh& mesh) {
  return std::make_shared<InteriorFaces>(mesh);
}
std::shared_ptr<const Entities> the_run(const Communicator& communicator) {
  return std::make_shared<Run>(communicator);
}

}  // namespace seam
