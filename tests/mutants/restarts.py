# SPDX-License-Identifier: BSD-3-Clause
"""Folders of results to damage: a run that was stopped, its restart points and what stands beside them, a series to be replayed."""
import json
import shutil
import struct
from pathlib import Path

import program
import texts

TESTS = Path(__file__).resolve().parents[1]
STEPS, STOPPED = 5, 3
SETS = ["--set", "meshes.channel.grid.cells=[8, 4]", "--set", f"time.end={STEPS * 0.05}", "--set", "output.restart={every: 1, keep: 3}"]


def seam_run(seam, folder, scene, *more):
    """A run into `results` of a folder."""
    return program.call([seam, "run", scene, "--folder", "results", "--quiet", "--no-picture", *SETS, *more], folder, 30)


class Base:
    """A run that was stopped, and the series that it has when it goes on undisturbed."""

    def __init__(self, seam, folder):
        self.folder = folder / "base"
        for name, more in (("one", []), ("other", ["--set", "fields.water.viscosity=0.02"])):
            below = self.folder / name
            below.mkdir(parents=True)
            shutil.copy(TESTS / "run" / "moving_disc.yaml", below / "scene.yaml")
            self._expect(seam_run(seam, below, "scene.yaml", "--stop-after", str(STOPPED), *more))
        shutil.copytree(self.folder / "one", self.folder / "whole")
        self._expect(seam_run(seam, self.folder / "whole", "scene.yaml", "--resume"))
        self.series = (self.folder / "whole" / "results" / "series.csv").read_bytes()

    @staticmethod
    def _expect(call):
        if call.code != 0:
            raise RuntimeError(f"the undamaged run ends with {call.code}: {call.error}")


def newest(results):
    """The newest restart point."""
    return sorted((results / "restart").glob("*.restart"))[-1]


def checksum(data):
    """64-bit FNV-1a, as core/seam/base/checksum.hpp has it."""
    value = 14695981039346656037
    for byte in data:
        value = ((value ^ byte) * 1099511628211) & 0xffffffffffffffff
    return value


def forge(rng, data):
    """Something in the header or among the numbers is another one, and the checksum is right again."""
    length = struct.unpack("<Q", data[8:16])[0]
    header, payload = json.loads(data[16:16 + length]), bytearray(data[16 + length:-8])
    way = rng.randrange(4)
    if way == 0:
        _change_header(rng, header)
    elif way == 1:
        for _ in range(rng.choice([1, 20])):
            at = 8 * rng.randrange(len(payload) // 8)
            payload[at:at + 8] = struct.pack("<d", rng.choice([float("nan"), float("inf"), -1e300, 1e300, 1e10, -1, 0, 5e-324, 3e9]))
    elif way == 2:
        payload = payload[:8 * rng.randrange(len(payload) // 8)] if rng.random() < 0.7 else payload + payload
    text = json.dumps(header).encode()
    if way == 3:
        text = rng.choice([texts.flip_bit, texts.remove_bytes, texts.change_number, lambda _, t: t[:len(t) // 2], lambda _, t: b"", lambda _, t: b"[" * 100000, lambda _, t: b"[]"])(rng, text)
    text += b" " * (-len(text) % 8)
    size = rng.choice([len(text), len(text), len(text), len(text), 0, 2 ** 63, len(text) + 8]) if way == 3 else len(text)
    body = data[:8] + struct.pack("<Q", size) + text + bytes(payload)
    return body + struct.pack("<Q", checksum(body))


def _change_header(rng, header):
    key = rng.choice(list(header))
    where = header
    if isinstance(header[key], list) and header[key] and isinstance(header[key][0], dict) and rng.random() < 0.7:
        where = rng.choice(header[key])
        key = rng.choice(list(where))
    if rng.random() < 0.3:
        del where[key]
    else:
        where[key] = rng.choice([None, "", "a", -1, 0, 1, 1.5, 10 ** 6, 2 ** 31, 2 ** 40, 1e300, True, [], {}, [1], [[]], ["a"]])


BESIDE = ["run.json", "manifest.txt", "series.csv", "events.jsonl", "summary.json"]
KINDS = {f"restart point: {name}": way for name, way in texts.BYTES.items()}
KINDS |= {"restart point: forged": forge, "restart point: of another scene": None, "restart point: an older one": None, "restart point: empty": lambda _, __: b"",
          "restart point: removed": None, "beside: bytes": None, "beside: words": None, "beside: removed": None}


def damage(rng, kind, base, folder):
    """A copy of the stopped run with something damaged. @returns the file"""
    shutil.copytree(base.folder / "one", folder)
    results = folder / "results"
    point = newest(results)
    if kind.startswith("beside"):
        file = results / rng.choice(BESIDE)
        ways = list((texts.BYTES if kind == "beside: bytes" else texts.WORDS | texts.LINES).values())
        if kind == "beside: removed":
            file.unlink(missing_ok=True)
        else:
            file.write_bytes(rng.choice(ways)(rng, file.read_bytes()) or b"")
        return file
    if kind == "restart point: removed":
        point.unlink()
    elif kind == "restart point: of another scene":
        shutil.copy(newest(base.folder / "other" / "results"), point)
    elif kind == "restart point: an older one":
        shutil.copy(sorted((results / "restart").glob("*.restart"))[0], point)
    else:
        points = [point] if rng.random() < 0.7 else list((results / "restart").glob("*.restart"))
        for one in points:
            one.write_bytes(KINDS[kind](rng, one.read_bytes()))
    return point
