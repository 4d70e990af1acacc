// SPDX-License-Identifier: BSD-3-Clause
#include "render.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "seam/base/diagnostics.hpp"
#include "shapes.hpp"
#include "streamlines.hpp"

namespace seam::picture {

namespace {

using Vec3 = std::array<double, 3>;
double dot(const Vec3& a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The colour map viridis (public domain, by Smith, van der Walt and Firing): equal steps look equal, also in
/// print and to the colour-blind.
vtkNew<vtkLookupTable> viridis() {
  constexpr std::array<std::array<int, 3>, 10> anchors = {{{68, 1, 84},
                                                           {72, 40, 120},
                                                           {62, 73, 137},
                                                           {49, 104, 142},
                                                           {38, 130, 142},
                                                           {31, 158, 137},
                                                           {53, 183, 121},
                                                           {110, 206, 88},
                                                           {181, 222, 43},
                                                           {253, 231, 37}}};
  constexpr int entries = 256;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(entries);
  for (int i = 0; i < entries; ++i) {
    const double at = static_cast<double>(i) / (entries - 1) * (anchors.size() - 1);
    const std::size_t left = std::min<std::size_t>(static_cast<std::size_t>(at), anchors.size() - 2);
    const double f = at - static_cast<double>(left);
    Vec3 c;
    for (int k = 0; k < 3; ++k) c[k] = ((1 - f) * anchors[left][k] + f * anchors[left + 1][k]) / 255;
    table->SetTableValue(i, c[0], c[1], c[2], 1);
  }
  table->SetNanColor(0.8, 0.8, 0.8, 1);
  return table;
}

/// Directions of the picture in space, and what it has to show along them.
struct View {
  bool plane = true;
  Vec3 right = {1, 0, 0}, up = {0, 1, 0}, towards = {0, 0, 1};
  double low[3], high[3];  ///< extent along right, up and towards
  [[nodiscard]] double width() const { return high[0] - low[0]; }
  [[nodiscard]] double height() const { return high[1] - low[1]; }
};

View find_view(const std::vector<Body>& bodies) {
  View v;
  for (const Body& b : bodies) {
    double bounds[6];
    b.current->GetBounds(bounds);
    if (bounds[5] - bounds[4] > 0) v.plane = false;
  }
  if (!v.plane) {
    // Seen from the right front, a little from above; z is up.
    const double turn = 0.6, rise = 0.45;
    v.right = {std::cos(turn), std::sin(turn), 0};
    v.towards = {std::sin(turn) * std::cos(rise), -std::cos(turn) * std::cos(rise), std::sin(rise)};
    v.up = {-std::sin(turn) * std::sin(rise), std::cos(turn) * std::sin(rise), std::cos(rise)};
  }
  std::fill(v.low, v.low + 3, std::numeric_limits<double>::infinity());
  std::fill(v.high, v.high + 3, -std::numeric_limits<double>::infinity());
  for (const Body& b : bodies)
    for (vtkUnstructuredGrid* grid : {b.reference.Get(), b.current.Get()})
      for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
        const double* x = grid->GetPoint(i);
        const double along[3] = {dot(v.right, x), dot(v.up, x), dot(v.towards, x)};
        for (int k = 0; k < 3; ++k) {
          v.low[k] = std::min(v.low[k], along[k]);
          v.high[k] = std::max(v.high[k], along[k]);
        }
      }
  return v;
}

/// Where things go, in pixels.
struct Layout {
  int width, height, font;
  int margin, title, bar;  ///< bar: width of the strip for the colour bar
  double units_per_pixel;
};

Layout find_layout(const View& view, const Options& options, bool coloured) {
  Layout l{};
  l.width = options.width;
  l.font = std::max(10, l.width / 50);
  l.margin = l.width / 30;
  l.title = options.title.empty() ? 0 : 2 * l.font;
  l.bar = coloured ? 8 * l.font : 0;
  const int room = l.width - 2 * l.margin - l.bar;
  const double largest = std::max(view.width(), view.height());
  const double w = std::max(view.width(), 1e-3 * largest), h = std::max(view.height(), 1e-3 * largest);
  const int around = 2 * l.margin + l.title;
  // Neither a strip nor a tower: the picture stays between 3:1 and 1:1.2.
  l.height = std::clamp(static_cast<int>(room * h / w) + around, l.width / 3, l.width * 6 / 5);
  l.units_per_pixel = std::max(w / room, h / (l.height - around));
  if (!(l.units_per_pixel > 0)) l.units_per_pixel = 1;
  return l;
}

void aim(vtkRenderer* renderer, const View& view, const Layout& l) {
  // The middle of the bodies goes to the middle of the room left by bar and title.
  const double middle[3] = {0.5 * (view.low[0] + view.high[0]) + 0.5 * l.bar * l.units_per_pixel,
                            0.5 * (view.low[1] + view.high[1]) + 0.5 * l.title * l.units_per_pixel,
                            0.5 * (view.low[2] + view.high[2])};
  const double depth = view.high[2] - view.low[2] + std::max(view.width(), view.height());
  Vec3 focus, eye;
  for (int i = 0; i < 3; ++i) {
    focus[i] = middle[0] * view.right[i] + middle[1] * view.up[i] + middle[2] * view.towards[i];
    eye[i] = focus[i] + depth * view.towards[i];
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(eye.data());
  camera->SetViewUp(view.up.data());
  camera->SetParallelScale(0.5 * l.height * l.units_per_pixel);
  renderer->ResetCameraClippingRange();
}

void add_lines(vtkRenderer* renderer, vtkPolyData* lines, double grey, double width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(lines);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(grey, grey, grey);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
}

void add_surface(vtkRenderer* renderer, const Body& body, vtkLookupTable* colours, const double* range,
                 bool plane) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface_of(body.current));
  mapper->SetScalarVisibility(body.coloured);
  if (body.cell_values)
    mapper->SetScalarModeToUseCellData();
  else
    mapper->SetScalarModeToUsePointData();
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOff();
  mapper->SetScalarRange(range[0], range[1]);
  // Values, not colours, are interpolated within a cell.
  mapper->InterpolateScalarsBeforeMappingOn();
  // Lines of the same place are drawn in front.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 4);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* p = actor->GetProperty();
  p->SetColor(0.72, 0.78, 0.85);
  p->SetInterpolationToFlat();
  if (plane) {
    p->LightingOff();
  } else {
    // Mostly ambient: shading shows the shape but must not change how a colour reads.
    p->SetAmbient(0.7);
    p->SetDiffuse(0.3);
  }
  renderer->AddActor(actor);
}

/// Whether a body has the vector at its points that streamlines follow.
bool can_follow(const Body& body, const std::string& name) {
  vtkDataArray* array = body.current->GetPointData()->GetArray(name.c_str());
  return array && array->GetNumberOfComponents() == 3;
}

void add_streamlines(vtkRenderer* renderer, const std::vector<Body>& bodies, const View& view,
                     const Options& options, double width) {
  const std::string& name = options.along.empty() ? options.array : options.along;
  const double distance = std::min(view.width(), view.height()) / options.streamlines;
  bool any = false;
  for (const Body& b : bodies) {
    if (!can_follow(b, name)) continue;
    add_lines(renderer, streamlines_of(b.current, name, distance), 0.0, width);
    any = true;
  }
  if (!any)
    throw Error(
        fmt::format("streamlines follow a vector at the points; '{}' is none; name one with --along", name));
}

void style(vtkTextProperty* text, int size) {
  text->SetFontFamilyToArial();
  text->SetFontSize(size);
  text->SetColor(0.1, 0.1, 0.1);
  text->BoldOff();
  text->ItalicOff();
  text->ShadowOff();
}

void add_text(vtkRenderer* renderer, const std::string& words, int size, double x, double y, bool centred) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(words.c_str());
  style(actor->GetTextProperty(), size);
  if (centred) actor->GetTextProperty()->SetJustificationToCentered();
  actor->GetTextProperty()->SetVerticalJustificationToCentered();
  actor->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
  actor->SetPosition(x, y);
  renderer->AddActor2D(actor);
}

std::string quantity(const Options& options) {
  return options.component == "magnitude" ? options.array : options.array + " " + options.component;
}

/// A bar with its quantity above it. VTK places the labels; the name is drawn apart, because VTK would shrink
/// it to the width of the bar.
void add_bar(vtkRenderer* renderer, vtkLookupTable* colours, const double* range, const Layout& l,
             const Options& options) {
  colours->SetTableRange(range[0], range[1]);
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colours);
  bar->SetNumberOfLabels(range[0] < range[1] ? 5 : 1);
  bar->SetLabelFormat("%-.4g");
  bar->UnconstrainedFontSizeOn();
  style(bar->GetLabelTextProperty(), l.font);
  bar->SetMaximumNumberOfColors(256);
  bar->SetTextPad(l.font / 3);
  const double left = l.width - l.bar, length = std::min(0.75 * (l.height - l.title), 0.4 * l.width);
  const double bottom = 0.5 * (l.height - l.title - length) - 0.5 * l.font;
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(left / l.width, bottom / l.height);
  bar->SetPosition2(0.85 * l.bar / l.width, length / l.height);
  bar->SetBarRatio(0.2);
  renderer->AddActor2D(bar);
  const std::string words = quantity(options);
  const double fitting = 1.7 * 0.9 * l.bar / static_cast<double>(std::max<std::size_t>(words.size(), 1));
  add_text(renderer, words, static_cast<int>(std::clamp(fitting, 0.6 * l.font, 1.1 * l.font)),
           left - 0.2 * l.font, bottom + length + 1.2 * l.font, false);
}

std::array<double, 2> colour_range(const std::vector<Body>& bodies, const Options& options) {
  if (options.range.size() == 2) return {options.range[0], options.range[1]};
  std::array<double, 2> all = {std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};
  for (const Body& b : bodies) {
    double range[2] = {0, 0};
    vtkDataSetAttributes* data = b.cell_values
                                     ? static_cast<vtkDataSetAttributes*>(b.current->GetCellData())
                                     : static_cast<vtkDataSetAttributes*>(b.current->GetPointData());
    if (vtkDataArray* values = data->GetScalars()) values->GetFiniteRange(range, 0);
    all = {std::min(all[0], range[0]), std::max(all[1], range[1])};
  }
  return all;
}

void write(vtkRenderWindow* window, const std::string& path) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputConnection(image->GetOutputPort());
  writer->Write();
  if (writer->GetErrorCode() != 0) throw Error(Location{path}, "cannot write the picture");
}

}  // namespace

void render(const std::vector<Body>& bodies, const Options& options) {
  const View view = find_view(bodies);
  const bool coloured = !options.array.empty();
  const Layout layout = find_layout(view, options, coloured);
  const auto range = colour_range(bodies, options);
  const auto colours = viridis();

  vtkIdType cells = 0;
  for (const Body& b : bodies) cells += b.current->GetNumberOfCells();
  const bool edges = options.edges == Edges::on ||
                     (options.edges == Edges::automatic && cells <= 4000 && options.streamlines == 0);
  const double line = std::max(1.0, layout.width / 1200.0);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  for (const Body& b : bodies) {
    add_surface(renderer, b, colours, range.data(), view.plane);
    if (edges) add_lines(renderer, edges_of(b.current), 0.25, 0.7 * line);
    // The parts of cut cells do not meet their neighbours edge to edge in space: no outline tells them apart.
    if (!b.sliced) add_lines(renderer, outline_of(b.current), 0.1, 1.4 * line);
    if (!options.deform.empty()) add_lines(renderer, outline_of(b.reference), 0.55, 1.2 * line);
  }
  if (options.streamlines > 0) add_streamlines(renderer, bodies, view, options, line);
  if (coloured) add_bar(renderer, colours, range.data(), layout, options);
  if (!options.title.empty())
    add_text(renderer, options.title, layout.font * 5 / 4, 0.5 * layout.width,
             layout.height - 0.5 * layout.margin - 0.5 * layout.title, true);

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(layout.width, layout.height);
  window->AddRenderer(renderer);
  aim(renderer, view, layout);
  window->Render();
  write(window, options.output);
}

}  // namespace seam::picture
