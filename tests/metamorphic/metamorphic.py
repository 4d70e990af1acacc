#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes scenes anew (turned, mirrored, moved, in other units, renamed, reordered, renumbered), runs both and compares columns.

  tests/metamorphic/metamorphic.py build/bin/seam --ci              one scene a family, in the plane and in space
  tests/metamorphic/metamorphic.py build/bin/seam                   all scenes
  tests/metamorphic/metamorphic.py build/bin/seam --scene fsi* --relation mirrored --keep out
  tests/metamorphic/metamorphic.py build/bin/seam --record          writes docs/results/metamorphic, too
  tests/metamorphic/metamorphic.py build/bin/seam --keep out --rows out/rows.json --scene 'fsi*' --record
                                                                    runs these anew, judges and records the others as they were

Exit code 1 when a deviation is larger than expected.py allows.
"""
import argparse
import fnmatch
import json
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))

import columns  # noqa: E402  the modules beside this file
import compare  # noqa: E402
import expected  # noqa: E402
import record  # noqa: E402
import relations  # noqa: E402
import runs  # noqa: E402
import scene as scenes  # noqa: E402
import yaml  # noqa: E402

# In continuous integration each scene is written anew in the first three ways and in one of the others, in turn.
CI_RELATIONS = ("turned, moved, all units", "lists reversed", "renumbered")
CI_IN_TURN = ("mirrored", "cyclic, same numbers", "renamed")


def read_scene(entry, schema):
    """A scene of the table as a tree."""
    tree = scenes.read(HERE / entry["scene"], schema, entry.get("set", {}))
    if entry.get("newton") != "own":
        tree.value["solver"] = tree.get("solver") or scenes.Node("object", "scene.solver", {})
        tree["solver"].value["newton"] = schema.read({"tolerance": "1e-11", "increment_tolerance": "1e-9"}, "scene.solver.newton",
                                                     schema.root["properties"]["solver"]["properties"]["newton"])
    return expand_circles(tree)


def expand_circles(tree, facets=48):
    """Circles as outlines: Seam's polygon starts at an angle that is not the same after a quarter of a turn."""
    import math
    for interface in (tree["interfaces"].value.values() if tree.get("interfaces") else []):
        body = interface.get("body")
        if not isinstance(body, scenes.Node) or body.place != "body.circle":
            continue
        (x, y), r = scenes.numbers(body["centre"]), float(body["radius"].value)
        corners = []
        for k in range(facets):
            angle = 2 * math.pi * (k + 0.3) / facets
            corners.append(scenes.Node("object", "body.outline.corners", {"at": scenes.Node(
                "vector", "body.outline.corners.at", [repr(x + r * math.cos(angle)), repr(y + r * math.sin(angle))], "m")}))
        interface.value["body"] = scenes.Node("typed", "body.outline", {"corners": scenes.Node("list", "body.outline.corners", corners)},
                                              type_name="outline")
    return tree


def compare_variant(seam, tree, base, table, relation, folder, reuse):
    """One row of the results."""
    folder.mkdir(parents=True, exist_ok=True)
    variant = relations.RELATIONS[relation](tree, table, folder)
    run = runs.run(seam, variant.tree, folder, reuse)
    if run.failure:
        return compare.Deviation(failure=run.failure), run
    series = {old: run.series[new] for old, new in variant.names.items() if new in run.series} | {"time": run.series["time"]} \
        if variant.names else run.series
    return compare.compare(table, base.series, table.back(variant.frame, series)), run


def judge(row):
    """Adds the verdict and its reason to a row."""
    allowed = expected.allowed(row["scene"], row["relation"])
    within = not row["failure"] and row["largest"] <= allowed.largest and row["remainder"] <= allowed.remainder
    row["verdict"] = "known" if allowed.known else "ok" if within else "FAILED"
    row["reason"] = allowed.reason


def run_scene(seam, schema, name, entry, wanted, folder, reuse):
    """All rows of a scene."""
    tree = read_scene(entry, schema)
    own = folder / name.replace(" ", "_")
    own.mkdir(parents=True, exist_ok=True)
    base = runs.run(seam, tree, own, reuse)
    if base.failure:
        row = dict(scene=name, family=entry["family"], relation="as written", failure=base.failure, largest=0, remainder=0)
        judge(row)
        return [row]
    table = columns.Columns(tree, [c for c in base.series if c != "time"])
    rows = []
    for relation in wanted:
        if relation in entry.get("without", {}):
            continue
        try:
            below = own / relation.replace(" ", "_").replace("/", "over")
            deviation, run = compare_variant(seam, tree, base, table, relation, below, reuse)
        except Exception as error:  # whatever it is, the other rows are wanted
            deviation, run = compare.Deviation(failure=f"{type(error).__name__}: {error}"), runs.Run({})
        rows.append(dict(scene=name, family=entry["family"], relation=relation, dimension=int(tree["dimension"].value),
                         largest=deviation.largest, column=deviation.column, remainder=deviation.remainder,
                         remainder_column=deviation.remainder_column, compared=deviation.compared, failure=deviation.failure,
                         steps=base.steps, iterations=[base.iterations, run.iterations],
                         seconds=round(run.seconds, 3)))
        judge(rows[-1])
    return rows


def show(row):
    """One line a row."""
    if row.get("failure"):
        return f"{row['verdict']:7} {row['scene']:30} {row['relation']:26} {row['failure']}"
    more = "" if row["iterations"][0] == row["iterations"][1] else f"  iterations {row['iterations'][0]}, {row['iterations'][1]}"
    return (f"{row['verdict']:7} {row['scene']:30} {row['relation']:26} {row['largest']:8.1e} {row['column']:24} "
            f"{row['remainder']:8.1e} {row['remainder_column']}{more}")


def relations_of(options, in_ci, name):
    """The relations of a scene that are asked for. @param in_ci the scenes that continuous integration runs"""
    every = relations.RELATIONS
    if options.ci:
        every = CI_RELATIONS + (CI_IN_TURN[in_ci.index(name) % len(CI_IN_TURN)],) if name in in_ci else ()
    return [relation for relation in every if fnmatch.fnmatch(relation, options.relation)]


def write_rows(folder, rows):
    """For --rows; whole at any time."""
    (folder / "rows.part").write_text(json.dumps(rows, indent=1))
    (folder / "rows.part").rename(folder / "rows.json")


def later(earlier, rows):
    """Rows of an earlier run of scenes that are still to come."""
    done = {row["scene"] for row in rows}
    return [row for row in earlier if row["scene"] not in done]


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seam", type=Path)
    parser.add_argument("--ci", action="store_true", help="only the scenes with `ci: true`, in a few ways")
    parser.add_argument("--scene", default="*", help="pattern of names of scenes")
    parser.add_argument("--relation", default="*", help="pattern of names of relations")
    parser.add_argument("--keep", type=Path, help="folder in which scenes and results stay")
    parser.add_argument("--record", action="store_true", help="write docs/results/metamorphic")
    parser.add_argument("--rows", type=Path, help="rows.json of an earlier run, from --keep, to which rows are added; runs of the same scenes are not repeated")
    options = parser.parse_args()
    seam = str(options.seam.resolve())
    schema = scenes.Schema(seam)
    table = yaml.load((HERE / "scenes.yaml").read_text(), Loader=yaml.BaseLoader)
    earlier = json.loads(options.rows.read_text()) if options.rows else []
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or Path(temporary)
        for name, entry in table.items():
            wanted = relations_of(options, [n for n in table if table[n].get("ci")], name)
            before = {row["relation"]: row for row in earlier if row["scene"] == name}
            chosen = fnmatch.fnmatch(name, options.scene) and (entry.get("ci") or not options.ci)
            new = run_scene(seam, schema, name, entry, wanted, folder.resolve(), bool(options.rows)) if chosen and wanted else []
            for row in new:
                print(show(row), flush=True)
            if new:
                before.pop("as written", None)  # it may have failed then
            both = before | {row["relation"]: row for row in new}
            rows += [both[relation] for relation in ("as written", *relations.RELATIONS) if relation in both]
            if options.keep:
                write_rows(folder, rows + later(earlier, rows))
    for row in rows:
        judge(row)
    failed = sum(row["verdict"] == "FAILED" for row in rows)
    if options.record:
        record.write(rows, sum(row.get("seconds", 0) for row in rows))
    print(f"{len(rows) - failed} passed, {failed} failed")
    return 1 if failed or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
