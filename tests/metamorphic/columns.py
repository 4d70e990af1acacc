# SPDX-License-Identifier: BSD-3-Clause
"""What the columns of series.csv are: their unit, whether they belong to a vector, and how they turn."""
import dataclasses
import math

import expressions
import scene as scenes
import units

AXES = "xyz"
TENSOR = ["xx", "yy", "zz", "xy", "yz", "xz"]

# Quantities of fields: unit, and how they turn.
QUANTITIES = {
    "displacement": ("m", "vector"), "velocity": ("m/s", "vector"), "pressure": ("Pa", ""), "translation": ("m", "vector"),
    "rotation": ("rad", "axial"), "stress": ("Pa", "tensor"), "cauchy_stress": ("Pa", "tensor"), "von_mises": ("Pa", ""),
    "vorticity": ("1/s", "axial"), "porosity": ("1", ""), "seepage": ("m/s", "vector"), "reaction": ("N", "vector"),
    "force": ("N", "vector"), "mesh_volume": ("1", "")}

# Integrals of fields and measures of couplings, by the last words of their names. V is the unit of the volume, A of the
# surface: m^3 and m^2, in the plane m^2 and m. sqrt(A) makes the unit of a norm over a surface.
INTEGRALS = {
    "volume": ("1", "V"), "volume_rate": ("1/s", "V"), "fluid_volume": ("1", "V"), "dropped_volume": ("1", "V"),
    "kinetic_energy": ("Pa", "V"), "strain_energy": ("Pa", "V"), "dissipation": ("Pa/s", "V"), "divergence": ("1/s", "V"),
    "mismatch": ("m/s", "sqrt(A)"), "mismatch_across": ("m/s", "sqrt(A)"), "mismatch_along": ("m/s", "sqrt(A)"),
    "jump": ("m/s", "sqrt(A)"), "apart": ("m", "sqrt(A)"), "overlap": ("m", "sqrt(A)"), "transfer": ("m/s", "A"), "gap": ("m", ""),
    "area": ("1", "A"), "contact_area": ("1", "A"), "pressure": ("Pa", ""), "contact_pressure": ("Pa", ""),
    "effective_pressure": ("Pa", ""), "into_gaps": ("m/s", "A"),
    "fluid_outflow": ("m/s", "A"), "body_outflow": ("m/s", "A"), "seepage": ("m/s", "A"), "dropped": ("m/s", "A"), "force": ("Pa", "A"),
    "contact_force": ("Pa", "A")}

# What adds up to next to nothing, or would vanish if the method were exact, deviates as its terms do; what is least,
# greatest or in touch among integration points, as these do.
REMAINDERS = ("divergence", "dropped_volume", "dropped", "mismatch", "mismatch_across", "mismatch_along", "jump", "apart", "overlap",
              "fluid_outflow", "gap", "pressure", "contact_pressure", "effective_pressure", "into_gaps", "area", "contact_area")


@dataclasses.dataclass
class Column:
    """One column.

    component: "" of a scalar, x of a vector, xy of a tensor; magnitude is a scalar
    single: the vector's one component that the probe shows, under the vector's own name
    """

    name: str
    base: str
    powers: tuple
    turns: str = ""
    component: str = ""
    single: bool = False

    @property
    def is_remainder(self):
        """Whether it is small against its terms, or decided among integration points."""
        owner, _, what = self.name.rpartition(".")
        return bool(owner) and what in REMAINDERS

    def new(self, frame):
        """Its name and its sign in a frame."""
        if not self.component or not self.turns:
            return self.name, frame.determinant if self.turns == "axial" and frame.dimension == 2 else 1
        if self.turns == "tensor":
            # In the plane zz stays where it is.
            pair = [frame.new_axis(AXES.index(letter)) if AXES.index(letter) < frame.dimension else (2, 1)
                    for letter in self.component]
            letters = "".join(AXES[axis] for axis, _ in pair)
            letters = letters if letters in TENSOR else letters[::-1]
            sign = pair[0][1] * pair[1][1]
        else:
            axis, sign = frame.new_axis(AXES.index(self.component))
            letters = AXES[axis]
            sign *= frame.determinant if self.turns == "axial" else 1
        return (self.name if self.single else f"{self.base}.{letters}"), sign


class Columns:
    """The columns of a scene."""

    def __init__(self, tree, names):
        self.dimension = int(tree["dimension"].value)
        output = tree["output"]
        self.probes = output["probes"].value if output.get("probes") else {}
        self.formulas = set(output["formulas"].value) if output.get("formulas") else set()
        self.owners = set(tree["fields"].value) | set(tree["interfaces"].value if tree.get("interfaces") else {})
        self.all = {name: self.column(name) for name in names}

    def column(self, name):
        """What is known of the column of this name."""
        if name in self.formulas:
            return Column(name, name, (0, 0, 0))
        base, _, component = name.rpartition(".") if name not in self.probes else (name, "", "")
        # A probe and an interface may have one name: components tell the probe's columns.
        if base in self.probes and (not component or component in AXES or component in TENSOR):
            return self.of_probe(name, base, component)
        owner, _, what = name.partition(".")
        if owner not in self.owners:
            raise scenes.SceneError(f"nothing is known of the column {name}")
        what, _, component = what.partition(".")
        if what not in INTEGRALS:
            raise scenes.SceneError(f"nothing is known of the column {name}")
        unit, extent = INTEGRALS[what]
        powers = units.times(units.powers(unit, 3), self.extent(extent))
        return Column(name, f"{owner}.{what}", powers, "vector" if component else "", component)

    def of_probe(self, name, base, component):
        """A probe: at a point, or the integral over boundaries or an interface."""
        probe = self.probes[base]
        quantity = probe["quantity"].value
        unit, turns = QUANTITIES[quantity]
        powers = units.powers(unit, self.dimension)
        if not probe.get("at") and quantity not in ("reaction", "force", "translation", "rotation"):
            powers = units.times(powers, self.extent("A"))
        asked = probe["component"].value if probe.get("component") else ""
        if asked == "magnitude":
            return Column(name, base, powers)
        if asked and turns == "tensor":
            asked *= 2
        return Column(name, base, powers, turns, component or asked, single=bool(asked))

    def extent(self, text):
        """Powers of a volume, a surface or the root of a surface."""
        d = self.dimension
        return {"V": (d, 0, 0), "A": (d - 1, 0, 0), "sqrt(A)": ((d - 1) / 2, 0, 0), "": (0, 0, 0)}[text]

    def inverse(self, frame):
        """For each column of the old frame an expression of what is recorded in the new one (dots as _)."""
        result = {}
        for name, column in self.all.items():
            if name in self.formulas:
                continue
            new, sign = column.new(frame)
            result[name] = "(" + expressions.times(new.replace(".", "_"), sign / frame.factor(column.powers)) + ")"
        return result

    def back(self, frame, series):
        """Columns of the new frame as they would be in the old one. @return {name: values}; missing ones are left out"""
        result = {"time": [(t - frame.start) / frame.time for t in series["time"]]}
        for name, column in self.all.items():
            new, sign = column.new(frame)
            if new in series:
                scale = sign / frame.factor(column.powers)
                result[name] = [value * scale if math.isfinite(value) else value for value in series[new]]
        return result
