"""Medians over seeds, as rows of tables and as pictures. A metric is (name in the summary, offset, label)."""
from bendlab.results.load import statuses, summary_spread, typical_run
from draw import cloth
from tables.numbers import number


def row(runs, metrics):
    """A row with the median, the smallest and the largest value of each metric, minus its offset."""
    entries = {"status": status_text(statuses(runs)) or "missing"}
    for name, offset, _ in metrics:
        entries |= cells(name, summary_spread(runs, name) - offset)
    return entries


def status_text(counts):
    return ", ".join(f"{count} {status}" for status, count in counts.items())


def cells(name, spread):
    """The values in a row for one Spread."""
    return {name: spread.median, f"{name}_low": spread.low, f"{name}_high": spread.high,
            f"{name}_range": (spread.low, spread.high)}


def names(metrics):
    return [name for name, *_ in metrics]


def columns(metrics):
    return [column for name, _, label in metrics
            for column in ((name, label), (f"{name}_range", "from – to"))]


def panels(pictures, metric="pin_max_stretch", **how):
    """A panel for each of the pictures (title, runs, text): the run nearest to the median of a metric. All
    panels have one scale. `how`: arguments for the cameras."""
    samples = [typical_run(runs, metric) for _, runs, _ in pictures]
    return [cloth.Panel(sample, camera, title, text) for (title, _, text), sample, camera
            in zip(pictures, samples, cloth.cameras_of(samples, **how))]


def pin_text(sample, place="pin: "):
    """The stretch at the pin in a sample (run, frame), as text; "" without a run."""
    if not sample:
        return ""
    run, frame = sample
    return f"{place}σ₁ − 1 = {number(run.metrics['pin_max_stretch'][frame] - 1)}"
