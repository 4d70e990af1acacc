#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Records stay true: a run is recorded, then scene or record are changed, and the stage `records` has to notice, or not to.

  tests/records/records_test.py build/bin/seam
"""
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SEAM = str(Path(sys.argv[1]).resolve())
SCENE = """title: A block that is pulled
tier: nightly
dimension: 2
plugins: [solid]
parameters: {pull: 0.1}
meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}}
fields:
  block:
    type: solid
    mesh: block
    material: {type: decoupled_neo_hookean, young: 10, poisson: 0.3}
    boundary: [{on: x_min, displacement: [0, 0]}, {on: x_max, traction: [pull*t, 0]}]
time: {static: true, end: 1, step: {initial: 0.25}}
output:
  fields: false
  probes: {end: {field: block, at: [1, 0.5], quantity: displacement, component: x}}
  formulas: {twice: 2*end}
  statistics: {most: {of: twice, what: maximum}}
checks:
  - {that: most, at_least: 0.001, at_most: 0.1, source: guess}
  - {that: twice, at: 0.5, at_least: 0.0005, source: guess}
  - {that: newton.iterations.median, at_most: 6, source: it converges}
"""


class Repository:
    """A folder with one nightly scene, its run recorded."""

    made = None  # the first one, which the others are copies of

    def __init__(self, folder):
        self.root = Path(folder).resolve()
        self.scene = self.root / "configs/solid/block.yaml"
        self.results = self.root / "docs/results"
        if Repository.made:
            shutil.copytree(Repository.made, self.root, dirs_exist_ok=True)
            return
        self.scene.parent.mkdir(parents=True)
        self.scene.write_text(SCENE)
        self.results.mkdir(parents=True)
        self.allow(0)
        self.run()

    def allow(self, number):
        (self.results / "early.txt").write_text(f"{number}\n")

    def run(self, *arguments, name="block", commit="0" * 40):
        subprocess.run([SEAM, "run", str(self.scene), "--quiet", "--overwrite", "--folder", str(self.root / "run"), *arguments],
                       check=False, capture_output=True)
        return subprocess.run([str(ROOT / "tools/record_run.py"), str(self.root / "run"), name, "--root", str(self.root),
                               "--seam", SEAM, "--commit", commit], check=False, capture_output=True, text=True)

    def check(self):
        done = subprocess.run([str(ROOT / "tools/check_records.py"), SEAM, "--root", str(self.root)], capture_output=True,
                              text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def change(self, found, instead):
        assert found in self.scene.read_text()
        self.scene.write_text(self.scene.read_text().replace(found, instead))


failures = []


def expect(repository, what, good, *words):
    code, text = repository.check()
    if (code == 0) != good or not all(word in text for word in words):
        failures.append(what)
        print(f"FAIL {what}: exit code {code}, expected {'0' if good else 'another'} and {words}; it says\n{text}")
    else:
        print(f"ok   {what}")


def with_scene(what, found, instead, good, *words):
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(folder)
        repository.change(found, instead)
        expect(repository, what, good, *words)


def records_as_made():
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(folder)
        expect(repository, "a record as it was made", True, "ok   configs/solid/block.yaml (3 checks",
               "history does not hold", "1 passed, 0 failed")
        shutil.rmtree(repository.results / "block")
        expect(repository, "no record", False, "there is no record", "0 passed, 1 failed")


def changed_records():
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(folder)
        series = repository.results / "block/series.csv"
        as_it_was = series.read_text()
        assert "twice" not in as_it_was.splitlines()[0]
        lines = as_it_was.splitlines()
        series.write_text("\n".join(lines[:2]) + "\n")
        expect(repository, "a series that lacks its end", False, "FAIL", "most")
        series.write_text("\n".join([*lines[:-1], lines[-1].replace(",", ";", 1)]) + "\n")
        expect(repository, "a series with a broken line", False, "series.csv:6", "record_run.py")
        series.write_text(as_it_was)
        file = repository.results / "block/record.json"
        data = json.loads(file.read_text())
        data["numbers"]["newton.iterations.median"] = 7
        file.write_text(json.dumps(data))
        expect(repository, "a number that is no series", False, "FAIL  newton.iterations.median")
        data["numbers"]["newton.iterations.median"] = 3
        data["resolved_checksum"] = "0" * 16
        file.write_text(json.dumps(data))
        expect(repository, "a checksum that does not fit", False, "checksum of the resolved scene")


def early_runs():
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(folder)
        shutil.rmtree(repository.results / "block")
        repository.run("--set", "time.end=0.5")
        expect(repository, "one more that ended early", False, "early configs/solid/block.yaml: finished at t = 0.5 of 1",
               "ended early: found 1, docs/results/early.txt allows 0")
        repository.allow(1)
        expect(repository, "one that may end early", True, "early configs/solid/block.yaml")
        assert "Ended early" in (repository.results / "block/early.md").read_text()
        assert not (repository.results / "block/run.md").exists()
        repository.change("young: 10", "young: 11")
        expect(repository, "one that ended early, of another scene", False, "young: 10, now 11")
        repository.change("young: 11", "young: 10")
        repository.run(name="whole")
        expect(repository, "a whole run beside it", True, "ok ", "may say 0 instead of 1")
        repository.allow("few")
        expect(repository, "no number of early ones", False, "expected the number")


def age_in_commits():
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(folder)

        def git(*words):
            return subprocess.run(["git", "-C", str(repository.root), "-c", "user.name=a", "-c", "user.email=a@b", *words],
                                  check=True, capture_output=True, text=True).stdout.strip()

        git("init")
        git("commit", "--allow-empty", "-m", "one")
        repository.run(commit=git("rev-parse", "HEAD"))
        git("commit", "--allow-empty", "-m", "two")
        git("commit", "--allow-empty", "-m", "three")
        expect(repository, "age in commits", True, "2 commits old")


def refuses_a_changed_scene():
    with tempfile.TemporaryDirectory() as folder:
        repository = Repository(folder)
        repository.run()
        repository.change("young: 10", "young: 12")
        done = subprocess.run([str(ROOT / "tools/record_run.py"), str(repository.root / "run"), "block", "--root",
                               str(repository.root), "--seam", SEAM], check=False, capture_output=True, text=True)
        if done.returncode == 0 or "has changed since" not in done.stderr:
            failures.append("a changed scene")
            print(f"FAIL recorded although the scene has changed: {done.stdout}{done.stderr}")
        else:
            print("ok   a changed scene is not recorded")


template = tempfile.TemporaryDirectory()
Repository.made = Repository(template.name).root
records_as_made()
with_scene("another title", "A block that is pulled", "A block", True)
with_scene("a parameter", "pull: 0.1", "pull: 0.11", False, "traction: [0.1*t, 0], now [0.11*t, 0]")
with_scene("a time step", "initial: 0.25", "initial: 0.2", False, "time.step.initial: 0.25, now 0.2")
with_scene("a stricter check", "at_most: 0.1,", "at_most: 0.002,", False, "FAIL  most")
with_scene("a formula", "twice: 2*end", "twice: 200*end", False, "FAIL  most")
with_scene("a statistic", "what: maximum", "what: minimum", False, "FAIL  most")
with_scene("another probe", "at: [1, 0.5]", "at: [1, 1]", False, "output.probes.end.at: [1, 0.5], now [1, 1]")
with_scene("a check of what was not recorded", "that: most", "that: reaction", False, "reaction")
changed_records()
early_runs()
age_in_commits()
refuses_a_changed_scene()
template.cleanup()
print(f"{len(failures)} failed")
sys.exit(len(failures) > 0)
