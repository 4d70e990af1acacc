#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Judges scenes by the JSON Schema that `seam schema` prints, with a validator and a reader of YAML 1.2 that are not Seam's;
and asks every check of a shipped scene for its kind.

  tests/schema/validate_scenes.py build/bin/seam      every scene of configs/ is accepted, the broken ones below are refused
"""

import json
import pathlib
import subprocess
import sys

import jsonschema
from ruamel.yaml import YAML

CONFIGS = pathlib.Path(__file__).resolve().parents[2] / "configs"

SOUND = """
title: A block
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [4, 4]}}}
fields:
  block: {type: solid, mesh: box, material: {type: neo_hookean, young: 1, poisson: 0.3}, boundary: [{on: 1, displacement: [0, null]}]}
study: {vary: {fields.block.material.young: [1, "2*3", 4.5]}, measure: unknowns}
"""

# What makes the scene above one that is to be refused: text in it, and what takes its place.
BROKEN = [
    ("title: A block\n", ""),
    ("dimension: 2", "dimension: 4"),
    ("dimension: 2", "dimension: [2]"),
    ("dimension: 2", "dimension: 2\nformat: 2"),
    ("meshes:", "mehses:"),
    ("type: solid", "type: sloid"),
    ("mesh: box, ", ""),
    ("young: 1", "young: -1"),
    ("young: 1", "young: [1]"),
    ("young: 1", "youngs: 1"),
    ("cells: [4, 4]", "cells: 4"),
    ("from: [0, 0]", "from: [0, 0, 0, 0]"),
    ("[{on: 1,", "[{on: {a: 1},"),
    ("[{on: 1,", "[{on: '',"),
    ("[{on: 1,", "[{true: 1,"),
    ("[1, \"2*3\", 4.5]", "[[1], 2]"),
]


def read(text):
    return YAML(typ="safe", pure=True).load(text)


def main():
    schema = json.loads(subprocess.run([sys.argv[1], "schema"], check=True, stdout=subprocess.PIPE).stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    failed = 0

    def judge(name, text, is_sound):
        nonlocal failed
        error = jsonschema.exceptions.best_match(validator.iter_errors(read(text)))
        if (error is None) != is_sound:
            failed += 1
            place = ".".join(str(key) for key in error.absolute_path) if error else ""
            print(f"{name}: {'refused at ' + place + ': ' + error.message[:200] if error else 'accepted'}")

    scenes = sorted(CONFIGS.rglob("*.yaml"))
    assert len(scenes) > 50, f"only {len(scenes)} scenes in {CONFIGS}"
    for scene in scenes:
        judge(scene, scene.read_text(), True)
        for check in read(scene.read_text()).get("checks", []):
            if "kind" not in check:
                failed += 1
                print(f"{scene}: the check of '{check['that']}' does not say its kind")
    judge("the sound scene", SOUND, True)
    for right, wrong in BROKEN:
        assert right in SOUND, right
        judge(f"with {wrong.strip()!r} for {right.strip()!r}", SOUND.replace(right, wrong), False)
    print(f"{len(scenes) + 1} sound and {len(BROKEN)} broken scenes, {failed} judged wrongly")
    return failed != 0


sys.exit(main())
