// SPDX-License-Identifier: BSD-3-Clause
#include "pairs.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

namespace seam::cli {
namespace {

using Pair = std::tuple<std::size_t, std::string, std::size_t, std::string>;

/// Variants that are taken, or not, as one, and the pairs of values that they hold.
struct Bundle {
  std::vector<std::size_t> variants;
  std::set<Pair> pairs;
};

std::vector<Bundle> bundle(const std::vector<Variant>& variants, const std::set<std::size_t>& whole) {
  std::vector<Bundle> bundles;
  std::map<std::vector<std::string>, std::size_t> places;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const std::vector<std::string>& values = variants[i].values;
    std::vector<std::string> chosen;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!whole.contains(k)) chosen.push_back(values[k]);
    const auto [place, is_new] = places.try_emplace(chosen, bundles.size());
    if (is_new) bundles.emplace_back();
    Bundle& bundle = bundles[place->second];
    bundle.variants.push_back(i);
    for (std::size_t k = 0; k < values.size(); ++k)
      for (std::size_t m = k + 1; m < values.size(); ++m) bundle.pairs.emplace(k, values[k], m, values[m]);
    // A key alone has no pairs, but values that must come.
    if (values.size() == 1) bundle.pairs.emplace(0, values[0], 0, values[0]);
  }
  return bundles;
}

}  // namespace

std::vector<Variant> fewest_with_all_pairs(const std::set<std::size_t>& whole,
                                           std::vector<Variant> variants) {
  std::vector<Bundle> bundles = bundle(variants, whole);
  std::set<Pair> open;
  for (const Bundle& b : bundles) open.insert(b.pairs.begin(), b.pairs.end());
  std::set<std::size_t> taken;
  while (!open.empty()) {
    const auto gain = [&](const Bundle& b) {
      return std::ranges::count_if(b.pairs, [&](const Pair& pair) { return open.contains(pair); });
    };
    // The first of those that gain most.
    const auto best = std::ranges::max_element(bundles, {}, gain);
    for (const Pair& pair : best->pairs) open.erase(pair);
    taken.insert(best->variants.begin(), best->variants.end());
  }
  std::vector<Variant> result;
  for (const std::size_t i : taken) result.push_back(std::move(variants[i]));
  return result;
}

}  // namespace seam::cli
