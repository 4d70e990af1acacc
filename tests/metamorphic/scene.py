# SPDX-License-Identifier: BSD-3-Clause
"""A scene as a tree of values with kinds and units.

Kinds and units come from `seam schema`. What it does not say is in the tables GEOMETRY (how a vector turns, whether a list
of numbers is a place) and REFERENCES (what a name stands for). A key that neither tells of is an error: no key is
silently left as it is.
"""
import copy
import json
import subprocess

import expressions
import units
import yaml

# Places that are moved, besides the special ones (grids, boxes).
POINT, VECTOR, AXIAL, DIAGONAL, TENSOR, DIRECTION, ANGLE = "point", "vector", "axial", "diagonal", "tensor", "direction", "angle"
GEOMETRY = {
    "scene.output.probes.at": POINT,
    "body.circle.centre": POINT,
    "body.sphere.centre": POINT,
    "body.outline.corners.at": POINT,
    "body.box.from": POINT,
    "body.box.to": POINT,
    "interface.cut.motion.about": POINT,
    "interface.obstacle.motion.about": POINT,
    "interface.cut.motion.axis": DIRECTION,
    "interface.obstacle.motion.axis": DIRECTION,
    "interface.cut.motion.rotation": ANGLE,
    "interface.obstacle.motion.rotation": ANGLE,
    "field.rigid_body.rotation": AXIAL,
    "field.rigid_body.moment": AXIAL,
    "field.rigid_body.initial.rotation_rate": AXIAL,
    "field.rigid_body.initial.velocity": VECTOR,
    "field.rigid_body.stiffness": DIAGONAL,
    "field.rigid_body.damping": DIAGONAL,
    "field.solid.boundary.support": DIAGONAL,
    "field.porous_solid.permeability": TENSOR,
    "field.porous_solid.regions.permeability": TENSOR,
}

# What names stand for. Boundaries and regions keep their names.
REFERENCES = {
    "field.solid.mesh": "meshes", "field.rigid_body.mesh": "meshes", "field.cutfem_fluid.mesh": "meshes",
    "field.porous_solid.mesh": "meshes", "body.mesh.mesh": "meshes",
    "interface.cut.field": "fields", "interface.embedded.field": "fields", "interface.embedded.body": "fields",
    "interface.contact.from": "fields", "interface.contact.to": "fields", "interface.obstacle.from": "fields",
    "interface.embedded_contact.field": "fields", "interface.embedded_contact.body": "fields",
    "interface.embedded_contact.to": "fields", "interface.matching.fields": "fields", "interface.non_matching.fields": "fields",
    "scene.output.probes.field": "fields", "scene.output.probes.interface": "interfaces",
}
REFERENCES |= {f"coupling.{name}.on": "interfaces" for name in
               ("fluid_wall", "fluid_traction", "fluid_patch", "fsi", "fpi", "bonded", "contact", "contact_in_fluid", "mortar_contact", "mortar_tie",
                "porous_contact_in_fluid")}

# Lists whose order means nothing.
UNORDERED = {"scene.plugins", "scene.coupling", "field.solid.boundary", "field.cutfem_fluid.boundary",
             "field.porous_solid.boundary", "field.solid.regions", "field.porous_solid.regions",
             "field.cutfem_fluid.moving_mesh.boundary", "interface.embedded.backing", "interface.embedded_contact.backing",
             "field.solid.boundary.on", "field.cutfem_fluid.boundary.on", "field.porous_solid.boundary.on",
             "interface.embedded.boundaries", "interface.contact.boundaries", "interface.contact.opposite",
             "interface.obstacle.boundaries", "interface.embedded_contact.boundaries", "interface.embedded_contact.opposite"}


class SceneError(Exception):
    """A scene, or a key of one, that the harness cannot read."""


class Node:
    """A value: its kind, where it is declared, its unit.

    kind: object, map, list, typed, number, integer, expression, vector, vector_expression, names, word, choice, text, boolean
    place: KIND.TYPE.key.key, of the type that declares it, without the numbers of lists and the names of maps
    value: text; a list of Nodes (list, of vectors texts); a dict of Nodes (object, map, typed)
    """

    def __init__(self, kind, place, value, unit="", type_name=""):
        self.kind, self.place, self.value, self.unit, self.type_name = kind, place, value, unit, type_name

    def __getitem__(self, key):
        return self.value[key]

    def get(self, key):
        """The value of a key, None where it is not given."""
        return self.value.get(key)

    def children(self):
        """Nodes below this one."""
        if isinstance(self.value, dict):
            return list(self.value.values())
        return [child for child in self.value if isinstance(child, Node)] if isinstance(self.value, list) else []

    def walk(self):
        """This node and all below it."""
        yield self
        for child in self.children():
            yield from child.walk()

    def plain(self):
        """As it stands in YAML, all scalars text."""
        if isinstance(self.value, dict):
            result = {key: child.plain() for key, child in self.value.items()}
            return {"type": self.type_name} | result if self.type_name else result
        if isinstance(self.value, list):
            return [child.plain() if isinstance(child, Node) else child for child in self.value]
        return self.value


class Schema:
    """What `seam schema` says of the keys of scenes."""

    def __init__(self, seam):
        text = subprocess.run([seam, "schema"], check=True, capture_output=True, text=True).stdout
        self.root = json.loads(text)
        self.definitions = self.root["definitions"]

    def read(self, value, place="scene", schema=None):
        """A plain value as a Node."""
        return self._read(value, self.root if schema is None else schema, place)

    def _read(self, value, schema, place, unit=""):
        unit = units.of_description(schema.get("description", "")) or unit
        if "allOf" in schema and "$ref" in schema["allOf"][0]:
            return self._typed(value, schema["allOf"][0]["$ref"])
        if "$ref" in schema:
            return self._typed(value, schema["$ref"])
        if "anyOf" in schema:
            first = schema["anyOf"][0]
            if first.get("type") == "array":
                return self._array(value, first, place, unit)
            kind = first["type"]
            if kind == "string":
                return Node("names", place, value if isinstance(value, list) else [value])
            return Node(kind, place, value, unit)
        kind = schema.get("type")
        if "enum" in schema:
            return Node("choice", place, value)
        if kind == "array":
            return self._array(value, schema, place, unit)
        if kind == "object":
            if isinstance(schema.get("additionalProperties"), dict):
                below = schema["additionalProperties"]
                return Node("map", place, {key: self._read(child, below, place, unit) for key, child in (value or {}).items()})
            return Node("object", place, self._keys(value, schema, place))
        if kind == ["number", "string"]:
            return Node("expression", place, value, unit)
        return Node({"boolean": "boolean", "string": "word"}.get(kind, "text") if isinstance(kind, str) else "text", place, value)

    def _keys(self, value, schema, place):
        known = schema.get("properties", {})
        for key in value or {}:
            if key not in known:
                raise SceneError(f"{place} has no key '{key}'")
        return {key: self._read(child, known[key], f"{place}.{key}") for key, child in (value or {}).items()}

    def _typed(self, value, reference):
        kind = reference.rsplit("/", 1)[1]
        given = {"type": value} if isinstance(value, str) else dict(value)
        name = given.pop("type")
        place = f"{kind}.{name}"
        return Node("typed", place, self._keys(given, self.definitions[place], place), type_name=name)

    def _array(self, value, schema, place, unit):
        items = schema["items"]
        if "$ref" in items or items.get("type") == "object":
            return Node("list", place, [self._read(child, items, place) for child in value])
        if isinstance(items.get("type"), list):  # numbers, expressions, null
            if isinstance(value, str):
                raise SceneError(f"{place}: functions of a plugin cannot be turned")
            return Node("vector_expression", place, list(value), unit)
        if items.get("type") == "string":
            return Node("names", place, value if isinstance(value, list) else [value])
        return Node("vector", place, list(value), unit)


class Dumper(yaml.emitter.Emitter, yaml.serializer.Serializer, yaml.representer.SafeRepresenter, yaml.resolver.BaseResolver):
    """Writes all scalars as they are: text that says 1e3, null or true is no string to Seam."""

    def __init__(self, stream, **kwargs):
        yaml.emitter.Emitter.__init__(self, stream, width=100000)
        yaml.serializer.Serializer.__init__(self)
        yaml.representer.SafeRepresenter.__init__(self, default_flow_style=None, sort_keys=False)
        yaml.resolver.BaseResolver.__init__(self)

    def ignore_aliases(self, data):
        return True


def load(path):
    """The plain values of a file. The base loader takes every scalar as text: `on` stays the key `on`."""
    return yaml.load(path.read_text(), Loader=yaml.BaseLoader)


def write(tree, path):
    """Writes a scene."""
    path.write_text(yaml.dump(tree.plain(), Dumper=Dumper))


def set_value(plain, path, value):
    """Replaces a value by its key path, as `seam run --set` does; null removes the key."""
    keys = path.split(".")
    for key in keys[:-1]:
        plain = plain[int(key)] if isinstance(plain, list) else plain.setdefault(key, {})
    last = int(keys[-1]) if isinstance(plain, list) else keys[-1]
    if value == "null":
        plain.pop(last, None)
    else:
        plain[last] = value


NO_PART = ("checks", "study", "tier", "source")
NO_OUTPUT = ("picture", "statistics", "errors", "restart", "every", "fields", "cut", "folder", "interfaces")


def read(path, schema, overrides):
    """A scene as a tree: parameters are put in, constants evaluated, what writes no column is left out."""
    plain = load(path)
    for key, value in overrides.items():
        set_value(plain, key, value)
    for key in NO_PART:
        plain.pop(key, None)
    for key in NO_OUTPUT:
        plain.setdefault("output", {}).pop(key, None)
    plain["output"]["fields"] = "false"
    parameters = {}
    for name, text in plain.pop("parameters", {}).items():
        parameters[name] = expressions.evaluate(text, parameters)
    tree = schema.read(plain)
    for node in tree.walk():
        fold_node(node, parameters)
    for mesh in tree["meshes"].value.values():
        if mesh.get("file"):
            mesh["file"].value = str((path.parent / mesh["file"].value).resolve())
    return tree


def constant(value):
    """A float as it stands in a scene."""
    if value == float("inf"):
        return ".inf"
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))


def fold_node(node, parameters):
    """Puts in the values of parameters."""
    if node.kind in ("number", "integer"):
        node.value = constant(expressions.evaluate(node.value, parameters))
    elif node.kind == "vector":
        node.value = [constant(expressions.evaluate(entry, parameters)) for entry in node.value]
    elif node.kind == "expression" or node.place == "scene.output.formulas" and node.kind == "text":
        node.value = expressions.fold(str(node.value), parameters)
    elif node.kind == "vector_expression":
        node.value = [entry if entry in ("null", "~", "") else expressions.fold(entry, parameters) for entry in node.value]


def numbers(node):
    """The floats of a vector or a number."""
    def one(text):
        return float("inf") if text == ".inf" else float(text)
    return [one(entry) for entry in node.value] if isinstance(node.value, list) else one(node.value)


def copy_of(tree):
    """A copy that may be changed."""
    return copy.deepcopy(tree)
