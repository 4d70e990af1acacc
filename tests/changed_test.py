#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What `tools/test.sh changed` selects: some facts that are known, and for each wrong change to the source that was ever noticed
(docs/results/mutations) the test which noticed it.

    tests/changed_test.py BUILD
"""
import csv
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools"))

import changed  # noqa: E402
import mutate  # noqa: E402

build = changed.Build(sys.argv[1])
selections, wrong = {}, []


def select(file):
    if file not in selections:
        selections[file] = changed.Selection(build, [file])
    return selections[file]


def expect(holds, what):
    if not holds:
        wrong.append(what)


def names(file):
    return [test.name for test in select(file).tests]


def share(file):
    """Of the test cases and scenes."""
    selection = select(file)
    return sum(t.cases + t.scene for t in selection.tests) / (selection.total + len(selection.scenes))


def noticed_by(by):
    """Names of tests of which one is to be selected, from what the record says, such as "run:porous_test: a case"."""
    test, _, _ = by.partition(": ")
    kind, _, name = test.partition(":")
    if kind == "kit":
        return [f"conformance_of_{name}"]
    if kind == "scene":
        return [f"configs/{name}"]
    if kind == "ctest":
        return [name]
    if kind == "cut_stress":
        return [kind]
    case = by.removeprefix(f"{test}: ")
    files = [name] if name else [f for f, found in build.names[kind].items() if any(c.startswith(case[:60]) for c in found)]
    return [f"{kind}/{f}" for f in files]


kernels = ["plugins/poroelasticity/kernels.hpp", "plugins/nitsche_fsci/contact_kernels.hpp", "plugins/solid/spring_kernels.hpp",
           "plugins/cutfem_fluid/kernels.hpp"]
for file in kernels:
    expect(share(file) < 1 / 3, f"{file} selects {share(file):.0%} of all cases and scenes, expected less than a third")
porous = names(kernels[0])
for name in ("conformance_of_poroelasticity", "solver/pore_kernels_test", "run/porous_test", "configs/poro/terzaghi"):
    expect(name in porous, f"{kernels[0]} does not select {name}")
for name in ("run/rigid_test", "conformance_of_solid", "configs/solid/cook", "cut/cut_test"):
    expect(name not in porous, f"{kernels[0]} selects {name}")
order = [porous.index(name) for name in ("solver/pore_kernels_test", "conformance_of_poroelasticity", "run/porous_test", "configs/poro/terzaghi")]
expect(order == sorted(order), f"{kernels[0]} selects in the order {porous}")
expect("solver/spring_test" == names(kernels[2])[1], f"{kernels[2]}: spring_test is not the first after format")
# Where time is short, what is far from the change and takes long is left out, and what is beside it stays.
short = changed.Selection(build, [kernels[0]])
known, changed.times = changed.times, lambda folder: {name: 1000.0 if "kernels_test" in name else 50.0 for name in porous}
short.fit(120)
changed.times = known
kept = [test.name for test in short.tests]
expect({"solver/pore_kernels_test", "solver/coupling_kernels_test"} <= set(kept), f"short of time, what is near is left out: {kept}")
expect(sorted(kept + [name for name, _ in short.left_out]) == sorted(porous), "what is left out is not told")
expect("configs/poro/terzaghi" in dict(short.left_out) and kept == [name for name in porous if name in kept], f"short of time, kept are {kept}")
expect(names("plugins/solid/nobody.hpp") == [] and names("README") == [], "files that nothing depends on select something")
expect(names("docs/architecture.md") == ["public_headers"], "documentation selects more than a check of headers")
expect(names("configs/solid/cook.yaml")[0] == "configs/solid/cook", "a changed scene is not the first")
expect("mistakes" in names("tests/mistakes/mistakes.py") and "run/rigid_test" not in names("tests/mistakes/mistakes.py"), "a Python test")
for file in ("core/seam/cut/cut_mesh.hpp", "core/seam/scene/expression.cpp", "tests/CMakeLists.txt"):
    expect(share(file) == 1, f"{file} does not select everything")
    expect({t["name"] for t in build.tests} - {n.split("/")[0] for n in names(file)} <= {"public_headers", "changed"}, f"{file} leaves tests out")
expect(names("core/seam/cut/cut_mesh.hpp")[1].startswith("cut/"), "the tests of the folder are not the first")

changes = {change.id: change for change in mutate.read_lists()}
with (ROOT / "docs/results/mutations/outcomes.csv").open() as file:
    noticed = [row for row in csv.DictReader(file) if row["outcome"] == "killed" and row["id"] in changes]
count = 0
for row in noticed:
    file = changes[row["id"]].file
    if not (ROOT / file).exists():
        continue
    due = noticed_by(row["by"])
    missing = due and not any(name == one or name.startswith(one + "/") for one in due for name in names(file))
    count += bool(due)
    expect(not missing, f"change {row['id']} of {file} was noticed by {row['by']}, which is not selected")
print(f"{count} of {len(noticed)} noticed changes looked up; {len(selections)} files")
for what in wrong:
    print("FAIL", what)
sys.exit(bool(wrong))
