"""What an iteration of each solver method costs, and what one of quasi_newton consists of."""
import matplotlib.pyplot as plt

from bendlab.results import registry
import style
from fig_performance import COLUMNS, PRECISION, SCALARS, columns, line, part, per_vertex, series
from report import Section, Table

# What quasi_newton consists of: in rows → name on the page, (colour, mark); and what that is compared with.
PARTS = {"gradient": ("gradient of quasi_newton", style.method_look("quasi_newton", 1)),
         "solve": ("solve of quasi_newton", (style.GREY, "v"))}
ORACLES = {"gradient_oracle": "oracle of the gradient", "solve_oracle": "CHOLMOD's own solve"}
STEP = "method/"  # rows of whole steps begin so; the method's name follows


def lines(table):
    """The same as PARTS, of every method that is timed and of the parts."""
    methods = sorted({name.removeprefix(STEP) for name, _ in table if name.startswith(STEP)},
                     key=registry.method_place)
    return {STEP + name: (name, style.method_look(name)) for name in methods} | PARTS


def main(bench, out):
    table = series(bench["rows"])
    section = Section("What does an iteration of each solver method cost?", "methods",
                      missing=missing(table),
                      commands=[f"./bendlab bench --filter '^(method|{'|'.join(PARTS)})/'"])
    section.text = ("On one cloth, with hinges. An iteration visits every constraint (pbd), finds a gradient "
                    "and solves with a factor that it keeps (quasi_newton), factorises (newton), or visits "
                    "every vertex (vbd). How far it brings the cloth is another question: the page of "
                    "accuracy compares errors over time. The gradient and the solve also stand alone.")
    if any((name, scalar) in table for name in lines(table) for scalar in SCALARS):
        section.pictures.append((_draw(table, out), "Marks: medians; bars: lowest to highest. Time of a "
                                 "whole step over its iterations; gradient and solve alone."))
        section.tables.append(_table(bench["rows"], table))
    return section


def missing(table):
    """A line for each precision that lacks rows."""
    parts = {name: label for name, (label, _) in PARTS.items()}
    expected = {"float": parts, "double": parts | ORACLES}
    lacking = [f"{PRECISION[scalar]} precision: {', '.join(absent)}" for scalar, named in expected.items()
               if (absent := [label for name, label in named.items() if (name, scalar) not in table])]
    return lacking + ["whole steps"] * (lines(table) == PARTS)


def title(table):
    """The solve's part of an iteration and pbd's cost, on the largest cloth that all have in common."""
    of = {name: {row["vertices"]: row for row in table.get((name, "float"), [])} for name in
          ("method/quasi_newton", "method/pbd", "solve")}
    both = set.intersection(*(set(some) for some in of.values()))
    if not both:
        return "Time of an iteration per vertex, over the size of the cloth"
    step, projections, solve = (per_vertex(some[max(both)]) for some in of.values())
    return (f"An iteration of quasi_newton costs {style.number(step)} ns per vertex, "
            f"{style.number(step / projections)} times one of pbd;\nthe solve is "
            f"{style.number(100 * solve / step, 2)} % of it (single precision, {max(both):,} vertices)")


def _draw(table, out):
    figure, axes = plt.subplots(figsize=(8.6, 5), layout="constrained")
    for name, (label, (colour, _)) in lines(table).items():
        for scalar, look in SCALARS.items():
            line(axes, table.get((name, scalar), []), per_vertex, color=colour, **look,
                 label=f"{label}, {PRECISION[scalar]}")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("vertices")
    axes.set_ylabel("ns per vertex and iteration")
    figure.suptitle(title(table), x=0.01, ha="left", fontsize=11)
    style.label_ends(axes)
    return style.save(figure, out, "fig_performance_methods")


def _table(rows, table):
    named = {name: label for name, (label, _) in lines(table).items()} | ORACLES
    cells = [[label, *columns(row), style.number(per_vertex(row)), threads_gain(rows, row),
              style.number(row["ratio_to_oracle"]), part(row["roofline_fraction"])]
             for name, label in named.items() for scalar in SCALARS for row in table.get((name, scalar), [])]
    return Table("Methods: ns per vertex and iteration; gradients: per constraint",
                 ["method", *COLUMNS, "ns per vertex", "times as fast on two threads",
                  "times as fast as the oracle", "share of the roofline"], cells)


def threads_gain(rows, row):
    """How many times as fast two threads are, as text."""
    two = next((other for other in rows if other["threads"] == 2 and other["name"] == row["name"]
                and other["scalar"] == row["scalar"]), None)
    return style.number(row["ns_per_constraint"] / two["ns_per_constraint"]) if two else ""
