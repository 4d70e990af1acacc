# SPDX-License-Identifier: BSD-3-Clause
"""Readers of meshes and series that are strict and not Seam's: why a file has to be refused, "" where they know of no reason."""
import base64
import math
import re
import struct
import zlib
import xml.etree.ElementTree as xml

NODES = {1: 2, 2: 3, 3: 4, 4: 4, 5: 8, 8: 3, 9: 6, 10: 9, 11: 10, 12: 27, 15: 1}
VTK_NODES = {5: 3, 9: 4, 10: 4, 12: 8, 22: 6, 24: 10, 28: 9, 29: 27}
TYPES = {"Int8": "b", "UInt8": "B", "Int16": "h", "UInt16": "H", "Int32": "i", "UInt32": "I", "Int64": "q", "UInt64": "Q", "Float32": "f", "Float64": "d"}


class Due(Exception):
    """A reason."""


def gmsh(data):
    """A mesh of Gmsh, format 2.2 or 4.1."""
    try:
        text = data.decode()
        parts = {m.group(1): m.group(2) for m in re.finditer(r"\$(\w+)\n(.*?)\$End\1\b", text, re.S)}
        for name in ("MeshFormat", "Nodes", "Elements"):
            if name not in parts or len(re.findall(rf"(?m)^\${name}\b", text)) != 1:
                raise Due(f"no ${name}, or more than one")
        words = iter(parts["Nodes"].split())
        nodes = _nodes(words, parts["MeshFormat"].split()[0])
        _elements(iter(parts["Elements"].split()), parts["MeshFormat"].split()[0], nodes)
    except UnicodeDecodeError:
        return ""  # names may be anything
    except (Due, ValueError, KeyError, IndexError, StopIteration, RuntimeError) as error:
        return f"mesh: {type(error).__name__} {error}"
    return ""


def _end(words):
    if next(words, None) is not None:
        raise Due("more than the counts say")


def _nodes(words, version):
    if version == "2.2":
        found = {int(next(words)): [float(next(words)) for _ in "xyz"] for _ in range(int(next(words)))}
    else:
        blocks, count, _, _ = (int(next(words)) for _ in range(4))
        found = {}
        for _ in range(blocks):
            size = [int(next(words)) for _ in range(4)][3]
            tags = [int(next(words)) for _ in range(size)]
            found |= {tag: [float(next(words)) for _ in "xyz"] for tag in tags}
        if len(found) != count:
            raise Due("nodes that are missing or there twice")
    _end(words)
    if any(not math.isfinite(x) for place in found.values() for x in place):
        raise Due("coordinates that are no numbers")
    return found


def _elements(words, version, nodes):
    if version == "2.2":
        for _ in range(int(next(words))):
            kind = [int(next(words)) for _ in range(2)][1]
            [next(words) for _ in range(int(next(words)))]
            for _ in range(NODES[kind]):
                nodes[int(next(words))]
    else:
        blocks = [int(next(words)) for _ in range(4)][0]
        for _ in range(blocks):
            _, _, kind, count = (int(next(words)) for _ in range(4))
            for _ in range(count):
                next(words)
                for _ in range(NODES[kind]):
                    nodes[int(next(words))]
    _end(words)


def vtu(data):
    """A mesh of VTK's XML format."""
    data = data.lstrip()  # white space before the declaration does no harm
    try:
        cut = re.search(rb'(?s)<AppendedData encoding="raw">\s*_(.*)</AppendedData>', data)
        appended = cut.group(1) if cut else None
        root = xml.fromstring(data[:cut.start()] + data[cut.end():] if cut else data)
        piece = root.find("./UnstructuredGrid/Piece")
        points, cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))
        inline = root.find("./AppendedData")
        if inline is not None:
            appended = inline.text.strip()[1:].encode()
        read = _Arrays(root, appended, cut is None)
        place = read.values(piece.find("./Points/DataArray"))
        arrays = {a.get("Name"): read.values(a) for a in piece.findall("./Cells/DataArray")}
        if len(place) != 3 * points or any(not math.isfinite(x) for x in place):
            raise Due("points")
        if len(arrays["types"]) != cells or len(arrays["offsets"]) != cells:
            raise Due("cells")
        sizes = [b - a for a, b in zip([0] + list(arrays["offsets"]), arrays["offsets"])]
        if sizes != [VTK_NODES[int(kind)] for kind in arrays["types"]] or sum(sizes) != len(arrays["connectivity"]):
            raise Due("connectivity")
        if any(not 0 <= n < points for n in arrays["connectivity"]):
            raise Due("points that are not there")
    except (Due, ValueError, KeyError, TypeError, AttributeError, struct.error, zlib.error, xml.ParseError) as error:
        return f"mesh: {type(error).__name__} {error}"
    return ""


class _Arrays:
    def __init__(self, root, appended, in_base64):
        self.appended, self.in_base64 = appended, in_base64
        self.head = {"UInt32": "I", "UInt64": "Q"}[root.get("header_type", "UInt32")]
        self.packed = root.get("compressor")

    def values(self, array):
        """The numbers of an array."""
        if array.get("format") == "ascii":
            return [float(word) for word in array.text.split()]
        if array.get("format") == "appended":
            data, encoded = self.appended[int(array.get("offset")):], self.in_base64
        else:
            data, encoded = array.text.strip().encode(), True
        size = struct.calcsize(self.head)
        take = (lambda count: base64.b64decode(data[:(count + 2) // 3 * 4], validate=True)[:count]) if encoded else (lambda count: data[:count])
        if self.packed:
            blocks = struct.unpack("<" + self.head, take(size))[0]
            sizes = struct.unpack(f"<{3 + blocks}{self.head}", take((3 + blocks) * size))
            data = data[((3 + blocks) * size + 2) // 3 * 4 if encoded else (3 + blocks) * size:]
            raw = zlib.decompress(take(sum(sizes[3:])))
        else:
            count = struct.unpack("<" + self.head, take(size))[0]
            raw = take(size + count)[size:]
            if len(raw) != count:
                raise Due("data that are cut short")
        kind = TYPES[array.get("type")]
        return struct.unpack(f"<{len(raw) // struct.calcsize(kind)}{kind}", raw)


def series(data):
    """Times of a series.csv. @returns (why it has to be refused, the times)"""
    try:
        rows = [line.split(",") for line in data.decode("latin-1").split("\n")]  # names of columns may be anything
        if rows[-1] == [""]:
            rows.pop()
        times = [float(row[0]) for row in rows[1:]]
        if rows[0][0].strip() != "time" or len(times) < 2 or any(len(row) != len(rows[0]) for row in rows):
            return "series: columns", []
        if any(not math.isfinite(t) for t in times) or any(not b > a for a, b in zip(times, times[1:])):
            return "series: times", []
        return "", times
    except (UnicodeDecodeError, ValueError, IndexError) as error:
        return f"series: {error}", []
