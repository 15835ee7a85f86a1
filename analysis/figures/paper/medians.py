"""Medians over seeds, as rows of tables. A metric is (name in the summary, offset, label)."""
from bendlab.results.load import statuses, summary_spread


def row(runs, metrics):
    """A row with the median, the smallest and the largest value of each metric, minus its offset."""
    entries = {"status": ", ".join(f"{count} {status}" for status, count in statuses(runs).items())
               or "missing"}
    for name, offset, _ in metrics:
        entries |= cells(name, summary_spread(runs, name) - offset)
    return entries


def cells(name, spread):
    """The values in a row for one Spread."""
    return {name: spread.median, f"{name}_low": spread.low, f"{name}_high": spread.high,
            f"{name}_range": (spread.low, spread.high)}


def columns(metrics):
    return [column for name, _, label in metrics
            for column in ((name, label), (f"{name}_range", "from – to"))]
