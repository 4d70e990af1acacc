// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "seam/record/series_units.hpp"

TEST_CASE("units of integrals follow the dimension of space") {
  CHECK(seam::unit_in_space("m^d", 2) == "m^2");
  CHECK(seam::unit_in_space("m^(d-1)", 2) == "m");
  CHECK(seam::unit_in_space("m/s m^((d-1)/2)", 2) == "m^1.5/s");
  CHECK(seam::unit_in_space("m/s m^((d-1)/2)", 3) == "m^2/s");
  CHECK(seam::unit_in_space("Pa m^(d-1)", 3) == "Pa m^2");
  CHECK(seam::unit_in_space("1/m m^(d-1)", 2).empty());
  CHECK(seam::unit_in_space("1/s", 3) == "1/s");
  CHECK(seam::unit_in_space("kg/m^3/s", 3) == "kg/m^3/s");
  CHECK(seam::unit_in_space("", 3).empty());
  // As plugins write them.
  CHECK(seam::unit_in_space("W/(m K)", 2) == "W/m/K");
  CHECK(seam::unit_in_space("mol/(m^2 s)", 2) == "mol/m^2/s");
  CHECK(seam::unit_in_space("J/(m^3 K) m^(d-1)", 3) == "J/m/K");
  for (const std::string odd : {"m^", "m^x", "a ( b", "^2", "m^(d", "%"})
    CHECK_NOTHROW(seam::unit_in_space(odd, 3));
}
