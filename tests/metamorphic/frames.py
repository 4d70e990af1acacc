# SPDX-License-Identifier: BSD-3-Clause
"""Frames: x' = length * Q x + shift, with a matrix Q that only permutes axes and turns their signs around, and other units.

A turned scene is one whose places, vectors, axes and tensors are turned and whose expressions are those of the old place.
"""
import dataclasses

import expressions
import scene as scenes
import units

AXES = "xyz"


@dataclasses.dataclass
class Frame:
    """What a scene is turned, moved and scaled by.

    axes: for each new axis the old one that it takes its values from, with a sign
    """

    dimension: int
    axes: list = None
    shift: list = None
    length: float = 1.0
    mass: float = 1.0
    time: float = 1.0
    start: float = 0.0
    keep_numbers: bool = False  # grids are written as files, so that nodes and cells keep their numbers

    def __post_init__(self):
        self.axes = self.axes or [(i, 1) for i in range(self.dimension)]
        self.shift = self.shift or [0.0] * self.dimension

    @property
    def determinant(self):
        """1, or -1 for a mirror."""
        order = [old for old, _ in self.axes]
        sign = 1
        for i in range(len(order)):
            for j in range(i):
                sign *= -1 if order[j] > order[i] else 1
        for _, s in self.axes:
            sign *= s
        return sign

    @property
    def is_straight(self):
        """Whether axes stay where they are."""
        return all(axis == (i, 1) for i, axis in enumerate(self.axes))

    def new_axis(self, old):
        """Where an old axis went, and its sign."""
        return next((new, sign) for new, (source, sign) in enumerate(self.axes) if source == old)

    def factor(self, powers):
        """What a number of this unit is multiplied by."""
        return self.length ** powers[0] * self.mass ** powers[1] * self.time ** powers[2]

    def unit_factor(self, unit):
        """The same by the unit's text."""
        return self.factor(units.powers(unit, self.dimension)) if unit else 1.0

    def point(self, x):
        """A place."""
        return [self.length * sign * x[old] + b for (old, sign), b in zip(self.axes, self.shift)]

    def vector(self, v):
        """A vector, without its unit."""
        return [sign * v[old] for old, sign in self.axes]

    def axial(self, v):
        """An axial vector; in the plane its one component."""
        if len(v) == 1:
            return [self.determinant * v[0]]
        return [self.determinant * sign * v[old] for old, sign in self.axes]

    def old_place(self):
        """x, y, z of the old place in terms of the new ones."""
        result = {}
        for old in range(self.dimension):
            new, sign = self.new_axis(old)
            text = AXES[new]
            if self.shift[new]:
                text = f"({text} - {expressions.number(self.shift[new])})"
            if self.length != 1:
                text = f"({text}/{expressions.number(self.length)})"
            result[AXES[old]] = f"(-{text})" if sign < 0 else text
        return result

    def expression(self, text, factor=1.0):
        """A function of place and time, times a factor."""
        text = expressions.stretch_time(text, self.time, self.start)
        return expressions.times(expressions.substitute(text, self.old_place()), factor)


def is_null(entry):
    """Whether a component is left free."""
    return entry in ("null", "~", "")


class Transformer:
    """Puts a scene into another frame."""

    def __init__(self, frame, columns):
        self.frame, self.columns = frame, columns

    def apply(self, tree):
        """The transformed scene; grids are left to the caller (meshes.py)."""
        tree = scenes.copy_of(tree)
        for node in tree.walk():
            self.node(node)
        self.times(tree)
        self.output(tree)
        return tree

    def node(self, node):
        """One value by its kind; objects whose keys belong together first."""
        frame = self.frame
        if node.place.startswith("scene.meshes.grid") or node.place.startswith("scene.output.formulas"):
            return
        if node.place in ("interface.cut.motion", "interface.obstacle.motion"):
            self.complete_motion(node)
        if node.place == "body.box":
            return self.box(node)
        if node.place.startswith("body.box."):
            return
        if node.place == "body.outline.corners" and node.kind == "list" and frame.determinant < 0:
            node.value.reverse()  # corners are counter-clockwise
        geometry = scenes.GEOMETRY.get(node.place)
        factor = frame.unit_factor(node.unit)
        if node.kind == "number":
            node.value = scenes.constant(scenes.numbers(node) * factor) if factor != 1 else node.value
        elif node.kind == "expression":
            sign = frame.determinant if geometry == scenes.ANGLE else 1
            node.value = frame.expression(node.value, factor * sign)
        elif node.kind == "vector":
            node.value = [scenes.constant(v) for v in self.constants(scenes.numbers(node), geometry, factor, node.place)]
        elif node.kind == "vector_expression":
            node.value = self.functions(node.value, geometry, factor, node.place)

    def constants(self, v, geometry, factor, place):
        """A list of numbers."""
        frame = self.frame
        if geometry == scenes.POINT:
            return frame.point(v)
        if geometry == scenes.VECTOR:
            return [factor * x for x in frame.vector(v)]
        if geometry == scenes.DIRECTION:
            return frame.vector(v)
        if geometry == scenes.AXIAL:
            return [factor * x for x in frame.axial(v)]
        if geometry == scenes.DIAGONAL:
            return [factor * v[old] for old, _ in frame.axes]
        if geometry == scenes.TENSOR:
            d = frame.dimension
            if len(v) == d:
                return [factor * v[old] for old, _ in frame.axes]
            if len(v) == d * d:
                return [factor * si * sj * v[i * d + j] for i, si in frame.axes for j, sj in frame.axes]
            return [factor * v[0]]
        raise scenes.SceneError(f"nothing is known of how {place} turns: see GEOMETRY")

    def functions(self, values, geometry, factor, place):
        """A list of expressions, one a component."""
        frame = self.frame
        def one(entry, sign):
            return "null" if is_null(entry) else frame.expression(entry, factor * sign)
        if geometry == scenes.AXIAL:
            if len(values) == 1:
                return [one(values[0], frame.determinant)]
            return [one(values[old], frame.determinant * sign) for old, sign in frame.axes]
        if len(values) != frame.dimension:
            raise scenes.SceneError(f"{place}: {len(values)} entries")
        return [one(values[old], sign) for old, sign in frame.axes]

    def complete_motion(self, node):
        """The defaults of a rotation are those of the old frame."""
        if not node.get("rotation"):
            return
        d = self.frame.dimension
        if not node.get("about"):
            node.value["about"] = scenes.Node("vector", node.place + ".about", ["0"] * d, "m")
        if d == 3 and not node.get("axis"):
            node.value["axis"] = scenes.Node("vector", node.place + ".axis", ["0", "0", "1"])

    def box(self, node):
        """Its corners are the lowest and the highest one of the new frame."""
        ends = [self.frame.point(scenes.numbers(node[key])) for key in ("from", "to")]
        node["from"].value = [scenes.constant(min(pair)) for pair in zip(*ends)]
        node["to"].value = [scenes.constant(max(pair)) for pair in zip(*ends)]

    def times(self, tree):
        """The time span; without one it is a single static step to 1."""
        frame = self.frame
        if frame.time == 1 and frame.start == 0:
            return
        time = tree.get("time")
        if not time:
            time = tree.value["time"] = scenes.Node("object", "scene.time", {
                "static": scenes.Node("boolean", "scene.time.static", "true"),
                "end": scenes.Node("number", "scene.time.end", scenes.constant(frame.time), "s")})
        for key in ("start", "end"):
            if key == "end" or frame.start:
                old = float(time[key].value) if time.get(key) else 0.0
                time.value[key] = scenes.Node("number", f"scene.time.{key}", scenes.constant(old + frame.start), "s")

    def output(self, tree):
        """Probes show the component that a vector's component became; formulas compute with numbers of the old frame."""
        output = tree["output"]
        for probe in output["probes"].value.values() if output.get("probes") else []:
            component = probe.get("component")
            if component and component.value in AXES:
                component.value = AXES[self.frame.new_axis(AXES.index(component.value))[0]]
        if output.get("formulas"):
            back = {name.replace(".", "_"): text for name, text in self.columns.inverse(self.frame).items()}
            for formula in output["formulas"].value.values():
                text = expressions.stretch_time(formula.value, self.frame.time, self.frame.start)
                formula.value = expressions.substitute(text, back)
