#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Slides bodies through 200 positions in a mesh and writes docs/results/fluid_conditioning: how far condition number and
errors of the flow move from their medians, with ghost penalty and without.

  tools/bench/conditioning.py --build build [--tables FOLDER]

--tables: draw the tables of an earlier run instead of running.
"""
import argparse
import csv
import datetime
import math
import os
import subprocess
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = Path(__file__).resolve().parents[2]
WITHOUT = "_without_ghost_penalty"
COLUMNS = ["condition", "velocity", "gradient", "pressure"]


def record(build, folder):
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", SEAM_RECORD_FOLDER=str(folder))
    subprocess.run([str(Path(build).resolve() / "bin/test_fluid"), "[.record]"], env=environment, check=True)


def read(path):
    with open(path) as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def median(values):
    return sorted(values)[len(values) // 2]


def name_of(stem):
    shape, cell, *rest = stem.split("_")
    return f"{shape}, {cell}s" + (f" of order {rest[0]}" if len(rest) > 1 else "") + f", {rest[-1]}"


def table(cases):
    lines = ["| body, cells, stabilisation | " + " | ".join(f"{c}: median (least, most over it)" for c in COLUMNS)
             + " | most condition without ghost penalty |", "|---" * (len(COLUMNS) + 2) + "|"]
    for stem, (rows, bare) in cases.items():
        cells = []
        for column in COLUMNS:
            values = [r[column] for r in rows]
            middle = median(values)
            cells.append(f"{middle:.2e} ({min(values) / middle:.2f}, {max(values) / middle:.2f})")
        worst = max(r["condition"] for r in bare)
        lines.append(f"| {name_of(stem)} | " + " | ".join(cells)
                     + (f" | {worst:.1e} |" if math.isfinite(worst) else " | no inverse |"))
    return lines


def draw(cases, path):
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), sharey=True)
    for number, (stem, (rows, bare)) in enumerate(cases.items()):
        for style, points, label in (("-", rows, name_of(stem)), (":", bare, None)):
            # Without an inverse there is nothing to draw but the upper end.
            height = {id(p): min(p["condition"], 1e24) for p in points}
            near = sorted((p for p in points if 0 < p["shift"] <= 0.1 and p in points[len(points) // 2:]),
                          key=lambda p: p["shift"])
            far = sorted(points[:len(points) // 2], key=lambda p: p["shift"])
            axes[0].loglog([p["shift"] for p in near], [height[id(p)] for p in near], style, color=f"C{number}", label=label)
            axes[1].semilogy([p["shift"] for p in far], [height[id(p)] for p in far], style, color=f"C{number}")
    axes[0].set_xlabel("distance from alignment / h")
    axes[1].set_xlabel("position / h")
    axes[0].set_ylabel("condition number")
    axes[0].set_title("dotted: without ghost penalty", fontsize=9)
    axes[0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build", help="build folder with the tests")
    parser.add_argument("--tables", help="folder with the tables of an earlier run")
    parser.add_argument("--out", default=str(ROOT / "docs/results/fluid_conditioning"))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(arguments.tables or temporary)
        if not arguments.tables:
            record(arguments.build, folder)
        stems = sorted(p.stem for p in folder.glob("*.csv") if not p.stem.endswith(WITHOUT))
        cases = {stem: (read(folder / f"{stem}.csv"), read(folder / f"{stem}{WITHOUT}.csv")) for stem in stems}
    out = Path(arguments.out)
    out.mkdir(parents=True, exist_ok=True)
    commit = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"], stdout=subprocess.PIPE, text=True,
                            stderr=subprocess.DEVNULL).stdout.strip() or "unknown"
    lines = ["# Condition and error of a cut flow", "",
             f"{datetime.date.today()}, commit {commit}. Repeat with `tools/bench/conditioning.py`.", "",
             "Stokes flow that is known exactly, round a body that slides along the diagonal of the mesh: 100 positions over a",
             "cell, 100 up to 1e-14 cells from where its boundary meets nodes of the mesh. The condition number is that of the",
             "tangent in the 2-norm, unknowns measured as the continuous problem measures them (not by the diagonal, which",
             "would hide thin cells); errors are L2 norms over the fluid. Without ghost penalty no jump of the velocity is",
             "penalised; below some 1e-6 h (plane) or 1e-4 h (space) the thin cell is left out, so that the condition is fair",
             "again.", ""]
    lines += table(cases) + ["", "![condition number](condition.png)"]
    (out / "conditioning.md").write_text("\n".join(lines) + "\n")
    draw(cases, out / "condition.png")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
