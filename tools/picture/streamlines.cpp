// SPDX-License-Identifier: BSD-3-Clause
#include "streamlines.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStreamTracer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace seam::picture {

namespace {

using Vec3 = std::array<double, 3>;
using Line = std::vector<Vec3>;

double distance_between(const Vec3& a, const Vec3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Points of the lines drawn so far, found by their place.
class Drawn {
 public:
  explicit Drawn(double distance) : distance_(distance) {}
  void add(const Vec3& x, int line, double along) { points_[key(x)].push_back({x, line, along}); }

  /// Whether a point comes closer than `fraction` of the distance to another line, or to a part of its own
  /// from which it is far along the line: then it goes round in circles.
  [[nodiscard]] bool is_near(const Vec3& x, double fraction, int line, double along) const {
    const Key middle = key(x);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto found = points_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (found == points_.end()) continue;
          for (const Point& p : found->second)
            if ((p.line != line || std::abs(p.along - along) > 2 * distance_) &&
                distance_between(p.position, x) < fraction * distance_)
              return true;
        }
    return false;
  }

 private:
  using Key = std::array<long, 3>;
  struct Point {
    Vec3 position;
    int line;
    double along;
  };
  [[nodiscard]] Key key(const Vec3& x) const {
    return {std::lround(x[0] / distance_), std::lround(x[1] / distance_), std::lround(x[2] / distance_)};
  }
  double distance_;
  std::map<Key, std::vector<Point>> points_;
};

double largest_magnitude(vtkDataArray* vectors) {
  double range[2];
  vectors->GetFiniteRange(range, -1);
  return range[1];
}

/// Starting points in rows, shifted against each other so that no direction is preferred.
vtkNew<vtkPolyData> seeds_in(vtkDataSet* plane, double spacing) {
  double b[6];
  plane->GetBounds(b);
  vtkNew<vtkPoints> points;
  std::array<int, 3> count{};
  for (int d = 0; d < 3; ++d)
    count[d] = std::max(1, static_cast<int>(std::ceil((b[2 * d + 1] - b[2 * d]) / spacing)));
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        const double shift = std::fmod(0.618034 * (j + k), 1.0);
        const double at[3] = {(i + shift) / count[0], (j + 0.5) / count[1], (k + 0.5) / count[2]};
        points->InsertNextPoint(b[0] + at[0] * (b[1] - b[0]), b[2] + at[1] * (b[3] - b[2]),
                                b[4] + at[2] * (b[5] - b[4]));
      }
  vtkNew<vtkPolyData> seeds;
  seeds->SetPoints(points);
  return seeds;
}

/// The lines through all seeds in one direction, seed first.
std::map<vtkIdType, Line> trace(vtkDataSet* plane, const std::string& array, vtkPolyData* seeds,
                                int direction, double step) {
  vtkNew<vtkStreamTracer> tracer;
  tracer->SetInputData(plane);
  tracer->SetSourceData(seeds);
  tracer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array.c_str());
  tracer->SetIntegratorTypeToRungeKutta4();
  tracer->SetInterpolatorTypeToCellLocator();
  tracer->SetIntegrationDirection(direction);
  tracer->SetIntegrationStepUnit(vtkStreamTracer::LENGTH_UNIT);
  tracer->SetInitialIntegrationStep(step);
  tracer->SetMaximumPropagation(3 * plane->GetLength());
  tracer->SetMaximumNumberOfSteps(static_cast<vtkIdType>(3 * plane->GetLength() / step));
  tracer->SetTerminalSpeed(1e-5 * largest_magnitude(plane->GetPointData()->GetArray(array.c_str())));
  tracer->SetComputeVorticity(false);
  tracer->Update();
  vtkPolyData* output = tracer->GetOutput();
  vtkDataArray* seed_of = output->GetCellData()->GetArray("SeedIds");
  std::map<vtkIdType, Line> lines;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c) {
    output->GetCellPoints(c, ids);
    Line& line = lines[static_cast<vtkIdType>(seed_of->GetTuple1(c))];
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) {
      Vec3 x;
      output->GetPoint(ids->GetId(k), x.data());
      line.push_back(x);
    }
  }
  return lines;
}

/// The part of a line in front of the place where it comes close to another one; marks it as drawn.
Line free_part(const Line& line, int number, int sign, Drawn& drawn) {
  Line part;
  double along = 0;
  for (const Vec3& x : line) {
    if (!part.empty()) along += sign * distance_between(part.back(), x);
    if (drawn.is_near(x, 0.5, number, along)) break;
    part.push_back(x);
    drawn.add(x, number, along);
  }
  return part;
}

double length_of(const Line& line) {
  double sum = 0;
  for (std::size_t k = 1; k < line.size(); ++k) sum += distance_between(line[k - 1], line[k]);
  return sum;
}

}  // namespace

vtkSmartPointer<vtkPolyData> streamlines_of(vtkDataSet* plane, const std::string& array, double distance) {
  const auto seeds = seeds_in(plane, 0.7 * distance);
  const double step = 0.1 * distance;
  const auto forward = trace(plane, array, seeds, vtkStreamTracer::FORWARD, step);
  const auto backward = trace(plane, array, seeds, vtkStreamTracer::BACKWARD, step);
  // The longest lines first: they give the picture its order, others fill the gaps.
  std::vector<std::pair<double, vtkIdType>> order;
  for (const auto& [seed, line] : forward) {
    const auto other = backward.find(seed);
    order.emplace_back(-length_of(line) - (other == backward.end() ? 0 : length_of(other->second)), seed);
  }
  std::sort(order.begin(), order.end());
  Drawn drawn(distance);
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& [negative_length, seed] : order) {
    const int number = static_cast<int>(seed);
    const Line& ahead = forward.at(seed);
    if (ahead.empty() || -negative_length < 0.5 * distance || drawn.is_near(ahead.front(), 1, number, 0))
      continue;
    const Line front = free_part(ahead, number, 1, drawn);
    const auto other = backward.find(seed);
    Line whole = other == backward.end() ? Line{} : free_part(other->second, number, -1, drawn);
    std::reverse(whole.begin(), whole.end());
    whole.insert(whole.end(), front.begin(), front.end());
    cells->InsertNextCell(static_cast<vtkIdType>(whole.size()));
    for (const Vec3& x : whole) cells->InsertCellPoint(points->InsertNextPoint(x.data()));
  }
  result->SetPoints(points);
  result->SetLines(cells);
  return result;
}

}  // namespace seam::picture
