# SPDX-License-Identifier: BSD-3-Clause
"""Damaged meshes, restart points and what stands beside them, series that are replayed."""
import functools
import random
import shutil
import tempfile
from pathlib import Path

import judge
import meshes
import program
import readers
import restarts
import texts

REPLAY = texts.BYTES | texts.LINES | texts.WORDS


def judge_file(seam, _, seed, number, __, folder):
    """A damaged file: two of three are meshes, the others are restart points and series in turn."""
    rng = random.Random(f"files {seed} {number}")
    folder.mkdir(parents=True)
    if number % 3 != 2:
        return judge_mesh(seam, rng, number, folder)
    return (judge_replay if number % 9 == 8 else judge_restart)(seam, rng, number, folder)


def row_of(number, what, kind, call, bad):
    """A row of the results."""
    outcome = "bad" if bad else {0: "accepted", 1: "failed", 2: "refused", 3: "refused", 124: "time limit"}.get(call.code, "bad")
    return dict(part="files", number=number, scene=what, kind=kind, outcome=outcome, code=call.code, bad=bad, place=judge.has_place(call),
                seconds=round(call.seconds, 2), told=(call.error or call.out)[:600])


@functools.cache
def mesh_files():
    """All mesh files."""
    return meshes.every()


def judge_mesh(seam, rng, number, folder):
    """A damaged mesh through a check, and through a run where that accepts it."""
    turn = number * 2 // 3
    name, data, scene, reader = mesh_files()[turn % len(mesh_files())]
    kind = list(meshes.KINDS)[(turn + turn // len(mesh_files())) % len(meshes.KINDS)]
    damaged = data
    for _ in range(10):
        damaged = meshes.KINDS[kind](rng, data) or data
        if damaged != data:
            break
    file = name.rsplit(".", 1)[-1] if name.endswith((".msh", ".geo")) else "msh" if "Gmsh" in name else "vtu"
    (folder / f"mesh.{file}").write_bytes(damaged)
    (folder / "scene.yaml").write_text(scene)
    checked = program.call([seam, *program.LIMITS, "check", "scene.yaml"], folder, 30)
    kind = f"{'VTU' if file == 'vtu' else 'Gmsh' if file == 'msh' else 'geometry'}: {kind}"
    bad = judge.told(checked)
    if not bad and checked.code == judge.FAILED and "memory" not in checked.error:
        bad = "a check that fails instead of refusing"
    if not bad and checked.code == 0 and reader:
        due = reader(damaged)
        bad = "accepted: " + due if due else ""
    if bad or checked.code != 0:
        return row_of(number, name, kind, checked, bad)
    call = program.call([seam, *program.LIMITS, "run", "scene.yaml", "--folder", "results", "--quiet", "--no-picture", "--time-limit", "6"], folder, 60)
    return row_of(number, name, kind, call, judge.run(call, checked, folder / "results"))


@functools.cache
def base_run(seam):
    """The run whose folder is damaged, in a folder that lives as long as this program."""
    temporary = tempfile.TemporaryDirectory()
    base = restarts.Base(seam, Path(temporary.name))
    base.temporary = temporary
    return base


def judge_restart(seam, rng, number, folder):
    """A run that goes on from damaged files: it must refuse, or end with the same numbers."""
    base, kinds = base_run(seam), list(restarts.KINDS)
    turn = number // 3
    kind = kinds[(turn - turn // 3) % len(kinds)]
    file = restarts.damage(rng, kind, base, folder / "one")
    results = folder / "one" / "results"
    call = restarts.seam_run(seam, folder / "one", "scene.yaml", "--resume")
    bad = judge.told(call)
    if not bad and "forged" in kind:
        pass  # numbers that nobody can tell from true ones
    elif not bad and call.code == judge.FAILED and not kind.startswith("beside"):
        bad = "fails instead of refusing"
    elif not bad and call.code == 0:
        bad = judge.left(results)
        if not bad and (results / "series.csv").read_bytes() != base.series:
            bad = "other numbers than undamaged"
        # What is damaged and passed over is told; an older point of the same run is as good.
        if not bad and kind.startswith("restart point") and "removed" not in kind and "older" not in kind and "restart point" not in call.error:
            bad = "damage is not told"
    return row_of(number, file.name if kind.startswith("beside") else "restart point", kind, call, bad)


def judge_replay(seam, rng, number, folder):
    """A scene that takes the steps of a damaged series again."""
    base = base_run(seam)
    kind = list(REPLAY)[number // 9 % len(REPLAY)]
    damaged = REPLAY[kind](rng, base.series) or b""
    shutil.copy(base.folder / "one" / "scene.yaml", folder / "scene.yaml")
    (folder / "old.csv").write_bytes(damaged)
    due, times = readers.series(damaged)
    more = ["--set", "time.step.replay=old.csv"]
    checked = program.call([seam, "check", "scene.yaml", *restarts.SETS, *more], folder, 20)
    call = restarts.seam_run(seam, folder, "scene.yaml", *more)
    bad = judge.told(checked) or judge.run(call, checked, folder / "results")
    if not bad and call.code == 0:
        bad = "accepted: " + due if due else missed(times, folder / "results")
    return row_of(number, "series.csv", "replay: " + kind, call, bad)


def missed(times, results):
    """A time of the series that the run did not come by."""
    taken = readers.series((results / "series.csv").read_bytes())[1]
    lost = [t for t in times if 0 < t <= restarts.STEPS * 0.05 and not any(abs(t - other) < 1e-9 for other in taken)]
    return f"the step to {lost[0]} was not taken" if lost else ""
