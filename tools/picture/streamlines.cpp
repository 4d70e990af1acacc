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

/// The lines of a picture, seeded ever more densely where none has come by.
class Picture {
 public:
  Picture(vtkDataSet* plane, const std::string& array, double distance)
      : plane_(plane), array_(array), distance_(distance), drawn_(distance) {}

  void add_lines(double seed_spacing) {
    const auto all = seeds_in(plane_, seed_spacing);
    vtkNew<vtkPoints> points;
    for (vtkIdType i = 0; i < all->GetNumberOfPoints(); ++i)
      if (Vec3 x; all->GetPoint(i, x.data()), is_free(x)) points->InsertNextPoint(x.data());
    if (points->GetNumberOfPoints() == 0) return;
    vtkNew<vtkPolyData> seeds;
    seeds->SetPoints(points);
    const double step = 0.25 * distance_;
    const auto forward = trace(plane_, array_, seeds, vtkStreamTracer::FORWARD, step);
    auto backward = trace(plane_, array_, seeds, vtkStreamTracer::BACKWARD, step);
    // The longest lines first: they give the picture its order, others fill the gaps.
    std::vector<std::pair<double, vtkIdType>> order;
    for (const auto& [seed, line] : forward)
      order.emplace_back(length_of(line) + length_of(backward[seed]), seed);
    std::sort(order.rbegin(), order.rend());
    for (const auto& [length, seed] : order)
      if (length > 0.5 * distance_ && is_free(forward.at(seed).front()))
        add_line(forward.at(seed), backward[seed]);
  }
  [[nodiscard]] vtkSmartPointer<vtkPolyData> lines() const {
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(points_);
    result->SetLines(cells_);
    return result;
  }

 private:
  [[nodiscard]] bool is_free(const Vec3& x) const { return !drawn_.is_near(x, 1, -1, 0); }
  void add_line(const Line& ahead, const Line& behind) {
    const int number = static_cast<int>(cells_->GetNumberOfCells());
    const Line front = free_part(ahead, number, 1, drawn_);
    Line whole = free_part(behind, number, -1, drawn_);
    std::reverse(whole.begin(), whole.end());
    whole.insert(whole.end(), front.begin(), front.end());
    cells_->InsertNextCell(static_cast<vtkIdType>(whole.size()));
    for (const Vec3& x : whole) cells_->InsertCellPoint(points_->InsertNextPoint(x.data()));
  }

  vtkDataSet* plane_;
  const std::string& array_;
  double distance_;
  Drawn drawn_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
};

}  // namespace

vtkSmartPointer<vtkPolyData> streamlines_of(vtkDataSet* plane, const std::string& array, double distance) {
  Picture picture(plane, array, distance);
  for (const double spacing : {16.0, 8.0, 4.0, 2.0, 1.0, 0.6}) picture.add_lines(spacing * distance);
  return picture.lines();
}

}  // namespace seam::picture
