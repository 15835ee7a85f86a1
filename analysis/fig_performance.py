"""Rows of `bendlab bench --json`, and what a constraint costs over the size of the cloth."""
from collections import Counter

import matplotlib.pyplot as plt
import numpy as np

from bendlab.results import registry
import style
from report import Section, Table

# The constraints of the membrane: in rows → name and colour on the page.
STRAIN = {"strain": ("strain triangles", style.INK),
          "strain_angle": ("strain triangles, shear as an angle", style.GREY)}
# Those of bending have the names of their models, but for these: in rows → model, what else is said of it.
RENAMED = {"dense": ("adaptive", ""), "choi_ko_compliance": ("choi_ko", " with compliance")}
PRECISION = {"float": "single", "double": "double"}
SCALARS = {"float": dict(ls="-", marker="o"), "double": dict(ls="--", marker="s", mfc="white")}
ORACLES = {"float": dict(marker="x", mew=1.8), "double": dict(marker="+", mew=1.2)}
OVER_SIZE = {"strain": 1, "crossover": 0.83, "dense": 1.2}  # oracles are moved sideways to be told apart


# Rows -----------------------------------------------------------------------------------------------------

def kind(row):
    """'strain_oracle' of the row strain_oracle/128, 'effect/wind' of effect/wind/100."""
    return row["name"].rpartition("/")[0]


def series(rows):
    """(kind, scalar) → timed rows of one thread, sorted by vertices."""
    found = {}
    for row in rows:
        if row["threads"] == 1 and row["ns_per_constraint"] is not None:
            found.setdefault((kind(row), row["scalar"]), []).append(row)
    return {key: sorted(some, key=lambda row: row["vertices"]) for key, some in found.items()}


def model_of(name):
    """The bending model whose constraints rows of this name time; None for other rows."""
    model, _ = RENAMED.get(name, (name, ""))
    return model if model in registry.models() else None


def label(name):
    """The name of a kind of constraint on the page."""
    if name in STRAIN:
        return STRAIN[name][0]
    model, more = RENAMED.get(name, (name, ""))
    return f"{model} {'hinges' if registry.made_of(model) == 'hinges' else 'springs'}{more}"


def colour(name):
    """The colour of a kind of constraint."""
    return STRAIN[name][1] if name in STRAIN else style.colour(model_of(name))


def bending(table):
    """The kinds of bending constraints that are timed, in the order of the rows."""
    return list(dict.fromkeys(name for name, _ in table if model_of(name)))


def kinds(table):
    """All kinds of constraints that are timed, those of the membrane first."""
    return [*(name for name in STRAIN if any((name, scalar) in table for scalar in PRECISION)),
            *bending(table)]


def at(table, name, scalar, vertices):
    """The row of a kind at a size, None if there is none."""
    return next((row for row in table.get((name, scalar), []) if row["vertices"] == vertices), None)


def usual(table):
    """The number of vertices at which most kinds of constraints are timed; None without any."""
    timed = kinds(table)
    sizes = Counter(row["vertices"] for (name, _), rows in table.items() if name in timed for row in rows)
    return max(sizes, key=lambda size: (sizes[size], -size), default=None)


def per_vertex(row, time="ns_per_constraint"):
    """ns per vertex and iteration (effects: step; solves: one); `time` may be the lowest or highest one."""
    return row[time] * row["constraints"] / row["vertices"]


def iterations(rows):
    """How many iterations a step of the rows has, from its time; None without a row of a step."""
    for row in rows:
        if kind(row) == "step":
            return round(1e6 * row["step_ms"] / (row["ns_per_constraint"] * row["constraints"]))
    return None


def lacking(table, names):
    """A line for each precision in which kinds have no row at all."""
    return [f"{PRECISION[scalar]} precision: {', '.join(absent)}" for scalar in SCALARS
            if (absent := [label(name) for name in names if (name, scalar) not in table])]


def part(value):
    """A share between 0 and 1 as text in %."""
    return "–" if value is None else f"{style.number(100 * value, 2)} %"


def to(values, digits=2):
    """'1.3 to 8.4', or one number where both are alike."""
    low, high = (style.number(value, digits) for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def columns(row):
    """The columns of a timed row that every table has."""
    return [row["scalar"], f"{row['vertices']:,}", style.number(row["ns_per_constraint"]),
            f"{style.number(row['ns_lowest'])} – {style.number(row['ns_highest'])}"]


COLUMNS = ["scalar", "vertices", "ns", "lowest – highest"]


# The figure -----------------------------------------------------------------------------------------------

def main(bench, out):
    table = series(bench["rows"])
    section = Section("Does a constraint cost more on a larger cloth?", "size",
                      missing=lacking(table, OVER_SIZE),
                      commands=["./bendlab bench --filter '^(strain|crossover|dense)'"])
    section.text = ("A larger cloth no longer fits the caches of the processor, so its constraints wait for "
                    "memory. An iteration visits every constraint once; the time is that of one constraint "
                    "in one iteration.")
    rows = [(name, row) for name in OVER_SIZE for scalar in SCALARS for row in table.get((name, scalar), [])]
    if rows:
        section.pictures.append((_draw(table, out), "Marks on lines: medians; bars: lowest to highest. × and "
                                 "+: the oracle, the scalar code that projects one constraint at a time in "
                                 "list order. It is timed at one size; marks are moved sideways to be told "
                                 "apart."))
        section.tables.append(Table("Cost over size: ns per constraint and iteration",
                                    ["constraint", *COLUMNS, "times as fast as the oracle"],
                                    [[label(name), *columns(row), style.number(row["ratio_to_oracle"])]
                                     for name, row in rows]))
    return section


def title(table):
    """How the cost grows from the usual cloth to the largest, over the constraints that are timed on both."""
    size, rows = usual(table), {name: table.get((name, "float"), []) for name in OVER_SIZE}
    largest = max((row["vertices"] for some in rows.values() for row in some), default=0)
    grown = {label(name): some[-1]["ns_per_constraint"] / first["ns_per_constraint"]
             for name, some in rows.items() if (first := at(table, name, "float", size))
             and some[-1]["vertices"] == largest > size}
    if not grown:
        return "Time per constraint over the size of the cloth"
    parts = " and ".join(f"{style.number(times)} for {name}" for name, times in grown.items())
    return (f"Cost of a constraint on {largest:,} vertices over that on {size:,}:\n{parts} (single "
            "precision)")


def _draw(table, out):
    figure, axes = plt.subplots(figsize=(8.6, 4.6), layout="constrained")
    for name in OVER_SIZE:
        for scalar, look in SCALARS.items():
            line(axes, table.get((name, scalar), []), lambda row, time: row[time], color=colour(name),
                 **look, label=f"{label(name)}, {PRECISION[scalar]}")
    for scalar, look in ORACLES.items():
        for name, shift in OVER_SIZE.items():
            for row in table.get((f"{name}_oracle", scalar), []):
                axes.plot(shift * row["vertices"], row["ns_per_constraint"], color=colour(name), ms=7,
                          **look)
        axes.plot([], [], ls="none", color=style.GREY, **look,
                  label=f"oracle of the same colour, {PRECISION[scalar]}")
    axes.set_xscale("log")
    style.plain_log(axes, "y")
    axes.set_xlabel("vertices")
    axes.set_ylabel("ns per constraint and iteration")
    oracles = [line for line in axes.lines if "oracle" in line.get_label()]
    axes.legend(handles=oracles, loc="upper right")
    figure.suptitle(title(table), x=0.01, ha="left", fontsize=11)
    style.label_ends(axes, only=lambda label: "oracle" not in label)
    return style.save(figure, out, "fig_performance")


def line(axes, rows, value, **look):
    """Medians of `value(row, time)` over vertices, with bars from the lowest to the highest."""
    if rows:
        middle, low, high = (np.array([value(row, time) for row in rows], float)
                             for time in ("ns_per_constraint", "ns_lowest", "ns_highest"))
        axes.errorbar([row["vertices"] for row in rows], middle, yerr=[middle - low, high - middle],
                      capsize=2.5, elinewidth=1, **look)
