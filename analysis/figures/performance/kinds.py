"""The cost of each kind of constraint, per constraint and per vertex, and the speed of its code."""
from bendlab.results import registry
from figures.performance.rows import (PRECISION, STRAIN, at, bending, kinds, label, lacking, model_of,
                                      per_vertex, series, shown, table, usual)
from tables.numbers import span


def sizes(timed, name, scalar):
    """The rows of a kind of constraint at the usual size and at its largest size."""
    rows = timed.get((name, scalar), [])
    return [row for row in rows if row["vertices"] == usual(timed) or row is rows[-1]]


def command(timed):
    """The command that times all kinds of constraints and their oracles."""
    return f"./bendlab bench --filter '^({'|'.join(kinds(timed) or STRAIN)})(_oracle)?/'"


def rows_of(timed):
    """The rows of a page's table of all kinds of constraints."""
    return [shown(row) | {"kind": label(name), "size": f"{row['vertices']:,} vertices"}
            for name in kinds(timed) for scalar in PRECISION for row in sizes(timed, name, scalar)]


def main(bench, out, section):
    timed = series(bench["rows"])
    section.missing = lacking(timed, kinds(timed))
    section.commands = [command(timed)]
    if not bending(timed):
        section.missing.append("any kind of bending constraint")
    section.text += " " + springs_text(timed)
    section.add_chart(
        table("kinds", "Kinds of constraints", ["kind", "precision", "vertices", "ns", "range", "per_vertex",
                                                "vertex", "ratio", "share"], rows_of(timed)),
        title(timed), "kind", ["ns", "vertex"], ["precision", "size"], scale="band", y_scale="log", look="",
        note="Times of one iteration.")


def springs_text(timed):
    """Sentences: which models have no rows, because other models have the same constraints; how many adaptive
    springs a vertex has, depending on the size of the cloth."""
    own = {model_of(name) for name in bending(timed)}
    springs = ", ".join(model for model in registry.models()
                        if registry.made_of(model) == "springs" and model not in own)
    counts = ", ".join(f"{row['constraints'] / row['vertices']:.0f} at {row['vertices']:,} vertices"
                       for row in sizes(timed, "dense", "float"))
    return (f"Springs of {springs} are projected like adaptive springs, discrete_shells like dihedral "
            "hinges." + (f" Adaptive springs per vertex: {counts}." if counts else ""))


def title(timed):
    rows = at(timed, bending(timed), usual(timed))
    if len(rows) < 2:
        return "Time per constraint and per vertex"
    return (f"A bending constraint costs {span([row['ns_per_constraint'] for row in rows], 2)} ns. All "
            f"bending constraints of a model cost {span([per_vertex(row) for row in rows], 2)} ns per vertex "
            f"(single precision, {usual(timed):,} vertices)")
