# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/results/mutants: how many of each kind were tried and what came of them. What is written there by hand, below
`## Found`, stays.
"""
import datetime
import platform
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs" / "results" / "mutants"
TITLES = {"check": "Scenes through `seam check`", "run": "Scenes through `seam check` and `seam run`",
          "files": "Meshes, restart points and what stands beside them, replayed series"}
TEXT = """
A row is a kind of mutation. *refused*: exit code 2 or 3 with an error; *with a place*: of these, errors that name file and line.
*accepted*: exit code 0 (of runs, meshes and restarts: the run, whose results are complete and finite). *failed*: the run ended with
a message and exit code 1. *time limit*: a run that takes long, ended by `--time-limit`. *bad*: a signal, no end within the limit, an exit
code that is not documented, no error told, words of the language or of a library, or accepted though a reader of YAML 1.2, the JSON
Schema, or strict readers of meshes and series that are not Seam's say otherwise; what a check accepts and the run refuses, or the
other way round; a run that goes on from damaged files and has other numbers, or does not tell.
"""


def _first_line(command):
    try:
        return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip().split("\n")[0]
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def _processor():
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0]}, {len(names)} cores" if names else "unknown"


def _row(name, rows):
    count = {outcome: sum(row["outcome"] == outcome for row in rows) for outcome in ("refused", "accepted", "failed", "time limit", "bad")}
    place = sum(row["outcome"] == "refused" and row["place"] for row in rows)
    cells = [len(rows), count["refused"], place, count["accepted"], count["failed"], count["time limit"], count["bad"]]
    return f"| {name} | " + " | ".join(str(cell or "") for cell in cells) + " |"


def _table(rows):
    kinds = sorted({row["kind"] for row in rows})
    lines = ["| kind | tried | refused | with a place | accepted | failed | time limit | bad |", "|---|---|---|---|---|---|---|---|"]
    return lines + [_row(kind, [row for row in rows if row["kind"] == kind]) for kind in kinds] + [_row("all", rows)]


def write(rows, options):
    """Writes the record of all rows."""
    counts = " ".join(f"--{part} {sum(row['part'] == part for row in rows)}" for part in TITLES)
    lines = ["# Damaged scenes, meshes, restart points and series", "",
             f"- machine: {platform.system()} {platform.release()} {platform.machine()}, {_processor()}",
             f"- commit: {_first_line(['git', 'log', '-1', '--format=%h', '--abbrev=12', '--', 'core', 'plugins', 'tools/cli'])}",
             f"- date: {datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M} UTC",
             f"- command: `tests/mutants/mutants.py build/bin/seam {counts} --seed {options.seed} --record`, "
             f"{sum(row['seconds'] for row in rows):.0f} s", "",
             "[What it does](../../test-seam.md#damaged-scenes-and-files)", TEXT]
    for part, title in TITLES.items():
        of_part = [row for row in rows if row["part"] == part]
        if of_part:
            lines += [f"## {title}", "", *_table(of_part), ""]
    bad = [row for row in rows if row["outcome"] == "bad"]
    lines += ["## Bad", ""] + ([f"- `--only {row['part']} {row['number']}`, {row['scene']}, {row['kind']}: {row['bad']}" for row in bad] or ["None."])
    FOLDER.mkdir(parents=True, exist_ok=True)
    file = FOLDER / "mutants.md"
    found = file.read_text().partition("## Found")[1:] if file.exists() else ("", "")
    file.write_text("\n".join(lines) + "\n" + ("\n" + "".join(found) if found[0] else ""))
