# SPDX-License-Identifier: BSD-3-Clause
"""Deviations: the largest over all times, over the largest value of the column (of a vector: of all its components)."""
import dataclasses
import math

ZERO = 1e-8  # of a column's own unit in the scene as written: smaller ones are left out


@dataclasses.dataclass
class Deviation:
    """The largest deviation of the columns proper and of those that add up to next to nothing."""

    largest: float = 0.0
    column: str = ""
    remainder: float = 0.0
    remainder_column: str = ""
    compared: int = 0
    failure: str = ""


def compare(columns, base, other):
    """Columns of a scene against those of its variant, brought back. @param other {name: values}"""
    result = Deviation()
    missing = [name for name in columns.all if name not in other]
    if missing:
        return Deviation(failure="no column " + ", ".join(missing))
    if len(base["time"]) != len(other["time"]):
        return Deviation(failure=f"{len(other['time']) - 1} steps instead of {len(base['time']) - 1}")
    for name, column in columns.all.items():
        scale = size(columns, column, base)
        if scale < ZERO:
            continue
        result.compared += 1
        d = max(difference(a, b) for a, b in zip(base[name], other[name])) / scale
        if column.is_remainder:
            if d > result.remainder:
                result.remainder, result.remainder_column = d, name
        elif d > result.largest:
            result.largest, result.column = d, name
    span = max(abs(t) for t in base["time"]) or 1.0
    d = max(abs(a - b) for a, b in zip(base["time"], other["time"])) / span
    if d > result.largest:
        result.largest, result.column = d, "time"
    return result


def size(columns, column, base):
    """The largest value of a column, or of the vector or tensor that it belongs to."""
    same = [name for name, other in columns.all.items() if other.base == column.base] if column.turns else [column.name]
    return max((abs(v) for name in same for v in base[name] if math.isfinite(v)), default=0.0)


def difference(a, b):
    """Of two numbers that may both be infinite or no number."""
    if math.isnan(a) and math.isnan(b) or a == b:
        return 0.0
    return abs(a - b) if math.isfinite(a) and math.isfinite(b) else math.inf
