# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of scenes: grids turned as grids, or written as Gmsh files with nodes and cells in any order."""
import itertools
import math
import random
import subprocess
import tempfile
from pathlib import Path

import expressions
import scene as scenes

AXES = "xyz"
# Gmsh's numbers: cells, faces and their corners.
CELLS = {"triangle": (2, 3), "quadrilateral": (3, 4), "tetrahedron": (4, 4), "hexahedron": (5, 8)}
FACES = {"triangle": (1, [(0, 1), (1, 2), (2, 0)]), "quadrilateral": (1, [(0, 1), (1, 2), (2, 3), (3, 0)]),
         "tetrahedron": (2, [(0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)]),
         "hexahedron": (3, [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)])}
BRICK = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def graded(start, end, n, ratio):
    """Lines of a stretch of n cells, the last `ratio` times as wide as the first, as core/seam/mesh/input/grid.cpp has it."""
    log_q = math.log(ratio) / (n - 1) if n > 1 else 0.0
    fractions = [i / n if log_q == 0 else math.expm1(i * log_q) / math.expm1(n * log_q) for i in range(n + 1)]
    return [start + f * (end - start) for f in fractions[:-1]] + [end]


class Axis:
    """The lines along one direction: stretches (to, cells, grading) from a start, or explicit lines."""

    def __init__(self, start, stretches=None, lines=None):
        self.start, self.stretches, self.explicit = start, stretches, lines

    def lines(self):
        """Coordinates."""
        if self.explicit:
            return self.explicit
        result = [self.start]
        for to, cells, grading in self.stretches:
            result += graded(result[-1], to, cells, grading)[1:]
        return result

    def mapped(self, sign, factor, shift):
        """The axis at sign*factor*x + shift."""
        def place(x):
            return sign * factor * x + shift
        if self.explicit:
            return Axis(None, lines=sorted(place(x) for x in self.explicit))
        if sign > 0:
            return Axis(place(self.start), [(place(to), n, g) for to, n, g in self.stretches])
        ends = [self.start] + [to for to, _, _ in self.stretches]
        back = [(place(ends[k]), self.stretches[k][1], 1 / self.stretches[k][2]) for k in range(len(self.stretches) - 1, -1, -1)]
        return Axis(place(ends[-1]), back)


def axes_of(grid, dimension):
    """A grid's axes."""
    result = []
    for i in range(dimension):
        letter = AXES[i]
        if grid.get("lines") and grid["lines"].get(letter):
            result.append(Axis(None, lines=scenes.numbers(grid["lines"][letter])))
        elif grid.get("segments") and grid["segments"].get(letter):
            stretches = [(float(s["to"].value), round(float(s["cells"].value)), float(s["grading"].value) if s.get("grading") else 1.0)
                         for s in grid["segments"][letter].value]
            result.append(Axis(scenes.numbers(grid["segments"]["from"])[i], stretches))
        else:
            ends = [scenes.numbers(grid[key])[i] for key in ("from", "to", "cells")]
            grading = scenes.numbers(grid["grading"])[i] if grid.get("grading") else 1.0
            result.append(Axis(ends[0], [(ends[1], round(ends[2]), grading)]))
    return result


def put_axes(grid, axes):
    """Writes axes into a grid, in its shortest form."""
    place = "scene.meshes.grid"
    for key in ("lines", "segments", "from", "to", "cells", "grading"):
        grid.value.pop(key, None)

    def vector(name, values):
        grid.value[name] = scenes.Node("vector", f"{place}.{name}", [scenes.constant(v) for v in values])
    if all(axis.stretches and len(axis.stretches) == 1 for axis in axes):
        vector("from", [axis.start for axis in axes])
        vector("to", [axis.stretches[0][0] for axis in axes])
        vector("cells", [axis.stretches[0][1] for axis in axes])
        if any(axis.stretches[0][2] != 1 for axis in axes):
            vector("grading", [axis.stretches[0][2] for axis in axes])
    elif all(axis.stretches for axis in axes):
        value = {"from": [scenes.constant(axis.start) for axis in axes]}
        for letter, axis in zip(AXES, axes):
            value[letter] = [{"to": scenes.constant(to), "cells": str(n), "grading": scenes.constant(g)} for to, n, g in axis.stretches]
        grid.value["segments"] = Raw(value)
    else:
        grid.value["lines"] = Raw({letter: [scenes.constant(x) for x in axis.lines()] for letter, axis in zip(AXES, axes)})


class Raw:
    """Plain YAML inside a tree."""

    def __init__(self, value):
        self.value, self.kind, self.place, self.unit, self.type_name = value, "raw", "raw", "", ""

    def plain(self):
        """As it stands in YAML."""
        return self.value

    def walk(self):
        """Nothing below it."""
        return [self]

    def children(self):
        """None."""
        return []

    def get(self, key):
        """Of an object of plain values."""
        return None if key not in self.value else Raw(self.value[key])

    def __getitem__(self, key):
        return Raw(self.value[key])


def sides_of(grid, dimension):
    """{x_min: name} of all sides."""
    names = [f"{letter}_{end}" for letter in AXES[:dimension] for end in ("min", "max")]
    given = grid["sides"].value if grid.get("sides") else {}
    return {name: (given[name].value if name in given else name) for name in names}


def turn_grid(grid, frame):
    """A grid in another frame, as a grid: nodes and cells are counted along the new axes."""
    d = frame.dimension
    old_axes, old_sides = axes_of(grid, d), sides_of(grid, d)
    axes, sides = [], {}
    # With a map the lines are in coordinates of their own, which are turned but neither moved nor scaled.
    mapped = grid.get("map")
    factor = 1.0 if mapped else frame.length
    for new, (old, sign) in enumerate(frame.axes):
        axes.append(old_axes[old].mapped(sign, factor, 0.0 if mapped else frame.shift[new]))
        for end, other in (("min", "max"), ("max", "min")):
            sides[f"{AXES[new]}_{end}"] = old_sides[f"{AXES[old]}_{end if sign > 0 else other}"]
    put_axes(grid, axes)
    if not frame.is_straight:
        grid.value["sides"] = Raw(sides)
    if mapped:
        turn = {AXES[old]: ("(-" + AXES[new] + ")" if sign < 0 else AXES[new]) for new, (old, sign) in enumerate(frame.axes)}
        old_map = [AXES[i] if text in ("null", "~", "") else text for i, text in enumerate(grid["map"].value)]
        result = []
        for new, (old, sign) in enumerate(frame.axes):
            text = expressions.times(expressions.substitute(old_map[old], turn), sign * frame.length)
            result.append(text + (f" + {expressions.number(frame.shift[new])}" if frame.shift[new] else ""))
        grid["map"].value = result
    if grid.get("diagonals") and not frame.is_straight:
        swap = {"rising": "falling", "falling": "rising"}
        # A quarter of a turn and a mirror exchange the two; a quarter of a turn that is mirrored, too, does not.
        changes = frame.axes[0][1] * frame.axes[1][1] < 0
        grid["diagonals"].value = swap[grid["diagonals"].value] if changes else grid["diagonals"].value
    if grid.get("rotate"):
        raise scenes.SceneError("grids with `rotate` are not turned")


def can_turn(grid, frame):
    """Whether the turned grid consists of the same cells: triangles and tetrahedra depend on where the diagonals start."""
    cell = grid["cell"].value if grid.get("cell") else ""
    if frame.is_straight or cell not in ("triangle", "tetrahedron"):
        return True
    return cell == "triangle" and bool(grid.get("diagonals")) and grid["diagonals"].value != "alternating"


class Mesh:
    """Nodes, cells of one type, named boundaries (faces as lists of nodes) and regions (numbers of cells)."""

    def __init__(self, dimension, cell, nodes, cells, boundaries, regions=None):
        self.dimension, self.cell, self.nodes, self.cells = dimension, cell, nodes, cells
        self.boundaries, self.regions = boundaries, regions or {}

    def mapped(self, frame):
        """In another frame, with the same numbers."""
        nodes = [frame.point(x) for x in self.nodes]
        cells = self.cells
        if frame.determinant < 0:
            cells = [self.mirrored(cell) for cell in cells]
        return Mesh(self.dimension, self.cell, nodes, cells, self.boundaries, self.regions)

    def mirrored(self, cell):
        """The corners of a mirrored cell in an order that is right-handed again."""
        order = {"triangle": (0, 2, 1), "quadrilateral": (0, 3, 2, 1), "tetrahedron": (0, 2, 1, 3),
                 "hexahedron": (0, 3, 2, 1, 4, 7, 6, 5)}[self.cell]
        return [cell[i] for i in order]

    def permuted(self, seed):
        """Nodes and cells in random order, the corners of each cell turned."""
        chance = random.Random(seed)
        order = list(range(len(self.nodes)))
        chance.shuffle(order)  # order[new] = old
        new = {old: k for k, old in enumerate(order)}
        cells = [self.turned([new[i] for i in cell], chance) for cell in self.cells]
        places = list(range(len(cells)))
        chance.shuffle(places)
        region_of = {k: p for p, k in enumerate(places)}
        boundaries = {name: [[new[i] for i in face] for face in faces] for name, faces in self.boundaries.items()}
        regions = {name: [region_of[k] for k in members] for name, members in self.regions.items()}
        return Mesh(self.dimension, self.cell, [self.nodes[i] for i in order], [cells[k] for k in places], boundaries, regions)

    def turned(self, cell, chance):
        """The same cell, its corners counted from another one."""
        if self.cell == "hexahedron":
            # Turns about the axis from bottom to top, after one about the space diagonal.
            if chance.random() < 0.5:
                cell = [cell[i] for i in (0, 3, 7, 4, 1, 2, 6, 5)]
            k = chance.randrange(4)
            return [cell[(i + k) % 4 + 4 * (i // 4)] for i in range(8)]
        if self.cell == "tetrahedron":
            even = [p for p in itertools.permutations(range(4)) if sum(p[i] > p[j] for j in range(4) for i in range(j)) % 2 == 0]
            return [cell[i] for i in chance.choice(even)]
        k = chance.randrange(len(cell))
        return cell[k:] + cell[:k]

    def write(self, path):
        """As Gmsh 2.2. Cells are in one physical group or in those of the regions."""
        code = CELLS[self.cell][0]
        face_code = FACES[self.cell][0]
        groups, elements = [], []
        for tag, (name, faces) in enumerate(self.boundaries.items(), 1):
            groups.append((self.dimension - 1, tag, name))
            elements += [(face_code, tag, face) for face in faces]
        regions = self.regions or {"all": range(len(self.cells))}
        region_of = {}
        for tag, (name, members) in enumerate(regions.items(), len(groups) + 1):
            groups.append((self.dimension, tag, name))
            region_of |= {k: tag for k in members}
        elements += [(code, region_of[k], cell) for k, cell in enumerate(self.cells)]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups))]
        lines += [f'{d} {tag} "{name}"' for d, tag, name in groups]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.nodes))]
        lines += [f"{k} " + " ".join(repr(float(v)) for v in (list(x) + [0.0])[:3]) for k, x in enumerate(self.nodes, 1)]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [f"{k} {kind} 2 {tag} {tag} " + " ".join(str(i + 1) for i in cell) for k, (kind, tag, cell) in enumerate(elements, 1)]
        path.write_text("\n".join(lines + ["$EndElements", ""]))


def of_grid(grid, dimension):
    """The mesh that Seam makes of a grid: the same nodes and cells in the same order."""
    if grid.get("order") and grid["order"].value != "1":
        raise scenes.SceneError("grids of order 2 are not written as files")
    cell = grid["cell"].value if grid.get("cell") else ("quadrilateral" if dimension == 2 else "hexahedron")
    lines = [axis.lines() for axis in axes_of(grid, dimension)] + [[0.0]] * (3 - dimension)
    counts = [len(line) for line in lines]
    nodes = [[lines[0][i], lines[1][j], lines[2][k]][:dimension]
             for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])]
    if grid.get("map"):
        nodes = [map_node(grid["map"].value, x) for x in nodes]

    def node(at):
        return (at[2] * counts[1] + at[1]) * counts[0] + at[0]
    sides = sides_of(grid, dimension)
    cells, boundaries = [], {}
    for k in range(max(counts[2] - 1, 1)):
        for j in range(counts[1] - 1):
            for i in range(counts[0] - 1):
                for corners in pattern(cell, grid, i, j):
                    places = [(i + a, j + b, k + c) for a, b, c in corners]
                    cells.append([node(at) for at in places])
                    for face in FACES[cell][1]:
                        for axis in range(dimension):
                            for end, line in (("min", 0), ("max", counts[axis] - 1)):
                                if all(places[v][axis] == line for v in face):
                                    boundaries.setdefault(sides[f"{AXES[axis]}_{end}"], []).append([node(places[v]) for v in face])
    return Mesh(dimension, cell, nodes, cells, boundaries)


def map_node(texts, x):
    """A node's new position."""
    place = dict(zip(AXES, x))
    return [x[i] if text in ("null", "~", "") else expressions.evaluate(text, place) for i, text in enumerate(texts)]


def pattern(cell, grid, i, j):
    """Corners of the cells in a brick, in units of it, as core/seam/mesh/input/grid.cpp cuts them."""
    if cell == "quadrilateral":
        return [BRICK[:4]]
    if cell == "hexahedron":
        return [BRICK]
    if cell == "triangle":
        word = grid["diagonals"].value if grid.get("diagonals") else "alternating"
        if word == "rising" or word == "alternating" and (i + j) % 2 == 0:
            return [[(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 0, 0), (1, 1, 0), (0, 1, 0)]]
        return [[(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(1, 1, 0), (0, 1, 0), (1, 0, 0)]]
    result = []
    for path in itertools.permutations(range(3)):
        at, corners = [0, 0, 0], [(0, 0, 0)]
        for axis in path:
            at[axis] += 1
            corners.append(tuple(at))
        if ((path[0] > path[1]) + (path[0] > path[2]) + (path[1] > path[2])) % 2:
            corners[1], corners[2] = corners[2], corners[1]
        result.append(corners)
    return result


def of_file(path, numbers, dimension):
    """The mesh of a Gmsh file; geometries are meshed by the program gmsh."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "mesh.msh"
        values = [word for name, value in numbers.items() for word in ("-setnumber", name, value)]
        command = ["gmsh", f"-{dimension}" if path.endswith(".geo") else "-0", path, *values, "-format", "msh22", "-o", str(target)]
        subprocess.run(command, check=True, capture_output=True)
        return read_msh(target.read_text(), dimension)


def read_msh(text, dimension):
    """Gmsh 2.2 as the program gmsh writes it; cells of one type, of order 1."""
    sections = {}
    for part in text.split("$End")[:-1]:
        name, _, body = part.partition("$")[2].partition("\n")
        sections[name.strip()] = body.strip().split("\n")
    names = {}
    for line in sections.get("PhysicalNames", ["0"])[1:]:
        d, tag, name = line.split(maxsplit=2)
        names[int(d), int(tag)] = name.strip('"')
    number, nodes = {}, []
    for line in sections["Nodes"][1:]:
        words = line.split()
        number[words[0]] = len(nodes)
        nodes.append([float(word) for word in words[1:1 + dimension]])
    by_code = {code: (cell, count) for cell, (code, count) in CELLS.items()}
    face_of = {2: (1,), 3: (2, 3)}[dimension]
    of_dimension = {2: (2, 3), 3: (4, 5)}[dimension]
    cell_type, cells, boundaries, regions = None, [], {}, {}
    for line in sections["Elements"][1:]:
        words = line.split()
        code, tag = int(words[1]), int(words[3])
        corners = [number[word] for word in words[3 + int(words[2]):]]
        if code in of_dimension:
            cell_type = by_code[code][0]
            regions.setdefault(names.get((dimension, tag), str(tag)), []).append(len(cells))
            cells.append(corners)
        elif code in face_of:
            boundaries.setdefault(names.get((dimension - 1, tag), str(tag)), []).append(corners)
        elif code not in (1, 15):
            raise scenes.SceneError("only meshes of order 1 are renumbered")
    return Mesh(dimension, cell_type, nodes, cells, boundaries, regions)


def mesh_of(entry, dimension):
    """The mesh of an entry of `meshes`."""
    if entry.get("grid"):
        return of_grid(entry["grid"], dimension)
    numbers = {name: node.value for name, node in entry["numbers"].value.items()} if entry.get("numbers") else {}
    return of_file(entry["file"].value, numbers, dimension)


def put_file(entry, mesh, path):
    """Lets an entry of `meshes` take its mesh from a file."""
    mesh.write(path)
    for key in ("grid", "numbers"):
        entry.value.pop(key, None)
    entry.value["file"] = scenes.Node("word", "scene.meshes.file", path.name)


def turn(tree, original, frame, folder):
    """Puts the meshes of a transformed tree into its frame. @param original the tree in its old frame"""
    d = frame.dimension
    for name, entry in tree["meshes"].value.items():
        old = original["meshes"][name]
        if entry.get("grid") and not frame.keep_numbers and can_turn(entry["grid"], frame):
            turn_grid(entry["grid"], frame)
        else:
            put_file(entry, mesh_of(old, d).mapped(frame), folder / f"{name}.msh")


def write_files(tree, folder, seed=None):
    """All meshes as files; with a seed nodes and cells are permuted."""
    d = int(tree["dimension"].value)
    for k, (name, entry) in enumerate(tree["meshes"].value.items()):
        mesh = mesh_of(entry, d)
        put_file(entry, mesh if seed is None else mesh.permuted(seed + 100 * k), folder / f"{name}.msh")
