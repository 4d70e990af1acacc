# SPDX-License-Identifier: BSD-3-Clause
"""Runs of scenes and what they leave: the columns of series.csv, the steps and iterations of summary.json."""
import csv
import dataclasses
import json
import os
import shutil
import subprocess

import scene as scenes


@dataclasses.dataclass
class Run:
    """What a run left, or why it left nothing."""

    series: dict
    iterations: int = 0
    rejected: int = 0
    seconds: float = 0.0
    failure: str = ""

    @property
    def steps(self):
        """Steps that were taken."""
        return len(self.series.get("time", [])) - 1


# A single process needs no daemon beside it, and no thread but its own.
ENVIRONMENT = os.environ | {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "OPENBLAS_NUM_THREADS": "1"}


def run(seam, tree, folder, reuse=False, limit=3600):
    """Writes a scene into a folder of its own, runs it there and reads what it leaves.

    reuse: what a run of the same scene left there is read instead
    """
    path = folder / "scene.yaml"
    results = folder / "results"
    before = path.read_text() if path.exists() else ""
    scenes.write(tree, path)
    if reuse and path.read_text() == before and is_finished(results):
        return left(results)
    shutil.rmtree(results, ignore_errors=True)
    try:
        done = subprocess.run([seam, "run", path.name, "--folder", "results", "--quiet", "--no-picture"], cwd=folder,
                              env=ENVIRONMENT, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return Run({}, failure=f"more than {limit} s")
    if done.returncode != 0:
        lines = [line for line in (done.stderr + done.stdout).splitlines() if line.strip()]
        told = next((line for line in lines if "error" in line.lower()), lines[0] if lines else "")
        told = "a signal ended it" if done.returncode < 0 else told
        return Run({}, failure=f"exit {done.returncode}: {told}")
    return left(results)


def is_finished(results):
    """Whether a run came to its end."""
    summary = results / "summary.json"
    return summary.exists() and json.loads(summary.read_text())["status"] == "finished"


def left(results):
    """What a finished run left in its folder."""
    summary = json.loads((results / "summary.json").read_text())
    iterations = sum(len(step["iterations"]) - 1 for step in summary["newton"])
    return Run(read_series(results / "series.csv"), iterations, summary["rejected_steps"], summary["seconds"]["total"])


def read_series(path):
    """Columns by name."""
    with path.open() as file:
        rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}
