// SPDX-License-Identifier: BSD-3-Clause
#include "selection.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>

#include "seam/base/diagnostics.hpp"

namespace seam::cli {
namespace {

namespace fs = std::filesystem;

/// A pattern in which * and ? alone have a meaning: names of variants may hold brackets.
std::string pattern_of(const std::string& filter) {
  std::string pattern = "*";
  for (const char c : filter) pattern += std::string(c == '[' || c == ']' || c == '\\' ? "\\" : "") + c;
  return pattern + "*";
}

bool matches(const std::string& filter, const MatrixPlan& plan, const Variant& variant) {
  const std::string name = plan.scene.string() + ": " + variant.name;
  return filter.empty() || name.find(filter) != std::string::npos ||
         fnmatch(pattern_of(filter).c_str(), name.c_str(), 0) == 0;
}

/// For each variant the first one that it must, directly or by others, agree with; itself when there is none.
std::vector<std::size_t> bundles(const MatrixPlan& plan) {
  std::vector<std::size_t> first(plan.variants.size());
  std::iota(first.begin(), first.end(), 0);
  for (bool changes = true; changes;) {
    changes = false;
    for (const Agreement& agreement : plan.agreements)
      for (const std::vector<std::size_t>& group : agreement.groups) {
        std::size_t least = first[group.front()];
        for (const std::size_t i : group) least = std::min(least, first[i]);
        for (const std::size_t i : group) {
          changes = changes || first[i] != least;
          first[i] = least;
        }
      }
  }
  return first;
}

int parse_number(const char* begin, const char* end) {
  int number = 0;
  const auto [last, code] = std::from_chars(begin, end, number);
  return code == std::errc{} && last == end ? number : 0;
}

}  // namespace

std::pair<int, int> parse_shard(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const char* const begin = text.data();
  const int part = parse_number(begin, begin + slash);
  const int parts = slash < text.size() ? parse_number(begin + slash + 1, begin + text.size()) : 0;
  if (part < 1 || part > parts)
    throw Error(fmt::format("found '{}', expected a part of all, as 2/5: from 1/5 to 5/5", text));
  return {part, parts};
}

std::string parse_tier(const std::string& text) {
  if (text != "fast" && text != "nightly" && text != "all")
    throw Error(fmt::format("found '{}', expected fast, nightly or all", text));
  return text;
}

std::vector<FoundScene> find_scenes(const std::vector<std::string>& files_and_folders) {
  std::vector<FoundScene> scenes;
  std::set<fs::path> seen;
  const auto add = [&](const fs::path& file, bool is_named) {
    std::error_code error;
    if (seen.insert(fs::weakly_canonical(file, error)).second) scenes.push_back({file, is_named});
  };
  for (const std::string& name : files_and_folders) {
    if (!fs::is_directory(name)) {
      add(name, true);
      continue;
    }
    std::vector<fs::path> here;
    for (auto entry = fs::recursive_directory_iterator(name); entry != fs::recursive_directory_iterator();
         ++entry) {
      const bool is_hidden = entry->path().filename().native().starts_with('.');
      if (is_hidden && entry->is_directory()) entry.disable_recursion_pending();
      if (!is_hidden && entry->is_regular_file() && entry->path().extension() == ".yaml")
        here.push_back(entry->path());
    }
    if (here.empty()) throw Error({name}, "the folder holds no scenes: no file whose name ends with .yaml");
    std::ranges::sort(here);
    for (const fs::path& file : here) add(file, false);
  }
  return scenes;
}

std::vector<VariantId> select(const std::vector<MatrixPlan>& plans, const Selection& selection) {
  std::vector<VariantId> chosen;
  std::size_t bundle_number = 0;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    const MatrixPlan& plan = plans[p];
    const bool in_tier =
        selection.tier == "all" || plan.tier.empty() || plan.is_named || selection.tier == plan.tier;
    if (!in_tier) continue;
    const std::vector<std::size_t> first = bundles(plan);
    std::set<std::size_t> failed;  // bundles
    for (std::size_t v = 0; v < first.size() && selection.failed; ++v)
      if (selection.failed->contains(name_of(plan, plan.variants[v]))) failed.insert(first[v]);
    std::vector<std::size_t> part(first.size());
    for (std::size_t v = 0; v < first.size(); ++v) {
      part[v] = first[v] == v ? bundle_number++ : part[first[v]];
      const bool in_shard = !selection.shard || part[v] % selection.shard->second + 1 ==
                                                    static_cast<std::size_t>(selection.shard->first);
      const bool is_wanted = !selection.failed || failed.contains(first[v]);
      if (in_shard && is_wanted && matches(selection.filter, plan, plan.variants[v]))
        chosen.emplace_back(p, v);
    }
  }
  return chosen;
}

}  // namespace seam::cli
