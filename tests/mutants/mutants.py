#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Damages shipped scenes, their meshes, restart points and replayed series, and looks at what Seam does with them.

  tests/mutants/mutants.py build/bin/seam --check 10000 --run 1000 --files 1000 --seed 1 --record
  tests/mutants/mutants.py build/bin/seam --check 100 --run 12 --files 36                             what continuous integration runs
  tests/mutants/mutants.py build/bin/seam --only check 4711 --keep out                                one of them, which stays in a folder
  tests/mutants/mutants.py build/bin/seam --check 10000 --rows rows.jsonl                             goes on with what rows.jsonl holds
  tests/mutants/mutants.py build/bin/seam --rows rows.jsonl --again                                   what was bad there, once more

A mutant is given by its part, the seed and its number. Exit code 1 when one of them did what must not happen.
"""
import argparse
import json
import shutil
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

import file_part  # noqa: E402  the modules beside this file
import judge  # noqa: E402
import record  # noqa: E402
import scene_part  # noqa: E402
import small  # noqa: E402

PARTS = {"check": scene_part.check, "run": scene_part.run, "files": file_part.judge_file}


def options_of():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seam", type=Path)
    parser.add_argument("--check", type=int, default=0, help="scenes through `seam check`")
    parser.add_argument("--run", type=int, default=0, help="scenes through `seam check` and `seam run`")
    parser.add_argument("--files", type=int, default=0, help="meshes, restart points, series")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs=2, metavar=("PART", "NUMBER"), help="one mutant; shows what Seam says")
    parser.add_argument("--keep", type=Path, help="folder in which the last mutant stays")
    parser.add_argument("--rows", type=Path, help="file to which each result is added; those that it holds are not repeated")
    parser.add_argument("--again", action="store_true", help="those that were bad in --rows, once more")
    parser.add_argument("--record", action="store_true", help="write docs/results/mutants")
    return parser.parse_args()


def wanted(options, rows):
    """(part, number) of what is to be done."""
    if options.only:
        return [(options.only[0], int(options.only[1]))]
    if options.again:
        return [key for key, row in rows.items() if row["outcome"] == "bad"]
    every = [(part, number) for part in PARTS for number in range(getattr(options, part))]
    return [key for key in every if key not in rows]


def main():
    """Runs what is asked for."""
    options = options_of()
    seam = str(options.seam.resolve())
    rules, every = judge.Rules(seam), small.scenes()
    rows = {}
    if options.rows and options.rows.exists():
        rows = {(row["part"], row["number"]): row for row in map(json.loads, options.rows.open())}
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep.resolve() if options.keep else Path(temporary)
        for part, number in wanted(options, rows):
            shutil.rmtree(folder / part, ignore_errors=True)
            row = PARTS[part](seam, rules, options.seed, number, every, folder / part)
            rows[part, number] = row
            if options.rows:
                with options.rows.open("a") as file:
                    file.write(json.dumps(row) + "\n")
            if row["outcome"] == "bad" or options.only:
                print(f"{part} {number}: {row['scene']}, {row['kind']}: {row['bad'] or row['outcome']} ({row['code']}, {row['seconds']} s)\n"
                      f"    {row['told'] if options.only else row['told'][:200]}", flush=True)
    failed = sum(row["outcome"] == "bad" for row in rows.values())
    if options.record:
        record.write(list(rows.values()), options)
    print(f"{len(rows) - failed} passed, {failed} failed")
    return 1 if failed or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
