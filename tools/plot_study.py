#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the table of `seam study`: each measure against a key of the scene, errors also against what they cost: unknowns,
seconds and memory."""

import argparse
import csv
import math

import matplotlib

matplotlib.use("Agg")  # no screen
import matplotlib.pyplot as plt  # noqa: E402

# Distinguishable with the common colour vision deficiencies (Okabe and Ito), and by their markers without colours.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X"]


def evaluate(text):
    """A value of the table as a number: plain, or a quotient such as 1/16; NaN for anything else."""
    try:
        numerator, _, denominator = text.partition("/")
        return float(numerator) / float(denominator or 1)
    except (ValueError, ZeroDivisionError):
        return math.nan


def read(path):
    """Rows of the table as dictionaries, and its title."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    title = next((line[1:].strip() for line in lines if line.startswith("#")), "")
    return list(csv.DictReader(line for line in lines if not line.startswith("#"))), title


def is_error(measure):
    return measure.startswith("error(") or measure.endswith((".l2", ".h1"))


def curves(rows, keys, against):
    """Rows by the values of the keys that are not on the horizontal axis."""
    ends = [key.rsplit(".", 1)[-1] for key in keys]
    # The end of a key path says enough where no other key ends alike.
    names = {key: end if ends.count(end) == 1 else key for key, end in zip(keys, ends)}
    groups = {}
    for row in rows:
        label = ", ".join(f"{names[key]} {row[key]}" for key in keys if key != against)
        groups.setdefault(label, []).append(row)
    # Along a curve the key grows; cost, which is measured, need not.
    for group in groups.values():
        group.sort(key=lambda row: evaluate(row[against]))
    return groups


def points(rows, x, y, scale, logarithmic):
    """Pairs of numbers in the order of the rows; those that a logarithmic axis cannot show are left out."""
    pairs = [(evaluate(row[x]) * scale, evaluate(row[y])) for row in rows]
    pairs = [p for p in pairs if math.isfinite(p[0]) and math.isfinite(p[1])]
    return [p for p in pairs if not logarithmic or (p[0] > 0 and p[1] > 0)]


def slope(pairs):
    """Of the last two points in a doubly logarithmic plot, or None."""
    if len(pairs) < 2 or pairs[-1][0] == pairs[-2][0]:
        return None
    (x0, y0), (x1, y1) = pairs[-2:]
    return math.log(y1 / y0) / math.log(x1 / x0)


def draw(axes, groups, x, y, label, scale=1.0, annotate=False):
    """Names of curves are said by the figure; where an order can be seen, its legend has that."""
    logarithmic = is_error(y)
    for k, (name, rows) in enumerate(groups.items()):
        pairs = points(rows, x, y, scale, logarithmic)
        if not pairs:
            continue
        text = None
        if annotate and logarithmic and slope(pairs) is not None:
            text = f"{slope(pairs):.2f}"
        axes.plot(*zip(*pairs), color=COLOURS[k % len(COLOURS)], marker=MARKERS[k % len(MARKERS)], markersize=5,
                  linewidth=1.4, label=text)
    if x != "peak_memory_bytes":  # most of it is there before the problem is
        axes.set_xscale("log")
    if logarithmic:
        axes.set_yscale("log")
    axes.set_xlabel(label)
    axes.grid(True, which="major", color="0.8", linewidth=0.6)
    axes.grid(True, which="minor", color="0.92", linewidth=0.4)


def mark_values(axes, rows, key):
    """The values of the study as ticks: powers of ten say little about 4, 8, 16, ..."""
    values = sorted({evaluate(row[key]) for row in rows} - {math.nan})
    texts = {evaluate(row[key]): row[key] for row in rows}
    if 0 < len(values) <= 10:
        axes.set_xticks(values)
        crowded = sum(len(texts[v]) for v in values) > 30
        axes.set_xticklabels([texts[v] for v in values], rotation=45 if crowded else 0)
        axes.minorticks_off()


def name_curves(figure, groups):
    """The names of the curves below all panels, where they cover none."""
    if len(groups) < 2:
        return
    columns = max(1, min(len(groups), int(figure.get_figwidth() * 11 / max(map(len, groups)))))
    lines = -(-len(groups) // columns)
    height = (0.1 + 0.22 * lines) / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, height, 1, 1 - height))
    handles = [plt.Line2D([], [], color=COLOURS[k % len(COLOURS)], marker=MARKERS[k % len(MARKERS)], markersize=5, linewidth=1.4)
               for k in range(len(groups))]
    figure.legend(handles, list(groups), loc="lower center", ncol=columns, fontsize=9, frameon=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table")
    parser.add_argument("picture")
    parser.add_argument("--against", required=True, help="column on the first horizontal axis")
    parser.add_argument("--key", action="append", default=[], help="column that was varied; may be repeated")
    parser.add_argument("--measure", action="append", default=[], help="column on the vertical axis; may be repeated")
    options = parser.parse_args()

    rows, title = read(options.table)
    cost = {"unknowns", "seconds.total", "seconds.assembly", "seconds.linear", "peak_memory_bytes"}
    measures = [m for m in options.measure if m not in cost] or options.measure
    groups = curves(rows, options.key, options.against)
    key = (options.against, options.against, 1.0)
    costs = [("unknowns", "unknowns", 1.0), ("seconds.total", "seconds", 1.0), ("peak_memory_bytes", "peak memory, MB", 1e-6)]
    # Rows of panels: an error with its costs; of what is no error, as many as fit.
    lines = [[(m, *panel) for panel in [key, *costs]] for m in measures if is_error(m)]
    others = [(m, *key) for m in measures if not is_error(m)]
    lines += [others[k:k + 1 + len(costs)] for k in range(0, len(others), 1 + len(costs))]
    width = max(map(len, lines))
    figure, grid = plt.subplots(len(lines), width, figsize=(4.1 * width, 3.8 * len(lines)), squeeze=False,
                                constrained_layout=True)
    for all_axes, line in zip(grid, lines):
        for axes in all_axes[len(line):]:
            axes.remove()
        for axes, (measure, column, label, scale) in zip(all_axes, line):
            draw(axes, groups, column, measure, label, scale, annotate=column == options.against)
            if column != options.against:
                axes.sharey(all_axes[0])
                continue
            mark_values(axes, rows, options.against)
            axes.set_ylabel(measure)
            if axes.get_legend_handles_labels()[0]:
                axes.legend(fontsize=8, framealpha=0.7, title="slope", title_fontsize=8, labelspacing=0.2, handlelength=1.2)
    name_curves(figure, groups)
    figure.suptitle(title, fontsize=12)
    figure.savefig(options.picture, dpi=110)


if __name__ == "__main__":
    main()
