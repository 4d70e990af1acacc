# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/results/metamorphic: deviations by family and relation, those with a reason of their own apart, all rows as CSV."""
import csv
import datetime
import platform
import subprocess
from pathlib import Path

import expected
import yaml

ROOT = Path(__file__).resolve().parents[2]

# Relations that ask the same of the program.
GROUPS = {
    "turned": "turned, mirrored", "mirrored": "turned, mirrored", "cyclic, same numbers": "turned, mirrored",
    "moved by (0.1, 1/3, 0.7)": "moved by (0.1, 1/3, 0.7)", "moved by a thousand": "moved by a thousand",
    "length x 1000": "length, mass, time scaled", "length / 1000": "length, mass, time scaled",
    "mass x 1000": "length, mass, time scaled", "mass / 1000": "length, mass, time scaled",
    "time x 1000": "length, mass, time scaled", "time / 1000": "length, mass, time scaled",
    "all units": "length, mass, time scaled", "turned, moved, all units": "length, mass, time scaled",
    "renamed": "renamed", "keys reversed": "keys, lists reversed", "lists reversed": "keys, lists reversed",
    "grids as files": "grids as files", "renumbered": "renumbered", "renumbered again": "renumbered"}


def first_line(command):
    """What a command says first; "" when it cannot be run."""
    try:
        return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip().split("\n")[0]
    except (OSError, subprocess.CalledProcessError):
        return ""


def processor():
    """The machine's processor and the number of its cores."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0]}, {len(names)} cores" if names else "unknown"


def program():
    """The last commit that changed the program; those of tests do not count."""
    return first_line(["git", "log", "-1", "--format=%h", "--abbrev=12", "--", "core", "plugins", "tools/cli"])


def header(title, command, seconds, note=""):
    """Title, machine, commit, command of a record."""
    return [f"# {title}", "", f"- machine: {platform.system()} {platform.release()} {platform.machine()}, {processor()}",
            f"- commit: {program()}" + (f"; {note}" if note else ""),
            f"- date: {datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M} UTC", f"- command: `{command}`" + (f", {seconds:.0f} s" if seconds else ""), ""]


def of_group(rows, family, group):
    """Rows of a family and a group of relations that no reason of their own sets apart."""
    return [r for r in rows if r["family"] == family and GROUPS.get(r["relation"]) == group and not r["apart"]]


def with_column(value, column):
    """A deviation and where it is."""
    return f"{value:.1e}" if value else "0"


def table(rows):
    """Deviations by family and group, beside the figures of an independent harness."""
    other = yaml.safe_load((Path(__file__).parent / "independent.yaml").read_text())
    lines = ["| family | relation | scenes, runs | largest deviation | in | of remainders | holds | independent harness |",
             "|---|---|---|---|---|---|---|---|"]
    for family in dict.fromkeys(r["family"] for r in rows):
        for group in dict.fromkeys(GROUPS.values()):
            these = of_group(rows, family, group)
            if not these:
                continue
            worst = max(these, key=lambda r: r.get("largest", 0))
            rest = max(these, key=lambda r: r.get("remainder", 0))
            where = f"{worst['scene']}, `{worst['column']}`" if worst.get("column") else ""
            holds = "yes" if all(r["verdict"] == "ok" for r in these) else "**no**"
            lines.append(f"| {family} | {group} | {len({r['scene'] for r in these})}, {len(these)} | "
                         f"{with_column(worst.get('largest', 0), '')} | {where} | {with_column(rest.get('remainder', 0), '')} | {holds} | "
                         f"{other.get(group, {}).get(family, other.get(group, {}).get('all', ''))} |")
    return lines


def apart(rows):
    """What deviates more, and why."""
    lines = ["| scene | relation | deviation | in | of remainders | verdict | reason |", "|---|---|---|---|---|---|---|"]
    for r in rows:
        if r["apart"] or r["verdict"] == "FAILED":
            value = r["failure"] if r.get("failure") else f"{r['largest']:.1e} | `{r['column']}` | {with_column(r['remainder'], '')}"
            value += " | | " if r.get("failure") else ""
            lines.append(f"| {r['scene']} | {r['relation']} | {value} | {'known' if r['verdict'] == 'known' else r['verdict']} | "
                         f"{r.get('reason', '')} |")
    return lines


def write(rows, seconds):
    """The record: metamorphic.md, and metamorphic.csv with all rows."""
    folder = ROOT / "docs" / "results" / "metamorphic"
    folder.mkdir(parents=True, exist_ok=True)
    for row in rows:
        row["apart"] = expected.is_apart(row["scene"], row["relation"])
    text = header("Scenes turned, mirrored, moved, in other units, renamed, reordered, renumbered",
                  "tests/metamorphic/metamorphic.py build/bin/seam --record", seconds)
    counts = {word: sum(r["verdict"] == word for r in rows) for word in ("ok", "known", "FAILED")}
    text += [f"{len({r['scene'] for r in rows})} scenes, {len(rows)} pairs of runs: {counts['ok']} within what is allowed, "
             f"{counts['known']} with a deviation that is known and not judged, {counts['FAILED']} not.",
             "The deviation is the largest over all times and columns of `series.csv`, over the largest value of the column (of the "
             "vector for components); columns below 1e-8 are left out. Remainders are columns that add up to next to nothing, as "
             "`divergence` and `mismatch`, and what is decided among integration points, as `gap` and `area`. All rows: [metamorphic.csv](metamorphic.csv). What is allowed, and why: "
             "[expected.py](../../../tests/metamorphic/expected.py). The last column gives what another harness, written "
             "independently, found with scenes of its own.", ""]
    count = {relation: sum(r["relation"] == relation for r in rows) for relation in GROUPS}
    short = [f"{relation} ({n})" for relation, n in count.items() if n < max(count.values())]
    text += ["Run for fewer scenes than the others: " + ", ".join(short) + ".", ""] if short else []
    text += table(rows) + ["", "## Deviations with a reason of their own", ""] + apart(rows) + [""]
    iterations = [r for r in rows if r.get("iterations") and not r.get("failure") and r["iterations"][0] != r["iterations"][1]]
    text += [f"Newton's iterations differ in {len(iterations)} of {len(rows)} pairs.", ""]
    (folder / "metamorphic.md").write_text("\n".join(text))
    with (folder / "metamorphic.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scene", "family", "dimension", "relation", "verdict", "largest", "column", "remainder", "remainder column",
                         "columns compared", "steps", "iterations", "iterations anew", "seconds", "failure"])
        for r in rows:
            pair = r.get("iterations", ["", ""])
            writer.writerow([r["scene"], r["family"], r.get("dimension", ""), r["relation"], r["verdict"], f"{r.get('largest', 0):.3g}",
                             r.get("column", ""), f"{r.get('remainder', 0):.3g}", r.get("remainder_column", ""), r.get("compared", ""),
                             r.get("steps", ""), pair[0], pair[1], r.get("seconds", ""), r.get("failure", "")])
    print(f"docs/results/metamorphic/metamorphic.md, {len(rows)} rows")

