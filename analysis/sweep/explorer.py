"""The data of the part of a report that shows all runs at once (its explorer)."""
from tables import looks

MOST_LOOKS = 24  # an axis with more values gives runs no colours
MOST_RUNS = 500  # a page with more runs has only the metrics of its charts


def explorer(report):
    """{axes, numbers, places, plain}: the axes of all sweeps, the names of the metrics, run id → index of the
    run's value on each axis, the style of runs without a colour."""
    by_pointer = {}
    for varied, _ in report.axes:
        for axis in varied:
            by_pointer.setdefault(axis.pointer, []).append(axis)
    axes = [_axis(pointer, same_axis) for pointer, same_axis in by_pointer.items()]
    # axes with names first, because the first axis has most room for names on its left
    axes.sort(key=lambda axis: axis["numbers"] is not None)
    places = {run.id: [_place(report, run, axis) for axis in axes] for run in report.runs}
    return {"axes": axes, "numbers": list(report.summary), "places": places, "plain": looks.of_place(0)}


def _axis(pointer, axes):
    """The axis of one setting, with the values from all sweeps that vary this setting, in order."""
    values = {text: value for axis in axes for text, value in zip(axis.texts, axis.values)}
    first = axes[0]
    numeric = all(axis.numeric for axis in axes)
    texts = sorted(values, key=values.get) if numeric else list(values)
    models = dict(pair for axis in axes if axis.models for pair in zip(axis.texts, axis.models))
    # the colours of models cannot tell apart two values that have the same model
    alone = len(set(models.values())) == len(values)
    look = lambda text, at: looks.of_model(models[text]) if alone else looks.of_place(at)
    return {"name": pointer, "label": first.short, "unit": first.unit, "meaning": first.meaning,
            "texts": texts, "numbers": [values[text] for text in texts] if numeric else None,
            "looks": [look(text, at) for at, text in enumerate(texts)] if len(texts) <= MOST_LOOKS else None}


def _place(report, run, axis):
    axes, _ = report.axes[report.sweep_of[run.id]]
    own = next((candidate for candidate in axes if candidate.pointer == axis["name"]), None)
    text = own.text(run) if own else ""
    return axis["texts"].index(text) if text else None
