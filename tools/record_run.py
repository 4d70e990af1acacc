#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a finished run into docs/results/NAME/run.md: what it found, what it cost, on which machine and commit.

  tools/record_run.py results/dfg_2d_2 dfg_2d_2 [--note "..."]

Reads the summary.json that `seam run` and `seam verify` leave in the folder of results.
"""
import argparse
import json
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def linear_iterations(summary):
    return [i["linear_iterations"] for step in summary["newton"] for i in step["iterations"] if i["linear_residual"] > 0]


def report(summary, note):
    newton = [len(step["iterations"]) - 1 for step in summary["newton"]]
    linear = linear_iterations(summary)
    lines = [f"# {summary['title']}", "", f"Scene `{Path(summary['scene']).name}`"
             + (", with " + ", ".join(f"`{o}`" for o in summary["overrides"]) if summary["overrides"] else "")
             + (f". {note}" if note else "."), "",
             "| number | value | reference | deviation | holds | source |", "|---|---|---|---|---|---|"]
    for check in summary["checks"]:
        lines.append(f"| {check['that']} | {check['value']:.6g} | {check['expected']} | {check.get('deviation', 0):+.2e} | "
                     f"{'yes' if check['passed'] else 'no'} | {check['source']} |")
    seconds = summary["seconds"]
    lines += ["", "| | |", "|---|---|", f"| unknowns | {summary['unknowns']:,} |", f"| ranks | {summary['ranks']} |",
              f"| steps, refused ones | {summary['steps']}, {summary['rejected_steps']} |",
              f"| Newton iterations, most in a step | {sum(newton)}, {max(newton)} |",
              f"| linear solves, their iterations in all, the most | {len(linear)}, {sum(linear)}, {max(linear, default=0)} |",
              "| seconds | " + ", ".join(f"{k} {v:.1f}" for k, v in seconds.items()) + " |",
              f"| memory, all ranks | {summary['peak_memory_bytes'] / 1e6:.0f} MB |"]
    for key in ("machine", "versions"):
        value = summary[key]
        text = ", ".join(f"{k} {v}" for k, v in value.items()) if isinstance(value, dict) else str(value)
        lines.append(f"| {key} | {text} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path)
    parser.add_argument("name")
    parser.add_argument("--note", default="")
    options = parser.parse_args()
    summary = json.loads((options.results / "summary.json").read_text())
    folder = ROOT / "docs" / "results" / options.name
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "run.md").write_text(report(summary, options.note))
    print(folder.relative_to(ROOT) / "run.md")


if __name__ == "__main__":
    main()
