# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files to damage: those of the shipped scenes, and small ones in all other forms that Seam reads."""
import base64
import struct
import zlib

import readers
import small
import texts

SCENE = """title: A body of a damaged mesh
dimension: {dimension}
plugins: [solid]
meshes: {{body: {{file: {file}{numbers}}}}}
fields:
  body: {{type: solid, mesh: body, density: 1, body_force: [{force}], material: {{type: neo_hookean, young: 1e6, poisson: 0.3}}, boundary: [{{on: {on}, displacement: [{held}]}}]}}
output: {{fields: false}}
"""


def scene(file, dimension, on, numbers=""):
    """A scene of a body, held somewhere, that hangs."""
    held, force = ", ".join(["0"] * dimension), ", ".join(["0"] * (dimension - 1) + ["-1"])
    return SCENE.format(file=file, dimension=dimension, on=on, numbers=numbers and f", numbers: {{{numbers}}}", held=held, force=force)


def grid(n=3, spatial=False):
    """Nodes and cells (quadrilaterals, or tetrahedra of one cube), cell 0 at the origin."""
    if spatial:
        nodes = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        return nodes, [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
    nodes = [(x / n, y / n, 0) for y in range(n + 1) for x in range(n + 1)]
    return nodes, [(y * (n + 1) + x, y * (n + 1) + x + 1, (y + 1) * (n + 1) + x + 1, (y + 1) * (n + 1) + x) for y in range(n) for x in range(n)]


def gmsh22(nodes, cells, spatial):
    """A mesh of Gmsh's older format, with its lower side (x = 0 in space) as a boundary."""
    faces = [(0, 2, 6), (0, 6, 4)] if spatial else [(i, i + 1) for i in range(3)]
    face, cell = (2, 4) if spatial else (1, 3)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", f'{1 + spatial} 1 "low"', f'{2 + spatial} 2 "body"', "$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{i + 1} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(nodes)] + ["$EndNodes", "$Elements", str(len(faces) + len(cells))]
    for i, (kind, group, corners) in enumerate([(face, 1, f) for f in faces] + [(cell, 2, c) for c in cells]):
        lines.append(" ".join(map(str, [i + 1, kind, 2, group, group] + [c + 1 for c in corners])))
    return "\n".join(lines + ["$EndElements", ""]).encode()


def vtu(nodes, cells, form, packed, head="UInt32"):
    """A mesh of VTK. @param form ascii, binary, raw or base64 (appended)"""
    kind = 9 if len(nodes) != 8 else 10
    size = len(cells[0])
    arrays = [("Points", "Float64", "d", 3, [x for p in nodes for x in p]), ("connectivity", "Int32", "i", 1, [n for c in cells for n in c]),
              ("offsets", "Int64", "q", 1, [size * (i + 1) for i in range(len(cells))]), ("types", "UInt8", "B", 1, [kind] * len(cells))]
    letter = {"UInt32": "I", "UInt64": "Q"}[head]
    appended, texts_of = b"", []
    for name, type_name, code, components, values in arrays:
        raw = struct.pack(f"<{len(values)}{code}", *values)
        front = struct.pack("<" + letter, len(raw))
        if packed:
            front, raw = struct.pack(f"<4{letter}", 1, len(raw), 0, len(zlib.compress(raw))), zlib.compress(raw)
        encoded = base64.b64encode(front) + base64.b64encode(raw) if packed else base64.b64encode(front + raw)
        attributes = f'type="{type_name}" Name="{name}" NumberOfComponents="{components}"'
        if form in ("ascii", "binary"):
            body = " ".join(map(repr, values)) if form == "ascii" else encoded.decode()
            texts_of.append(f'<DataArray {attributes} format="{form}">{body}</DataArray>')
        else:
            texts_of.append(f'<DataArray {attributes} format="appended" offset="{len(appended)}"/>')
            appended += front + raw if form == "raw" else encoded
    compressor = ' compressor="vtkZLibDataCompressor"' if packed else ""
    text = (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="{head}"{compressor}>\n'
            f'<UnstructuredGrid>\n<Piece NumberOfPoints="{len(nodes)}" NumberOfCells="{len(cells)}">\n<Points>{texts_of[0]}</Points>\n<Cells>\n'
            + "\n".join(texts_of[1:]) + "\n</Cells>\n</Piece>\n</UnstructuredGrid>\n").encode()
    if appended:
        text += f'<AppendedData encoding="{form}">_'.encode() + appended + b"</AppendedData>\n"
    return text + b"</VTKFile>\n"


def every():
    """(name, bytes, scene, reader) of all mesh files."""
    found = []
    for path, on in (("fluid/meshes/beam.msh", "surface"), ("fsi/meshes/disc_45.msh", "surface")):
        found.append((path, (small.CONFIGS / path).read_bytes(), scene("mesh.msh", 2, on), readers.gmsh))
    for name, spatial in (("plane", False), ("space", True)):
        nodes, cells = grid(spatial=spatial)
        found.append((f"{name}, Gmsh 2.2", gmsh22(nodes, cells, spatial), scene("mesh.msh", 2 + spatial, "low"), readers.gmsh))
        for form, packed, head in (("ascii", False, "UInt32"), ("binary", False, "UInt64"), ("binary", True, "UInt32"), ("raw", False, "UInt64"),
                                   ("raw", True, "UInt32"), ("base64", True, "UInt64")):
            found.append((f"{name}, VTU {form}{', packed' * packed}", vtu(nodes, cells, form, packed, head), scene("mesh.vtu", 2 + spatial, "outer"), readers.vtu))
    for path, on, numbers in (("contact/meshes/half_disc.geo", "top", "h: 0.5, fine: 0.1, reach: 0.1"), ("poro/meshes/bending_beam.geo", "clamped", "h: 0.06, width: 0.12, radius: 0.12")):
        found.append((path, (small.CONFIGS / path).read_bytes(), scene("mesh.geo", 2, on, numbers), None))
    return found


def change_count(rng, data):
    """A whole number that counts, or names a node: another one, a huge one."""
    found = [m for m in texts.NUMBER.finditer(data) if m.group().isdigit()]
    if not found:
        return None
    match = rng.choice(found[:12] if rng.random() < 0.5 else found)
    value = int(match.group())
    other = rng.choice([0, -1, value + 1, max(value - 1, 0), value * 2, 10 ** 9, 2 ** 31 - 1, 2 ** 32, 2 ** 63 - 1, 2 ** 64, 10 ** 30])
    return data[:match.start()] + b"%d" % other + data[match.end():]


def change_section(rng, data):
    """A section is missing, there twice, empty, or elsewhere."""
    lines = data.split(b"\n")
    marks = [i for i, line in enumerate(lines) if line.startswith((b"$", b"<", b"Physical", b"Line", b"Plane"))]
    if len(marks) < 3:
        return None
    one, other = sorted(rng.sample(marks, 2))
    block = lines[one:other]
    return b"\n".join(rng.choice([lines[:one] + lines[other:], lines[:other] + block + lines[other:], lines[:one + 1] + lines[other:], lines[:one] + lines[other:] + block]))


KINDS = texts.BYTES | texts.LINES | texts.WORDS | {"count changed": change_count, "section changed": change_section}
