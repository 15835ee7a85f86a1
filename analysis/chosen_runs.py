"""Which runs of a page are played, and the sentence that says why these."""
import numpy as np

from bendlab.results.load import group

MOST = 8


def choose(sweeps, axes_of_sweep, wanted=(), most=MOST):
    """(runs, sentence). `wanted`: beginnings of ids, or texts that a run's folder contains. Without these at
    most `most` runs: of one axis every value, the others in the middle, and one that went wrong."""
    runs = [run for sweep in sweeps for run in sweep.runs if run.frames and run.file]
    if wanted:
        return _named(runs, wanted)
    if len(runs) <= most:
        return runs, ""
    if len(sweeps) > 1:
        return _of_each(sweeps, most)
    return _along_axes(runs, axes_of_sweep[0], most)


def _named(runs, wanted):
    found = []
    for text in wanted:
        some = [run for run in runs if run.id.startswith(text) or text in str(run.file.parent)]
        if not some:
            raise ValueError(f"--play {text}: no run with frames has an id that begins so, or a folder with "
                             f"that in its name. Their ids: {', '.join(run.id for run in runs[:20])}"
                             f"{' …' if len(runs) > 20 else ''}")
        found += [run for run in some if run not in found]
    return found, ""


def _of_each(sweeps, most):
    """The run in the middle of each sweep."""
    middle = [some[len(some) // 2] for sweep in sweeps
              if (some := [run for run in sweep.runs if run.frames and run.file])]
    places = np.unique(np.linspace(0, len(middle) - 1, most).round().astype(int))
    return [middle[i] for i in places], "One run of each sweep, in the middle of its list."


def _along_axes(runs, axes, most):
    broken = [run for run in runs if run.status in ("implausible", "diverged")]
    axes = [axis for axis in axes if not axis.is_seed]
    if not axes:
        return runs[:most], f"The first {most} runs."
    # Models first, then other names, then numbers.
    first = min(axes, key=lambda axis: (axis.models is None, axis.numeric, -len(axis.values)))
    others = [axis for axis in axes if axis is not first]
    # Of the places on the other axes, the one with most values of the first; of several the middle one.
    places = group(runs, lambda run: tuple(axis.place(run) for axis in others))
    filled = lambda some: len({first.place(run) for run in some})
    best = max(map(filled, places.values()))
    full = sorted((place for place, some in places.items() if filled(some) == best), key=_sortable)
    here = places[full[len(full) // 2]]
    at_first = sorted(group(here, first.place).items(), key=lambda entry: _sortable(entry[0]))
    one_each = [some[0] for _, some in at_first]
    room = most - (1 if broken and not any(run in broken for run in one_each) else 0)
    kept = [one_each[i] for i in np.unique(np.linspace(0, len(one_each) - 1, min(room, len(one_each))).round()
                                           .astype(int))]
    text = f"One run for {'every' if len(kept) == len(one_each) else 'some values of'} {first.label}"
    at = ", ".join(f"{axis.short} {axis.text(kept[0])}" for axis in others if axis.text(kept[0]))
    text += f", at {at}" if at else ""
    if room < most:
        kept.append(broken[0])
        text += f", and the first that is {broken[0].status}"
    return kept, text + "."


def _sortable(place):
    values = place if isinstance(place, tuple) else (place,)
    return tuple(-1 if value is None else value for value in values)
