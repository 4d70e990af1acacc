#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Error of drag and lift against seconds on DFG 2D-1, beside a peer, and writes docs/results/dfg_2d_1_peer.

  tools/bench/dfg.py --build build [--peer dolfinx_dfg_2d_1.py] [--levels 4] [--rounds 3]

The peer is any program that takes a number of levels and prints lines of unknowns, seconds (assembly and solution only),
relative error of the drag and of the lift. It and Seam take turns, so that the comparison holds when the machine's speed
drifts; of both, seconds are the least of the rounds. Seam's seconds are those of assembly, pattern and solution, too.
"""
import argparse
import datetime
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "configs/fluid/dfg_2d_1.yaml"
REFERENCE = {"drag_coefficient": 5.57953523384, "lift_coefficient": 0.010618948146}
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
KINDS = {"order 2, cip": (2, "cip", [24, 32, 48, 64, 96, 128]),
         "order 1, residual": (1, "residual", [48, 80, 160, 320]),
         "order 1, cip": (1, "cip", [48, 80, 160, 320])}


def run_seam(seam, order, stabilisation, n):
    """(unknowns, seconds, error of the drag, error of the lift)"""
    settings = [f"fields.water.order={order}", f"fields.water.stabilisation={stabilisation}", f"parameters.n={n}",
                "output.fields=false"]
    with tempfile.TemporaryDirectory() as folder:
        command = [seam, "run", str(SCENE), "--quiet", "--folder", folder]
        for setting in settings:
            command += ["--set", setting]
        # A coarse run misses the scene's checks; its numbers are what is wanted.
        subprocess.run(command, env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        summary = json.loads((Path(folder) / "summary.json").read_text())
    seconds = sum(summary["seconds"][part] for part in ("assembly", "pattern", "linear"))
    errors = [abs(summary["results"][name] / value - 1) for name, value in REFERENCE.items()]
    return (summary["unknowns"], seconds, *errors)


def run_peer(program, levels):
    text = subprocess.run(["/usr/bin/python3", program, str(levels)], env=ENVIRONMENT, check=True, stdout=subprocess.PIPE,
                          text=True).stdout
    rows = [line.split() for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return [(int(row[0]), *(float(entry) for entry in row[1:4])) for row in rows]


def fastest(rounds):
    """Of several rounds of the same rows, those with their least seconds."""
    return [(rows[0][0], min(row[1] for row in rows), *rows[0][2:]) for rows in zip(*rounds)]


def measure(arguments, seam):
    rounds = {name: [] for name in [*KINDS, *(["peer"] if arguments.peer else [])]}
    for _ in range(arguments.rounds):
        if arguments.peer:
            rounds["peer"].append(run_peer(arguments.peer, arguments.levels))
        for name, (order, stabilisation, sizes) in KINDS.items():
            rounds[name].append([run_seam(seam, order, stabilisation, n) for n in sizes])
    return {name: fastest(several) for name, several in rounds.items()}


def draw(results, path):
    figure, axes = plt.subplots(1, 2, figsize=(10, 4))
    for axis, column, what in ((axes[0], 2, "drag"), (axes[1], 3, "lift")):
        for name, rows in results.items():
            axis.loglog([row[1] for row in rows], [row[column] for row in rows], "k--s" if name == "peer" else "-o",
                        label=name)
        axis.set_xlabel("s, assembly and solution")
        axis.set_ylabel(f"relative error of the {what}")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def report(results, arguments):
    commit = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"], stdout=subprocess.PIPE, text=True,
                            stderr=subprocess.DEVNULL).stdout.strip() or "unknown"
    lines = ["# DFG 2D-1: error against seconds", "",
             f"{datetime.date.today()}, commit {commit}, {os.cpu_count()} cores, one used; least seconds of "
             f"{arguments.rounds} rounds in turn.", "",
             f"Repeat with `tools/bench/dfg.py {' '.join(a if '/' not in a else Path(a).name for a in sys.argv[1:])}`.",
             "", "| solver | unknowns | s | drag error | lift error |", "|---|---|---|---|---|"]
    for name, rows in results.items():
        lines += [f"| {name} | {n} | {s:.2f} | {drag:.1e} | {lift:.1e} |" for n, s, drag, lift in rows]
    return lines + ["", "![error against seconds](errors.png)"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build", help="build folder with the programs")
    parser.add_argument("--peer", help="program to take turns with")
    parser.add_argument("--levels", type=int, default=4, help="meshes of the peer")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--out", default=str(ROOT / "docs/results/dfg_2d_1_peer"))
    arguments = parser.parse_args()
    results = measure(arguments, str(Path(arguments.build).resolve() / "bin/seam"))
    out = Path(arguments.out)
    out.mkdir(parents=True, exist_ok=True)
    lines = report(results, arguments)
    (out / "errors.md").write_text("\n".join(lines) + "\n")
    draw(results, out / "errors.png")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
