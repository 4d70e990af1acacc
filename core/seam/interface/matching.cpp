// SPDX-License-Identifier: BSD-3-Clause
#include "seam/interface/matching.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "seam/assembly/domains.hpp"
#include "seam/assembly/remote_cells.hpp"
#include "seam/assembly/together.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {
namespace {

/// A point on a grid of cubes of the matching tolerance.
using Cube = std::array<long long, 3>;

struct FaceCentre {
  double x[3] = {0, 0, 0};
  double size = 0;  ///< of the face
};

FaceCentre centre_of(const MeshData& whole, const CellFace& face) {
  const auto& vertices = topology(whole.type).faces[face.face];
  FaceCentre centre;
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (const int v : vertices) {
    const int node = whole.cells[static_cast<std::size_t>(face.cell) * whole.nodes_per_cell() + v];
    for (int d = 0; d < whole.dimension; ++d) {
      const double x = whole.coordinates[static_cast<std::size_t>(node) * whole.dimension + d];
      centre.x[d] += x / static_cast<double>(vertices.size());
      low[d] = std::min(low[d], x);
      high[d] = std::max(high[d], x);
      centre.size = std::max(centre.size, high[d] - low[d]);
    }
  }
  return centre;
}

/// Finds the face of the other side with the same centre.
class FaceFinder {
 public:
  FaceFinder(const MeshData& whole, const std::vector<CellFace>& faces) : faces_(faces) {
    double smallest = 1e300;
    for (const CellFace& face : faces) {
      centres_.push_back(centre_of(whole, face));
      smallest = std::min(smallest, centres_.back().size);
    }
    tolerance_ = 1e-6 * smallest;
    for (std::size_t k = 0; k < faces.size(); ++k)
      by_cube_[cube(centres_[k], {0, 0, 0})].push_back(static_cast<int>(k));
  }
  [[nodiscard]] const CellFace* find(const FaceCentre& wanted) const {
    for (int n = 0; n < 27; ++n) {
      const auto found = by_cube_.find(cube(wanted, {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1}));
      if (found == by_cube_.end()) continue;
      for (const int k : found->second)
        if (std::hypot(centres_[k].x[0] - wanted.x[0], centres_[k].x[1] - wanted.x[1],
                       centres_[k].x[2] - wanted.x[2]) <= tolerance_)
          return &faces_[k];
    }
    return nullptr;
  }

 private:
  [[nodiscard]] Cube cube(const FaceCentre& c, const Cube& shift) const {
    Cube result{};
    for (int d = 0; d < 3; ++d) result[d] = std::llround(c.x[d] / tolerance_) + shift[d];
    return result;
  }
  const std::vector<CellFace>& faces_;
  std::vector<FaceCentre> centres_;
  std::map<Cube, std::vector<int>> by_cube_;
  double tolerance_ = 1;
};

class MatchingDomain final : public IntegrationDomain {
 public:
  MatchingDomain(std::vector<Field*> sides, std::vector<CellFace> faces, std::vector<RemoteCell> partners,
                 int degree)
      : sides_(std::move(sides)),
        faces_(std::move(faces)),
        partners_(std::move(partners)),
        tables_(*sides_[0], degree, true) {}
  [[nodiscard]] int size() const override { return static_cast<int>(faces_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return sides_; }
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override {
    return side == 0 ? sides_[0]->blocks()[block].space->cell_nodes(faces_[index].cell)
                     : partners_[index].nodes[block].data();
  }
  [[nodiscard]] std::string description() const override {
    return fmt::format("the interface between '{}' and '{}'", sides_[0]->name(), sides_[1]->name());
  }

 private:
  std::vector<Field*> sides_;
  std::vector<CellFace> faces_;
  std::vector<RemoteCell> partners_;
  FaceTables tables_;
  mutable ShapeTable partner_table_[2];
};

void MatchingDomain::fill(int index, Element& element) const {
  const Mesh& mesh = sides_[0]->mesh();
  const int dim = mesh.dimension();
  element.dimension = dim;
  element.points = tables_.rule().count();
  element.sides.resize(2);
  ElementSide &first = element.sides[0], &second = element.sides[1];
  attach_cell(first, *sides_[0], faces_[index].cell);
  first.face = faces_[index].face;
  tables_.attach(first);
  first.map_geometry();
  element.measure_face(topology(mesh.type()), first.face, tables_.rule().weights);
  element.set_sizes(first.diameter, mesh.volume(faces_[index].cell) / element.measure());

  const RemoteCell& partner = partners_[index];
  partner.attach(second, *sides_[1]);
  const CellType type = sides_[1]->mesh().type();
  const bool simplex = is_simplex(type);
  std::vector<double> reference(static_cast<std::size_t>(element.points) * dim,
                                simplex ? 1.0 / (dim + 1) : 0.5);
  for (int q = 0; q < element.points; ++q)
    invert_map(second, &first.position[static_cast<std::size_t>(q) * dim],
               &reference[static_cast<std::size_t>(q) * dim]);
  for (int order = 1; order <= 2; ++order) {
    tabulate(type, order, reference.data(), element.points, true, partner_table_[order - 1]);
    second.table[order - 1] = &partner_table_[order - 1];
  }
  second.map_geometry();
}

}  // namespace

MatchingInterface::MatchingInterface(const Parameters& p)
    : fields_(p.names("fields")), boundaries_(p.names("boundaries")), where_(p.where()) {
  if (fields_.size() != 2) throw Error(p.where("fields"), "a matching interface lies between two fields");
  if (boundaries_.size() != 2)
    throw Error(p.where("boundaries"), "a matching interface needs a boundary of each field");
}

Schema MatchingInterface::schema() {
  Schema s("Two boundaries whose faces coincide one by one in the reference configuration.");
  s.names("fields", "The two fields").naming("field");
  s.names("boundaries", "A boundary of the first field's mesh and one of the second's");
  return s;
}

std::vector<InterfacePart> MatchingInterface::build(InterfaceSetup& setup) const {
  const std::vector<Field*>& sides = setup.sides;
  const MeshData& first = sides[0]->mesh().whole();
  const MeshData& second = sides[1]->mesh().whole();
  const auto partners_of = second.boundaries.find(boundaries_[1]);
  if (partners_of == second.boundaries.end())
    throw Error(where_,
                fmt::format("mesh '{}' has no boundary '{}'", sides[1]->mesh().name(), boundaries_[1]));
  const FaceFinder finder(second, partners_of->second);
  std::vector<CellFace> faces;
  std::vector<int> partner_cells;
  // A face without a partner may be another rank's, and the partners' cells are fetched together.
  together(sides[0]->mesh().communicator(), [&] {
    for (const CellFace& face : sides[0]->mesh().boundary(boundaries_[0])) {
      if (face.cell >= sides[0]->mesh().owned_cells()) continue;
      const FaceCentre centre = centre_of(first, {sides[0]->mesh().global_cell(face.cell), face.face});
      const CellFace* partner = finder.find(centre);
      if (!partner)
        throw Error(
            where_,
            fmt::format("the face of '{}' on boundary '{}' with centre ({}) has no matching face on boundary "
                        "'{}' of '{}'",
                        fields_[0], boundaries_[0], fmt::join(centre.x, centre.x + first.dimension, ", "),
                        boundaries_[1], fields_[1]));
      faces.push_back(face);
      partner_cells.push_back(partner->cell);
    }
  });
  return {{"", std::make_shared<MatchingDomain>(sides, faces, fetch_cells(*sides[1], partner_cells),
                                                setup.degree + setup.extra_degree)}};
}

void register_matching(Registry& registry) {
  registry.add<Interface>(
      "interface", "matching", MatchingInterface::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<MatchingInterface>(p); });
}

}  // namespace seam
