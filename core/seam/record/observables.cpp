// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/observables.hpp"

#include <algorithm>

#include "seam/base/error_list.hpp"
#include "seam/record/derived.hpp"
#include "seam/record/error_norms.hpp"
#include "seam/record/evaluate.hpp"
#include "seam/record/result_names.hpp"

namespace seam {
namespace {

/// What is to be written must be there.
void check_output(const Scene& scene, Problem& problem, ErrorList& errors) {
  const Parameters& output = scene.root.object("output");
  errors.attempt([&] {
    if (output.boolean("interfaces") &&
        std::ranges::all_of(problem.measures(),
                            [](const InterfaceMeasure& m) { return m.integrals.empty(); }))
      throw Error(
          output.where("interfaces"),
          "interfaces: no coupling measures anything on its interface, so that there is nothing to write");
  });
  errors.attempt([&] {
    if (output.boolean("cut") && !problem.is_cut())
      throw Error(output.where("cut"),
                  "cut: no interface cuts a body out of a field, so that there is no cut to write");
  });
  if (!output.has("picture")) return;
  const Parameters& picture = output.object("picture");
  errors.attempt([&] {
    try {
      static_cast<void>(find_quantity(problem.field(picture.text("field")), picture.text("quantity")));
    } catch (const Error& error) {
      throw Error(picture.where("quantity"), error.what());
    }
  });
}

}  // namespace

Observables::Observables(const Scene& scene, Problem& problem) : scene_(scene), problem_(problem) {
  ErrorList errors(problem.communicator());
  for (const auto& [name, parameters] : scene.root.object("output").map("probes"))
    errors.attempt([&, &called = name, &of = parameters] { probes_.emplace_back(called, of, problem); });
  check_output(scene, problem, errors);
  errors.throw_if_any();
}

Results Observables::row(const TimePoint& at) {
  Results row;
  row.time.push_back(at.time);
  for (const Probe& probe : probes_) probe.record(problem_, at, row);
  record_integrals(problem_, at, row);
  if (!names_checked_) check_result_names(scene_, row);
  names_checked_ = true;
  check_numbers(row);
  record_formulas(scene_, row);
  return row;
}

std::map<std::string, double> Observables::errors(double time) {
  std::map<std::string, double> errors;
  for (const auto& [name, p] : scene_.root.object("output").map("errors")) {
    const FieldEntry& entry = problem_.field(p.text("field"));
    const auto& exact = p.vector_expression("exact");
    const auto gradient = p.has("gradient") ? p.vector_expression("gradient") : std::vector<Expression>{};
    require_known_solution(entry, p);
    const ErrorNorms norms = p.has("interface")
                                 ? interface_error_norms(problem_.interfaces().at(p.text("interface")), entry,
                                                         p.text("unknown"), exact, gradient, time)
                                 : error_norms(entry, p.text("unknown"), exact, gradient, time);
    errors[name + ".l2"] = norms.l2;
    if (norms.h1) errors[name + ".h1"] = *norms.h1;
  }
  return errors;
}

}  // namespace seam
