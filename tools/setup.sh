# shellcheck shell=bash
# Sourced by run.sh and test.sh: installs what is missing, configures, builds. Fast when nothing is to be done.
#
# Variables: SEAM_BUILD      build folder (default: build, in the source folder)
#            SEAM_JOBS       compilations and tests at a time (default: number of cores)
#            SEAM_NO_INSTALL when set, packages are left alone

seam_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
seam_build=$(realpath -m "${SEAM_BUILD:-$seam_root/build}")
seam_jobs=${SEAM_JOBS:-$(nproc)}

# What the compiler cache holds of one checkout serves all others.
export CCACHE_BASEDIR=$seam_root CCACHE_NOHASHDIR=1
# It may keep what was compiled with precompiled headers.
export CCACHE_SLOPPINESS=pch_defines,time_macros
# One thread per process: BLAS threads only fight over the cores.
export OPENBLAS_NUM_THREADS=1
if [ "$(id -u)" = 0 ]; then
  # Open MPI asks root to confirm that it is meant.
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
# Shared-memory tricks of Open MPI need rights that containers often withhold.
export OMPI_MCA_btl_vader_single_copy_mechanism=none
# All ranks are on this machine: to try every kind of network takes 0.2 s at each start.
export OMPI_MCA_pml=ob1
# Tests run side by side: a rank that waits leaves its core to one that works.
export OMPI_MCA_mpi_yield_when_idle=1

seam_needed_packages() { sed 's/#.*//; s/[[:space:]]//g; /^$/d' "$seam_root/tools/packages.txt"; }

# Names of the needed packages that are not installed.
seam_missing_packages() {
  local installed
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Abbrev}\n' 2>/dev/null | awk '$2 == "ii" {print $1}')
  seam_needed_packages | grep -vxF -f <(printf '%s\n' "$installed") || true
}

seam_install_packages() {
  [ -n "${SEAM_NO_INSTALL:-}" ] && return 0
  if ! command -v dpkg-query >/dev/null; then
    echo "This is no Debian: what tools/packages.txt lists is taken as installed." >&2
    return 0
  fi
  local missing
  missing=$(seam_missing_packages)
  [ -z "$missing" ] && return 0
  if [ "$(id -u)" != 0 ]; then
    echo "Packages are missing; as root run:" >&2
    echo "  apt-get install --no-install-recommends" $missing >&2
    return 1
  fi
  echo "Installing $(wc -w <<<"$missing") packages"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq || return 1
  # shellcheck disable=SC2086  # one word a package
  apt-get install -y -qq --no-install-recommends $missing >/dev/null || {
    echo "apt-get could not install: $missing" >&2
    return 1
  }
}

# seam_configure FOLDER [cmake options]: only when the folder is new; Ninja calls CMake again when its files change.
seam_configure() {
  local folder=$1
  shift
  [ -f "$folder/build.ninja" ] && return 0
  local launcher=() linker=()
  if command -v ccache >/dev/null; then
    launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  if command -v mold >/dev/null; then
    linker=(-DCMAKE_{EXE,SHARED,MODULE}_LINKER_FLAGS=-fuse-ld=mold)
  fi
  mkdir -p "$folder"
  if ! cmake -S "$seam_root" -B "$folder" -G Ninja "${launcher[@]}" "${linker[@]}" "$@" >"$folder/configure.log" 2>&1; then
    # A folder that was configured by half would be taken for a good one the next time.
    rm -f "$folder/build.ninja" "$folder/CMakeCache.txt"
    tail -n 40 "$folder/configure.log" >&2
    return 1
  fi
}

# seam_ninja FOLDER [targets]: one line of progress; on failure what the compiler said.
seam_ninja() {
  local folder=$1
  shift
  local log=$folder/build.log
  if [ -t 1 ]; then
    # What failed fails once more, for the log.
    ninja -C "$folder" -j "$seam_jobs" "$@" || { ninja -C "$folder" -j "$seam_jobs" "$@" >"$log" 2>&1; return 1; }
    return
  fi
  if ninja -C "$folder" -j "$seam_jobs" "$@" >"$log" 2>&1; then
    tail -n 1 "$log"
  else
    grep -vE '^\[[0-9]+/[0-9]+\] (Building|Linking)' "$log" | tail -n 80 >&2
    return 1
  fi
}
