"""Rows of `bendlab bench --json`, and how tables and charts show them."""
from collections import Counter

from tables.numbers import number
from bendlab.results import registry
from tables.table import Column, Table

# Constraints of the membrane: name in rows → name on the page.
STRAIN = {"strain": "strain triangles", "strain_angle": "strain triangles, shear as an angle"}
# Rows of bending have the names of models, except these: name in rows → (model, addition to its name).
RENAMED = {"dense": ("adaptive", ""), "choi_ko_compliance": ("choi_ko", " with compliance")}
PRECISION = {"float": "single", "double": "double"}
RANGE = "median of the repetitions, from lowest to highest"
# Columns of a timed row; see shown().
COLUMNS = {column.id: column for column in (
    Column("kind"), Column("precision"), Column("vertices", "vertices", ",d"), Column("threads"),
    Column("ns", "time per constraint and iteration", "", "ns", RANGE),
    Column("range", "lowest – highest", "", "ns"),
    Column("vertex", "time per vertex and iteration", "", "ns", RANGE),
    Column("per_vertex", "constraints per vertex"), Column("ratio", "times as fast as the oracle"),
    Column("share", "share of the roofline", "", "%"))}


def kind(row):
    """'strain_oracle' of the row strain_oracle/128, 'effect/wind' of effect/wind/100."""
    return row["name"].rpartition("/")[0]


def series(rows):
    """(kind, scalar) → timed rows of one thread, sorted by vertices."""
    timed = {}
    for row in rows:
        if row["threads"] == 1 and row["ns_per_constraint"] is not None:
            timed.setdefault((kind(row), row["scalar"]), []).append(row)
    return {key: sorted(same_kind, key=lambda row: row["vertices"]) for key, same_kind in timed.items()}


def model_of(name):
    """The bending model whose constraints are timed in the rows of this name; None for other rows."""
    model, _ = RENAMED.get(name, (name, ""))
    return model if model in registry.models() else None


def label(name):
    """The name of a kind of constraint on the page."""
    if name in STRAIN:
        return STRAIN[name]
    model, more = RENAMED.get(name, (name, ""))
    return f"{model} {'hinges' if registry.made_of(model) == 'hinges' else 'springs'}{more}"


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
    """ns per vertex and iteration (of an effect per step, of a solve per solve). `time`: the key of the
    median, lowest or highest time."""
    return row[time] * row["constraints"] / row["vertices"]


def iterations(rows):
    """How many iterations a step of the rows has, from its time; None without a row of a step."""
    for row in rows:
        if kind(row) == "step":
            return round(1e6 * row["step_ms"] / (row["ns_per_constraint"] * row["constraints"]))
    return None


def lacking(table, names):
    """A line for each precision in which kinds have no row at all."""
    return [f"{PRECISION[scalar]} precision: {', '.join(absent)}" for scalar in PRECISION
            if (absent := [label(name) for name in names if (name, scalar) not in table])]


def to(values, digits=2):
    """'1.3 to 8.4', or one number where both are alike."""
    low, high = (number(value, digits) for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def shown(row):
    """A row of the benchmark as a row of tables."""
    values = {"precision": PRECISION[row["scalar"]], "vertices": row["vertices"], "threads": row["threads"],
              "range": (row["ns_lowest"], row["ns_highest"]),
              "per_vertex": row["constraints"] / row["vertices"],
              "ratio": row["ratio_to_oracle"],
              "share": row["roofline_fraction"] and 100 * row["roofline_fraction"]}
    for end, time in (("", "ns_per_constraint"), ("_low", "ns_lowest"), ("_high", "ns_highest")):
        values |= {f"ns{end}": row[time], f"vertex{end}": per_vertex(row, time)}
    return values


def table(id, caption, columns, rows):
    """A table of shown() rows. `columns`: ids of entries of COLUMNS, or columns as Table.of() takes them."""
    return Table.of(id, caption, [COLUMNS.get(column, column) if isinstance(column, str) else column
                                  for column in columns], rows)
