#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a run into docs/results/NAME: what it found, what it cost, on which machine and commit.

  tools/record_run.py results/dfg_2d_2 dfg_2d_2 [--note "..."]

run.md     for people; early.md instead where the run did not reach the end of its scene: it replaces no run.md
record.json  for `seam judge`: scene, commit, overrides, how far it ran, the resolved scene, the numbers that are no series
series.csv   what was recorded in every step, to 12 digits; formulas are left out, since they are computed anew

Reads the summary.json, run.json and series.csv that `seam run` and `seam verify` leave in the folder of results. The scene
must still be the one that ran.
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def is_complete(summary, end):
    """A finished run that `--set` gave an earlier end is none."""
    return summary["status"] == "finished" and summary["time"] >= end - 1e-9 * abs(end)


def early(summary, end):
    if is_complete(summary, end):
        return []
    return [f"Ended early, at t = {summary['time']:.6g} of {end:.6g}: {summary['status']}"
            + (f", {summary['reason']}" if summary.get("reason") else "") + ".", ""]


def linear_iterations(summary):
    return [i["linear_iterations"] for step in summary["newton"] for i in step["iterations"] if i["linear_residual"] > 0]


def report(summary, note, end):
    newton = [len(step["iterations"]) - 1 for step in summary["newton"]]
    linear = linear_iterations(summary)
    lines = [f"# {summary['title']}", "", f"Scene `{Path(summary['scene']).name}`"
             + (", with " + ", ".join(f"`{o}`" for o in summary["overrides"]) if summary["overrides"] else "")
             + (f". {note}" if note else "."), "", *early(summary, end),
             "| number | value | reference | deviation | holds | source |", "|---|---|---|---|---|---|"]
    for check in summary["checks"]:
        lines.append(f"| {check['that']} | {check['value']:.6g} | {check['expected']} | {check.get('deviation', 0):+.2e} | "
                     f"{'yes' if check['passed'] else 'no'} | {check['source']} |")
    seconds = summary["seconds"]
    lines += ["", "| | |", "|---|---|", f"| unknowns | {summary['unknowns']:,} |", f"| ranks | {summary['ranks']} |",
              f"| steps, refused ones | {summary['steps']}, {summary['rejected_steps']} |",
              f"| Newton iterations, most in a step | {sum(newton)}, {max(newton, default=0)} |",
              f"| linear solves, their iterations in all, the most | {len(linear)}, {sum(linear)}, {max(linear, default=0)} |",
              "| seconds | " + ", ".join(f"{k} {v:.1f}" for k, v in seconds.items()) + " |",
              f"| memory, all ranks | {summary['peak_memory_bytes'] / 1e6:.0f} MB |"]
    for key in ("machine", "versions"):
        value = summary[key]
        text = ", ".join(f"{k} {v}" for k, v in value.items()) if isinstance(value, dict) else str(value)
        lines.append(f"| {key} | {text} |")
    return "\n".join(lines) + "\n"


def resolved(seam, scene, overrides):
    """Of a scene, as `seam check --resolved` prints them: ({key path: value} that decide what is computed, the other values,
    checksum)."""
    command = [seam, "check", "--resolved", str(scene), *(["--set", *overrides] if overrides else [])]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"record_run: '{' '.join(command)}' failed:\n{run.stderr}")
    title, *lines = run.stdout.splitlines()
    others = lines.index("# the others")
    decide, rest = (dict(line.split(": ", 1) for line in block) for block in (lines[:others], lines[others + 1:]))
    return decide, rest, title.rsplit(" ", 1)[1]


def names(values, block):
    start = f"output.{block}."
    return {path[len(start):].split(".")[0] for path in values if path.startswith(start)}


def record(summary, scene, commit, decide, others, end, columns):
    known = set(columns) | names(others, "formulas") | names(others, "statistics")
    measured = {path: value for path, value in others.items() if path.startswith(("output.probes", "output.errors"))}
    return {"scene": str(scene), "commit": commit, "overrides": summary["overrides"], "status": summary["status"],
            **({"reason": summary["reason"]} if "reason" in summary else {}),
            "time": summary["time"], "end": end, "complete": is_complete(summary, end),
            "steps": summary["steps"], "ranks": summary["ranks"], "seconds": summary["seconds"]["total"],
            "machine": summary["machine"], "versions": summary["versions"],
            "numbers": {name: value for name, value in summary["results"].items() if name not in known},
            "resolved_checksum": summary["resolved_checksum"],
            "resolved": dict(sorted((decide | measured).items()))}


def write_series(source, target, left_out):
    """12 digits: 8 more than the tolerances of the checks need."""
    with open(source, newline="") as file:
        rows = list(csv.reader(file))
    kept = [k for k, name in enumerate(rows[0]) if name not in left_out]
    lines = [[rows[0][k] for k in kept]] + [[f"{float(row[k]):.12g}" for k in kept] for row in rows[1:]]
    target.write_text("".join(",".join(line) + "\n" for line in lines))
    return lines[0][1:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path)
    parser.add_argument("name")
    parser.add_argument("--note", default="")
    parser.add_argument("--commit", help="of the program that ran; default the present one")
    parser.add_argument("--seam", default=str(Path(os.environ.get("SEAM_BUILD", ROOT / "build")) / "bin/seam"))
    parser.add_argument("--root", type=Path, default=ROOT, help="with configs/ and docs/results/")
    options = parser.parse_args()
    options.root = options.root.resolve()
    summary = json.loads((options.results / "summary.json").read_text())
    scene = Path(json.loads((options.results / "run.json").read_text())["scene"])
    decide, others, checksum = resolved(options.seam, scene, summary["overrides"])
    if checksum != summary["resolved_checksum"]:
        sys.exit(f"record_run: {scene} resolves to {checksum}; what ran was {summary['resolved_checksum']}: the scene, a file "
                 "that it names or a default has changed since. Run it again, or go back to what it was.")
    plain, _, _ = resolved(options.seam, scene, [])
    end = float(plain["time.end"])
    commit = options.commit or subprocess.run(["git", "-C", str(options.root), "rev-parse", "HEAD"], capture_output=True, text=True,
                                              check=True).stdout.strip()
    folder = options.root / "docs/results" / options.name
    folder.mkdir(parents=True, exist_ok=True)
    columns = write_series(options.results / "series.csv", folder / "series.csv", names(others, "formulas"))
    here = scene.resolve()
    told = here.relative_to(options.root) if here.is_relative_to(options.root) else here
    data = record(summary, told, commit, decide, others, end, columns)
    # nan and inf have no words in JSON.
    data["numbers"] = {k: v if v is not None and math.isfinite(v) else None for k, v in data["numbers"].items()}
    (folder / "record.json").write_text(json.dumps(data, indent=1) + "\n")
    page = folder / ("run.md" if data["complete"] else "early.md")
    page.write_text(report(summary, options.note, end))
    if data["complete"]:
        (folder / "early.md").unlink(missing_ok=True)
    print(page)


if __name__ == "__main__":
    main()
