"""The rows of the benchmark (measured.py), and their form in tables and charts."""
from collections import Counter

from bendlab.results import registry
from bendlab.results.load import group
from tables.table import Column, Table

# Constraints of the membrane: name in the benchmark → name on the page.
STRAIN = {"strain": "strain triangles", "strain_angle": "strain triangles, shear as an angle"}
# A row of bending has the name of its model, except: name in the benchmark → (model, text after its name).
RENAMED = {"dense": ("adaptive", ""), "choi_ko_compliance": ("choi_ko", " with compliance")}
PRECISION = {"float": "single", "double": "double"}
RANGE = "median of the repetitions; the range is lowest to highest"
# Columns for rows from shown().
COLUMNS = {column.id: column for column in (
    Column("vertices", "vertices", ",d"),
    Column("ns", "time per constraint and iteration", "", "ns", RANGE),
    Column("range", "lowest – highest", "", "ns"),
    Column("vertex", "time per vertex and iteration", "", "ns", RANGE),
    Column("per_vertex", "constraints per vertex"), Column("ratio", "times as fast as the oracle"),
    Column("share", "share of the roofline", "", "%"))}


def kind(row):
    """The name of a row without the size at its end: effect/wind for effect/wind/100."""
    return row["name"].rpartition("/")[0]


def first(rows, kind_name, **values):
    """The first row of this kind that has these values, or None."""
    return next((row for row in rows if kind(row) == kind_name and values.items() <= row.items()), None)


def series(rows):
    """(kind, "float" or "double") → timed rows on one thread, sorted by number of vertices."""
    timed = [row for row in rows if row["threads"] == 1]
    return {key: sorted(same_kind, key=lambda row: row["vertices"])
            for key, same_kind in group(timed, lambda row: (kind(row), row["scalar"])).items()}


def model_of(name):
    """The bending model whose constraints the rows of this kind time; None if the rows time no bending."""
    model, _ = RENAMED.get(name, (name, ""))
    return model if model in registry.models() else None


def label(name):
    """The page's name for a kind of constraint."""
    model, more = RENAMED.get(name, (name, ""))
    springs = " springs" if registry.made_of(model) == "springs" else ""
    return STRAIN.get(name, f"{model}{springs}{more}")


def bending(table):
    """The kinds of bending constraints that are timed, in the order of the rows."""
    return list(dict.fromkeys(name for name, _ in table if model_of(name)))


def kinds(table):
    """All kinds of constraints that are timed: first the membrane, then bending."""
    return [*(name for name in STRAIN if any((name, scalar) in table for scalar in PRECISION)),
            *bending(table)]


def at(table, names, vertices):
    """The rows of these kinds in single precision with this number of vertices."""
    return [row for name in names for row in table.get((name, "float"), []) if row["vertices"] == vertices]


def usual(table):
    """The number of vertices at which most kinds of constraints are timed; None if no kind is timed."""
    timed = kinds(table)
    sizes = Counter(row["vertices"] for (name, _), rows in table.items() if name in timed for row in rows)
    return max(sizes, key=lambda size: (sizes[size], -size), default=None)


def per_vertex(row, time="ns_per_constraint"):
    """Time per vertex and iteration in ns (for an effect per step, for a linear solve per solve). `time`: the
    key of the median, lowest or highest time."""
    return row[time] * row["constraints"] / row["vertices"]


def whole_step(rows, scalar="float"):
    """The benchmark's row of a step on one thread, or None."""
    return first(rows, "step", scalar=scalar, threads=1)


def iterations(rows):
    """Number of iterations in a step, computed from the times of a step; None if no step was timed."""
    step = first(rows, "step")
    return step and round(1e6 * step["call_ms"] / (step["ns_per_constraint"] * step["constraints"]))


def lacking(table, names, label_of=label, scalars=PRECISION):
    """The kinds in `names` that were not timed, as a line for each precision."""
    return [f"{PRECISION[scalar]} precision: {', '.join(absent)}" for scalar in scalars
            if (absent := [label_of(name) for name in names if (name, scalar) not in table])]


def shown(row):
    """A row of the benchmark as a row of a page's table."""
    values = {"precision": PRECISION[row["scalar"]], "vertices": row["vertices"], "threads": row["threads"],
              "range": (row["ns_lowest"], row["ns_highest"]),
              "per_vertex": row["constraints"] / row["vertices"], "ratio": row["ratio_to_oracle"],
              "share": row["roofline_fraction"] and 100 * row["roofline_fraction"]}
    for end, time in (("", "ns_per_constraint"), ("_low", "ns_lowest"), ("_high", "ns_highest")):
        values |= {f"ns{end}": row[time], f"vertex{end}": per_vertex(row, time)}
    return values


def table(id, caption, columns, rows):
    """A table of shown() rows. A column is an id in COLUMNS, or a column of Table.of()."""
    return Table.of(id, caption, [COLUMNS.get(column, column) for column in columns], rows)
