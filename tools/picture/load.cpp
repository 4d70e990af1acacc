// SPDX-License-Identifier: BSD-3-Clause
#include "load.hpp"

#include <fmt/format.h>
#include <vtkAppendFilter.h>
#include <vtkCellData.h>
#include <vtkCutter.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>

#include "seam/base/diagnostics.hpp"
#include "seam/output/pvd.hpp"

namespace seam::picture {

namespace {

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> read_with(const std::string& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  if (!grid || grid->GetNumberOfPoints() == 0)
    throw Error(Location{file}, "the file has no points that could be drawn");
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> read(const std::string& file) {
  namespace fs = std::filesystem;
  const std::string extension = fs::path(file).extension().string();
  if (!fs::is_regular_file(file)) throw Error(Location{file}, "there is no such file");
  if (extension == ".vtu") return read_with<vtkXMLUnstructuredGridReader>(file);
  if (extension == ".pvtu") return read_with<vtkXMLPUnstructuredGridReader>(file);
  if (extension != ".pvd")
    throw Error(Location{file}, "cannot tell the format; expected .vtu, .pvtu or .pvd");
  const PvdSeries series = PvdSeries::resume(file, std::numeric_limits<double>::infinity());
  if (series.entries().empty()) throw Error(Location{file}, "the series has no entries");
  const fs::path last = series.entries().back().second;
  if (last.extension() == ".pvd") throw Error(Location{file}, "a series of series cannot be drawn");
  return read(last.is_absolute() ? last.string() : (fs::path(file).parent_path() / last).string());
}

[[noreturn]] void no_array(vtkUnstructuredGrid* grid, const std::string& file, const std::string& name) {
  std::vector<std::string> known;
  for (vtkDataSetAttributes* data : {static_cast<vtkDataSetAttributes*>(grid->GetPointData()),
                                     static_cast<vtkDataSetAttributes*>(grid->GetCellData())})
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      if (const char* array = data->GetArrayName(i)) known.emplace_back(array);
  const std::string nearest = nearest_name(name, known);
  throw Error(Location{file},
              fmt::format("there is no array '{}'{}; the file has: {}", name,
                          nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest),
                          known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

/// Number of a component, -1 for the magnitude.
int component_number(const std::string& word, int components, const std::string& array) {
  if (word == "magnitude") return components == 1 ? 0 : -1;
  int number = word == "x" ? 0 : word == "y" ? 1 : word == "z" ? 2 : -1;
  if (number < 0) std::from_chars(word.data(), word.data() + word.size(), number);
  if (number < 0 || number >= components)
    throw Error(
        fmt::format("array '{}' has no component '{}'; expected magnitude, x, y, z or a number from 0 to {}",
                    array, word, components - 1));
  return number;
}

void colour(Body& body, const Options& options) {
  vtkDataSetAttributes* data = body.current->GetPointData();
  vtkDataArray* array = data->GetArray(options.array.c_str());
  if (!array) {
    data = body.current->GetCellData();
    array = data->GetArray(options.array.c_str());
    body.cell_values = true;
  }
  if (!array) return;
  const int components = array->GetNumberOfComponents();
  const int component = component_number(options.component, components, options.array);
  vtkNew<vtkDoubleArray> values;
  values->SetName("seam_colour");
  values->SetNumberOfTuples(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    double sum = 0;
    for (int k = 0; component < 0 && k < components; ++k) sum += std::pow(array->GetComponent(i, k), 2);
    values->SetValue(i, component < 0 ? std::sqrt(sum) : array->GetComponent(i, component));
  }
  data->SetScalars(values);
  body.coloured = true;
}

void displace(Body& body, const std::string& file, const Options& options) {
  vtkDataArray* by = body.reference->GetPointData()->GetArray(options.deform.c_str());
  if (!by) return;
  if (by->GetNumberOfComponents() != 3)
    throw Error(Location{file}, fmt::format("array '{}' has {} components; a displacement has 3",
                                            options.deform, by->GetNumberOfComponents()));
  vtkNew<vtkPoints> points;
  points->DeepCopy(body.reference->GetPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    double x[3];
    points->GetPoint(i, x);
    for (int k = 0; k < 3; ++k) x[k] += options.scale * by->GetComponent(i, k);
    points->SetPoint(i, x);
  }
  body.current->SetPoints(points);
  body.displaced = true;
}

/// A spatial result becomes what it is at half its height, its vectors what they are along that plane.
/// @return false for a plane one, which stays as it is
bool slice(vtkSmartPointer<vtkUnstructuredGrid>& grid) {
  double bounds[6];
  grid->GetBounds(bounds);
  if (bounds[5] - bounds[4] <= 0) return false;
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, 0.5 * (bounds[4] + bounds[5]));
  plane->SetNormal(0, 0, 1);
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(grid);
  cutter->SetCutFunction(plane);
  vtkNew<vtkAppendFilter> converter;
  converter->AddInputConnection(cutter->GetOutputPort());
  converter->Update();
  grid = converter->GetOutput();
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
    double x[3];
    grid->GetPoint(i, x);
    grid->GetPoints()->SetPoint(i, x[0], x[1], 0);
  }
  grid->GetPoints()->Modified();
  for (int a = 0; a < grid->GetPointData()->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = grid->GetPointData()->GetArray(a);
    for (vtkIdType i = 0; array->GetNumberOfComponents() == 3 && i < array->GetNumberOfTuples(); ++i)
      array->SetComponent(i, 2, 0);
  }
  return true;
}

Body load(const std::string& file, const Options& options) {
  Body body;
  body.reference = read(file);
  if (options.streamlines > 0) body.sliced = slice(body.reference);
  body.current = vtkSmartPointer<vtkUnstructuredGrid>::New();
  body.current->ShallowCopy(body.reference);
  colour(body, options);
  displace(body, file, options);
  return body;
}

}  // namespace

std::vector<Body> load_bodies(const Options& options) {
  std::vector<Body> bodies;
  for (const std::string& file : options.files) bodies.push_back(load(file, options));
  const auto none = [&](bool Body::*flag) {
    return std::none_of(bodies.begin(), bodies.end(), [flag](const Body& b) { return b.*flag; });
  };
  if (!options.array.empty() && none(&Body::coloured))
    no_array(bodies.front().reference, options.files.front(), options.array);
  if (!options.deform.empty() && none(&Body::displaced))
    no_array(bodies.front().reference, options.files.front(), options.deform);
  return bodies;
}

}  // namespace seam::picture
