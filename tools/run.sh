#!/usr/bin/env bash
# Runs a scene; sets everything up first where that is needed.
#   tools/run.sh                                  Cook's membrane
#   tools/run.sh configs/solid/cook.yaml --set parameters.n=64
# Further arguments are those of `seam run`; results go to results/<scene>.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

seam_install_packages
seam_configure "$seam_build"
# Neither the tests nor the benchmarks are needed here.
seam_ninja "$seam_build" seam seam-picture plugins/all >&2

if [ $# = 0 ]; then
  set -- configs/solid/cook.yaml
  cd "$seam_root"
fi
exec "$seam_build/bin/seam" run "$@"
