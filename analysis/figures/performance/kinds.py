"""The cost of each kind of constraint, per constraint and per vertex, and the speed of its code. The usual
size is the number of vertices for which most kinds are timed.
"""
from bendlab.results import registry
from figures.performance.rows import (PRECISION, STRAIN, bending, kinds, label, lacking, model_of, per_vertex,
                                      series, shown, table, to, usual)
from tables.chart import Chart


def sizes(timed, name, scalar):
    """The rows of a kind of constraint at the usual size and at its largest size."""
    rows = timed.get((name, scalar), [])
    return [row for row in rows if row["vertices"] == usual(timed) or row is rows[-1]]


def main(bench, out, section):
    timed = series(bench["rows"])
    section.missing = lacking(timed, kinds(timed))
    section.commands = [f"./bendlab bench --filter '^({'|'.join(kinds(timed) or STRAIN)})/'"]
    if not bending(timed):
        section.missing.append("any kind of bending constraint")
    section.text += " " + same_text(timed) + springs_text(timed)
    rows = [shown(row) | {"kind": label(name), "size": f"{row['vertices']:,} "
                                                       f"vertices"} for name in kinds(timed)
            for scalar in PRECISION for row in sizes(timed, name, scalar)]
    section.tables.append(table("kinds", "Kinds of constraints", [
        "kind", "precision", "vertices", "ns", "range", "per_vertex", "vertex", "ratio", "share"], rows))
    section.charts.append(Chart("kinds", title(timed), "kinds", "kind", ["ns", "vertex"],
                                ["precision", "size"],
                                scale="band", y_scale="log", look="", note="Times of one iteration."))


def same_text(timed):
    """Sentences: which models have no rows, because other models have the same constraints."""
    own = {model_of(name) for name in bending(timed)}
    springs = [model for model in registry.models() if registry.made_of(model) == "springs"
               and model not in own]
    return (f"Springs of {', '.join(springs)} are projected like adaptive springs, discrete_shells like "
            "dihedral hinges.")


def springs_text(timed):
    """A sentence: how many adaptive springs a vertex has, depending on the size of the cloth."""
    rows = sizes(timed, "dense", "float")
    counts = [f"{row['constraints'] / row['vertices']:.0f} at {row['vertices']:,} vertices" for row in rows]
    return f" Adaptive springs per vertex: {', '.join(counts)}." if counts else ""


def at_usual(timed, names, scalar="float"):
    return [row for name in names for row in timed.get((name, scalar), []) if row["vertices"] == usual(timed)]


def title(timed):
    rows = at_usual(timed, bending(timed))
    if len(rows) < 2:
        return "Time per constraint and per vertex"
    return (f"A bending constraint costs {to([row['ns_per_constraint'] for row in rows])} ns. All bending "
            f"constraints of a model cost {to([per_vertex(row) for row in rows])} ns per vertex (single "
            f"precision, {usual(timed):,} vertices)")
