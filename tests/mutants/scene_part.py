# SPDX-License-Identifier: BSD-3-Clause
"""Mutated scenes: through `seam check`, or through that and `seam run`."""
import random
import shutil

import judge
import program
import small
import texts
import trees
import yamls

TEXT_KINDS = texts.BYTES | texts.LINES | texts.WORDS | yamls.ALL
KINDS = list(TEXT_KINDS) + list(trees.ALL)
# Runs are dear: mostly of what a check accepts, which bytes and YAML rarely do.
RUN_KINDS = list(texts.WORDS) + list(trees.ALL) + ["line removed", "line doubled"]


class Mutant:
    """A scene, what was done to it, and its bytes."""

    def __init__(self, part, seed, number, every):
        rng = random.Random(f"{part} {seed} {number}")
        kinds = RUN_KINDS if part == "run" else KINDS
        self.scene, text = every[number % len(every)]
        self.kind = kinds[(number + number // len(every)) % len(kinds)]
        # One mutation mostly, now and then some of any kind.
        extra = rng.choice([2, 3, 5]) if rng.random() < 0.1 else 0
        self.data = self._mutate(rng, self.kind, text.encode(), every)
        for _ in range(extra):
            self.data = self._mutate(rng, rng.choice(kinds), self.data, every)
        if extra:
            self.kind = "several at once"

    @staticmethod
    def _mutate(rng, kind, data, every):
        """Until something has changed."""
        for _ in range(10):
            try:
                other = (trees.apply(rng, trees.ALL[kind], data, rng.choice(every)[1]) if kind in trees.ALL else TEXT_KINDS[kind](rng, data))
            except Exception:  # not even the mutation reads what an earlier one left
                other = None
            if other is not None and other != data:
                return other
        return data


def put(mutant, folder):
    """Writes the scene below a folder, beside links to the meshes of configs."""
    path = folder / mutant.scene
    if not (folder / "solid").exists():
        for family in small.CONFIGS.iterdir():
            if family.is_dir():
                (folder / family.name).mkdir(parents=True)
                if (family / "meshes").is_dir():
                    (folder / family.name / "meshes").symlink_to(family / "meshes")
    path = path.with_name("mutant.yaml")
    path.write_bytes(mutant.data)
    return path


def row_of(part, number, mutant, call, bad):
    """A row of the results."""
    outcome = "bad" if bad else {0: "accepted", 1: "failed", 2: "refused", 3: "refused", 124: "time limit"}.get(call.code, "bad")
    return dict(part=part, number=number, scene=mutant.scene, kind=mutant.kind, outcome=outcome, code=call.code, bad=bad,
                place=judge.has_place(call), seconds=round(call.seconds, 2), told=(call.error or call.out)[:600])


def check(seam, rules, seed, number, every, folder):
    """A mutant through `seam check`."""
    mutant = Mutant("check", seed, number, every)
    path = put(mutant, folder)
    call = program.call([seam, *program.LIMITS, "check", path.name], path.parent, 20)
    return row_of("check", number, mutant, call, judge.check(call, rules, mutant.data))


def run(seam, rules, seed, number, every, folder):
    """A mutant through `seam check` and `seam run`."""
    mutant = Mutant("run", seed, number, every)
    path = put(mutant, folder)
    results = path.parent / "results"
    shutil.rmtree(results, ignore_errors=True)
    checked = program.call([seam, *program.LIMITS, "check", path.name], path.parent, 20)
    bad = judge.check(checked, rules, mutant.data)
    if bad:
        return row_of("run", number, mutant, checked, "check: " + bad)
    # A third may go to its end, as far as that comes within seconds; the others take a few steps.
    stop = ["--stop-after", "2"] if number % 3 else []
    call = program.call([seam, *program.LIMITS, "run", path.name, "--folder", "results", "--overwrite", "--quiet", "--no-picture", "--time-limit", "6", *stop], path.parent, 60)
    return row_of("run", number, mutant, call, judge.run(call, checked, results))
