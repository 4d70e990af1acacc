#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs one scene of each family under valgrind's memcheck: no invalid access, nothing that depends on what was never set.

  tests/endurance/valgrind.py build/bin/seam [--scene 'fsi*'] [--record]

The scenes are those of the metamorphic tests that continuous integration runs. Suppressed is what Open MPI's own file
names, and what valgrind.supp beside this one does, with reasons. Leaks are not counted: Open MPI and VTK keep memory to the
end on purpose; that of steps is watched by moving_cut.py.
"""
import argparse
import fnmatch
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent / "metamorphic"))

import metamorphic  # noqa: E402
import record  # noqa: E402
import scene as scenes  # noqa: E402
import yaml  # noqa: E402

OPEN_MPI = "/usr/share/openmpi/openmpi-valgrind.supp"
FOUND = 99


def check(seam, tree, folder):
    """Runs a scene. @return (exit code, number of errors, log)"""
    scenes.write(tree, folder / "scene.yaml")
    command = ["valgrind", "--quiet", "--leak-check=no", f"--error-exitcode={FOUND}", "--num-callers=20",
               f"--suppressions={HERE / 'valgrind.supp'}", "--log-file=valgrind.log"]
    command += [f"--suppressions={OPEN_MPI}"] if Path(OPEN_MPI).exists() else []
    # Vector instructions that valgrind does not know are left alone; two ways into shared memory that it cannot follow are off.
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OPENBLAS_CORETYPE": "Haswell", "OMPI_MCA_btl": "self",
                                "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run([*command, seam, "run", "scene.yaml", "--folder", "results", "--quiet", "--no-picture"], cwd=folder,
                          env=environment, capture_output=True, text=True)
    log = (folder / "valgrind.log").read_text()
    errors = len(re.findall(r"^==\d+== (?:Invalid|Conditional|Use of|Syscall|Mismatched|Source and)", log, re.MULTILINE))
    return done.returncode, errors, log or done.stderr


def shortened(tree, steps=2):
    """The first steps of a scene."""
    time_of = tree.get("time")
    if time_of and time_of.get("step"):
        first = float(time_of["step"]["initial"].value)
        start = float(time_of["start"].value) if time_of.get("start") else 0.0
        time_of["end"].value = scenes.constant(min(float(time_of["end"].value), start + steps * first))
    return tree


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seam", type=Path)
    parser.add_argument("--scene", default="*", help="pattern of names of scenes")
    parser.add_argument("--record", action="store_true", help="write docs/results/valgrind")
    options = parser.parse_args()
    seam = str(options.seam.resolve())
    schema = scenes.Schema(seam)
    table = yaml.load((metamorphic.HERE / "scenes.yaml").read_text(), Loader=yaml.BaseLoader)
    lines, failed, start = ["| scene | family | errors | exit | s |", "|---|---|---:|---:|---:|"], 0, time.monotonic()
    with tempfile.TemporaryDirectory() as temporary:
        for name, entry in table.items():
            if not entry.get("ci") or not fnmatch.fnmatch(name, options.scene):
                continue
            folder = Path(temporary) / name.replace(" ", "_")
            folder.mkdir()
            began = time.monotonic()
            code, errors, log = check(seam, shortened(metamorphic.read_scene(entry, schema)), folder)
            failed += code != 0 or errors != 0
            lines.append(f"| {name} | {entry['family']} | {errors} | {code} | {time.monotonic() - began:.0f} |")
            print(lines[-1], flush=True)
            if code != 0 or errors:
                print(log[:6000], flush=True)
    if options.record:
        folder = record.ROOT / "docs" / "results" / "valgrind"
        folder.mkdir(parents=True, exist_ok=True)
        version = record.first_line(["valgrind", "--version"])
        text = record.header("One scene of each family under valgrind", "tests/endurance/valgrind.py build/bin/seam --record",
                             time.monotonic() - start, version)
        text += ["Memcheck on the release build, one rank, two steps: invalid accesses and use of what was never set. Leaks are not "
                 "counted.", ""]
        (folder / "run.md").write_text("\n".join(text + lines) + "\n")
    print(f"{failed} scenes with errors")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
