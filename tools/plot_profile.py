#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws columns of the tables that `output: {interfaces: true}` writes along an interface, one panel per table."""

import argparse
import csv

from plot_study import COLOURS, plt


def read(path, along, limits):
    """The table's columns as lists, points ordered by `along` and within the limits."""
    with open(path, encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    for key in [along, *limits]:
        if rows and key not in rows[0]:
            raise SystemExit(f"{path}: no column '{key}'; it has {', '.join(rows[0])}")
    kept = [row for row in rows if all(low <= row[key] <= high for key, (low, high) in limits.items())]
    if not kept:
        raise SystemExit(f"{path}: no points within the limits")
    kept.sort(key=lambda row: row[along])
    return {key: [row[key] for row in kept] for key in kept[0]}


def limit(text):
    key, low, high = text.split(":")
    return key, (float(low or "-inf"), float(high or "inf"))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", metavar="FILE", help="INTERFACE-STEP.csv ... OUT.png")
    parser.add_argument("--along", default="body_x", help="column along the axis (default: body_x)")
    parser.add_argument("--of", action="append", required=True, metavar="COLUMN[=LABEL]", help="what is drawn; may be repeated")
    parser.add_argument("--within", action="append", type=limit, default=[], metavar="COLUMN:LOW:HIGH", help="leave out other points")
    arguments = parser.parse_args()
    *tables, picture = arguments.files
    if not tables or not picture.endswith(".png"):
        parser.error("expected tables, then a name that ends in .png")
    figure, panels = plt.subplots(1, len(tables), figsize=(4.2 * len(tables) + 0.8, 3.6), sharey=True, squeeze=False)
    for panel, path in zip(panels[0], tables):
        table = read(path, arguments.along, dict(arguments.within))
        for colour, curve in zip(COLOURS, arguments.of):
            column, _, label = curve.partition("=")
            if column not in table:
                raise SystemExit(f"{path}: no column '{column}'; it has {', '.join(table)}")
            panel.plot(table[arguments.along], table[column], ".-", color=colour, markersize=3, linewidth=0.8, label=label or column)
        panel.set_title(f"t = {table['time'][0]:g}", fontsize=10)
        panel.set_xlabel(arguments.along)
        panel.grid(alpha=0.3)
    panels[0][0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main()
