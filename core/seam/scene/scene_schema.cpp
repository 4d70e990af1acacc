// SPDX-License-Identifier: BSD-3-Clause
// The keys of a scene, one function a block.
#include "seam/mesh/input/mesh_input.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

namespace {

Schema parameters_schema() {
  Schema schema("A named constant.");
  schema.number("value", "number, or an expression of parameters above it");
  return schema;
}

Schema time_schema() {
  Schema step("Length of the time steps.");
  step.number("initial", "first step").unit("s").above(0);
  step.number("minimum",
              "a step that fails is repeated with a shorter one, down to this; default 1e-6 of `initial`")
      .unit("s")
      .above(0)
      .optional();
  step.number("maximum", "longest step; default `initial`, or a tenth of the time span when adaptive")
      .unit("s")
      .above(0)
      .optional();
  step.boolean("adaptive", "choose the steps by an estimate of the time error").otherwise("false");
  step.number("tolerance", "of an adaptive step's error, relative to the unknowns")
      .above(0)
      .otherwise("1e-3");
  step.file("replay", "series.csv of an earlier run whose steps are taken again").optional();

  Schema schema("The time span and how it is stepped through.");
  schema.boolean("static", "leave out all rates: the time is the parameter of the load").otherwise("false");
  schema
      .choice(
          "scheme",
          "bdf2, the backward difference formula of second order over two steps, damps what the steps do not "
          "resolve and little else",
          {"one_step_theta", "bdf2"})
      .otherwise("one_step_theta");
  schema.number("theta", "of the one-step-theta scheme: 1 implicit Euler, 0.5 trapezoidal")
      .at_least(0.5)
      .at_most(1)
      .otherwise("1");
  schema.number("start", "time at the start").unit("s").otherwise("0");
  schema.number("end", "time at the end").unit("s");
  schema.object("step", "length of the steps; default one step to the end", step).optional();
  return schema;
}

Schema solver_schema() {
  Schema newton("The nonlinear solution of a step.");
  newton.number("tolerance", "of the residual, relative to the forces at work")
      .above(0)
      .below(1)
      .otherwise("1e-8");
  newton
      .number("increment_tolerance",
              "of what is left to add, judged by the last two updates, relative to the change in the step")
      .above(0)
      .otherwise("1e-5");
  newton.integer("maximum_iterations", "a step that needs more has failed")
      .at_least(1)
      .at_most(1000)
      .otherwise("25");
  newton.boolean("damping", "shorten updates that make the residual grow").otherwise("true");
  newton
      .boolean("shape_derivatives",
               "differentiate cuts with respect to the bodies that make them; without, each iteration takes "
               "the cut as fixed")
      .otherwise("true");

  Schema schema("How the equations are solved.");
  schema.object("newton", "the nonlinear iteration", newton).otherwise("{}");
  schema.typed("linear", "the linear solver", "linear_solver").otherwise("auto");
  return schema;
}

Schema picture_schema() {
  Schema schema("A picture of the last state, as PNG.");
  schema.reference("field", "whose mesh is shown", "field");
  schema.text("quantity",
              "what colours it: an unknown or another quantity of the field (`seam explain` lists them)");
  schema.choice("component", "of a vector quantity; default its magnitude", {"x", "y", "z", "magnitude"})
      .optional();
  schema.number("deformed", "scale of the displacement that moves the mesh; 0 for none").otherwise("1");
  schema.integer("width", "pixels").at_least(200).at_most(10000).otherwise("1200");
  return schema;
}

Schema probe_schema() {
  Schema schema(
      "A number recorded at every step: a quantity at a point, or its integral over boundaries or over an "
      "interface.");
  schema.reference("field", "where it is read", "field").optional();
  schema.reference("interface", "over which it is integrated, instead of a field", "interface").optional();
  schema.vector("at", "point in the reference configuration").unit("m").optional();
  schema.names("on", "boundaries instead of a point").naming("boundary").optional();
  schema.text(
      "quantity",
      "an unknown or another quantity of the field (`seam explain` lists them); reaction, the force that "
      "holds what is prescribed on `on`; or force and moment, what the side named first (`field` of a cut, "
      "`from`) exerts through `interface` on the other: the body, `to`, the obstacle");
  schema.vector("about", "of a moment: the point, at rest; default the origin").unit("m").optional();
  schema.choice("component", "of a vector quantity; default all of them", {"x", "y", "z", "magnitude"})
      .optional();
  return schema;
}

Schema formula_schema() {
  Schema schema("A number computed from others at every step.");
  schema.text("value",
              "formula of what is recorded (with _ for the dots in its names: cylinder_volume), of the "
              "parameters and of the time t");
  return schema;
}

Schema statistic_schema() {
  Schema schema("What a series does over time, known at the end.");
  schema.text("of", "a probe or a formula");
  schema.choice(
      "what",
      "integral: over time; frequency: of the upward crossings of the mean; rise: largest increase from one "
      "step to the next; roughness: largest deviation of a value from the cubic through its four "
      "neighbours, over the largest magnitude; curvature: largest second derivative in time; kink: the same "
      "over the median one; kink_time: where it is; onset: the first time at which it is above 0, infinite "
      "when "
      "it never is; release: the time after the last such, infinite when it lasts to the end",
      {"maximum", "minimum", "mean", "integral", "frequency", "rise", "roughness", "curvature", "kink",
       "kink_time", "onset", "release"});
  schema.number("from", "time from which on it counts; default the start").unit("s").optional();
  schema.number("to", "time up to which it counts; default the end").unit("s").optional();
  return schema;
}

Schema error_schema() {
  Schema schema("Norms of the difference to a known solution, at the end.");
  schema.reference("field", "whose solution is compared", "field");
  schema.text("unknown", "which of its unknowns");
  schema
      .reference("interface",
                 "over which the norms are taken, .h1 that of the normal derivative; default the "
                 "whole field",
                 "interface")
      .optional();
  schema.vector_expression("exact", "the known solution, one entry per component").entries(-1);
  schema.vector_expression("gradient", "its gradient for the H1 norm: d(1)/dx, d(1)/dy, ..., d(2)/dx, ...")
      .entries(-1)
      .optional();
  return schema;
}

Schema output_schema() {
  Schema restart("Points from which an interrupted run continues.");
  restart.integer("every", "steps between them; 0: by the clock only").at_least(0).otherwise("0");
  restart.number("minutes", "wall time between them; 0: by steps only").at_least(0).otherwise("10");
  restart.integer("keep", "how many of the last ones are kept").at_least(1).otherwise("2");

  Schema schema("What the run writes.");
  schema.text("folder", "where to; default `results/` and the scene's name").optional();
  schema.integer("every", "steps between two outputs of the fields").at_least(1).otherwise("1");
  schema.boolean("fields", "write the fields as VTU, with a PVD file for the time series").otherwise("true");
  schema.boolean("cut", "write the cut cells, interface points and ghost faces of fields that bodies cut")
      .otherwise("false");
  schema
      .boolean("interfaces",
               "write what couplings measure at each point of their interfaces, as tractions, in CSV tables")
      .otherwise("false");
  schema.object("picture", "a picture of the last state", picture_schema()).optional();
  schema.map("probes", "numbers recorded at every step, as CSV", probe_schema()).otherwise("{}");
  schema.value_map("formulas", "numbers computed from probes at every step", formula_schema())
      .otherwise("{}");
  schema.map("statistics", "extremes, means and frequencies of series", statistic_schema()).otherwise("{}");
  schema.map("errors", "comparison with known solutions", error_schema()).otherwise("{}");
  schema.object("restart", "points to continue from", restart).otherwise("{}");
  return schema;
}

Schema check_schema() {
  Schema schema("One thing that must hold at the end of the run; give `is` with `within`, or bounds.");
  schema.text("that", "the number to check: a probe, an error norm, a balance");
  schema
      .choice("kind",
              "what it says of the program: `exact` to rounding and the solvers' tolerances; `reference`, an "
              "outside value within the discretisation's error; `trend`, a sign, an order of magnitude or a "
              "shape; `regression`, a bound that comes from the program's own results",
              {"exact", "reference", "trend", "regression"})
      .otherwise("regression");
  schema.number("is", "its true value").optional();
  schema.text("within", "allowed deviation from `is`: relative as in 0.1%, or absolute").optional();
  schema.number("at_least", "lower bound").optional();
  schema.number("at_most", "upper bound").optional();
  schema.number("at", "time at which it is taken; default the end").unit("s").optional();
  schema.text("source", "where the reference comes from");
  return schema;
}

/// What `study` and `matrix` have in common.
Schema varying_schema(const std::string& summary, const std::string& vary) {
  Schema values("Values of one key.");
  values.names("values", "numbers, expressions or words, as they would stand in the scene");

  Schema schema(summary);
  schema.value_map("vary", vary, values);
  schema
      .names("together",
             "keys of `vary` that change together, all with as many values; the others form all combinations")
      .otherwise("[]");
  return schema;
}

Schema matrix_schema() {
  Schema known("Variants that fall short today: counted apart, and an error once they pass.");
  known.text("when", "which: a condition as that of `leave_out`");
  known.text("reason", "why they fall short, for reports");

  Schema agreement("Variants that differ in these keys alone must leave the same series.");
  agreement.names("over", "keys of `vary`");
  agreement.names("series", "columns of series.csv; none: all of them").otherwise("[]");
  agreement
      .number("within",
              "largest difference in any row, relative to the largest value of the series; of a component, "
              "that of its whole vector")
      .above(0);

  Schema schema = varying_schema(
      "Variants of this scene, each of which must meet the scene's checks: `seam verify --matrix`.",
      "key paths (a parameter's name alone will do) with the values each takes; `ranks`: of MPI; `restart`: "
      "`none`, or the number of ranks on which a run goes on that was ended in the middle of its time");
  schema
      .choice(
          "combine",
          "`all` combinations; or the fewest that hold each pair of values of two keys, which is where most "
          "of what breaks is found: keys that `agree` goes over are combined with all others",
          {"all", "pairs"})
      .otherwise("all");
  schema
      .text("leave_out",
            "variants that are not run: a condition on keys of `vary`, their values and the scene's "
            "parameters, solver.linear == krylov && ranks > 1")
      .optional();
  schema.list("known", "variants that fall short today", known).otherwise("[]");
  schema.list("agree", "variants that must agree with each other", agreement).otherwise("[]");
  return schema;
}

Schema study_schema() {
  Schema schema =
      varying_schema("Runs of this scene over ranges of values, compared with each other by `seam study`.",
                     "key paths (a parameter's name alone will do) with the values each takes");
  schema
      .text("leave_out",
            "combinations that are not run: a condition on keys of `vary`, their values and the scene's "
            "parameters, order == 2 && n > 64")
      .optional();
  schema.names(
      "measure",
      "numbers of each run: probes, error norms, time, unknowns, seconds.total, peak_memory_bytes, or "
      "error(NAME): relative deviation of NAME from what the check of that name expects, or "
      "error(NAME, REFERENCE)");
  schema
      .boolean("until_failure",
               "runs that fail are part of the result: they are measured at their last good state")
      .otherwise("false");
  schema.text("against", "key of `vary` on the horizontal axis; default the last one").optional();
  return schema;
}

}  // namespace

Schema scene_schema() {
  Schema schema("A scene: meshes, fields on them, interfaces between fields, and what happens there.");
  schema.integer("format", "version of the scene's format; a newer one is refused")
      .at_least(1)
      .at_most(static_cast<double>(scene_format))
      .otherwise("1");
  schema.text("title", "what the scene shows");
  schema.text("source", "where it comes from: a paper, a benchmark").optional();
  schema
      .choice("tier", "when the tests run it: always, or at night because it takes long", {"fast", "nightly"})
      .otherwise("fast");
  schema.integer("dimension", "of space").at_least(2).at_most(3);
  schema.names("plugins", "plugins to load").naming("plugin").otherwise("[]");
  schema.names("plugin_folders", "further folders with plugins, relative to the scene").otherwise("[]");
  schema.value_map("parameters", "named constants for expressions in the scene", parameters_schema())
      .otherwise("{}");
  schema
      .typed_map("functions",
                 "known functions of position and time; expressions use their parts by name: exact.velocity",
                 "function")
      .otherwise("{}");
  schema.map("meshes", "the meshes", mesh_schema());
  schema.typed_map("fields", "the physics: unknowns on a mesh", "field");
  schema.typed_map("interfaces", "where fields meet", "interface").otherwise("{}");
  schema.typed_list("coupling", "what happens where fields meet", "coupling").otherwise("[]");
  schema.typed_list("constraints", "what ties unknowns to each other", "constraint").otherwise("[]");
  schema.object("time", "time span; without it, one static step to t = 1", time_schema()).optional();
  schema.object("solver", "how the equations are solved", solver_schema()).otherwise("{}");
  schema.object("output", "what the run writes", output_schema()).otherwise("{}");
  schema.list("checks", "what must hold at the end", check_schema()).otherwise("[]");
  schema.object("study", "runs over ranges of parameters, for `seam study`", study_schema()).optional();
  schema.object("matrix", "variants that must meet the checks, for `seam verify --matrix`", matrix_schema())
      .optional();
  return schema;
}

}  // namespace seam
