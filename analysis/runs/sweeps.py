"""The runs of a config and its missing runs, from the sweep file that `bendlab run` writes beside them."""
import copy
import itertools
import json
import sys
from dataclasses import dataclass
from pathlib import Path

from bendlab.results import registry
from bendlab.results.load import Indices, Run, load_if_begun

CONFIGS = Path(__file__).resolve().parents[2] / "configs"


@dataclass
class Experiment:
    """The runs of one config: those that exist, and those that are missing."""

    config: str  # file below configs/, as in "paper/fig5"
    settings: dict  # the config as written
    sweep: dict  # JSON pointer → values
    runs: list  # in the order of the sweep
    missing: list  # points of the sweep without a finished run, as text
    absent: str = ""  # why the config as it is written has no runs

    @property
    def missing_text(self):
        return "; ".join(filter(None, [self.absent, _listed(self.missing) if self.missing else ""]))

    @property
    def command(self):
        return f"./bendlab run configs/{self.config}.json"


def load_experiment(results, config):
    """The runs of configs/<config>.json below `results`, and the points of its sweep that have no run.
    `bendlab run` lists the runs in <config>.sweep.json in the same folder. If there are only trials of the
    config (runs with --set), the newest trial is loaded, and `absent` states this."""
    settings = read_config(config)
    folder = Path(results) / settings["name"]
    axes = settings.get("sweep", {})
    experiment = Experiment(config, settings, axes, [], [])
    file = _sweep_file(folder, Path(config).name)
    if not file:
        experiment.absent = "none of its runs"
        return experiment
    sweep = json.loads(file.read_text(encoding="utf-8"))
    if sweep["overrides"]:
        experiment.absent = f"only runs of a trial with --set {' --set '.join(sweep['overrides'])}"
    elif not (_same_runs(settings, sweep["settings"]) and _same_axes(axes, sweep["axes"])):
        experiment.absent = "none of its runs, because the config was changed after it was run"
        return experiment
    registry.learn(sweep["models"], sweep.get("methods", {}))
    experiment.sweep = sweep["axes"]
    indices = Indices(folder)
    for entry in sweep["runs"]:
        run = load_if_begun(file_in(folder / entry["folder"]), indices) if entry["folder"] else None
        if run and run.id != entry["id"]:
            print(f"left out: {run.file} is the file of another run, {run.id}", file=sys.stderr)
            run = None
        if run:
            run.point, run.experiment = entry["point"], config
            experiment.runs.append(run)
        if not run or not run.over:
            experiment.missing.append(_point_text(entry["point"]))
    indices.write()
    return experiment


def _point_text(point):
    """The settings of a point, each by its pointer: "/mesh/cells 8, /bending/model dkt"."""
    def settings(pointer, value):
        if isinstance(value, dict):
            return [text for name, inner in value.items() for text in settings(f"{pointer}/{name}", inner)]
        return [f"{pointer} {value:.6g}" if isinstance(value, float) else f"{pointer} {value}"]
    return ", ".join(text for pointer, value in point.items() for text in settings(pointer, value))


def _listed(points):
    """How many runs these points are, and the first three points."""
    runs = "1 run" if len(points) == 1 else f"{len(points)} runs, first"
    return f"{runs} {'; '.join(points[:3])}{' …' if len(points) > 3 else ''}"


def complete_runs(section, experiment):
    """The complete runs of an experiment. The section names the config, and its missing and diverged runs."""
    runs = section.uses(experiment)
    leave_out(section, [run for run in runs if run.status == "diverged"], "diverged")
    return [run for run in runs if run.complete]


def leave_out(section, runs, why):
    """Adds to the section the runs of one config that it leaves out, and why, in a few words."""
    if runs:
        points = [_point_text(run.point) for run in runs]
        section.missing.append(f"configs/{runs[0].experiment}.json: {why}: {_listed(points)}")


def used_runs(section, results, *configs):
    """The runs of these configs. The section names the configs, except those that only --full computes."""
    runs = []
    for config in configs:
        experiment = load_experiment(results, config)
        runs += experiment.runs if config.endswith("_full") else section.uses(experiment)
    return runs


def read_config(config):
    """configs/<config>.json as it is written."""
    return json.loads((CONFIGS / f"{config}.json").read_text(encoding="utf-8"))


def planned_points(settings, axes):
    """Every point on these axes (pointer → value), in the order of the program. The point of a run has no
    settings of bending models that the run does not use."""
    points = {}
    for values in itertools.product(*axes.values()):
        point = dict(zip(axes, values))
        model = point.get("/bending/model") or point.get("/bending", settings.get("bending"))["model"]
        point = {pointer: value for pointer, value in point.items() if pointer.count("/") < 3
                 or not pointer.startswith("/bending/") or pointer.startswith(f"/bending/{model}/")}
        points.setdefault(point_key(point), point)
    return list(points.values())


def point_key(point):
    """A text that is the same for equal points, where 0 equals 0.0."""
    return json.dumps(json.loads(json.dumps(point), parse_int=float), sort_keys=True)


def planned_runs(experiment):
    """Every run of an experiment's config, in the order of its sweep. A missing run has the status "missing"
    and only the settings that the config states. Runs of a trial (--set) count as missing."""
    existing = {} if experiment.absent else {point_key(run.point): run for run in experiment.runs}
    return [existing.get(point_key(point)) or missing_run(experiment.config, point)
            for point in planned_points(experiment.settings, experiment.settings["sweep"])]


def missing_run(config, point):
    settings = settings_at(read_config(config), point)
    return Run(file=None, id="", name=settings["name"], status="missing", config=settings, summary={},
               metrics={}, point=point, experiment=config)


def settings_at(settings, point):
    """A copy of a config as it is written, with the values of a point of its sweep."""
    settings = copy.deepcopy(settings)
    for pointer, value in point.items():
        *path, last = pointer.split("/")[1:]
        node = settings
        for key in path:
            node = node[int(key)] if isinstance(node, list) else node.setdefault(key, {})
        node[int(last) if isinstance(node, list) else last] = copy.deepcopy(value)
    return settings


def is_number(value):
    """Whether a value of JSON is a number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _sweep_file(folder, name):
    """The sweep file of a config, or else of the config's newest trial (--set), or None."""
    file = folder / f"{name}.sweep.json"
    if file.exists():
        return file
    return max(folder.glob(f"{name},*.sweep.json"), key=lambda trial: trial.stat().st_mtime, default=None)


def file_in(folder):
    """The finished run file of a run's folder, or else the newest unfinished file."""
    whole = folder / "run.vtkhdf"
    parts = folder.glob("run.vtkhdf*.part")
    return whole if whole.exists() else max(parts, key=lambda part: part.stat().st_mtime, default=whole)


def _same_runs(written, computed):
    """Whether the config as written has the same settings as the config of the computed runs, without the
    axes (_same_axes). The computed config lists effects even if the written config has none."""
    beside = ("description", "sweep", "expect", "allow", "cover", "because", "$schema")
    decides = lambda settings: {key: value for key, value in settings.items()
                                if key not in beside and (key != "effects" or key in written)}
    return decides(written) == decides(computed)


def _same_axes(written, axes):
    """Whether the axes in a config are the axes of the runs. "all" means every choice of a setting."""
    return list(written) == list(axes) and all(written[pointer] in ("all", axes[pointer]) for pointer in axes)
