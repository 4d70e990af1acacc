#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills a run at random moments and resumes it, again and again: in the end it must equal the run that nobody killed.

  tests/run/kill_resume.py --seam build/bin/seam --kills 100 --ranks 1 2 --seed 1 [--record docs/results/kill_resume]

The scene has contact and a pocket of fluid, and writes a restart point at every step, so that many a kill strikes while
one is written. On one rank, with linear systems solved directly and anew, series, restart and output files must be the
same to the bit; with factors that are kept, and on several ranks, whose sums come in any order, series must agree to
--tolerance of the largest value of each column, or of the vector that it is a component of.
"""
import argparse
import difflib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCENE = HERE / "contact_and_pocket.yaml"


class Wrong(Exception):
    """What must not happen."""


def command(options, ranks, keep, folder, *more):
    call = [str(options.seam), "run", str(SCENE), "--quiet", "--no-picture", "--folder", str(folder),
            "--set", f"parameters.keep={keep}", *more]
    return call if ranks == 1 else ["mpirun", "--oversubscribe", "-np", str(ranks), *call]


def run_to_end(call):
    done = subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise Wrong(f"{' '.join(call)} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def children(process):
    try:
        return [int(p) for p in Path(f"/proc/{process}/task/{process}/children").read_text().split()]
    except OSError:
        return []


def kill(process, ranks, dice):
    """One of the ranks, or all of them at once. Returns what was killed, "" when nothing was left to be."""
    victims = [process.pid] if ranks == 1 else children(process.pid)
    what = "the process" if ranks == 1 else "all ranks"
    if ranks > 1 and victims and dice.random() < 0.5:
        victims, what = [dice.choice(victims)], "one rank"
    for victim in victims:
        try:
            os.kill(victim, signal.SIGKILL)
        except ProcessLookupError:
            pass
    return what if victims and process.wait() != 0 else ""


def run_and_kill(call, ranks, seconds, dice):
    """Lets a run live for some seconds. Returns what was killed ("" when it came to its end) and its output."""
    process = subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    killed = ""
    try:
        output, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        killed = kill(process, ranks, dice)
        output, _ = process.communicate()
    if not killed and process.returncode != 0:
        raise Wrong(f"{' '.join(call)} ended with {process.returncode} though nobody killed it:\n{output}")
    return killed, output


def table(file):
    lines = file.read_text().splitlines()
    return lines[0], [[float(x) for x in line.split(",")] for line in lines[1:]]


def deviation(one, other):
    (names, a), (other_names, b) = table(one), table(other)
    if names != other_names or len(a) != len(b):
        raise Wrong(f"{other} has {len(b)} rows of {other_names}, expected {len(a)} of {names}")
    size, columns = {}, []
    for c, name in enumerate(names.split(",")):
        finite = [(x[c], y[c]) for x, y in zip(a, b) if x[c] - x[c] == 0 and y[c] - y[c] == 0]
        if any((x[c] - x[c] == 0) != (y[c] - y[c] == 0) for x, y in zip(a, b)):
            raise Wrong(f"{other}: column {name} is finite where it is not in {one}, or the other way round")
        # Of a vector the whole: a component that is zero is nothing but rounding.
        vector = name.split(".")[0]
        size[vector] = max([size.get(vector, 0)] + [abs(x) for x, _ in finite])
        columns.append((vector, finite))
    return max([0.0] + [abs(x - y) / size[v] for v, finite in columns for x, y in finite if size[v] > 0])


def difference(one, other):
    """The first lines that differ, of texts."""
    try:
        lines = difflib.unified_diff(one.read_text().splitlines(), other.read_text().splitlines(), lineterm="", n=0)
    except UnicodeDecodeError:
        return ""
    return ":\n" + "\n".join(list(lines)[2:12])


def same_files(whole, parts):
    """Compares all files of results but those that tell of the run itself."""
    own = {"run.json", "summary.json", "events.jsonl"}

    def listing(folder):
        return {str(f.relative_to(folder)) for f in folder.rglob("*") if f.is_file()} - own

    if listing(whole) != listing(parts):
        raise Wrong(f"files differ: {sorted(listing(whole) ^ listing(parts))}")
    # A restart point names its run.
    compared = [f for f in listing(whole) if not f.endswith(".restart")]
    for name in compared:
        if (whole / name).read_bytes() != (parts / name).read_bytes():
            raise Wrong(f"{name} differs{difference(whole / name, parts / name)}")
    return len(compared)


def check_events(parts, steps):
    lines = [json.loads(line) for line in (parts / "events.jsonl").read_text().splitlines()]
    numbers = [e["number"] for e in lines if e["event"] == "step"]
    if numbers != list(range(1, steps + 1)):
        raise Wrong(f"events.jsonl tells of the steps {numbers}, expected 1 to {steps}")


def compare(options, whole, parts, ranks, keep):
    steps = json.loads((whole / "summary.json").read_text())["steps"]
    check_events(parts, steps)
    if json.loads((parts / "run.json").read_text())["status"] != "finished":
        raise Wrong("run.json does not say that the run has finished")
    if ranks == 1 and keep == 0:
        same_files(whole, parts)
        return 0.0
    worst = deviation(whole / "series.csv", parts / "series.csv")
    if not worst <= options.tolerance:
        raise Wrong(f"the series deviate by {worst:.1e}, allowed are {options.tolerance:.1e}")
    return worst


def attack(options, ranks, keep, folder, dice):
    """Kills until there were enough. Returns a row of numbers."""
    whole = folder / f"whole-{ranks}-{keep}"
    begin = time.monotonic()
    run_to_end(command(options, ranks, keep, whole))
    duration = time.monotonic() - begin
    row = dict(ranks=ranks, keep=keep, kills=0, runs=0, early=0, worst=0.0, seconds=0.0)
    begin = time.monotonic()
    while row["kills"] < options.kills:
        parts = folder / f"parts-{ranks}-{keep}"
        shutil.rmtree(parts, ignore_errors=True)
        left = min(10, options.kills - row["kills"])  # a run that is killed more often hardly gets on
        while True:
            seconds = dice.uniform(0, 0.6 * duration) if left > 0 else 1e4
            killed, output = run_and_kill(command(options, ranks, keep, parts, "--resume"), ranks, seconds, dice)
            if not killed:
                break
            left -= 1
            row["kills"] += 1
            row["early"] += not (parts / "series.csv").exists()
        row["runs"] += 1
        row["worst"] = max(row["worst"], compare(options, whole, parts, ranks, keep))
    row["seconds"] = time.monotonic() - begin
    return row


def report(options, rows):
    lines = ["# Runs that are killed", "",
             "A run with contact and a pocket of fluid, killed with SIGKILL at random moments and resumed each time, "
             "compared with the run that nobody killed. On several ranks one of them, or all at once, are killed.", "",
             f"Repeat: `tests/run/kill_resume.py --seam build/bin/seam --kills {options.kills} --ranks "
             f"{' '.join(map(str, options.ranks))} --seed {options.seed}`", "",
             "| ranks | factors | kills | of them before there was a state | runs | deviation | seconds |",
             "|---|---|---|---|---|---|---|"]
    for row in rows:
        worst = "none, to the bit, in all files" if row["ranks"] == 1 and row["keep"] == 0 else f"{row['worst']:.1e}"
        lines.append(f"| {row['ranks']} | {'kept' if row['keep'] else 'fresh'} | {row['kills']} | {row['early']} | "
                     f"{row['runs']} | {worst} | {row['seconds']:.0f} |")
    lines += ["", f"Allowed are deviations of {options.tolerance:.0e} of each column's largest value where factors are "
                  "kept or several ranks add up in any order."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seam", type=Path, required=True)
    parser.add_argument("--kills", type=int, default=100, help="of each kind of run")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--keep", type=int, nargs="+", default=[0, 10], help="factorisations that are kept")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tolerance", type=float, default=1e-8)
    parser.add_argument("--record", type=Path, help="folder that gets run.md")
    options = parser.parse_args()
    options.seam = options.seam.resolve()
    dice = random.Random(options.seed)
    rows = []
    with tempfile.TemporaryDirectory(prefix="seam-kill-") as folder:
        for ranks in options.ranks:
            for keep in options.keep:
                try:
                    rows.append(attack(options, ranks, keep, Path(folder), dice))
                except Wrong as wrong:
                    print(f"FAIL {ranks} ranks, {keep} factors kept, seed {options.seed}: {wrong}")
                    return 1
                print("ok   {ranks} ranks, {keep} factors kept: {kills} kills in {runs} runs, {early} before there was a "
                      "state, deviation {worst:.1e}, {seconds:.0f} s".format(**rows[-1]), flush=True)
    if options.record:
        options.record.mkdir(parents=True, exist_ok=True)
        (options.record / "run.md").write_text(report(options, rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
