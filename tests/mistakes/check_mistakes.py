#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the mistakes of mistakes.py in the scenes beside it, one at a time, and counts what `seam check` finds.

  tests/mistakes/check_mistakes.py build/bin/seam          lists what is not found
  tests/mistakes/check_mistakes.py build/bin/seam --all    lists all, with their messages

Found is what an error or a warning tells with file and line, naming what is wrong. Exit code 1 when one is not found by `seam check`,
or, of the kind "by the run", which only a run can know, is not refused by that, naming it: what is found stays found.
"""

import argparse
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

from mistakes import MISTAKES

HERE = pathlib.Path(__file__).resolve().parent


def run(command, folder):
    """@returns exit code and all that was printed."""
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=1000, check=False)
    return done.returncode, done.stdout.decode(errors="replace")


def names(output, key, must_place):
    """Whether a message gives the place and names the key."""
    lines = [line for line in output.splitlines() if re.search(r"scene\.yaml:\d+", line)]
    return any(key in line for line in (lines if must_place else output.splitlines()))


def judge(seam, scene, key, folder):
    """@returns "check", "run" or "never", and what was printed."""
    (folder / "scene.yaml").write_text(scene)
    code, output = run([seam, "check", "scene.yaml"], folder)
    if code < 0 or code > 3:
        return "never", f"exit {code}: {output}"
    if (code != 0 or "warning:" in output) and names(output, key, True):
        return "check", output
    run_code, run_output = run([seam, "run", "scene.yaml", "--no-picture", "--overwrite", "--folder", "out"], folder)
    found = run_code in (1, 2, 3) or "warning:" in run_output
    return ("run" if found else "never"), output + run_output


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seam")
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args()
    seam = str(pathlib.Path(options.seam).resolve())
    count, by_kind, missed = collections.Counter(), collections.Counter(), 0
    for number, (kind, key, places) in enumerate(MISTAKES):
        for name, (right, wrong) in places.items():
            text = (HERE / f"{name}.yaml").read_text()
            assert right in text, f"mistake {number} does not fit {name}.yaml: {right}"
            with tempfile.TemporaryDirectory() as folder:
                where, output = judge(seam, text.replace(right, wrong, 1), key, pathlib.Path(folder))
            count[where] += 1
            by_kind[kind, where] += 1
            as_expected = where == "check" if kind != "by the run" else where == "run" and names(output, key, False)
            missed += not as_expected
            if options.all or not as_expected:
                print(f"{where:6} {kind} {number} in {name}: '{right.strip()}' -> '{wrong.strip()}' ({key})")
                print("       " + "\n       ".join(output.strip().splitlines()[:4]))
    total = sum(count.values())
    for kind in dict.fromkeys(kind for kind, _, _ in MISTAKES):
        print(f"{kind:10}", ", ".join(f"{by_kind[kind, where]} by {where}" for where in ("check", "run", "never")))
    print(f"{total} mistakes: {count['check']} found by check ({100 * count['check'] / total:.1f} %), "
          f"{count['run']} by run, {count['never']} never")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
