// SPDX-License-Identifier: BSD-3-Clause
// The conformance kit finds what is wrong: a check that cannot fail proves nothing.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "../cli/run_command.hpp"

using Catch::Matchers::Contains;

namespace {

struct Result {
  int code = -1;
  std::string output;
  /// "ok", "FAIL" or "skip" of the first check whose name holds the text; "" when there is none.
  [[nodiscard]] std::string outcome(const std::string& name) const {
    const std::size_t at = output.find(name);
    if (at == std::string::npos) return "";
    const std::size_t line = output.rfind('\n', at) + 1;
    const std::size_t word = output.find_first_not_of(' ', line);
    return output.substr(word, output.find(' ', word) - word);
  }
};

Result run_kit(const std::string& arguments) {
  const auto [code, output] = seam_cli_test::seam("plugin test " + arguments);
  return {code, output};
}

/// Runs the kit on the wrong plugin, with one of its materials in the scene.
Result test_material(const std::string& material, const std::string& options) {
  std::ifstream in(SEAM_WRONG_SCENE);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string key = "material: right";
  text.replace(text.find(key), key.size(), "material: " + material);
  const auto scene = std::filesystem::temp_directory_path() /
                     ("seam_wrong_" + std::to_string(std::random_device{}()) + ".yaml");
  std::ofstream(scene) << text;
  Result result = run_kit(SEAM_WRONG_PLUGIN " --scene " + scene.string() + " " + options);
  std::filesystem::remove(scene);
  INFO(result.output);
  CHECK(result.code == 1);
  return result;
}

}  // namespace

TEST_CASE("a right material passes where the wrong ones fail; schemas, coverage and own checks are judged") {
  const Result result = test_material("right", "--ranks 1");
  INFO(result.output);
  for (const char* name : {"gradient against", "Hessian against", "third derivatives against", "symmetry",
                           "no energy", "no stress", "restart", "rewind", "tangent: whole system",
                           "descriptor", "registration", "JSON Schema"})
    CHECK(result.outcome(name) == "ok");
  CHECK(result.outcome("number of ranks") == "skip");
  CHECK(result.outcome("the scene's own checks") == "FAIL");
  CHECK(result.outcome("schema of hyperelastic:undescribed") == "FAIL");
  CHECK_THAT(result.output, Contains("keys without help: silent"));
  CHECK_THAT(result.output, Contains("share"));
  CHECK(result.outcome("used by a scene: hyperelastic:right") == "ok");
  CHECK(result.outcome("used by a scene: hyperelastic:counts") == "FAIL");
}

TEST_CASE("a Hessian that is 1 % off is found in the material, in the term and in the system") {
  const Result result = test_material("wrong_hessian", "--ranks 1");
  INFO(result.output);
  CHECK(result.outcome("gradient against") == "ok");
  CHECK(result.outcome("Hessian against") == "FAIL");
  CHECK(result.outcome("tangent: whole system") == "FAIL");
  CHECK(result.outcome("tangent: seam::solid::InternalForce") == "FAIL");
  CHECK(result.outcome("tangent: seam::BodyLoad") == "ok");
}

TEST_CASE("third derivatives that are 1 % off are found") {
  const Result result = test_material("wrong_third", "--ranks 1");
  INFO(result.output);
  CHECK(result.outcome("Hessian against") == "ok");
  CHECK(result.outcome("third derivatives against") == "FAIL");
}

TEST_CASE("an energy that does not fit its gradient is found") {
  const Result result = test_material("wrong_energy", "--ranks 1");
  INFO(result.output);
  CHECK(result.outcome("gradient against") == "FAIL");
  CHECK(result.outcome("no energy undeformed") == "FAIL");
  CHECK(result.outcome("Hessian against") == "ok");
}

TEST_CASE("a material that remembers is found by the rewind and the restart") {
  const Result result = test_material("remembers", "--ranks 1");
  INFO(result.output);
  CHECK(result.outcome("rewind") == "FAIL");
  CHECK(result.outcome("restart") == "FAIL");
}

TEST_CASE("a result that depends on the number of ranks is found") {
  const Result result = test_material("counts", "--ranks 1,2");
  INFO(result.output);
  CHECK(result.outcome("the same on 1, 2 ranks") == "FAIL");
}

TEST_CASE("a plugin that does not register what it declares, or is none, fails before any scene runs") {
  const Result unpromised = run_kit(SEAM_BAD_PLUGINS "/libseam_unpromised.so");
  INFO(unpromised.output);
  CHECK(unpromised.code == 1);
  CHECK(unpromised.outcome("descriptor") == "ok");
  CHECK(unpromised.outcome("registration") == "FAIL");
  const Result other_abi = run_kit(SEAM_BAD_PLUGINS "/libseam_other_abi.so");
  CHECK(other_abi.code == 1);
  CHECK(other_abi.outcome("descriptor") == "FAIL");
  CHECK(run_kit("/nowhere/libseam_none.so").code == 2);
}
