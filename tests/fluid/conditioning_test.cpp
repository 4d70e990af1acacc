// SPDX-License-Identifier: BSD-3-Clause
// A disc and a sphere slide through the mesh, past positions where their boundary meets nodes of it: neither
// the condition of the system nor the error may notice.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numbers>

#include "condition.hpp"
#include "cut_flow.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/surface/body.hpp"

using namespace seam;
using namespace seam::test;

namespace {

/// A body that slides along the diagonal of the mesh; at 0 parts of its boundary lie on nodes.
struct Slide {
  std::string name;
  BodyInFlow flow;
  std::string stabilisation;
  std::string shape;  ///< type and further keys of the body
  double radius = 0;
};

struct Sample {
  double shift;  ///< over the cell size
  double condition;
  CutErrors errors;
};

/// The scene with the body's centre shifted along the diagonal.
/// @param ghost false: no penalty on jumps of the velocity; that of jumps of the divergence is one, too
std::string scene_at(const Slide& slide, double shift, bool ghost) {
  const int dim = slide.flow.exact.dimension();
  const std::string c = fmt::format("0.5 + {:.17g}", -shift / slide.flow.cells);
  BodyInFlow flow = slide.flow;
  flow.field +=
      fmt::format("\nstabilisation: {{type: {}, divergence: {}}}", slide.stabilisation, ghost ? 5e-5 : 0);
  flow.body = fmt::format("{{{}, centre: [{}], radius: {:.17g}}}", slide.shape,
                          dim == 2 ? c + ", " + c : c + ", " + c + ", " + c, slide.radius);
  if (!ghost) flow.field += "\nghost_penalty: {viscous: 0, transient: 0, second_order: 0}";
  return flow.scene();
}

Sample sample(const Slide& slide, double shift, bool ghost = true) {
  FlowRun run(scene_at(slide, shift, ghost));
  try {
    const CutErrors errors = errors_of(run.run());
    return {shift,
            condition_number(run.simulation().problem(), slide.flow.exact.viscosity, 1.0 / slide.flow.cells),
            errors};
  } catch (const SingularMatrix&) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {shift, infinite, {infinite, infinite, infinite}};
  }
}

/// Half of them evenly over a cell, half towards alignment from both sides, 1e-1 ... 1e-14 cells away.
std::vector<double> shifts(int count) {
  std::vector<double> result;
  const int half = count / 2, quarter = count / 4;
  for (int k = 0; k < half; ++k) result.push_back((k + 0.5) / half);
  for (int k = 0; k < quarter; ++k)
    for (const double side : {-1.0, 1.0})
      result.push_back(side * std::pow(10, -1 - 13.0 * k / (quarter - 1)));
  return result;
}

template <class Get>
double median(const std::vector<Sample>& samples, const Get& get) {
  std::vector<double> values;
  for (const Sample& s : samples) values.push_back(get(s));
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

template <class Get>
void stays_near_median(const std::vector<Sample>& samples, const std::string& what, const Get& get) {
  const double middle = median(samples, get);
  for (const Sample& s : samples) {
    INFO(what << " at " << s.shift << " cells from alignment: " << get(s) << ", median " << middle);
    CHECK(get(s) < 3 * middle);
    CHECK(get(s) > middle / 3);
  }
}

void stays_near_median(const std::vector<Sample>& samples) {
  stays_near_median(samples, "condition", [](const Sample& s) { return s.condition; });
  stays_near_median(samples, "velocity", [](const Sample& s) { return s.errors.velocity; });
  stays_near_median(samples, "gradient", [](const Sample& s) { return s.errors.gradient; });
  stays_near_median(samples, "pressure", [](const Sample& s) { return s.errors.pressure; });
}

/// Corners of the disc's polygon lie on the nodes (+-4, +-4) from its centre.
Slide disc(const std::string& cell, int order, const std::string& stabilisation) {
  ExactFlow exact = vortices("1", "0");
  exact.convection = false;
  constexpr int facets = 720, cells = 16;
  const double step = 2 * std::numbers::pi / facets;
  // The polygon has the area of the circle: undo the factor that its corners are moved out by.
  const double radius = 4 * std::numbers::sqrt2 / cells / std::sqrt(step / std::sin(step));
  return {fmt::format("disc_{}_{}_{}", cell, order, stabilisation),
          {.exact = exact, .cell = cell, .cells = cells, .field = fmt::format("order: {}", order)},
          stabilisation,
          fmt::format("type: circle, facets: {}", facets),
          radius};
}

/// How far the facets across the space diagonals are from the centre of a sphere of radius 1.
double distance_of_facets(const std::string& shape) {
  FlowRun flow(BodyInFlow{.exact = spirals(),
                          .cell = "hexahedron",
                          .cells = 2,
                          .body = "{" + shape + ", centre: [0, 0, 0], radius: 1}"}
                   .scene());
  const Parameters& body = flow.scene().root.map("interfaces")[0].second.object("body");
  const MeshFinder no_meshes;
  const Mesh& background = *flow.simulation().problem().fields()[0].mesh;
  const Surface surface = fluid_types().create<BodyShape>("body", body)->surface({background, no_meshes})(0);
  double largest = 0;
  for (int f = 0; f < surface.facet_count(); ++f) {
    double centre[3] = {0, 0, 0};
    for (int k = 0; k < 9; ++k)
      centre[k % 3] += surface.points[3 * surface.facets[3 * f + k / 3] + k % 3] / 3;
    const double along = (centre[0] + centre[1] + centre[2]) / std::numbers::sqrt3;
    const double length = std::hypot(centre[0], centre[1], centre[2]);
    if (along > (1 - 1e-10) * length) largest = length;
  }
  return largest;
}

/// Facets of the sphere lie on the nodes (+-1, +-1, +-1) from its centre.
Slide sphere(const std::string& cell, const std::string& stabilisation, int cells) {
  ExactFlow exact = spirals();
  exact.convection = false;
  const std::string shape = "type: sphere, refinements: 2";
  return {fmt::format("sphere_{}_{}", cell, stabilisation),
          {.exact = exact, .cell = cell, .cells = cells},
          stabilisation,
          shape,
          std::numbers::sqrt3 / cells / distance_of_facets(shape)};
}

std::vector<Sample> samples_of(const Slide& slide, int count, bool ghost = true) {
  std::vector<Sample> samples;
  for (const double shift : shifts(count)) samples.push_back(sample(slide, shift, ghost));
  return samples;
}

void write(const std::string& path, const std::vector<Sample>& samples) {
  std::ofstream file(path);
  file << "shift,condition,velocity,gradient,pressure\n";
  for (const Sample& s : samples)
    file << fmt::format("{:.3e},{:.6e},{:.6e},{:.6e},{:.6e}\n", s.shift, s.condition, s.errors.velocity,
                        s.errors.gradient, s.errors.pressure);
}

}  // namespace

TEST_CASE("condition and errors do not depend on where a disc lies in the mesh", "[study]") {
  const auto [cell, order, stabilisation] = GENERATE(table<std::string, int, std::string>(
      {{"quadrilateral", 1, "cip"}, {"triangle", 1, "residual"}, {"quadrilateral", 2, "cip"}}));
  const std::vector<Sample> samples = samples_of(disc(cell, order, stabilisation), 16);
  INFO(cell << " of order " << order << ", " << stabilisation);
  stays_near_median(samples);
}

TEST_CASE("condition and errors do not depend on where a sphere lies in the mesh", "[study]") {
  const std::string cell = GENERATE("hexahedron", "tetrahedron");
  INFO(cell);
  stays_near_median(samples_of(sphere(cell, "residual", 6), 12));
}

TEST_CASE("without ghost penalty the condition depends on the cut by orders of magnitude", "[study]") {
  const Slide slide = GENERATE(disc("quadrilateral", 1, "cip"), sphere("hexahedron", "residual", 6));
  INFO(slide.name);
  double largest = 0, smallest = 1e300, held = 0;
  for (const double shift : {0.9, 0.5, 0.1, 1e-2, 1e-3, 1e-4}) {
    const double condition = sample(slide, shift, false).condition;
    largest = std::max(largest, condition);
    smallest = std::min(smallest, condition);
    held = std::max(held, sample(slide, shift).condition);
  }
  CHECK(largest > 1e3 * smallest);
  CHECK(largest > 1e3 * held);
}

TEST_CASE("a record of 200 positions of the cut", "[.record]") {
  const char* folder = std::getenv("SEAM_RECORD_FOLDER");
  if (!folder) FAIL("SEAM_RECORD_FOLDER must name the folder that tables are written to");
  const Slide slide = GENERATE(disc("quadrilateral", 1, "cip"), disc("quadrilateral", 1, "residual"),
                               disc("quadrilateral", 2, "cip"), sphere("hexahedron", "cip", 6),
                               sphere("tetrahedron", "residual", 6));
  const std::vector<Sample> samples = samples_of(slide, 200);
  stays_near_median(samples);
  write(fmt::format("{}/{}.csv", folder, slide.name), samples);
  write(fmt::format("{}/{}_without_ghost_penalty.csv", folder, slide.name), samples_of(slide, 200, false));
}
