"""The rows (measurements) of `bendlab bench --json`, and their form in tables and charts."""
from collections import Counter

from tables.numbers import number
from bendlab.results import registry
from tables.table import Column, Table

# Constraints of the membrane: name in the benchmark → name on the page.
STRAIN = {"strain": "strain triangles", "strain_angle": "strain triangles, shear as an angle"}
# A row of bending has the name of its model, except: name in the benchmark → (model, text after its name).
RENAMED = {"dense": ("adaptive", ""), "choi_ko_compliance": ("choi_ko", " with compliance")}
PRECISION = {"float": "single", "double": "double"}
RANGE = "median of the repetitions; the range is lowest to highest"
# Columns for rows from shown().
COLUMNS = {column.id: column for column in (
    Column("kind"), Column("precision"), Column("vertices", "vertices", ",d"), Column("threads"),
    Column("ns", "time per constraint and iteration", "", "ns", RANGE),
    Column("range", "lowest – highest", "", "ns"),
    Column("vertex", "time per vertex and iteration", "", "ns", RANGE),
    Column("per_vertex", "constraints per vertex"), Column("ratio", "times as fast as the oracle"),
    Column("share", "share of the roofline", "", "%"))}


def kind(row):
    """The name of a row without the size at its end: effect/wind for effect/wind/100."""
    return row["name"].rpartition("/")[0]


def series(rows):
    """(kind, "float" or "double") → timed rows on one thread, sorted by number of vertices."""
    timed = {}
    for row in rows:
        if row["threads"] == 1 and row["ns_per_constraint"] is not None:
            timed.setdefault((kind(row), row["scalar"]), []).append(row)
    return {key: sorted(same_kind, key=lambda row: row["vertices"]) for key, same_kind in timed.items()}


def model_of(name):
    """The bending model whose constraints the rows of this kind time; None if the rows time no bending."""
    model, _ = RENAMED.get(name, (name, ""))
    return model if model in registry.models() else None


def label(name):
    """The page's name for a kind of constraint."""
    if name in STRAIN:
        return STRAIN[name]
    model, more = RENAMED.get(name, (name, ""))
    return f"{model} {'hinges' if registry.made_of(model) == 'hinges' else 'springs'}{more}"


def bending(table):
    """The kinds of bending constraints that are timed, in the order of the rows."""
    return list(dict.fromkeys(name for name, _ in table if model_of(name)))


def kinds(table):
    """All kinds of constraints that are timed: first the membrane, then bending."""
    return [*(name for name in STRAIN if any((name, scalar) in table for scalar in PRECISION)),
            *bending(table)]


def at(table, name, scalar, vertices):
    """The row of this kind with this number of vertices, or None."""
    return next((row for row in table.get((name, scalar), []) if row["vertices"] == vertices), None)


def usual(table):
    """The number of vertices at which most kinds of constraints are timed; None if no kind is timed."""
    timed = kinds(table)
    sizes = Counter(row["vertices"] for (name, _), rows in table.items() if name in timed for row in rows)
    return max(sizes, key=lambda size: (sizes[size], -size), default=None)


def per_vertex(row, time="ns_per_constraint"):
    """Time per vertex and iteration in ns (for an effect per step, for a linear solve per solve). `time`: the
    key of the median, lowest or highest time."""
    return row[time] * row["constraints"] / row["vertices"]


def iterations(rows):
    """Number of iterations in a step, computed from the times of a step; None if no step was timed."""
    for row in rows:
        if kind(row) == "step":
            return round(1e6 * row["step_ms"] / (row["ns_per_constraint"] * row["constraints"]))
    return None


def lacking(table, names):
    """The kinds in `names` that were not timed, as a line for each precision."""
    return [f"{PRECISION[scalar]} precision: {', '.join(absent)}" for scalar in PRECISION
            if (absent := [label(name) for name in names if (name, scalar) not in table])]


def to(values, digits=2):
    """The range as text, '1.3 to 8.4'; one number if both ends round to the same number."""
    low, high = (number(value, digits) for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def shown(row):
    """A row of the benchmark as a row of a page's table."""
    values = {"precision": PRECISION[row["scalar"]], "vertices": row["vertices"], "threads": row["threads"],
              "range": (row["ns_lowest"], row["ns_highest"]),
              "per_vertex": row["constraints"] / row["vertices"],
              "ratio": row["ratio_to_oracle"],
              "share": row["roofline_fraction"] and 100 * row["roofline_fraction"]}
    for end, time in (("", "ns_per_constraint"), ("_low", "ns_lowest"), ("_high", "ns_highest")):
        values |= {f"ns{end}": row[time], f"vertex{end}": per_vertex(row, time)}
    return values


def table(id, caption, columns, rows):
    """A table of shown() rows. A column is an id in COLUMNS, or a column of Table.of()."""
    return Table.of(id, caption, [COLUMNS.get(column, column) if isinstance(column, str) else column
                                  for column in columns], rows)
