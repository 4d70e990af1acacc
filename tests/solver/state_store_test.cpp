// SPDX-License-Identifier: BSD-3-Clause
// What is rewound with a step, and what goes on to the next one.
#include "seam/state/state_store.hpp"

#include <catch2/catch.hpp>

#include "diffusion.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/record/restart.hpp"

using namespace seam;
using Catch::Matchers::Contains;

namespace {

std::shared_ptr<const Mesh> square(int cells) {
  return std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, cells), Communicator());
}

/// Unknowns of nodes around which bodies may part the cells.
class Parted final : public Physics {
 public:
  explicit Parted(bool parts) : parts_(parts) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, 1, 1, ""}}; }
  [[nodiscard]] bool separates_parts() const override { return parts_; }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(test::Diffusion{1}), {"c"});
    setup.prescribe("x_min", "c", 0, Expression(0.0), {});
  }

 private:
  bool parts_;
};

}  // namespace

TEST_CASE("states go back to the bit, at present and at the start of the step, and with them what is kept") {
  const auto mesh = square(2);
  StateStore whole, part;
  whole.include(part);
  StateArray<double>& numbers = part.add<double>({"numbers", cells_of(*mesh), 2, 3}, 7.0);
  StateArray<char>& flag = whole.add<char>({"flag", the_run(mesh->communicator())});
  std::shared_ptr<const int> kept = std::make_shared<int>(4);
  part.keep(kept);
  double returned = -1;
  part.on_return([&](double time) { returned = time; });
  REQUIRE(numbers.now() == std::vector<double>(8, 7.0));

  numbers.now()[3] = 1;
  whole.advance();
  numbers.now()[3] = 2;
  whole.advance();
  numbers.now()[3] = 0.1 + 0.2;
  flag.now()[0] = 1;
  const StateStore::Snapshot before = whole.snapshot(0.5), present_only = whole.snapshot(0.25, false);
  for (std::vector<double>& level : numbers.all_levels()) level[3] = -1;
  CHECK(relative_difference(before, whole.snapshot(0.5)) == Approx(1.3 / 7));
  flag.now()[0] = 0;
  kept = std::make_shared<int>(5);
  CHECK(differences(whole, before, whole.snapshot(0.5)) == std::vector<std::string>{"flag", "numbers"});

  whole.restore(before);
  CHECK(returned == 0.5);
  CHECK(numbers.now()[3] == 0.1 + 0.2);
  CHECK(numbers.old()[3] == 2);
  CHECK(numbers.all_levels()[2][3] == 1);
  CHECK(flag.now()[0] == 1);
  CHECK(*kept == 4);
  CHECK(differences(whole, before, whole.snapshot(0)).empty());

  for (std::vector<double>& level : numbers.all_levels()) level[3] = -1;
  whole.restore(present_only);
  CHECK(numbers.now()[3] == 0.1 + 0.2);
  CHECK(numbers.old()[3] == -1);
  numbers.begin_anew(1);
  for (const std::vector<double>& level : numbers.all_levels()) CHECK(level[3] == 7);

  whole.resumed(2);
  CHECK(returned == 2);
  CHECK(kept == nullptr);
}

TEST_CASE("a name stands for one state, which several may share where all of them say so") {
  const Communicator communicator;
  StateStore store;
  StateArray<char>& first = store.share<char>({"deep", the_run(communicator)});
  CHECK(&store.share<char>({"deep", the_run(communicator)}) == &first);
  CHECK_THROWS_WITH(store.add<char>({"deep", the_run(communicator)}),
                    Contains("two states are called 'deep'"));
}

TEST_CASE("a state is found again by global numbers", "[ranks]") {
  const auto mesh = square(5);
  StateStore store;
  for (const auto& on : {cells_of(*mesh), points_of_cells(*mesh, 4)}) {
    StateArray<double>& state = store.add<double>({on->name(), on, 2, 2});
    std::vector<double> all(static_cast<std::size_t>(on->global_bound()) * 2);
    CHECK(on->global_bound() == (on->name() == "cell" ? 25 : 100));
    const int points = on->name() == "cell" ? 1 : 4;
    for (int e = 0; e < on->count(); ++e)
      CHECK(on->global(e) == mesh->global_cell(e / points) * points + e % points);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = 0.5 * static_cast<double>(i);
    state.take(all);
    for (int e = 0; e < on->count(); ++e)
      for (int c = 0; c < 2; ++c) {
        CHECK(state.now()[static_cast<std::size_t>(e) * 2 + c] == all[on->global(e) * 2 + c]);
        CHECK(state.old()[static_cast<std::size_t>(e) * 2 + c] == all[on->global(e) * 2 + c]);
      }
    state.old().assign(state.old().size(), -1);
    const std::vector<double> own = state.numbers();
    REQUIRE(own.size() == static_cast<std::size_t>(on->owned()) * 2);
    for (int e = 0; e < on->owned(); ++e) CHECK(own[2 * e + 1] == all[on->global(e) * 2 + 1]);
  }
  const Communicator& communicator = mesh->communicator();
  CHECK(communicator.sum(static_cast<long long>(the_run(communicator)->owned())) == 1);
}

TEST_CASE("a run goes on from all levels that its next step looks back to", "[ranks]") {
  const Communicator communicator;
  const auto problem_with = [&](int levels) {
    auto problem = test::diffusion_problem(CellType::quadrilateral, 4, {});
    problem->finish();
    problem->initialise(0);
    const Mesh& mesh = *problem->fields()[0].mesh;
    problem->state().add<double>({"history", cells_of(mesh), 2, levels});
    return problem;
  };
  const auto history = [](Problem& problem) -> std::vector<std::vector<double>>& {
    const std::vector<AnyState*> states = problem.state().states();
    return dynamic_cast<StateArray<double>&>(**std::ranges::find(states, "history", &AnyState::name))
        .all_levels();
  };
  const auto written = problem_with(4);
  const Mesh& mesh = *written->fields()[0].mesh;
  for (int step = 0; step < 4; ++step) {
    written->state().advance();
    for (int cell = 0; cell < mesh.cells(); ++cell)
      for (int c = 0; c < 2; ++c)
        history(*written)[0][static_cast<std::size_t>(cell) * 2 + c] =
            100 * step + 2 * mesh.global_cell(cell) + c;
  }
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("levels_on_" + std::to_string(communicator.size()));
  RunState state;
  state.step = 1;
  state.step_number = 4;
  write_restart(file, *written, state, "run");
  const auto read = problem_with(4);
  static_cast<void>(read_restart(file, *read));
  written->state().advance();
  read->state().advance();
  CHECK(history(*read) == history(*written));
  const auto other = problem_with(3);
  CHECK_THROWS_WITH(read_restart(file, *other), Contains("at 3 times") && Contains("at 2 times"));
}

TEST_CASE("an iteration goes back without the start of its step, but where sets of nodes may change") {
  for (const bool parts : {false, true}) {
    CAPTURE(parts);
    Problem problem{Communicator()};
    problem.add_field("water", square(2), std::make_unique<Parted>(parts));
    problem.finish();
    problem.initialise(0);
    Block& block = problem.fields()[0].field->blocks()[0];
    const StateStore::Snapshot before = problem.iterate(time_point(1, 1, 1));
    block.now.value[0] = block.old.value[0] = block.now.rate[0] = 3;
    block.known[0] = 0;
    problem.state().restore(before);
    CHECK(block.now.value[0] == 0);
    CHECK(block.now.rate[0] == 0);
    CHECK(block.known[0] == 1);
    CHECK(block.old.value[0] == (parts ? 0 : 3));
  }
}

TEST_CASE("nodal numbers that somebody adds to a field are extended to nodes that come alive") {
  const auto mesh = square(4);
  Field field("water", *mesh, {{"c", 1, 1, 0, ""}});
  const Space& space = *field.blocks()[0].space;
  StateArray<double>& added =
      field.state().add<double>({"added", nodes_of(space), 3, 1, WhenUncovered::extended});
  CHECK(added.now().size() == static_cast<std::size_t>(space.nodes()) * 3);
  const auto extended = field.state().extended_on(space);
  CHECK(extended.size() == 4);
  CHECK(extended.back() == &added);
}
