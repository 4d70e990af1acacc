# SPDX-License-Identifier: BSD-3-Clause
"""Units as powers of length, mass and time.

In the plane forces, energies and masses are those of a slab one metre thick, which no scaling changes: per metre.
"""
import re

BASE = {"m": (1, 0, 0), "kg": (0, 1, 0), "s": (0, 0, 1), "N": (1, 1, -2), "Pa": (-1, 1, -2), "J": (2, 1, -2),
        "W": (2, 1, -3), "rad": (0, 0, 0), "degree": (0, 0, 0), "1": (0, 0, 0)}
EXTENSIVE = ("N", "J", "W")  # of the whole body


def powers(unit, dimension):
    """(length, mass, time) of a unit as `seam schema` writes it: "kg/m^3", "N s/m"."""
    result = [0, 0, 0]
    for at, half in enumerate(unit.split("/")):
        for word in half.split():
            name, _, power = word.partition("^")
            sign = (-1 if at else 1) * int(power or 1)
            thick = 1 if dimension == 2 and name in EXTENSIVE else 0
            for i, exponent in enumerate(BASE[name]):
                result[i] += sign * (exponent - (thick if i == 0 else 0))
    return tuple(result)


def times(a, b, times_b=1):
    """Powers of a product."""
    return tuple(x + times_b * y for x, y in zip(a, b))


def of_description(text):
    """The unit that a description of the JSON schema ends with, in brackets before the default; "" for none."""
    found = re.search(r" \[([A-Za-z0-9/^ ]+)\](?: \(default: .*\))?$", text)
    words = re.split(r"[ /]", found.group(1)) if found else []
    return found.group(1) if words and all(word.partition("^")[0] in BASE for word in words) else ""
