// SPDX-License-Identifier: BSD-3-Clause
// Cuts meshes with many bodies, at random and aligned with lines of the mesh, and compares volumes with an
// independent clipping and with what must hold whatever the input is.
#include <fmt/format.h>
#include <gmpxx.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <map>
#include <memory>

#include "cut_stress/clipping.hpp"
#include "cut_stress/scenes.hpp"
#include "seam/cut/outline.hpp"

using namespace seam;
using cutting::operator*;  // NOLINT(misc-unused-using-decls): in a template
using cutting::operator+;
using cutting::operator-;

namespace {

// Largest deviations, of a cell's volume (or of a face's area, where that is compared).
constexpr double most_per_facet = 1e-11;
constexpr double rounding = 1e-12;

struct Options {
  long plane = 1000, space = 100;
  unsigned long seed = 1;
  int exact_in_space = 10;  ///< of so many configurations one is clipped, all are tested by identities
  int rational = 1000;      ///< of so many clipped ones one is clipped in rational arithmetic, too
  std::vector<long> only_plane, only_space;  ///< these alone where there are any, all of them clipped
};

/// A mesh of the unit square or cube, or of where an affine map puts it.
struct Testbed {
  Testbed(const std::string& what, CellType type, int cells, const Placement& placement, int order,
          bool moves)
      : name(what),
        n(cells),
        dim(topology(type).dimension),
        mesh(grid(type, {n, n, dim == 3 ? n : 1}, placement, order)),
        whole("whole", std::make_shared<MeshData>(mesh.whole()), Communicator(MPI_COMM_SELF)),
        outline(whole),
        cut(mesh),
        complement(mesh) {
    if (moves) body_placement = placement;
    for (int c = 0; c < whole.cells(); ++c) volume.push_back(outline.volume(c));
  }
  std::string name;
  int n, dim;
  Mesh mesh, whole;  ///< distributed, and on every rank all of it
  cutting::Outline outline;
  CutMesh cut, complement;
  Placement body_placement;
  std::vector<double> volume;  ///< [global cell]

  template <class T>
  [[nodiscard]] std::vector<clipping::Simplex<T>> simplices(int cell) const {
    std::vector<clipping::Simplex<T>> result;
    const auto centre = outline.centre(cell);
    for (int s = outline.first_side[cell]; s < outline.first_side[cell + 1]; ++s) {
      clipping::Simplex<T> simplex;
      simplex.corner[dim] = clipping::position<T>(centre.data(), dim);
      for (int k = 0; k < dim; ++k)
        simplex.corner[k] = clipping::position<T>(outline.position[outline.sides[s].vertex[k]].data(), dim);
      const auto& [a, b, c, d] = simplex.corner;
      const T turn =
          dim == 2 ? clipping::area(a, b, c) : T(-clipping::height(clipping::normal(a, b, c), a, d));
      if (turn == T(0)) continue;
      simplex.sign = turn > T(0) ? 1 : -1;
      result.push_back(simplex);
    }
    return result;
  }
  [[nodiscard]] std::pair<Point, Point> box_of(int cell) const {
    Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (int s = outline.first_side[cell]; s < outline.first_side[cell + 1]; ++s)
      for (int k = 0; k < dim; ++k)
        for (int i = 0; i < dim; ++i) {
          const double x = outline.position[outline.sides[s].vertex[k]][i];
          low[i] = std::min(low[i], x);
          high[i] = std::max(high[i], x);
        }
    return {low, high};
  }
  [[nodiscard]] double face_area(int cell, int face) const {
    double sum = 0;
    for (int s = outline.first_side[cell]; s < outline.first_side[cell + 1]; ++s) {
      if (outline.sides[s].face != face) continue;
      const auto& v = outline.sides[s].vertex;
      const auto a = outline.position[v[1]] - outline.position[v[0]];
      const auto b = dim == 3 ? outline.position[v[2]] - outline.position[v[0]] : cutting::Vector{0, 0, 2};
      const auto area = cutting::cross(a, b);
      sum += 0.5 * std::sqrt(cutting::dot(area, area));
    }
    return sum;
  }
};

/// Inner lines bend, the border stays flat.
Placement bent(int dim) {
  return [dim](const Point& x) {
    const double a = 0.05, pi = std::acos(-1.0);
    Point y = x;
    y[0] += a * std::sin(pi * x[0]) * std::sin(3 * x[1] + 2 * x[2] + 0.4);
    y[1] += a * std::sin(pi * x[1]) * std::cos(2 * x[0] - x[2]);
    if (dim == 3) y[2] += a * std::sin(pi * x[2]) * std::sin(2 * x[0] + 3 * x[1] + 1);
    return y;
  };
}

std::vector<std::unique_ptr<Testbed>> testbeds(int dim) {
  std::vector<std::unique_ptr<Testbed>> beds;
  const Placement turned = rotated(dim, 0.3, {1.2, 0.8, 1}, {3, -2, 1});
  const auto add = [&](const std::string& name, CellType type, int n, const Placement& placement, int order,
                       bool moves) {
    beds.push_back(std::make_unique<Testbed>(name, type, n, placement, order, moves));
  };
  const CellType tensor = dim == 2 ? CellType::quadrilateral : CellType::hexahedron;
  const CellType simplex = dim == 2 ? CellType::triangle : CellType::tetrahedron;
  for (const CellType type : {tensor, simplex}) {
    const std::string name = type == tensor ? (dim == 2 ? "quadrilaterals" : "hexahedra")
                                            : (dim == 2 ? "triangles" : "tetrahedra");
    add(name, type, 2, unmoved(), 1, false);
    add(name, type, dim == 2 ? 4 : 3, unmoved(), 1, false);
    add(name + ", order 2", type, 2, unmoved(), 2, false);
    add(name + ", turned", type, 2, turned, 1, true);
    add(name + ", bent", type, dim == 2 ? 3 : 2, bent(dim), 1, false);
    add(name + ", bent, order 2", type, 2, bent(dim), 2, false);
  }
  return beds;
}

/// Lays facets that are flush with the border onto it, as it is documented.
Surface laid_onto_border(const Testbed& bed, Surface body) {
  const int dim = bed.dim;
  const cutting::Outline& o = bed.outline;
  const auto vertex = [&](int v) {
    cutting::Vector x{};
    std::copy_n(&body.points[static_cast<std::size_t>(v) * dim], dim, x.begin());
    return x;
  };
  std::map<int, std::vector<std::pair<cutting::Vector, double>>> planes;
  for (int c = 0; c < bed.whole.cells(); ++c)
    for (int s = o.first_side[c]; s < o.first_side[c + 1]; ++s) {
      if (o.neighbour[c][o.sides[s].face] >= 0) continue;
      const cutting::Vector n = cutting::side_normal(o, o.sides[s]);
      const cutting::Vector origin = o.position[o.sides[s].vertex[0]];
      const double reach = 1e-9 * std::pow(bed.volume[c], 1.0 / dim);
      for (int f = 0; f < body.facet_count(); ++f) {
        std::array<cutting::Vector, 3> x{};
        bool flush = true;
        for (int k = 0; k < dim && flush; ++k) {
          x[k] = vertex(body.facets[f * dim + k]);
          flush = std::abs(cutting::dot(x[k] - origin, n)) < reach;
        }
        if (!flush) continue;
        const cutting::Vector area = dim == 2 ? cutting::Vector{x[1][1] - x[0][1], x[0][0] - x[1][0], 0}
                                              : cutting::cross(x[1] - x[0], x[2] - x[0]);
        if (std::abs(cutting::dot(area, n)) < 0.5 * std::sqrt(cutting::dot(area, area))) continue;
        for (int i = 0; i < dim && flush; ++i) {
          double low = 1e300, high = -1e300, from = 1e300, to = -1e300;
          for (int k = 0; k < dim; ++k) {
            low = std::min(low, x[k][i]);
            high = std::max(high, x[k][i]);
            const double y = o.position[o.sides[s].vertex[k]][i];
            from = std::min(from, y);
            to = std::max(to, y);
          }
          flush = high >= from - reach && low <= to + reach;
        }
        for (int k = 0; k < dim && flush; ++k)
          planes[body.facets[f * dim + k]].emplace_back(n, cutting::dot(n, origin));
      }
    }
  for (const auto& [v, of_vertex] : planes) {
    cutting::Vector x = vertex(v);
    for (int round = 0; round < 40; ++round)
      for (const auto& [n, offset] : of_vertex) x = x + (offset - cutting::dot(n, x)) * n;
    std::copy_n(x.begin(), dim, &body.points[static_cast<std::size_t>(v) * dim]);
  }
  return body;
}

/// What bodies leave of a cell.
template <class T>
T left_over(const Testbed& bed, int cell, const std::vector<std::vector<clipping::Facet<T>>>& bodies) {
  const auto [low, high] = bed.box_of(cell);
  const auto parts = bed.simplices<T>(cell);
  T result = clipping::total(parts, bed.dim);
  for (const auto& body : bodies) result = T(result - clipping::covered(parts, bed.dim, body, low, high));
  if (bodies.size() > 1)
    result = T(result +
               clipping::covered(clipping::within(parts, bed.dim, bodies[1]), bed.dim, bodies[0], low, high));
  return result;
}

template <class T>
std::vector<std::vector<clipping::Facet<T>>> facets_of(const std::vector<Surface>& bodies) {
  std::vector<std::vector<clipping::Facet<T>>> result;
  for (const Surface& s : bodies) result.push_back(clipping::facets<T>(s));
  return result;
}

struct Tally {
  long scenes = 0, clipped = 0, cells = 0, failures = 0;
  double volume = 0, rational = 0, closure = 0, flux = 0, faces = 0, complement = 0;
};

class Stress {
 public:
  Stress(const Options& options, int dim) : options_(options), dim_(dim), beds_(testbeds(dim)) {}

  void run(long index) {
    Testbed& bed = *beds_[static_cast<std::size_t>(index) % beds_.size()];
    Draw draw(options_.seed * 2 + (dim_ == 3 ? 1 : 0), static_cast<unsigned long>(index), bed.n);
    scene_ = draw_scene(dim_, draw);
    if (bed.body_placement)
      for (Surface& s : scene_.bodies) s = moved(s, bed.body_placement);
    bed_ = &bed;
    index_ = index;
    if (is_chosen()) print_bodies();
    tally_ = &tallies_[scene_.kind];
    by_mesh_[bed.name] += 1;
    ++tally_->scenes;
    failed_ = false;
    try {
      bed.cut.cut(scene_.bodies);
      check_identities();
      check_neighbours();
      check_ranks();
      const bool clipped = dim_ == 2 || index % options_.exact_in_space == 0 || is_chosen();
      if (clipped) check_volumes();
      if (scene_.bodies.size() == 1 && encloses_something() && (!clipped || index % 4 == 0))
        check_complement();
    } catch (const std::exception& error) {
      fail("refused", 0, error.what());
    }
    if (failed_) ++tally_->failures;
  }

  /// @return whether nothing failed
  bool report(double seconds) const {
    const Communicator world;
    long scenes = 0, failures = 0;
    std::string text = fmt::format(
        "\n## In {}\n\n| bodies | scenes | clipped | cells compared | volume, per facet | against rational | "
        "closure | "
        "volume by interface | faces of neighbours | complement | failed |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        dim_ == 2 ? "the plane" : "space");
    for (const auto& [kind, t] : tallies_) {
      const auto most = [&](double x) { return world.max(x); };
      const long failed = static_cast<long>(world.sum(static_cast<long long>(t.failures)));
      text += fmt::format(
          "| {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {} |\n", kind,
          t.scenes, t.clipped, world.sum(static_cast<long long>(t.cells)), most(t.volume), most(t.rational),
          most(t.closure), most(t.flux), most(t.faces), most(t.complement), failed);
      scenes += t.scenes;
      failures += failed;
    }
    text += fmt::format("| all | {} | | | | | | | | | {} |\n\nMeshes: ", scenes, failures);
    for (const auto& [mesh, count] : by_mesh_) text += fmt::format("{} {}; ", mesh, count);
    text += fmt::format("{:.0f} s.\n", seconds);
    if (world.rank() == 0) fmt::print("{}", text);
    return failures == 0;
  }

 private:
  [[nodiscard]] bool is_chosen() const {
    return !(dim_ == 2 ? options_.only_plane : options_.only_space).empty();
  }
  void print_bodies() const {
    fmt::print("{} on {}, cells of 1/{}\n", scene_.kind, bed_->name, bed_->n);
    for (const Surface& s : scene_.bodies) {
      fmt::print("body of the corners");
      for (int v = 0; v < s.point_count(); ++v) {
        for (int i = 0; i < dim_; ++i) fmt::print("{}{:.17g}", i == 0 ? "; " : " ", s.points[v * dim_ + i]);
      }
      fmt::print("\n");
    }
  }
  void fail(const std::string& what, double value, const std::string& detail) {
    failed_ = true;
    if (++said_ > 60) return;
    fmt::print(stderr, "{} {}: {} ({}), {}: {:.3e} {}\n", dim_ == 2 ? "plane" : "space", index_, scene_.kind,
               bed_->name, what, value, detail);
  }
  void check(double& worst, double value, double bound, const std::string& what, int cell) {
    worst = std::max(worst, value);
    if (!(value <= bound)) fail(what, value, fmt::format("in cell {}, at most {:.1e}", cell, bound));
  }

  /// Facets whose boxes meet that of a cell, and one more, as what is too small is not kept.
  [[nodiscard]] int facets_in(int cell) const {
    const auto [low, high] = bed_->box_of(cell);
    int count = 1;
    for (const Surface& s : scene_.bodies)
      for (int f = 0; f < s.facet_count(); ++f) {
        bool meets = true;
        for (int i = 0; i < dim_; ++i) {
          double from = 1e300, to = -1e300;
          for (int k = 0; k < dim_; ++k) {
            const double x = s.points[static_cast<std::size_t>(s.facets[f * dim_ + k]) * dim_ + i];
            from = std::min(from, x);
            to = std::max(to, x);
          }
          meets = meets && to >= low[i] - 1e-9 && from <= high[i] + 1e-9;
        }
        count += meets ? 1 : 0;
      }
    return count;
  }

  [[nodiscard]] double wet_volume(const CutMesh& cut, int cell) const {
    if (cut.state(cell) == CellState::cut) return cut.wet_volume(cell);
    return cut.state(cell) == CellState::wet ? bed_->volume[bed_->mesh.global_cell(cell)] : 0;
  }

  void check_volumes() {
    ++tally_->clipped;
    std::vector<Surface> bodies;
    for (const Surface& s : scene_.bodies) bodies.push_back(laid_onto_border(*bed_, s));
    const auto facets = facets_of<long double>(bodies);
    const bool rational = tally_->clipped % options_.rational == 1;
    const auto exact_facets =
        rational ? facets_of<mpq_class>(bodies) : std::vector<std::vector<clipping::Facet<mpq_class>>>{};
    for (int c = 0; c < bed_->mesh.owned_cells(); ++c) {
      const int global = bed_->mesh.global_cell(c);
      const double volume = bed_->volume[global];
      const long double left = left_over<long double>(*bed_, global, facets);
      const int count = facets_in(global);
      ++tally_->cells;
      check(tally_->volume, static_cast<double>(std::abs(wet_volume(bed_->cut, c) - left)) / volume / count,
            most_per_facet, "volume", global);
      if (!rational) continue;
      const mpq_class exact = left_over<mpq_class>(*bed_, global, exact_facets);
      const mpq_class off = exact - mpq_class(static_cast<double>(left));
      check(tally_->rational, std::abs(off.get_d()) / volume, 1e-14, "the clipping itself", global);
    }
  }

  void check_identities() {
    const CutMesh& cut = bed_->cut;
    for (const int c : cut.cut_cells()) {
      if (c >= bed_->mesh.owned_cells()) continue;  // of a ghost only the owner knows all
      const int global = bed_->mesh.global_cell(c);
      const double volume = cut.cell_volume(c), wet = cut.wet_volume(c);
      if (!(wet >= 0 && wet <= volume * (1 + rounding))) fail("not a part of the cell", wet / volume, "");
      if (!(cut.interface_area(c) > 0)) fail("no interface", cut.interface_area(c), "");
      if (!has_flat_sides(bed_->mesh, c)) continue;
      const Point open = closure(cut, c);
      const double size = std::max(std::pow(volume, (dim_ - 1.0) / dim_), cut.interface_area(c));
      for (int i = 0; i < dim_; ++i)
        check(tally_->closure, std::abs(open[i]) / size, rounding, "closure", global);
      check(tally_->flux, std::abs(flux_of_position(cut, c) / dim_ - wet) / volume, rounding,
            "volume by interface", global);
    }
  }

  [[nodiscard]] double wet_face(int cell, int face) {
    const CutMesh& cut = bed_->cut;
    if (cut.state(cell) == CellState::body) return 0;
    if (cut.state(cell) == CellState::wet) return bed_->face_area(bed_->mesh.global_cell(cell), face);
    cut.face_rule(cell, face, 0, rule_);
    double sum = 0;
    for (const double w : rule_.weight) sum += w;
    return sum;
  }

  void check_neighbours() {
    const CutMesh& cut = bed_->cut;
    const int faces = static_cast<int>(topology(bed_->mesh.type()).faces.size());
    for (const int c : cut.cut_cells())
      for (int f = 0; f < faces && c < bed_->mesh.owned_cells(); ++f) {
        const int other = cut.neighbour(c, f);
        if (other < 0) continue;
        int back = 0;
        while (cut.neighbour(other, back) != c) ++back;
        const int global = bed_->mesh.global_cell(c);
        const double whole = bed_->face_area(global, f);
        check(tally_->faces, wet_face(c, f) / whole - 1, rounding, "more wet than the whole face", global);
        // Where next to nothing of a neighbour is cut off, that one is taken for whole.
        const double most = cut.state(other) == CellState::wet ? 2 * most_per_facet : rounding;
        const double off = std::abs(wet_face(c, f) - wet_face(other, back)) / whole;
        check(tally_->faces, off, most, "faces of neighbours", global);
      }
  }

  /// What a rank has found in its ghost cells is what their owner has.
  void check_ranks() {
    const Mesh& mesh = bed_->mesh;
    if (mesh.communicator().size() == 1) return;
    std::vector<double> known(3 * bed_->volume.size(), 0.0);
    const auto of = [&](int c) {
      const bool cut = bed_->cut.state(c) == CellState::cut;
      return std::array<double, 3>{static_cast<double>(bed_->cut.state(c)), wet_volume(bed_->cut, c),
                                   cut ? bed_->cut.interface_area(c) : 0.0};
    };
    for (int c = 0; c < mesh.owned_cells(); ++c)
      std::copy_n(of(c).begin(), 3, &known[3 * static_cast<std::size_t>(mesh.global_cell(c))]);
    mesh.communicator().sum(known);
    for (int c = mesh.owned_cells(); c < mesh.cells(); ++c) {
      const auto own = of(c);
      const double* theirs = &known[3 * static_cast<std::size_t>(mesh.global_cell(c))];
      if (own[0] != theirs[0])
        fail("state on another rank", own[0], fmt::format("in cell {}", mesh.global_cell(c)));
      // They number nodes otherwise, and sum in another order; where several bodies meet in space they divide
      // the cell in another one, too.
      const double most = dim_ == 3 && scene_.bodies.size() > 1 ? rounding : 1e-14;
      if (own[0] == theirs[0] && std::abs(own[1] - theirs[1]) > most * bed_->volume[mesh.global_cell(c)])
        fail("volume on another rank", own[1] - theirs[1], fmt::format("in cell {}", mesh.global_cell(c)));
    }
  }

  /// Of what encloses less than rounding moves nobody can tell whether it is turned inside out.
  [[nodiscard]] bool encloses_something() const {
    const Surface& s = scene_.bodies[0];
    double sum = 0, size = 0;
    for (const auto& f : clipping::facets<long double>(s)) {
      const auto& [a, b, c] = f.corner;
      const auto origin = clipping::position<long double>(s.points.data(), dim_);
      const auto n = clipping::normal(a, b, c);
      sum += static_cast<double>(dim_ == 2 ? clipping::area(origin, a, b) : clipping::height(n, origin, a));
      size += dim_ == 2 ? std::hypot(static_cast<double>(b[0] - a[0]), static_cast<double>(b[1] - a[1]))
                        : std::sqrt(static_cast<double>(clipping::height(n, {0, 0, 0}, n)));
    }
    return sum > 4e-14 * size;
  }

  void check_complement() {
    bed_->complement.cut(std::vector{reversed(scene_.bodies[0])});
    for (int c = 0; c < bed_->mesh.owned_cells(); ++c) {
      const int global = bed_->mesh.global_cell(c);
      const double sum = wet_volume(bed_->cut, c) + wet_volume(bed_->complement, c),
                   volume = bed_->volume[global];
      check(tally_->complement, std::abs(sum - volume) / volume / facets_in(global), most_per_facet,
            "complement", global);
    }
  }

  const Options& options_;
  int dim_;
  std::vector<std::unique_ptr<Testbed>> beds_;
  std::map<std::string, Tally> tallies_;
  std::map<std::string, long> by_mesh_;
  CutRule rule_;
  // Of the present configuration:
  Scene scene_;
  Testbed* bed_ = nullptr;
  long index_ = 0;
  Tally* tally_ = nullptr;
  bool failed_ = false;
  int said_ = 0;
};

bool run(const Options& options, int dim) {
  const auto start = std::chrono::steady_clock::now();
  Stress stress(options, dim);
  for (const long k : dim == 2 ? options.only_plane : options.only_space) stress.run(k);
  const bool are_chosen = !options.only_plane.empty() || !options.only_space.empty();
  for (long k = 0; k < (dim == 2 ? options.plane : options.space) && !are_chosen; ++k) stress.run(k);
  return stress.report(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

Options read(int count, char** words) {
  Options options;
  int place = 0;
  for (int k = 1; k < count; ++k) {
    const auto value = [&] { return k + 1 < count ? std::atol(words[++k]) : 0L; };
    if (std::strcmp(words[k], "--seed") == 0)
      options.seed = static_cast<unsigned long>(value());
    else if (std::strcmp(words[k], "--clip-in-space") == 0)
      options.exact_in_space = static_cast<int>(std::max(1L, value()));
    else if (std::strcmp(words[k], "--rational") == 0)
      options.rational = static_cast<int>(std::max(2L, value()));
    else if (std::strcmp(words[k], "--only-plane") == 0)
      options.only_plane.push_back(value());
    else if (std::strcmp(words[k], "--only-space") == 0)
      options.only_space.push_back(value());
    else
      (place++ == 0 ? options.plane : options.space) = std::atol(words[k]);
  }
  return options;
}

}  // namespace

/// cut_stress [PLANE [SPACE]] [--seed N] [--clip-in-space N] [--rational N] [--only-plane K]... [--only-space
/// K]...
int main(int count, char** words) {
  MPI_Init(&count, &words);
  const Options options = read(count, words);
  const bool plane = run(options, 2), space = run(options, 3), good = plane && space;
  MPI_Finalize();
  return good ? 0 : 1;
}
