"""What every kind of constraint costs, per constraint and per vertex."""
import matplotlib.pyplot as plt

from bendlab.results import registry
import style
from fig_performance import (COLUMNS, PRECISION, STRAIN, bending, columns, kinds, label, lacking, model_of,
                             per_vertex, series, to, usual)
from report import Section, Table

COLOURS = dict(zip(PRECISION, style.SEQUENCE))
MARKERS = "oDsv^P"


def sizes(table, name, scalar):
    """The rows of a kind at the usual size and at its largest."""
    rows = table.get((name, scalar), [])
    return [row for row in rows if row["vertices"] == usual(table) or row is rows[-1]]


def main(bench, out):
    table = series(bench["rows"])
    section = Section("What does each kind of constraint cost?", "kinds",
                      missing=lacking(table, kinds(table)),
                      commands=[f"./bendlab bench --filter '^({'|'.join(kinds(table) or STRAIN)})/'"])
    if not bending(table):
        section.missing.append("any kind of bending constraint")
    section.text = ("Models differ in what one constraint costs, and in how many they have. So the cost "
                    "stands twice here: per constraint, and per vertex. " + same_text(table)
                    + springs_text(table))
    if kinds(table):
        section.pictures.append((_draw(table, out), "Time of one iteration. Full marks: the size that all "
                                 "kinds have in common; hollow ones: the largest cloth of the kind. Bars: "
                                 "lowest to highest."))
        section.tables.append(_table(table))
    return section


def _draw(table, out):
    figure, (left, right) = panels(table)
    dots(left, table, lambda row, time: row[time])
    dots(right, table, per_vertex)
    style.plain_log(left, "x"), style.plain_log(right, "x")
    left.set_xlabel("ns per constraint and iteration")
    right.set_xlabel("ns per vertex and iteration")
    right.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    figure.suptitle(title(table), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_performance_kinds")


def same_text(table):
    """Which models have no row of their own, because their constraints are those of another one."""
    timed = {model_of(name) for name in bending(table)}
    springs = [model for model in registry.models() if registry.made_of(model) == "springs"
               and model not in timed]
    return (f"Springs of {', '.join(springs)} are projected like adaptive ones, discrete_shells like "
            "dihedral hinges.")


def panels(table):
    """Two panels with a line for every kind of constraint."""
    return plt.subplots(1, 2, figsize=(11.2, 1.5 + 0.36 * len(kinds(table))), layout="constrained",
                        sharey=True)


def dots(axes, table, value):
    """A line of dots per kind: colours are precisions, marks sizes. `value(row, time)` may be None."""
    names = kinds(table)
    shown = [(y, row) for y, name in enumerate(names) for scalar in COLOURS
             for row in sizes(table, name, scalar) if value(row, "ns_per_constraint")]
    marks = dict(zip(sorted({row["vertices"] for _, row in shown}), MARKERS))
    mark = lambda scalar, size: dict(ls="none", marker=marks[size], ms=6, color=COLOURS[scalar],
                                     mfc=COLOURS[scalar] if size == usual(table) else "white")
    for y, row in shown:
        middle, low, high = (value(row, time) for time in ("ns_per_constraint", "ns_lowest", "ns_highest"))
        aside = y + (-0.16 if row["scalar"] == "float" else 0.16)
        axes.hlines(aside, low, high, color=COLOURS[row["scalar"]], linewidth=1)
        axes.plot(middle, aside, **mark(row["scalar"], row["vertices"]))
    for scalar in COLOURS:
        for size in marks:
            if any(row["scalar"] == scalar and row["vertices"] == size for _, row in shown):
                axes.plot([], [], **mark(scalar, size), label=f"{PRECISION[scalar]}, {size:,} vertices")
    axes.set_yticks(range(len(names)), labels=[label(name) for name in names])
    axes.set_ylim(len(names) - 0.5, -0.5)


def springs_text(table):
    """How the number of adaptive springs depends on the size."""
    rows = sizes(table, "dense", "float")
    counts = [f"{row['constraints'] / row['vertices']:.0f} per vertex at {row['vertices']:,} vertices"
              for row in rows]
    return f" Adaptive springs are {' and '.join(counts)}." if counts else ""


def at_usual(table, names, scalar="float"):
    """The rows of these kinds at the usual size."""
    return [row for name in names for row in table.get((name, scalar), []) if row["vertices"] == usual(table)]


def title(table):
    rows = at_usual(table, bending(table))
    if len(rows) < 2:
        return "Time per constraint and per vertex"
    return (f"A bending constraint costs {to([row['ns_per_constraint'] for row in rows])} ns; all "
            f"constraints of a model cost {to([per_vertex(row) for row in rows])} ns per vertex\n(single "
            f"precision, {usual(table):,} vertices)")


def _table(table):
    rows = [[label(name), *columns(row), style.number(row["constraints"] / row["vertices"]),
             style.number(per_vertex(row))]
            for name in kinds(table) for scalar in COLOURS for row in sizes(table, name, scalar)]
    return Table("Kinds of constraints: ns per constraint and iteration",
                 ["constraint", *COLUMNS, "constraints per vertex", "ns per vertex"], rows)
