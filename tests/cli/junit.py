#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What `seam verify --matrix` leaves for continuous integration, read by a program that is not Seam's, and compared with
the schema that Jenkins publishes for it (junit-10.xsd of its xUnit plugin), whose rules are written down here.

    tests/cli/junit.py SEAM
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as tree

import junitparser

SCENE = """
title: 'Pulled: "a" & b <c>'
dimension: 2
plugins: [solid]
parameters: {load: 1, n: 2}
meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [n, n]}}}
fields:
  block:
    type: solid
    mesh: block
    material: {type: neo_hookean, young: 100, poisson: 0.3}
    boundary:
      - {on: x_min, displacement: [0, 0]}
      - {on: x_max, traction: [0, load*t]}
time: {static: true, end: 1, step: {initial: 0.25}}
output: {probes: {tip: {field: block, at: [1, 1], quantity: displacement, component: y}}}
checks:
  - {that: tip, is: 0.06, within: 50%, source: order of magnitude}
  - {that: tip, at_least: 0, source: it is pulled}
matrix:
  vary:
    load: [1, -1, 1e9, 2]
    restart: [none, 1]
    output.probes.tip.at: ["[1, 1]", "[1, 7]"]
  leave_out: restart == 1 && load != 1
  agree: [{over: [restart], within: 1e-9}]
  known: [{when: load == 2, reason: 'twice "as" <far>'}]
"""

# Children and attributes of each element; those with ! must be there.
SCHEMA = {
    "testsuites": ({"testsuite"}, {"name", "time", "tests", "failures", "errors"}),
    "testsuite": ({"testcase", "properties", "testsuite", "system-out", "system-err"},
                  {"name!", "tests!", "failures!", "errors!", "group", "time", "skipped", "timestamp", "hostname", "id", "package",
                   "file", "log", "url"}),
    "testcase": ({"skipped", "error", "failure", "system-out", "system-err"}, {"name!", "time", "classname", "group"}),
    "failure": (set(), {"type", "message"}),
    "error": (set(), {"type", "message"}),
    "skipped": (set(), {"type", "message"}),
}
TIME = re.compile(r"(([0-9]{0,3},)*[0-9]{3}|[0-9]{0,3})*(\.[0-9]*)?")


def require(condition, text):
    if not condition:
        sys.exit(f"FAIL {text}")


def check_element(element):
    require(element.tag in SCHEMA, f"no element {element.tag} is known")
    children, attributes = SCHEMA[element.tag]
    names = {a.rstrip("!") for a in attributes}
    require(set(element.attrib) <= names, f"{element.tag} has {set(element.attrib) - names}")
    require({a[:-1] for a in attributes if a.endswith("!")} <= set(element.attrib), f"{element.tag} lacks an attribute")
    if element.tag != "testcase" and "time" in element.attrib:
        require(TIME.fullmatch(element.attrib["time"]), f"time {element.attrib['time']}")
    for child in element:
        require(child.tag in children, f"{child.tag} in {element.tag}")
        check_element(child)


def kind(case):
    kinds = {junitparser.Failure: "failure", junitparser.Error: "error", junitparser.Skipped: "skipped"}
    return [kinds[type(result)] for result in case.result]


def main():
    seam = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory(prefix='seam & <"junit">') as folder:
        os.chdir(folder)
        pathlib.Path("a&b.yaml").write_text(SCENE)
        pathlib.Path("bad.yaml").write_text("title: \"a \\x01 \\u1234\"\ndimension: \x22four\x22\n")
        run = subprocess.run([seam, "verify", "--matrix", "a&b.yaml", "bad.yaml"], capture_output=True, text=True)
        require(run.returncode == 1, f"exit code {run.returncode}\n{run.stdout}{run.stderr}")
        file = pathlib.Path("results/matrix/junit.xml")
        root = tree.parse(file).getroot()
        check_element(root)
        table = json.loads(pathlib.Path("results/matrix/matrix.json").read_text())

        suites = {suite.name: suite for suite in junitparser.JUnitXml.fromfile(str(file))}
        require(set(suites) == {"a&b.yaml", "bad.yaml"}, f"suites {set(suites)}")
        found = {}
        for name, suite in suites.items():
            cases = list(suite)
            require(suite.tests == len(cases), f"{name}: {suite.tests} tests, {len(cases)} cases")
            for word, number in (("failure", suite.failures), ("error", suite.errors), ("skipped", suite.skipped)):
                require(number == sum(kind(case) == [word] for case in cases), f"{name}: {number} of {word}")
            require(abs(suite.time - sum(case.time for case in cases)) < 0.1, f"{name}: {suite.time} s")
            for case in cases:
                found.setdefault((name, case.name.rpartition(": ")[0]), []).extend(kind(case))
        # Each variant of the table is there with what came of it.
        expected = {"ok": set(), "known": {"skipped"}, "FAIL": {"failure", "error"}}
        for variant in table["variants"]:
            kinds = set(found[(variant["scene"], variant["variant"])])
            verdict = variant["verdict"]
            require(kinds <= expected[verdict] and bool(kinds) == bool(expected[verdict]),
                    f"{variant['variant']}: {verdict} is {kinds}")
        count = {verdict: sum(v["verdict"] == verdict for v in table["variants"]) for verdict in expected}
        require(count == {"ok": 2, "known": 2, "FAIL": 7}, f"verdicts {count}")
        text = file.read_text()
        require("alone: seam run 'a&amp;b.yaml' --set parameters.load=-1" in text, "the command that repeats a failure")
        require('known: twice "as" &lt;far&gt;'.replace('"', "&quot;") in text, "why a variant is known")
    print("1 passed, 0 failed")


if __name__ == "__main__":
    main()
