"""The commands that compute given runs again."""
import json
import shlex

from bendlab.results.load import group
from runs.sweeps import planned_points, point_key, read_config


def commands(runs):
    """The fewest `bendlab run` commands that compute exactly these runs."""
    lines = []
    for config, own_runs in group(runs, lambda run: run.experiment).items():
        settings = read_config(config)
        for chosen in _chosen_axes(settings, [run.point for run in own_runs]):
            lines.append(" ".join([f"./bendlab run configs/{config}.json",
                                   *_changes(settings["sweep"], chosen)]))
    return lines


def command(config, point, axes=None, overrides=()):
    """The `bendlab run` command of a run, from the config's path, point of the sweep, and `--set` texts."""
    chosen = {pointer: [value] for pointer, value in point.items()}
    options = [f"--set {shlex.quote(text)}" for text in overrides if text.partition("=")[0] not in chosen]
    return " ".join(["./bendlab run", shlex.quote(str(config)), *options, *_changes(axes or chosen, chosen)])


def runs_of(line):
    """(config below configs/, points of its sweep) of the runs that a command computes."""
    words = shlex.split(line)
    config = words[2].removeprefix("configs/").removesuffix(".json")
    settings = read_config(config)
    axes = dict(settings.get("sweep", {}))
    for option, text in zip(words[3::2], words[4::2]):
        pointer, _, value = text.partition("=")
        values = _value(value)
        if option == "--set" and pointer in axes:
            axes[pointer] = values if isinstance(values, list) and values not in axes[pointer] else [values]
    return config, planned_points(settings, axes)


def _value(text):
    try:
        return json.loads(text)
    except ValueError:
        return text


def _chosen_axes(settings, points):
    """The fewest sweeps that have exactly these points: list of pointer → values. The axes are narrowed to
    the values that the points use. If the narrowed axes have further points, the wanted points are divided by
    their values on one axis, which is the axis that leads to the fewest sweeps."""
    wanted = {point_key(point) for point in points}
    narrow = {pointer: _used(pointer, values, points) for pointer, values in settings["sweep"].items()}
    if {point_key(point) for point in planned_points(settings, narrow)} == wanted:
        return [narrow]
    divided = []
    for pointer, values in narrow.items():
        parts = group(points, lambda point: point_key(point.get(pointer, values[0]))).values()
        if len(parts) > 1:
            divided.append([sweep for part in parts for sweep in _chosen_axes(settings, part)])
    return min(divided, key=len)


def _used(pointer, values, points):
    """The values of an axis that these points have; all of its values if the points do not have this axis."""
    used = {point_key(point[pointer]) for point in points if pointer in point}
    return [value for value in values if point_key(value) in used] or values


def _changes(axes, chosen):
    """Options that narrow a config's axes to the chosen values."""
    for pointer, values in chosen.items():
        if values != axes[pointer]:
            value = values[0] if len(values) == 1 else values
            text = f"{pointer}={value if isinstance(value, str) else json.dumps(value)}"
            quoted = shlex.quote(text) if "'" in text else f"'{text}'"  # always in quotes
            yield f"--set {quoted}"
