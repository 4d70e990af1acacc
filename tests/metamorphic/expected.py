# SPDX-License-Identifier: BSD-3-Clause
"""Deviations that are allowed, each with its reason. The first entry of LARGER that fits a scene and a relation counts."""
import dataclasses
import fnmatch


@dataclasses.dataclass
class Allowed:
    """For columns proper, and for those that add up to next to nothing (columns.REMAINDERS).

    known: an open defect that shows here; the deviation is recorded, not judged
    """

    largest: float
    remainder: float
    reason: str
    known: bool = False


# With Newton's method at 1e-11 and increments at 1e-9 what is left is rounding, times the condition of the problem; and the
# remainders are differences of terms a thousand times as large and more.
ROUNDING = Allowed(1e-9, 1e-7, "rounding; Newton at 1e-11")
FAR = Allowed(1e-8, 1e-6, "coordinates of a thousand sizes have three digits less")
SAME = Allowed(1e-11, 1e-10, "the same to the bit but for maps, which are evaluated here with another rounding")

BY_RELATION = {"moved by a thousand": FAR, "renamed": ROUNDING, "grids as files": SAME}

PIECES = "cut cells in space are integrated by a rule of degree 4 on pieces, which follow the numbers of nodes"
DIAGONALS = "quadrilateral faces of bodies in space are two triangles, along a diagonal that follows the numbers of nodes"
LINE = "a side on a line of the mesh counts as moved by (e, e^2, e^3): the mirror image has the sliver on the other side"
FROZEN = "the step of the touch is taken with a frozen cut (decision 34), from another iteration on in each variant"
RENUMBERING = ("turned*", "mirrored", "renumbered*")  # grids that are turned are counted along other axes

# (scenes, relations, allowed), patterns of names. `known` ones are open defects.
LARGER = [
    # Bodies of hexahedra.
    (("contact of warped hexahedra",), RENUMBERING, Allowed(0.1, 0.5, DIAGONALS)),
    (("fsi of hexahedra",), RENUMBERING, Allowed(1e-2, 1e-2, DIAGONALS)),
    (("contact in fluid of hexahedra",), RENUMBERING, Allowed(1e-2, 0.3, DIAGONALS + "; the least gap is that of integration points")),
    # Cuts in space.
    (("fluid in space", "fluid of tetrahedra", "fluid cip in space"), RENUMBERING, Allowed(1e-4, 1e-5, PIECES)),
    (("fsi in space",), RENUMBERING, Allowed(1e-6, 1e-6, PIECES)),
    (("fpi in space",), RENUMBERING, Allowed(1e-5, 1e-5, PIECES)),
    (("contact in fluid in space",), RENUMBERING,
     Allowed(5e-3, 0.2, PIECES + "; slip that grows as 1/gap is no polynomial; the least gap is that of integration points")),
    (("touching in space",), ("moved by a thousand",), Allowed(0, 0, "segmentation fault in CellUnion::add_leaf", known=True)),
    (("touching in space",), RENUMBERING + ("moved*", "length*", "mass*", "time*", "all units", "cyclic*", "*reversed"),
     Allowed(0, 0, FROZEN, known=True)),
    # In the plane.
    (("edges on a line",), ("turned*", "mirrored", "moved*", "cyclic*"), Allowed(1e-2, 1.0, LINE)),
    (("bar",), ("moved by a thousand",),
     Allowed(0, 0, "gaps are rounded to 1e-13 there, which is more than Newton's 1e-11 allows: a step is halved", known=True)),
    (("separate parts",), RENUMBERING, Allowed(0, 0, "parts that meet around a node inside of a body share unknowns", known=True)),
    (("cavity",), ("lists reversed",), Allowed(0, 0, "of boundaries that meet with different values the last one counts", known=True)),
    (("fsi fitted",), ("*units",), Allowed(0, 0, "in these units the linear solve leaves a residual of 1.7e-6 and is refused", known=True)),
]


def _entry(scene, relation):
    """The entry of LARGER that speaks of a pair of runs."""
    def fits(name, patterns):
        return any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)
    return next((value for scenes, relations, value in LARGER if fits(scene, scenes) and fits(relation, relations)), None)


def allowed(scene, relation):
    """What may deviate."""
    return _entry(scene, relation) or BY_RELATION.get(relation, ROUNDING)


def is_apart(scene, relation):
    """Whether an entry of LARGER speaks of it."""
    return _entry(scene, relation) is not None
