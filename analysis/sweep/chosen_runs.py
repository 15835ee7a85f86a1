"""The runs that a page plays, and a sentence on how these runs were chosen."""
from bendlab.results.load import group
from tables.numbers import evenly

MOST = 8


def choose(sweeps, axes_of_sweep, wanted=()):
    """(runs, sentence). `wanted`: beginnings of ids, or parts of folder names. If `wanted` is empty, at most
    MOST runs are chosen: one for each value of one axis, with the finest mesh and middle values of all
    other axes, and the first run that is implausible or diverged."""
    runs = with_frames(run for sweep in sweeps for run in sweep.runs)
    if wanted:
        return _named(runs, wanted)
    if len(runs) <= MOST:
        return runs, ""
    if len(sweeps) > 1:
        middle = [own[len(own) // 2] for sweep in sweeps if (own := with_frames(sweep.runs))]
        chosen = [middle[i] for i in evenly(len(middle), MOST)]
        return chosen, "One run of each sweep, the run in the middle of the sweep's list."
    return _along_axes(runs, axes_of_sweep[0])


def with_frames(runs):
    return [run for run in runs if run.frames and run.file]


def offered(runs, chosen):
    """The runs that could also be played; runs on fine meshes come first."""
    rest = [run for run in with_frames(runs) if run not in chosen]
    return sorted(rest, key=lambda run: -run.summary.get("vertices", 0))


def _named(runs, wanted):
    named = []
    for text in wanted:
        matching = [run for run in runs if run.id.startswith(text) or text in str(run.file.parent)]
        if not matching:
            raise ValueError(f"--play {text}: no run with frames has an id that begins with this text, or a "
                             "folder whose name contains it. Ids of the runs: "
                             f"{', '.join(run.id for run in runs[:20])}{' …' if len(runs) > 20 else ''}")
        named += [run for run in matching if run not in named]
    return named, ""


def _along_axes(runs, axes):
    axes = [axis for axis in axes if not axis.is_seed]
    if not axes:
        return runs[:MOST], f"The first {MOST} runs."
    # Axes of models first, then axes of names, then axes of numbers.
    first = min(axes, key=lambda axis: (axis.models is None, axis.numeric, -len(axis.values)))
    other_axes = [axis for axis in axes if axis is not first]
    # Values of other_axes for which as many values of the first axis as possible have runs. Ties go to the
    # finest mesh, then to the middle.
    places = group(runs, lambda run: tuple(axis.place(run) for axis in other_axes))
    vertices = lambda run: run.summary.get("vertices", 0)
    rank = lambda place: (len(set(map(first.place, places[place]))), max(map(vertices, places[place])))
    best = max(map(rank, places))
    full = sorted((place for place in places if rank(place) == best), key=_sortable)
    here = sorted(places[full[len(full) // 2]], key=lambda run: _sortable([first.place(run)]))
    one_each = [same_value[0] for same_value in group(here, first.place).values()]
    broken = [run for run in runs if run.status in ("implausible", "diverged")]
    added = [] if any(run in broken for run in one_each) else broken[:1]
    kept = [one_each[i] for i in evenly(len(one_each), MOST - len(added))]
    text = f"One run for {'every' if len(kept) == len(one_each) else 'some values of'} {first.label}"
    at = ", ".join(f"{axis.short} {axis.text(kept[0])}" for axis in other_axes if axis.text(kept[0]))
    text += f", at {at}" if at else ""
    text += "".join(f", and the first run that is {run.status}" for run in added)
    return kept + added, text + "."


def _sortable(places):
    """Indices of values as a key for sorting; None comes first."""
    return [-1 if place is None else place for place in places]
