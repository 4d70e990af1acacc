#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and writes docs/results/benchmarks.md: figures, machine, commit, and how to repeat them.

  tools/bench/record.py --build build [--peer dolfinx_assembly.py] [--rounds 5] [--large 69]

The peer is any program that prints lines like "hex8 neo-Hookean tangent: 9.60 us/cell". It and Seam take turns in one
run, so that the ratios hold when the machine's speed drifts.
"""
import argparse
import datetime
import json
import os
import platform
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def output(command):
    return subprocess.run(command, env=ENVIRONMENT, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True).stdout


def on_ranks(ranks, command):
    return ["mpirun", "--oversubscribe", "-np", str(ranks), *command]


def figures(text):
    """{"hex8 neo-Hookean tangent": 9.6, ...}"""
    return {m[1]: float(m[2]) for m in re.finditer(r"^(.+?): ([\d.]+) us/cell", text, re.MULTILINE)}


def in_turn(first, second, rounds):
    """Runs two commands in turn; per figure, the medians of both and of the ratio first/second."""
    pairs = [(figures(output(first)), figures(output(second))) for _ in range(rounds)]
    result = {}
    for name in pairs[0][0]:
        a, b = [p[0][name] for p in pairs], [p[1][name] for p in pairs]
        ratios = [x / y for x, y in zip(a, b)]
        result[name] = (statistics.median(a), statistics.median(b), statistics.median(ratios), min(ratios), max(ratios))
    return result


def assembly_against_peer(bench, peer, rounds):
    lines = ["## Tangent assembly, matrix insertion included, one rank", "",
             "| form | Seam us/cell | peer us/cell | Seam/peer (least, most) |", "|---|---|---|---|"]
    for name, (seam, other, ratio, least, most) in in_turn([bench], ["/usr/bin/python3", peer], rounds).items():
        lines.append(f"| {name} | {seam:.2f} | {other:.2f} | {ratio:.2f} ({least:.2f}, {most:.2f}) |")
    return lines


def assembly_on_two_ranks(bench, rounds):
    lines = ["## Assembly on two ranks", "", "| form | one rank us/cell | two ranks us/cell | speed-up (least, most) |",
             "|---|---|---|---|"]
    for name, (one, two, ratio, least, most) in in_turn(on_ranks(1, [bench, "48", "400"]), on_ranks(2, [bench, "48", "400"]),
                                                        rounds).items():
        lines.append(f"| {name}, 48 and 400 cells a side | {one:.2f} | {two:.2f} | {ratio:.2f} ({least:.2f}, {most:.2f}) |")
    return lines


def porous_against_solid(bench, rounds):
    lines = ["## A porous cell against a solid one, one rank", "",
             "Cell terms of `porous_solid` (five unknowns a node, changing porosity, Kozeny-Carman) and of `solid`, both with inertia and",
             "away from rest.", "",
             "| solid us/cell | porous us/cell | porous/solid, per entry of the cells' matrices (least, most) |", "|---|---|---|"]
    runs = [figures(output([bench, "0", "0", "150"])) for _ in range(rounds)]
    solid, porous = ([r[f"quad4 {kind} tangent"] for r in runs] for kind in ("solid", "porous"))
    ratios = [p / 400 / (s / 64) for s, p in zip(solid, porous)]
    lines.append(f"| {statistics.median(solid):.2f} | {statistics.median(porous):.2f} | {statistics.median(ratios):.2f} "
                 f"({min(ratios):.2f}, {max(ratios):.2f}) |")
    return lines


def memory(bench):
    lines = ["## Memory of assembly, one rank", "", "| form | growth over the size before the pattern is built |", "|---|---|"]
    for arguments in (["64", "0"], ["0", "600"]):
        text = output([bench, *arguments])
        match = re.search(r"^(.+?): .*peak growth (.+?)\)", text)
        lines.append(f"| {match[1]}, {max(arguments, key=int)} cells a side | {match[2]} |")
    return lines


def large_elasticity(seam, sizes):
    lines = ["## 3D elasticity, flexible GMRES with smoothed aggregation, two ranks", "",
             "`configs/solid/block.yaml`, hexahedra of order 1, a fresh preconditioner for each of the",
             "four solves (`keep: 0`); iterations of each solve.", "",
             "| unknowns | iterations | setup and solve s | assembly s | total s | memory GB (both ranks) |",
             "|---|---|---|---|---|---|"]
    for n in sizes:
        with tempfile.TemporaryDirectory() as folder:
            output(on_ranks(2, [seam, "run", str(ROOT / "configs/solid/block.yaml"), "--quiet", "--set", f"parameters.n={n}",
                                "--set", "solver.linear.keep=0", "--folder", folder]))
            s = json.loads((Path(folder) / "summary.json").read_text())
        solves = [i["linear_iterations"] for i in s["newton"][0]["iterations"][:-1]]
        t = s["seconds"]
        lines.append(f"| {s['unknowns']} | {', '.join(str(i) for i in solves)} | {t['linear']:.1f} | {t['assembly']:.1f} | "
                     f"{t['total']:.1f} | {s['peak_memory_bytes'] / 1e9:.2f} |")
    return lines


def header(arguments):
    commit = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"], stdout=subprocess.PIPE, text=True,
                            stderr=subprocess.DEVNULL).stdout.strip() or "unknown"
    cpu = re.search(r"model name\s*: (.+)", Path("/proc/cpuinfo").read_text())
    return ["# Benchmarks", "",
            f"{datetime.date.today()}, commit {commit}, {cpu[1] if cpu else platform.machine()}, {os.cpu_count()} cores, "
            f"{platform.system()} {platform.release()}. Medians of {arguments.rounds} rounds taken in turn.", "",
            f"Repeat with `tools/bench/record.py {' '.join(a if '/' not in a else Path(a).name for a in sys.argv[1:])}`.", ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build", help="build folder with the benchmark programs")
    parser.add_argument("--peer", help="program to take turns with")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--large", type=int, nargs="+", default=[32, 69], help="cells a side of the elastic block")
    parser.add_argument("--out", default=str(ROOT / "docs/results/benchmarks.md"))
    arguments = parser.parse_args()
    programs = Path(arguments.build).resolve() / "bin"
    bench, seam = str(programs / "seam-bench-assembly"), str(programs / "seam")
    lines = header(arguments)
    if arguments.peer:
        lines += assembly_against_peer(bench, arguments.peer, arguments.rounds) + [""]
    lines += assembly_on_two_ranks(bench, arguments.rounds) + [""] + memory(bench) + [""]
    lines += porous_against_solid(bench, arguments.rounds) + [""]
    lines += large_elasticity(seam, arguments.large)
    Path(arguments.out).parent.mkdir(parents=True, exist_ok=True)
    Path(arguments.out).write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
