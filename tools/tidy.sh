#!/usr/bin/env bash
# clang-tidy on what changed; called by test.sh.
#   tools/tidy.sh BUILD          files that differ from the main branch, or from the last commit on it
#   tools/tidy.sh BUILD --all    all files
# Without git all files count as changed. A run over all stops after SEAM_TIDY_SECONDS (default 300) and says what it left.
set -uo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$seam_root" || exit 1
build=$(realpath -m "${1:-$seam_build}")
budget=${SEAM_TIDY_SECONDS:-300}

# The folder may belong to another user than the one who runs this.
git() { command git -c safe.directory='*' "$@"; }

# Prints the files that changed, one a line; fails when there is nothing to compare with.
changed_files() {
  local base
  base=$(git merge-base HEAD origin/main 2>/dev/null) || base=
  if [ -z "$base" ] || [ "$base" = "$(git rev-parse HEAD)" ]; then
    base=$(git rev-parse -q --verify HEAD~1 2>/dev/null) || return 1
  fi
  git diff --name-only --diff-filter=d "$base" 2>/dev/null && git ls-files --others --exclude-standard
}

# Source files that CMake compiles, relative to the root.
compiled() { sed -nE 's/^ *"file": "(.*)",?$/\1/p' "$build/compile_commands.json" | sed "s|^$seam_root/||" | sort -u; }

# The source files to look at: those that changed, and for a header one that includes it.
select_files() {
  if [ "${2:-}" = --all ] || ! changed_files >"$build/tidy.changed" 2>/dev/null; then
    compiled
    return
  fi
  local compiled_list file
  compiled_list=$(compiled)
  while read -r file; do
    case $file in
      .clang-tidy) compiled; return ;;
      *.cpp) echo "$file" ;;
      *.hpp) { echo "${file%.hpp}.cpp"; grep -lF "${file##*/}\"" $compiled_list | head -n 1; } |
          grep -xF "$compiled_list" | head -n 1 ;;
    esac
  done <"$build/tidy.changed" | sort -u | grep -xF "$compiled_list"
}

mapfile -t files < <(select_files "$@" | sort -u)
[ ${#files[@]} = 0 ] && { echo "no source file changed"; exit 0; }
echo "${#files[@]} files"
rm -rf "$build/tidy"
mkdir -p "$build/tidy"
# clang does not read what GCC has precompiled.
sed -E 's| -Winvalid-pch -include [^ ]*/cmake_pch\.hxx||' "$build/compile_commands.json" >"$build/tidy/compile_commands.json"

check_one() {
  local file=$1 log=$build/tidy/${1//\//_}.log
  [ "$(date +%s)" -lt "$deadline" ] || { echo "$file" >>"$build/tidy/left"; return 0; }
  # Options of GCC that clang does not know are none of its business.
  clang-tidy -p "$build/tidy" --quiet --extra-arg=-Wno-unknown-warning-option "$file" >"$log" 2>"$log.err" && return 0
  grep -vE '^[0-9]+ warnings? generated|^Suppressed' "$log"
  grep -E 'error:' "$log.err"
  return 1
}
export -f check_one
export build
deadline=$(($(date +%s) + budget))
export deadline
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$seam_jobs" bash -c 'check_one "$0"'
code=$?
[ -f "$build/tidy/left" ] && echo "$(wc -l <"$build/tidy/left") files were left: the $budget s are over"
exit $code
