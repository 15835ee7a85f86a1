"""The runs that a page plays, and a sentence on how these runs were chosen."""
import numpy as np

from bendlab.results.load import group

MOST = 8


def choose(sweeps, axes_of_sweep, wanted=(), most=MOST):
    """(runs, sentence). `wanted`: beginnings of ids, or parts of folder names. If `wanted` is empty, at most
    `most` runs are chosen: one for each value of one axis, with the finest mesh and middle values of all
    other axes, and the first run that is implausible or diverged."""
    runs = [run for sweep in sweeps for run in sweep.runs if run.frames and run.file]
    if wanted:
        return _named(runs, wanted)
    if len(runs) <= most:
        return runs, ""
    if len(sweeps) > 1:
        return _of_each(sweeps, most)
    return _along_axes(runs, axes_of_sweep[0], most)


def offered(runs, chosen):
    """The runs that could also be played; runs on fine meshes come first."""
    rest = [run for run in runs if run.frames and run.file and run not in chosen]
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


def _of_each(sweeps, most):
    """The run in the middle of each sweep."""
    middle = [runs[len(runs) // 2] for sweep in sweeps
              if (runs := [run for run in sweep.runs if run.frames and run.file])]
    places = np.unique(np.linspace(0, len(middle) - 1, most).round().astype(int))
    return [middle[i] for i in places], "One run of each sweep, the run in the middle of the sweep's list."


def _along_axes(runs, axes, most):
    broken = [run for run in runs if run.status in ("implausible", "diverged")]
    axes = [axis for axis in axes if not axis.is_seed]
    if not axes:
        return runs[:most], f"The first {most} runs."
    # Axes of models first, then axes of names, then axes of numbers.
    first = min(axes, key=lambda axis: (axis.models is None, axis.numeric, -len(axis.values)))
    other_axes = [axis for axis in axes if axis is not first]
    # Values of other_axes for which as many values of the first axis as possible have runs. Ties go to the
    # finest mesh, then to the middle.
    places = group(runs, lambda run: tuple(axis.place(run) for axis in other_axes))
    filled = lambda place: len({first.place(run) for run in places[place]})
    best = max(map(filled, places))
    full = [place for place in places if filled(place) == best]
    vertices = lambda place: max(run.summary.get("vertices", 0) for run in places[place])
    finest = max(map(vertices, full))
    full = sorted((place for place in full if vertices(place) == finest), key=_sortable)
    here = places[full[len(full) // 2]]
    at_first = sorted(group(here, first.place).items(), key=lambda entry: _sortable(entry[0]))
    one_each = [same_value[0] for _, same_value in at_first]
    room = most - (1 if broken and not any(run in broken for run in one_each) else 0)
    kept = [one_each[i] for i in np.unique(np.linspace(0, len(one_each) - 1, min(room, len(one_each))).round()
                                           .astype(int))]
    text = f"One run for {'every' if len(kept) == len(one_each) else 'some values of'} {first.label}"
    at = ", ".join(f"{axis.short} {axis.text(kept[0])}" for axis in other_axes if axis.text(kept[0]))
    text += f", at {at}" if at else ""
    if room < most:
        kept.append(broken[0])
        text += f", and the first run that is {broken[0].status}"
    return kept, text + "."


def _sortable(place):
    values = place if isinstance(place, tuple) else (place,)
    return tuple(-1 if value is None else value for value in values)
