#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes one wrong change to the source at a time, and sees whether a test notices.

  tools/mutate.py --list                     # the changes of tests/mutations, and whether they apply
  tools/mutate.py FOLDER [--only S3 R6 ...]  # in FOLDER, a git worktree of its own without changes

Without --only: all that have no outcome in the record yet. What was found is added to the record, docs/results/mutations.
"""
import argparse
import csv
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LISTS = ROOT / "tests" / "mutations"
RECORD = ROOT / "docs" / "results" / "mutations"
PLUGINS = ("solid", "cutfem_fluid", "nitsche_fsci", "poroelasticity", "manufactured", "mortar_contact")
FIELDS = ("id", "outcome", "by", "seconds", "commit")
SECONDS = 6000  # of a test; one that takes longer, ten times what the longest one needs, has noticed

# What could see a change, by the folder of the source, cheap ones first.
CHAINS = {
    "assembly": "solver kit:solid fluid kit:cutfem_fluid kit:nitsche_fsci",
    "base": "input solver",
    "constraint": "solver:ties_test run:constraints_test kit:solid kit:cutfem_fluid",
    "contact": "contact solver:surface_unknown_test cut scene:contact/patch_2d scene:contact/patch_3d scene:contact/closing_notch run:passage_test "
               "fsi:contact_in_fluid_test kit:nitsche_fsci",
    "cut": "cut cut_stress run:moving_cut_test run:separate_parts_test run:pocket_test fluid kit:cutfem_fluid "
           "scene:fsi/c01 ctest:cut_stress_found",
    "cutfem_fluid": "fluid:kernel_test fluid kit:cutfem_fluid run:moving_mesh_test scene:fluid/couette_slip scene:fluid/patch_shear "
                    "scene:fluid/vortices",
    "state": "solver cut ctest:solver_on_2_ranks run:restart_test run:separate_parts_test fsi:replay_test run:stepper_test",
    "field": "solver cut ctest:solver_on_3_ranks ctest:cut_on_3_ranks run:restart_test",
    "interface": "mesh solver cut scene:solid/bonded_blocks",
    "linear": "solver ctest:solver_on_2_ranks fluid:linear_solver_test kit:cutfem_fluid",
    "matrix": "cli:matrix_test ctest:junit run:matrix_run_test",
    "manufactured": "fsi:exact_test solver scene:fsi/c01 scene:poro/c07 scene:poro/waves",
    "mesh": "mesh input",
    "mortar_contact": "run:mortar_test kit:mortar_contact",
    "nitsche_fsci": "solver:nitsche_kernels_test solver:coupling_kernels_test fsi:eigenvalue_test fsi:exact_test fsi:contact_in_fluid_test fsi:porous_trends_test kit:nitsche_fsci "
                    "scene:contact/patch_2d run:energy_test",
    "output": "mesh:vtu_test run:output_test run:results_test run:results_folder_test run:cut_output_test run:flush_test",
    "physics": "solver kit:solid",
    "plugin": "input conformance",
    "poroelasticity": "solver:pore_kernels_test solver:coupling_kernels_test kit:poroelasticity run:porous_test run:porous_column_test run:porous_block_test run:porous_orders_test scene:poro/waves scene:poro/terzaghi",
    "record": "run:statistics_test run:results_test run:balances_test solver:error_norms_test run",
    "run": "run:statistics_test run:stepper_test run:balances_test run:results_test run:restart_test run:time_scheme_test "
           "solver:error_norms_test fsi:replay_test run",
    "scene": "input cli",
    "solid": "solver kit:solid scene:solid/pressure scene:solid/oscillator scene:solid/spinning_block "
             "scene:solid/cook_incompressible run:physics_test run:energy_test",
    "solve": "solver cut run:stepper_test run:time_scheme_test fsi:replay_test run:failure_test fsi:newton_test",
    "space": "solver cut ctest:cut_on_2_ranks ctest:solver_on_3_ranks fluid run:separate_parts_test fsi:replay_test",
    "surface": "cut contact mesh scene:contact/patch_2d",
    "term": "solver kit:solid fluid kit:cutfem_fluid scene:fluid/patch_shear",
}


@dataclass
class Change:
    id: str
    file: str
    what: str
    before: str = ""
    after: str = ""
    tests: list = field(default_factory=list)
    excused: tuple = ()  # ("equivalent" or "gone", why)

    @property
    def area(self):
        parts = Path(self.file).parts
        return parts[1] if parts[0] == "plugins" else "matrix" if parts[0] == "tools" else parts[2]

    def apply(self, text):
        """The changed text, or None where `before`, but for white space, does not stand in it exactly once."""
        words = r"\s+".join(re.escape(word) for word in self.before.split())
        found = re.findall(words, text)
        return text.replace(found[0], self.after) if len(found) == 1 else None

    def chain(self):
        return self.tests + [t for t in CHAINS[self.area].split() if t not in self.tests]


def read_lists():
    """A change: `id | file | what`, lines `- ` as it is, lines `+ ` as it becomes; `test: ` tests to begin with,
    `equivalent: ` why no test can see it, `gone: ` what became of the code."""
    changes = []
    for path in sorted(LISTS.glob("*.txt")):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            key, _, rest = line.partition(" ")
            if not line.strip() or line.startswith("#"):
                continue
            if line.count(" | ") >= 2 and not line.startswith(("- ", "+ ")):
                changes.append(Change(*line.split(" | ", 2)))
            elif key == "-":
                changes[-1].before += rest + "\n"
            elif key == "+":
                changes[-1].after += rest + "\n"
            elif key == "test:":
                changes[-1].tests += rest.split()
            elif key in ("equivalent:", "gone:"):
                changes[-1].excused = (key[:-1], rest)
            else:
                sys.exit(f"{path}:{number}: a change, `- `, `+ `, `test:`, `equivalent:` or `gone:` was expected, found `{line}`")
    for change in changes:
        change.before, change.after = change.before.strip("\n"), change.after.strip("\n")
    twice = {c.id for c in changes if sum(d.id == c.id for d in changes) > 1}
    if twice:
        sys.exit(f"ids of several changes: {', '.join(sorted(twice))}")
    return changes


def command_of(test, build, root):
    """What to build for a test, and its command."""
    kind, _, name = test.partition(":")
    plugins = [f"seam_plugin_{p}" for p in PLUGINS]
    if kind == "kit":
        return ["seam"] + plugins, ["bin/seam", "plugin", "test", f"{plugin_file(build, name)}", "--ranks", "1"]
    if kind == "scene":
        return ["seam"] + plugins, ["bin/seam", "verify", f"{root}/configs/{name}.yaml", "--quiet"]
    if kind == "cut_stress":
        return ["cut_stress"], ["bin/cut_stress", "1000", "100"]
    if kind == "ctest":  # one that has more arguments than those here, or several ranks
        program = "cut_stress" if name.startswith("cut_stress") else f"test_{name.split('_on_')[0]}"
        if name == "junit":
            return ["seam", "seam_plugin_solid"], ["ctest", "-R", "^junit$", "--output-on-failure"]
        return [program], ["ctest", "-R", f"^{name}$", "--output-on-failure"]
    selection = ["-#", f"[#{name}]"] if name else ["~[study]~[.]"]
    return [f"test_{kind}"], [f"bin/test_{kind}"] + selection


def plugin_file(build, name):
    return next(iter(sorted(Path(build).glob(f"lib/plugins/*{name}.so"))), f"lib/plugins/libseam_{name}.so")


def first_failure(output):
    """The name of the test case or scene that failed first, or the line that says so."""
    output = re.sub(r"\x1b\[[0-9;]*m", "", output)  # colours
    case = re.search(r"-{70,}\n(.+)\n(?:.*\n)*?-{70,}\n.*\n\.{70,}\n\n.*FAILED", output)
    if case:
        return case.group(1).strip()
    for line in output.splitlines():
        if not line.lstrip().startswith("ok") and re.search(r"FAIL|\bfailed\b|error|wrong", line):
            return " ".join(line.split())[:120]
    return ""


class Tree:
    """The worktree in which changes are made: whatever happens, it is left as it was."""

    def __init__(self, folder):
        self.root = Path(folder).resolve()
        self.build = self.root / "build"
        self.believed = set()  # tests that pass without a change
        if self.git("rev-parse", "--show-toplevel") != str(self.root):
            sys.exit(f"{folder} is no git worktree: make one with `git worktree add {folder}`")
        dirty = self.git("status", "--porcelain", "--untracked-files=no")
        if dirty:
            sys.exit(f"{folder} has changes that are not committed; a worktree of its own is needed, as it is committed:\n{dirty}")
        if not (self.build / "build.ninja").exists():
            sys.exit(f"{self.build} is not configured: `cmake --preset release` in {folder}")
        self.commit = self.git("rev-parse", "--short", "HEAD")

    def git(self, *words):
        return subprocess.run(["git", "-C", self.root, *words], capture_output=True, text=True, check=True).stdout.rstrip()

    def compile(self, targets):
        done = subprocess.run(["ninja", "-C", self.build, "-j", os.environ.get("SEAM_JOBS", "1"), *targets],
                              capture_output=True, text=True)
        return done.returncode == 0

    def run(self, test):
        """Whether it passes, and what it says if not."""
        _, command = command_of(test, self.build, self.root)
        folder = self.build / "mutate"
        folder.mkdir(exist_ok=True)
        in_build = command[0].startswith("bin/")
        process = subprocess.Popen([self.build / command[0] if in_build else command[0], *command[1:]],
                                   cwd=folder if in_build else self.build, text=True, errors="replace",
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            output, _ = process.communicate(timeout=SECONDS)
        except BaseException as stop:  # the time limit, or an interruption: its children go with it
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            if isinstance(stop, subprocess.TimeoutExpired):
                return False, f"longer than {SECONDS} s"
            raise
        if re.search(r"No test cases matched|No tests (ran|were found)", output):
            sys.exit(f"test `{test}` names no test case of {command[0]}: mend CHAINS or the `test:` line")
        output = output.replace(f"{self.root}/", "")
        return process.returncode == 0, first_failure(output) or f"exit code {process.returncode}"

    def outcome(self, change):
        path = self.root / change.file
        original = path.read_text() if path.exists() else ""
        changed = change.apply(original)
        if changed is None:
            return "does not apply", f"`{change.before}` does not stand exactly once in {change.file}"
        try:
            path.write_text(changed)
            for test in change.chain():
                if not self.compile(command_of(test, self.build, self.root)[0]):
                    return "does not compile", ""
                passed, failure = self.run(test)
                if not passed:
                    break
            else:
                return "survived", ", ".join(change.chain())
        finally:
            path.write_text(original)
        # A test that fails is believed if it passes without the change.
        if test not in self.believed:
            if not self.compile(command_of(test, self.build, self.root)[0]) or not self.run(test)[0]:
                sys.exit(f"test `{test}` fails without a change, too: nothing can be learned from it")
            self.believed.add(test)
        return "killed", f"{test}: {failure}"


def write_record(changes, outcomes):
    with open(RECORD / "outcomes.csv", "w", newline="") as out:
        writer = csv.DictWriter(out, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(outcomes[c.id] for c in changes if c.id in outcomes)

    def state(change):
        if change.excused:
            return change.excused[0]
        return outcomes[change.id]["outcome"] if change.id in outcomes else "not run"

    states = ("killed", "survived", "equivalent", "gone", "does not apply", "does not compile", "not run")
    lines = ["# Wrong changes to the source, and the tests that notice", "",
             "`tools/mutate.py FOLDER`, [what it does](../../test-seam.md#wrong-changes-to-the-source). A change that survived",
             "passed the tests that its row names, not all there are.", "",
             "| area | " + " | ".join(states) + " |", "|---|" + "---|" * len(states)]
    for area in sorted({c.area for c in changes}) + ["all"]:
        counts = [sum(state(c) == s for c in changes if area in (c.area, "all")) for s in states]
        lines.append(f"| {area} | " + " | ".join(str(n or "") for n in counts) + " |")
    lines += ["", "| id | file | change | outcome | by | s | commit |", "|---|---|---|---|---|---|---|"]
    for change in sorted(changes, key=lambda c: c.area):
        row = {f: "" for f in FIELDS} if change.excused else outcomes.get(change.id, {f: "" for f in FIELDS})
        why = change.excused[1] if change.excused else row["by"]
        name = change.file.removeprefix("core/seam/").removeprefix("plugins/")
        cells = [change.id, name, change.what, state(change), why, row["seconds"], row["commit"]]
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    (RECORD / "mutations.md").write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", help="a git worktree that nobody else works in")
    parser.add_argument("--only", nargs="+", metavar="ID", help="these changes, whether they were run or not")
    parser.add_argument("--list", action="store_true", help="only says which changes there are and whether they apply")
    options = parser.parse_args()
    changes = read_lists()
    unknown = set(options.only or ()) - {c.id for c in changes}
    if unknown:
        sys.exit(f"no change is called {', '.join(sorted(unknown))}: see --list")
    chosen = [c for c in changes if c.id in options.only] if options.only else changes
    if options.list:
        for c in chosen:
            path = ROOT / c.file
            applies = "applies" if path.exists() and c.apply(path.read_text()) else "does not apply"
            print(f"{c.id:5} {c.excused[0] if c.excused else applies:15} {c.file}: {c.what}")
        return
    if not options.folder:
        parser.error("the folder of a worktree is missing")
    RECORD.mkdir(parents=True, exist_ok=True)
    saved = RECORD / "outcomes.csv"
    outcomes = {row["id"]: row for row in csv.DictReader(open(saved))} if saved.exists() else {}
    # To be ended is to be interrupted: what was changed is restored.
    ending = (signal.SIGTERM, signal.SIGHUP)

    def end(*_):
        for number in ending:  # a second one must not interrupt the restoring
            signal.signal(number, signal.SIG_IGN)
        sys.exit("ended by a signal")

    for number in ending:
        signal.signal(number, end)
    os.environ.update(OPENBLAS_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                      OMPI_MCA_btl_vader_single_copy_mechanism="none", OMPI_MCA_mpi_yield_when_idle="1")
    tree = Tree(options.folder)
    for change in chosen:
        if change.excused or (change.id in outcomes and not options.only):
            continue
        start = time.monotonic()
        outcome, by = tree.outcome(change)
        seconds = f"{time.monotonic() - start:.0f}"
        print(f"{change.id:5} {outcome:16} {seconds:>4} s  {by}", flush=True)
        outcomes[change.id] = dict(zip(FIELDS, (change.id, outcome, by, seconds, tree.commit)))
        write_record(changes, outcomes)


if __name__ == "__main__":
    main()
