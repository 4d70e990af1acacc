#!/usr/bin/env bash
# Passes the tests; sets everything up first where that is needed.
#   tools/test.sh                 build, fast, scenes, install
#   tools/test.sh build fast      only these stages
#   tools/test.sh changed         before a commit: builds, and passes what the changed files can affect
#   tools/test.sh all             everything, as continuous integration does
#
# changed   what differs from HEAD, or where nothing does, the last commit; SEAM_CHANGED_SINCE=REV compares with another one.
#           The tests, scenes and formats which these files can affect, most likely to fail first, as far as they fit into
#           SEAM_CHANGED_SECONDS (240) by what earlier runs took; not part of `all`
# build     compile, warnings are errors
# fast      unit, property and command line tests
# scenes    every scene of configs/ in all variants of its matrix against its own checks, but for those of the nightly tier
# records   the records of the scenes of the nightly tier: still of these scenes, checks evaluated anew; a few seconds
# nightly   the scenes of the nightly tier, then `metamorphic` and `endurance`: long runs, not part of `all`
# metamorphic  all scenes of tests/metamorphic written anew, runs compared; `fast` has one scene of each family
# endurance    a scene of each family under valgrind, 2,000 steps of a moving cut
# install   plugins built out of tree against an installed Seam
# sanitize  the fast tests but for the studies among them, with address and undefined behaviour sanitizers
# fuzz      the readers of scenes and meshes, 60 s each
# format    clang-format
# tidy      clang-tidy on the files that changed
#
# What failed is said once more at the end, in at most 100 lines, each with the command which runs it alone (after
# `source tools/setup.sh`). The last line counts test cases, scenes and the stages that hold a single one. The exit code is 0 only if none failed.
set -uo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$seam_root" || exit 1

all_stages=(build fast scenes records install sanitize fuzz format tidy)
passed=0
failed=0
failed_stages=()

count() {
  passed=$((passed + $1))
  failed=$((failed + $2))
  [ "$2" = 0 ]
}

# For a stage that is one test: counts the exit code of the command before it.
count_one() { if [ "$1" = 0 ]; then count 1 0; else count 0 1; fi; }

# run_ctest FOLDER ARGUMENTS: runs ctest and counts its tests, those made with Catch2 by their cases.
run_ctest() {
  local folder=$1 log=$1/$stage.log
  shift
  # The limit ends what hangs, on a slow machine too: the longest test takes 10 minutes on a quick one.
  ctest --test-dir "$folder" -V -j "$seam_jobs" --timeout 3600 "$@" >"$log" 2>&1
  local code=$?
  grep -E '^ *[0-9]+/[0-9]+ Test +#' "$log"
  if [ $code != 0 ]; then
    # What failed, without the output of what did not.
    local bad
    bad=$(sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#([0-9]+):.*(\*\*\*|Not Run).*/\1/p' "$log")
    for number in $bad; do grep -E "^$number: " "$log" | tail -n 60; done
    [ -n "$bad" ] || tail -n 20 "$log"
  fi
  # shellcheck disable=SC2046  # two numbers
  count $(count_ctest "$log" $code)
}

# "passed failed" of a log of ctest -V, whose lines start with the number of the test they come from.
count_ctest() {
  awk -v code="$2" '
    /^[0-9]+: All tests passed/ { n = $1; if (match($0, /in [0-9]+ test case/)) good[n] = substr($0, RSTART + 3) + 0 }
    /^[0-9]+: test cases:/ {
      n = $1
      if (match($0, /[0-9]+ passed/)) good[n] = substr($0, RSTART) + 0
      if (match($0, /[0-9]+ failed/)) bad[n] = substr($0, RSTART) + 0
    }
    /^ *[0-9]+\/[0-9]+ Test +#[0-9]+:/ {
      match($0, /#[0-9]+:/); n = substr($0, RSTART + 1, RLENGTH - 1)
      if ($0 ~ / Passed /) p += (n in good) ? good[n] : 1
      else { p += good[n]; f += (bad[n] > 0) ? bad[n] : 1 }
    }
    END { if (code != 0 && f == 0) f = 1; print p + 0, f + 0 }' "$1"
}

stage_build() {
  seam_configure "$seam_build" && seam_ninja "$seam_build"
  count_one $?
}

stage_changed() {
  seam_configure "$seam_build" && seam_ninja "$seam_build" || { count 0 1; return 1; }
  # Writes what is to be run as tests of CTest, in this order.
  tools/changed.py "$seam_build" || { count 0 1; return 1; }
  run_ctest "$seam_build/changed"
  local code=$?
  tools/changed.py "$seam_build" --learn
  return $code
}

stage_fast() { run_ctest "$seam_build" --label-exclude 'slow|install'; }

stage_install() { run_ctest "$seam_build" --label-regex install; }

stage_scenes() { verify_scenes fast --cover core --cover cutfem_fluid --cover manufactured --cover mortar_contact --cover nitsche_fsci --cover poroelasticity --cover solid; }

stage_records() {
  local log=$seam_build/records.log
  tools/check_records.py "$seam_build/bin/seam" >"$log" 2>&1
  local code=$? sums
  grep -vE '^[0-9]+ passed, [0-9]+ failed$' "$log"
  sums=$(sed -nE 's/^([0-9]+) passed, ([0-9]+) failed$/\1 \2/p' "$log")
  # shellcheck disable=SC2086  # two numbers
  if [ -n "$sums" ]; then count $sums; else count_one $code; fi
}

stage_nightly() {
  local failed_before=$failed
  # Some take hours, several at once on a machine with others.
  verify_scenes nightly --time-limit 2d
  stage_metamorphic
  stage_endurance
  [ "$failed" = "$failed_before" ]
}

stage_metamorphic() {
  local log=$seam_build/metamorphic.log
  tests/metamorphic/metamorphic.py "$seam_build/bin/seam" >"$log" 2>&1
  local code=$? sums
  grep -v '^ok' "$log"
  # Without this line the program broke off.
  sums=$(sed -nE 's/^([0-9]+) passed, ([0-9]+) failed$/\1 \2/p' "$log")
  # shellcheck disable=SC2086  # two numbers
  if [ -n "$sums" ]; then count $sums; else count_one $code; fi
}

stage_endurance() {
  local failed_before=$failed
  local log=$seam_build/endurance.log
  tests/endurance/valgrind.py "$seam_build/bin/seam" 2>&1 | tee "$log"
  count_one "${PIPESTATUS[0]}"
  tests/endurance/moving_cut.py "$seam_build/bin/seam" 2>&1 | tee -a "$log"
  count_one "${PIPESTATUS[0]}"
  [ "$failed" = "$failed_before" ]
}

# verify_scenes TIER OPTIONS: runs the scenes of a tier in all their variants and compares them with their checks.
verify_scenes() {
  local folder=$seam_build/$stage tier=$1 code sums
  shift
  rm -rf "$folder"
  (cd "$seam_root" && "$seam_build/bin/seam" verify --matrix configs --tier "$tier" --folder "$folder" --jobs "$seam_jobs" "$@") 2>&1 |
    tee "$seam_build/$stage.log"
  code=${PIPESTATUS[0]}
  # Without this line the command broke off.
  sums=$(sed -nE 's/^[0-9]+ variants?: ([0-9]+) ok, ([0-9]+) known to fall short, ([0-9]+) failed$/\1 \2 \3/p' "$seam_build/$stage.log")
  read -r ok known bad <<<"$sums"
  if [ -n "$sums" ] && { [ "$code" = 0 ] || [ "$bad" != 0 ]; }; then count $((ok + known)) "$bad"; else count_one "$code"; fi
}

stage_sanitize() {
  local folder=$seam_build-sanitize
  seam_configure "$folder" -DSEAM_SANITIZE=ON -DCMAKE_BUILD_TYPE=Sanitize -DCMAKE_CXX_FLAGS_SANITIZE=-O1 \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON &&
    seam_ninja "$folder" || { count 0 1; return 1; }
  # Open MPI never frees some memory and unloads the parts of it that took it, so that no suppression can name them.
  # Leaks in the readers are found by the fuzz targets, which run without MPI.
  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 \
    run_ctest "$folder" --label-exclude 'slow|install|unsanitized'
}

stage_fuzz() {
  local folder=$seam_build-fuzz
  seam_configure "$folder" -DSEAM_FUZZ=ON -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ || { count 0 1; return 1; }
  local targets=()
  for source in tests/fuzz/*_fuzz.cpp; do targets+=("$(basename "$source" .cpp)"); done
  seam_ninja "$folder" "${targets[@]}" || { count 0 1; return 1; }
  # Each process is content with one core.
  run_ctest "$folder"
}

sources() { find core plugins tools tests -name '*.cpp' -o -name '*.hpp'; }

stage_format() {
  sources | xargs clang-format --dry-run -Werror 2>"$seam_build/format.log"
  local code=$?
  [ $code = 0 ] || sed -nE 's/^([^:]+):[0-9]+:.*/\1/p' "$seam_build/format.log" | sort | uniq -c |
    sed 's/$/: not formatted; clang-format -i mends it/'
  count_one $code
}

stage_tidy() {
  seam_configure "$seam_build" || { count 0 1; return 1; }
  tools/tidy.sh "$seam_build" 2>&1 | tee "$seam_build/tidy.log"
  count_one "${PIPESTATUS[0]}"
}

# What is said at the end comes from logs: those of an earlier run would tell of that.
forget_logs() {
  case $1 in
    sanitize | fuzz) rm -f "$seam_build-$1"/{build,"$1"}.log ;;
    build | changed) rm -rf "$seam_build"/build.log "$seam_build/changed" ;;
    nightly) rm -rf "$seam_build"/{nightly,nightly.log,metamorphic.log,endurance.log} ;;
    scenes) rm -rf "$seam_build"/{scenes,scenes.log} ;;
    *) rm -f "$seam_build/$1.log" ;;
  esac
}

run_stage() {
  local start=$SECONDS code
  forget_logs "$1"
  echo "== $1"
  "stage_$1"
  code=$?
  echo "-- $1: $([ $code = 0 ] && echo ok || echo FAILED), $((SECONDS - start)) s"
  [ $code = 0 ] || failed_stages+=("$1")
  return $code
}

stages=("$@")
[ $# = 0 ] && stages=(build fast scenes install)
[ "${stages[*]}" = all ] && stages=("${all_stages[@]}")
for stage in "${stages[@]}"; do
  if [[ " ${all_stages[*]} changed nightly metamorphic endurance " != *" $stage "* ]]; then
    echo "There is no stage '$stage'; there are: ${all_stages[*]}, changed, nightly, metamorphic, endurance, and 'all'" >&2
    exit 2
  fi
done

echo "== packages"
start=$SECONDS
seam_install_packages || exit 1
echo "-- packages: ok, $((SECONDS - start)) s"
mkdir -p "$seam_build"
for stage in "${stages[@]}"; do
  # Nothing can be said about what does not compile.
  run_stage "$stage" || { [ "$stage" = build ] && break; }
done
if [ ${#failed_stages[@]} != 0 ]; then
  tools/what_failed.py "$seam_build" "${failed_stages[@]}"
  echo "failed: ${failed_stages[*]}"
fi
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
