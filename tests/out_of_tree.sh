#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs Seam into a folder of its own, builds plugins against that installation only, and runs their tests (their
# scenes, and the conformance kit): the template, a coupling of Seam's own fluid and solid, a law of friction in contact, one of adhesion, a linear solver and a
# block inverse, a constraint, a shape with an interface and a known function, a stabilisation.
# Usage: out_of_tree.sh <source folder> <build folder>
set -eu
source=$1
build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "out_of_tree: $1" >&2
  exit 1
}

cmake --install "$build" --prefix "$work/seam" >/dev/null
# Paths stay absolute, whatever a compiler cache is told elsewhere: they are looked at below.
export CCACHE_BASEDIR=
launcher=
if command -v ccache >/dev/null; then launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache; fi

# build_plugin NAME SOURCES: to $work/NAME-build
build_plugin() {
  # A copy, so that nothing is found by its place in the source tree.
  cp -r "$2" "$work/$1"
  cmake -S "$work/$1" -B "$work/$1-build" -G Ninja -DCMAKE_PREFIX_PATH="$work/seam" $launcher \
    -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wshadow -Werror"
  cmake --build "$work/$1-build"

  # Headers that the plugin was built with: installed ones, and none of the solver stack.
  ninja -C "$work/$1-build" -t deps >"$work/headers"
  grep -q "$work/seam/include/seam/plugin/plugin.hpp" "$work/headers" || fail "the installed headers were not used"
  if grep -q "$source/core" "$work/headers"; then fail "headers of the source tree were used"; fi
  if grep -iE "trilinos|Tpetra|Teuchos|Kokkos|vtk" "$work/headers"; then fail "a plugin must not need these headers"; fi

  ctest --test-dir "$work/$1-build" --output-on-failure
}

build_plugin example "$source/tools/template"
build_plugin friction "$source/tests/out_of_tree/friction"
build_plugin coulomb "$source/tests/out_of_tree/coulomb"
build_plugin adhesion "$source/tests/out_of_tree/adhesion"
build_plugin solvers "$source/tests/out_of_tree/solvers"
build_plugin rod "$source/tests/out_of_tree/rod"
build_plugin geometry "$source/tests/out_of_tree/geometry"
build_plugin stabilisation "$source/tests/out_of_tree/stabilisation"

# The material, the volume term and the CMake calls that make a plugin of them.
lines=$(cat "$work/example/mooney_rivlin.cpp" "$work/example/heat.cpp" | wc -l)
cmake_lines=$(sed -n '/^cmake_minimum/p;/^project/p;/^find_package/p;/^seam_add_plugin/,/)$/p' \
  "$work/example/CMakeLists.txt" | wc -l)
echo "material and volume term: $lines lines, CMake: $cmake_lines lines"
[ $((lines + cmake_lines)) -lt 100 ] || fail "material, volume term and CMake take 100 lines or more"

# What the template's workflows do, as it stands there, with the Seam that is installed.
for workflow in .github/workflows/test.yml .gitlab-ci.yml; do
  rm -rf "$work/workflow"
  cp -r "$source/tools/template" "$work/workflow"
  "$source/tests/out_of_tree/workflow.py" "$work/workflow/$workflow" >"$work/commands"
  (cd "$work/workflow" && env -u SEAM_PLUGIN_PATH SEAM="$work/seam" SEAM_REPOSITORY=none sh -eu "$work/commands") || fail "$workflow"
  grep -q '<testsuite name="conformance/steady_heat.yaml"' "$work/workflow/build/matrix/junit.xml" || fail "$workflow left no JUnit file"
done

# Installed, a plugin is found without any variable.
cmake --install "$work/example-build" --prefix "$work/seam" >/dev/null
cd "$work"
env -u SEAM_PLUGIN_PATH "$work/seam/bin/seam" verify "$work"/example/conformance/*.yaml --quiet
env -u SEAM_PLUGIN_PATH "$work/seam/bin/seam" plugin test "$work"/seam/lib*/seam/plugins/libseam_example.so --ranks 1

# Without the library that iterative solvers load, these say so, and direct ones run as ever.
rm "$work"/seam/lib*/libseam_preconditioners.so
krylov="$work/seam/bin/seam run $source/configs/solid/cook.yaml --no-picture --quiet --set output.fields=false"
if $krylov --folder "$work/krylov" --set solver.linear=krylov >"$work/log" 2>&1; then fail "preconditioners from elsewhere"; fi
grep -q "the library of preconditioners cannot be loaded" "$work/log" || fail "what is missing was not told: $(cat "$work/log")"
$krylov --folder "$work/direct"
