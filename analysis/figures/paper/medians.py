"""Medians over seeds as rows of tables. A metric is (name in a summary, offset, label)."""
from bendlab.results.load import statuses, summary_spread


def row(runs, metrics):
    """The median of each metric over the runs, minus its offset, with the smallest and largest value."""
    entries = {"status": ", ".join(f"{count} {status}" for status, count in statuses(runs).items())
               or "missing"}
    for name, offset, _ in metrics:
        entries |= cells(name, summary_spread(runs, name) - offset)
    return entries


def cells(name, spread):
    """A Spread as the cells of a row."""
    return {name: spread.median, f"{name}_low": spread.low, f"{name}_high": spread.high,
            f"{name}_range": (spread.low, spread.high)}


def columns(metrics):
    """The columns of row()."""
    return [column for name, _, label in metrics
            for column in ((name, label), (f"{name}_range", "from – to"))]
