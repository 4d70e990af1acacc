#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the records of long runs in docs/results with the scenes they are of; nothing is solved.

  tools/check_records.py build/bin/seam

Each scene of the nightly tier needs a record (tools/record_run.py) of the same resolved scene whose checks hold, evaluated
anew (`seam judge`). Runs that ended early are listed with their age in commits; there may be as many as docs/results/early.txt
says, and no more. The last line reads `N passed, N failed`.
"""
import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def nightly_scenes(configs):
    return sorted(path for path in configs.rglob("*.yaml") if re.search(r"^tier: nightly", path.read_text(), re.M))


def records(results):
    """{path of the scene as recorded: [folder]}, whole runs first."""
    found = {}
    for file in sorted(results.glob("*/record.json")):
        data = json.loads(file.read_text())
        found.setdefault(data["scene"], []).append((not data["complete"], file.parent, data))
    return {scene: sorted(entries, key=lambda entry: entry[:2]) for scene, entries in found.items()}


def age(commit, root):
    """In commits, in words: a clone without history does not know."""
    count = subprocess.run(["git", "-C", str(root), "rev-list", "--count", f"{commit}..HEAD"], capture_output=True, text=True,
                           check=False)
    shallow = subprocess.run(["git", "-C", str(root), "rev-parse", "--is-shallow-repository"], capture_output=True, text=True,
                             check=False)
    if count.returncode != 0 or shallow.stdout.strip() == "true":
        return f"of commit {commit[:9]}, which this clone's history does not hold"
    return f"{count.stdout.strip()} commits old"


def allowed_early(file):
    text = file.read_text() if file.is_file() else "nothing"
    number = re.match(r"\d+$", text.strip())
    if not number:
        sys.exit(f"check_records: {file}: found {text.strip()!r}, expected the number of records that may have ended early")
    return int(number.group())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seam")
    parser.add_argument("--root", type=Path, default=ROOT, help="with configs/ and docs/results/")
    options = parser.parse_args()
    results = options.root / "docs/results"
    known, passed, failed, early = records(results), 0, 0, 0
    for scene in nightly_scenes(options.root / "configs"):
        name = str(scene.relative_to(options.root))
        if name not in known:
            print(f"FAIL {name}: there is no record of it in {results.relative_to(options.root)}; run it, then "
                  "tools/record_run.py")
            failed += 1
            continue
        _, folder, data = known[name][0]
        run = subprocess.run([options.seam, "judge", name, str(folder.relative_to(options.root))], cwd=options.root,
                             capture_output=True, text=True, check=False)
        told = run.stdout.splitlines()
        if run.returncode != 0:
            print(run.stdout + run.stderr, end="")
            failed += 1
            continue
        early += told[0].startswith("early")
        print(f"{told[0]}, {age(data['commit'], options.root)}")
        passed += 1
    allowed = allowed_early(results / "early.txt")
    if early > allowed:
        print(f"FAIL records of runs that ended early: found {early}, docs/results/early.txt allows {allowed}; run scenes to "
              "their ends and record them")
        failed += 1
    elif early < allowed:
        print(f"docs/results/early.txt may say {early} instead of {allowed} now")
    print(f"{passed} passed, {failed} failed")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
