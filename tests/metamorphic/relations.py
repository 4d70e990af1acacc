# SPDX-License-Identifier: BSD-3-Clause
"""Relations: ways to write a scene anew whose result is known from that of the scene itself."""
import expressions
import meshes
import scene as scenes
from frames import Frame, Transformer

SHIFT = [0.1, 1 / 3, 0.7]


class Variant:
    """A scene that was written anew, and the frame that brings its columns back."""

    def __init__(self, tree, frame, names=None):
        self.tree, self.frame, self.names = tree, frame, names or {}


def in_frame(frame_of):
    """A relation by a frame. @param frame_of dimension -> Frame"""
    def relation(tree, columns, folder):
        frame = frame_of(int(tree["dimension"].value))
        new = Transformer(frame, columns).apply(tree)
        meshes.turn(new, tree, frame, folder)
        return Variant(new, frame)
    return relation


def turned(d):
    """By a quarter of a turn about z."""
    return Frame(d, [(1, -1), (0, 1), (2, 1)][:d])


def mirrored(d):
    """x to -x."""
    return Frame(d, [(0, -1), (1, 1), (2, 1)][:d])


def cyclic(d):
    """x to y to z to x; in the plane x to y. Nodes and cells keep their numbers."""
    return Frame(d, [(2, 1), (0, 1), (1, 1)] if d == 3 else [(1, -1), (0, 1)], keep_numbers=True)


def reversed_keys(tree, columns, folder):
    """Keys of all objects from last to first; what is a name for something comes in another order, too."""
    new = scenes.copy_of(tree)
    for node in new.walk():
        if isinstance(node.value, dict):
            node.value = dict(reversed(node.value.items()))
    # Formulas may use those above them only.
    if new["output"].get("formulas"):
        new["output"]["formulas"].value = dict(reversed(new["output"]["formulas"].value.items()))
    return Variant(new, Frame(int(tree["dimension"].value)))


def reversed_lists(tree, columns, folder):
    """Lists without an order from last to first; corners from another one on."""
    new = scenes.copy_of(tree)
    for node in new.walk():
        if node.place in scenes.UNORDERED and isinstance(node.value, list):
            node.value.reverse()
        if node.place == "body.outline.corners" and node.kind == "list":
            node.value = node.value[1:] + node.value[:1]
    return Variant(new, Frame(int(tree["dimension"].value)))


def renamed(tree, columns, folder):
    """Other names of meshes, fields, interfaces and probes, in another alphabetical order."""
    new = scenes.copy_of(tree)
    names = {}
    for kind, map_ in (("meshes", new["meshes"]), ("fields", new["fields"]), ("interfaces", new.get("interfaces")),
                       ("probes", new["output"].get("probes")), ("formulas", new["output"].get("formulas"))):
        if not map_:
            continue
        backwards = sorted(map_.value, reverse=True)
        names[kind] = {old: f"n{backwards.index(old):02d}_{kind[0]}_{old[::-1]}" for old in map_.value}
        map_.value = {names[kind][old]: node for old, node in map_.value.items()}
    for node in new.walk():
        kind = scenes.REFERENCES.get(node.place)
        if kind and isinstance(node.value, list):
            node.value = [names[kind][old] for old in node.value]
        elif kind:
            node.value = names[kind][node.value]
    columns_of = {}
    for old in columns.all:
        columns_of[old] = new_column(old, columns, names)
    if new["output"].get("formulas"):
        words = {old.replace(".", "_"): now.replace(".", "_") for old, now in columns_of.items()}
        for formula in new["output"]["formulas"].value.values():
            formula.value = expressions.substitute(formula.value, words)
    return Variant(new, Frame(int(tree["dimension"].value)), columns_of)


def new_column(old, columns, names):
    """The new name of a column."""
    if old in columns.formulas:
        return names["formulas"][old]
    if old in columns.probes:
        return names["probes"][old]
    base, _, rest = old.partition(".")
    if columns.all[old].base == base and base in columns.probes:
        return f"{names['probes'][base]}.{rest}"
    # A field and an interface may have one name; then what they record tells them apart.
    field = base in names["fields"] and (base not in names.get("interfaces", {}) or not of_interface(rest))
    return f"{names['fields' if field else 'interfaces'][base]}.{rest}"


def of_interface(what):
    """Whether a number is one that couplings record."""
    return what.split(".")[0] in ("mismatch", "mismatch_across", "mismatch_along", "jump", "apart", "overlap", "transfer", "gap", "area",
                                  "pressure", "contact_area", "contact_pressure", "effective_pressure", "into_gaps", "fluid_outflow", "body_outflow", "seepage", "dropped", "force",
                                  "contact_force")


def as_files(seed):
    """Grids as Gmsh files, their nodes and cells permuted when there is a seed."""
    def relation(tree, columns, folder):
        new = scenes.copy_of(tree)
        meshes.write_files(new, folder, seed)
        return Variant(new, Frame(int(tree["dimension"].value)))
    return relation


def shifted(factor):
    """A frame that is moved along all axes."""
    return lambda d: Frame(d, shift=[factor * b for b in SHIFT[:d]])


# In the order of the tables. Powers of ten, so that no scaling is exact.
RELATIONS = {
    "turned": in_frame(turned),
    "mirrored": in_frame(mirrored),
    "cyclic, same numbers": in_frame(cyclic),
    "moved by (0.1, 1/3, 0.7)": in_frame(shifted(1)),
    "moved by a thousand": in_frame(lambda d: Frame(d, shift=[1000 + b for b in SHIFT[:d]])),
    "length x 1000": in_frame(lambda d: Frame(d, length=1e3)),
    "length / 1000": in_frame(lambda d: Frame(d, length=1e-3)),
    "mass x 1000": in_frame(lambda d: Frame(d, mass=1e3)),
    "mass / 1000": in_frame(lambda d: Frame(d, mass=1e-3)),
    "time x 1000": in_frame(lambda d: Frame(d, time=1e3)),
    "time / 1000": in_frame(lambda d: Frame(d, time=1e-3)),
    "all units": in_frame(lambda d: Frame(d, length=1e-3, mass=1e-6, time=100)),
    "turned, moved, all units": in_frame(lambda d: Frame(d, turned(d).axes, [1e-3 * b for b in SHIFT[:d]], 1e-3, 1e-6, 100)),
    "renamed": renamed,
    "keys reversed": reversed_keys,
    "lists reversed": reversed_lists,
    "grids as files": as_files(None),
    "renumbered": as_files(1),
    "renumbered again": as_files(2),
}
