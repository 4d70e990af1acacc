// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "seam/base/all_or_none.hpp"
#include "seam/base/checksum.hpp"
#include "seam/output/safe_file.hpp"

namespace seam {
namespace {

// File: magic, format number, length of a JSON header, header, doubles, checksum of all that.
constexpr char magic[8] = {'S', 'E', 'A', 'M', 'R', 'S', 'T', '4'};

/// Those that outlast a step.
std::vector<AnyState*> lasting_states(const Problem& problem) {
  std::vector<AnyState*> states = problem.state().states();
  std::erase_if(states, [](const AnyState* state) { return state->lasts_a_step(); });
  return states;
}

/// Calls with all levels of a state, of whatever type its numbers are.
template <class Use>
auto with_levels(AnyState& state, Use&& use) {
  if (auto* flags = dynamic_cast<StateArray<char>*>(&state)) return use(flags->all_levels());
  return use(dynamic_cast<StateArray<double>&>(state).all_levels());
}

/// How many levels a run goes on from: the next step takes over all but the last one. That at the start of
/// the last step is needed only where a state has one before it.
std::size_t kept_levels(AnyState& state) {
  return with_levels(state, [](const auto& levels) { return std::max<std::size_t>(levels.size(), 2) - 1; });
}

nlohmann::json describe(AnyState& state) {
  nlohmann::json about = {{"name", state.name()},
                          {"on", state.on().name()},
                          {"count", state.on().global_bound()},
                          {"size", state.size()}};
  if (const std::size_t levels = kept_levels(state); levels > 1) about["levels"] = levels;
  return about;
}

/// "water/order 1/value" with 3 numbers on each of 320 "node"
std::string in_words(const nlohmann::json& state) {
  if (!state.is_object()) return state.dump();
  const auto text = [&](const char* key) { return state.value(key, nlohmann::json()).dump(); };
  const std::string levels = state.contains("levels") ? fmt::format(" at {} times", text("levels")) : "";
  return fmt::format("{} with {} numbers on each of {} {}{}", text("name"), text("size"), text("count"),
                     text("on"), levels);
}

/// The numbers of a level by global number, on rank 0: [global number][component]. Collective.
std::vector<double> collect(AnyState& state, std::size_t level) {
  const Entities& on = state.on();
  const Communicator& communicator = on.communicator();
  std::vector<std::vector<int>> entities(communicator.size());
  std::vector<std::vector<double>> data(communicator.size());
  for (int e = 0; e < on.owned(); ++e) entities[0].push_back(on.global(e));
  with_levels(state, [&](const auto& levels) {
    const auto& from = levels[level];
    data[0].assign(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(on.owned()) * state.size());
  });
  const auto all_entities = communicator.exchange(entities);
  const auto all_data = communicator.exchange(data);
  if (communicator.rank() != 0) return {};
  const int size = state.size();
  std::vector<double> result(static_cast<std::size_t>(on.global_bound()) * size, 0.0);
  for (std::size_t r = 0; r < all_entities.size(); ++r)
    for (std::size_t k = 0; k < all_entities[r].size(); ++k)
      std::copy_n(all_data[r].begin() + static_cast<std::ptrdiff_t>(k) * size, size,
                  result.begin() + static_cast<std::ptrdiff_t>(all_entities[r][k]) * size);
  return result;
}

/// Takes the numbers of a level: [global number][component].
void take_level(AnyState& state, std::size_t level, const std::vector<double>& by_global_number) {
  const Entities& on = state.on();
  const auto size = static_cast<std::size_t>(state.size());
  with_levels(state, [&](auto& levels) {
    for (int e = 0; e < on.count(); ++e)
      for (std::size_t c = 0; c < size; ++c) {
        auto& number = levels[level][static_cast<std::size_t>(e) * size + c];
        number = static_cast<std::remove_reference_t<decltype(number)>>(
            by_global_number[static_cast<std::size_t>(on.global(e)) * size + c]);
      }
  });
}

std::string read_all(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(fmt::format("cannot read the restart point '{}'", file.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

Error damaged_file(const std::filesystem::path& file) {
  return Error(fmt::format("the restart point '{}' is damaged or incomplete", file.string()));
}

/// Header and payload of a complete file; throws when anything is damaged.
nlohmann::json parse(const std::filesystem::path& file, const std::string& bytes, const double*& payload,
                     std::size_t& count) {
  const auto damaged = [&] { return damaged_file(file); };
  std::uint64_t length = 0, sum = 0;
  constexpr std::size_t fixed = sizeof magic + sizeof length;
  constexpr std::size_t number = sizeof magic - 1;  // where the format's stands
  if (bytes.size() < fixed + sizeof sum || !std::equal(magic, magic + number, bytes.begin())) throw damaged();
  if (bytes[number] != magic[number] && bytes[number] >= '0' && bytes[number] <= '9')
    throw Error(
        fmt::format("the restart point '{}' was written by another version of Seam: found format {}, "
                    "expected {}; begin the run anew",
                    file.string(), bytes[number], magic[number]));
  if (bytes[number] != magic[number]) throw damaged();
  std::copy_n(bytes.data() + sizeof magic, sizeof length, reinterpret_cast<char*>(&length));
  std::copy_n(bytes.data() + bytes.size() - sizeof sum, sizeof sum, reinterpret_cast<char*>(&sum));
  if (checksum(bytes.substr(0, bytes.size() - sizeof sum)) != sum ||
      length > bytes.size() - fixed - sizeof sum)
    throw damaged();
  auto header = nlohmann::json::parse(
      bytes.begin() + fixed, bytes.begin() + static_cast<std::ptrdiff_t>(fixed + length), nullptr, false);
  if (!header.is_object()) throw damaged();
  payload = reinterpret_cast<const double*>(bytes.data() + fixed + length);
  count = (bytes.size() - fixed - length - sizeof sum) / sizeof(double);
  return header;
}

/// What the header says of the run; throws where something is missing, of another kind, or impossible.
RunState read_header(const std::filesystem::path& file, const nlohmann::json& header) {
  RunState state;
  try {
    state.time = header.at("time");
    state.step = header.at("step");
    state.step_number = header.at("step_number");
    state.iterations = header.at("iterations").get<std::vector<int>>();
    state.rejected_steps = header.at("rejected_steps");
    if (const auto refusals = header.find("refusals"); refusals != header.end())
      state.refusals = {refusals->at("length"), refusals->at("patience"), refusals->at("waiting")};
  } catch (const nlohmann::json::exception&) {
    throw damaged_file(file);
  }
  const Refusals& r = state.refusals;
  if (!(r.length >= 0) || r.patience < 0 || r.waiting < 0) throw damaged_file(file);
  if (!std::isfinite(state.time) || !std::isfinite(state.step) || !(state.step > 0) || state.step_number < 0)
    throw Error(
        fmt::format("the restart point '{}' holds the time {}, a step of {} s and the number {}: expected a "
                    "step above 0, "
                    "a finite time and a number from 0 on; resume from an older one",
                    file.string(), state.time, state.step, state.step_number));
  return state;
}

/// (name, number of values) of each series. A value belongs to a time.
std::vector<std::pair<std::string, std::size_t>> read_series(const std::filesystem::path& file,
                                                             const nlohmann::json& header) {
  std::vector<std::pair<std::string, std::size_t>> all;
  try {
    const std::size_t times = header.at("times");
    for (const auto& series : header.at("series")) {
      all.emplace_back(series.at("name"), series.at("size"));
      if (all.back().second != times) throw damaged_file(file);
    }
    all.emplace_back("time", times);
  } catch (const nlohmann::json::exception&) {
    throw damaged_file(file);
  }
  return all;
}

}  // namespace

void write_restart(const std::filesystem::path& file, const Problem& problem, const RunState& state,
                   const std::string& run) {
  nlohmann::json header;
  header["time"] = state.time;
  header["step"] = state.step;
  header["step_number"] = state.step_number;
  header["iterations"] = state.iterations;
  header["rejected_steps"] = state.rejected_steps;
  header["refusals"] = {{"length", state.refusals.length},
                        {"patience", state.refusals.patience},
                        {"waiting", state.refusals.waiting}};
  header["run"] = run;
  // Series are no JSON: they may be infinite, as a gap is where nothing is opposite.
  header["times"] = state.results.time.size();
  header["series"] = nlohmann::json::array();
  std::vector<double> payload = state.results.time;
  const auto append = [&](const std::vector<double>& values) {
    payload.insert(payload.end(), values.begin(), values.end());
  };
  for (const auto& [name, values] : state.results.series) {
    header["series"].push_back({{"name", name}, {"size", values.size()}});
    append(values);
  }
  for (AnyState* of : lasting_states(problem)) {
    header["states"].push_back(describe(*of));
    for (std::size_t level = 0; level < kept_levels(*of); ++level) append(collect(*of, level));
  }
  all_or_none<FileError>(problem.communicator(), [&] {
    if (problem.communicator().rank() != 0) return;
    // Aligns the doubles that follow.
    std::string text = header.dump();
    text.resize((text.size() + 7) / 8 * 8, ' ');
    const std::uint64_t length = text.size();
    std::string bytes(magic, sizeof magic);
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length).append(text);
    bytes.append(reinterpret_cast<const char*>(payload.data()), payload.size() * sizeof(double));
    const std::uint64_t sum = checksum(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    write_whole_file(file.string(), bytes, Durability::on_disk);
  });
}

RunState read_restart(const std::filesystem::path& file, Problem& problem) {
  const std::string bytes = read_all(file);
  const double* payload = nullptr;
  std::size_t count = 0;
  const nlohmann::json header = parse(file, bytes, payload, count);
  std::size_t at = 0, which = 0;
  const auto take = [&](std::size_t size) {
    if (size > count - at) throw damaged_file(file);
    const double* from = payload + std::exchange(at, at + size);
    return std::vector<double>(from, from + size);
  };
  RunState state = read_header(file, header);
  const auto all_series = read_series(file, header);
  const nlohmann::json states = header.value("states", nlohmann::json::array());
  state.results.time = take(all_series.back().second);
  for (std::size_t s = 0; s + 1 < all_series.size(); ++s)
    state.results.series[all_series[s].first] = take(all_series[s].second);
  for (AnyState* of : lasting_states(problem)) {
    const nlohmann::json expected = describe(*of);
    const bool is_there = states.is_array() && which < states.size();
    if (!is_there || states[which] != expected)
      throw Error(
          fmt::format("the restart point '{}' does not fit this scene: found {}, expected {}; its mesh or "
                      "the order of its "
                      "unknowns has changed, with which no run can go on",
                      file.string(), is_there ? in_words(states[which]) : "nothing", in_words(expected)));
    const std::size_t size = static_cast<std::size_t>(of->on().global_bound()) * of->size();
    of->take(take(size));
    for (std::size_t level = 1; level < kept_levels(*of); ++level) take_level(*of, level, take(size));
    ++which;
  }
  if (at != count) throw damaged_file(file);
  problem.state().resumed(state.time);
  return state;
}

std::filesystem::path latest_restart(const std::vector<std::filesystem::path>& points, const std::string& run,
                                     std::vector<std::string>& warnings) {
  for (const std::filesystem::path& point : points) {
    try {
      const double* payload = nullptr;
      std::size_t count = 0;
      const nlohmann::json header = parse(point, read_all(point), payload, count);
      const auto found = header.find("run");
      if (found != header.end() && *found == run) return point;
      warnings.push_back(fmt::format("the restart point '{}' was written by another run", point.string()));
    } catch (const Error& error) {
      warnings.emplace_back(error.what());
    }
  }
  return {};
}

}  // namespace seam
