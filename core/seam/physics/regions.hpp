// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "seam/physics/physics.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

/// Bodies of several materials: the key `regions` of a field, whose entries give what differs in some regions
/// of the mesh; for what they do not give the field's own values hold.
namespace seam {

/// Adds the keys that may differ by region, for the field and for the entries of `regions`.
/// @param declare adds them to a schema; each optional or with a default
template <class Declare>
void declare_regions(Schema& field, const Declare& declare) {
  declare(field);
  Schema region("A region of other material; what is not given here is as the field says.");
  region.names("on", "Regions of the mesh").naming("region");
  declare(region);
  field
      .list("regions", "Regions of other material, which together are all of the mesh; default one for all",
            region)
      .otherwise("[]");
}

/// Where the values of one region stand.
class MaterialOfRegion {
 public:
  MaterialOfRegion(const Parameters& field, const Parameters* region) : field_(&field), region_(region) {}
  /// What holds the value of a key: the region where it gives it, else the field.
  [[nodiscard]] const Parameters& operator()(const std::string& key) const {
    return region_ && region_->given(key) ? *region_ : *field_;
  }

 private:
  const Parameters* field_;
  const Parameters* region_;
};

/// One for each entry of `regions`; where there is none, one for the whole.
/// @param required keys that region or field must give
/// @throws Error when neither does
inline std::vector<MaterialOfRegion> materials(const Parameters& field,
                                               const std::vector<std::string>& required) {
  std::vector<MaterialOfRegion> result;
  for (const Parameters& region : field.list("regions")) result.emplace_back(field, &region);
  if (result.empty()) result.emplace_back(field, nullptr);
  for (std::size_t k = 0; k < result.size(); ++k)
    for (const std::string& key : required)
      if (!result[k](key).has(key)) {
        const bool whole = field.list("regions").empty();
        throw Error(whole ? field.where() : field.list("regions")[k].where(),
                    whole ? "expected the key '" + key + "', or `regions` that give it"
                          : "expected the key '" + key + "', here or beside `regions`, for all of them");
      }
  return result;
}

/// Whether something holds in all regions, where it must hold in all or in none: it decides which rates an
/// unknown has.
/// @throws Error when it holds in some only
template <class Regions, class Holds>
bool holds_in_all(const Parameters& field, const Regions& regions, const Holds& holds,
                  const std::string& what) {
  const auto count = std::ranges::count_if(regions, holds);
  if (count != 0 && count != std::ranges::ssize(regions))
    throw Error(field.where("regions"),
                "some regions have " + what + " and some have not; expected all or none");
  return count > 0;
}

/// Tells the regions of the key `regions` apart, in this order.
inline void divide(FieldSetup& setup, const Parameters& field) {
  std::vector<std::pair<std::vector<std::string>, Location>> names;
  for (const Parameters& region : field.list("regions"))
    names.emplace_back(region.names("on"), region.where("on"));
  if (!names.empty()) setup.divide(names);
}

}  // namespace seam
