"""Every bending model in two scenes: the hanging sheet of Fig. 5, and a clamped strip. For the matched runs
of the strip, the compliances of the models are chosen for one flexural rigidity.
"""
import re

import numpy as np

from bendlab.results.load import group, statuses, summary_spread
from draw import cloth
from figures.paper import medians
from runs.strips import elastica, model_name
from runs.sweeps import load_experiment
from tables.numbers import number
from tables.table import Table

# Mean strains. Below HOLDS a sheet counts as intact, above TORN as torn (more than twice as long).
HOLDS, TORN = 0.1, 1


def main(results, out, section):
    sheet = load_experiment(results, "models/hanging_sheet")
    strips = [load_experiment(results, f"models/{name}") for name in ("cantilever", "cantilever_rigidity")]
    section.text = sheet.settings["description"]
    grid = _grid(sheet)
    if section.uses(sheet):
        section.pictures.append((_sheet(*grid, out), f"{sheet_title(*grid)}. The pictures show the last "
                                 "frame of the seed nearest to the median. A row has one scale. The number "
                                 "in a picture is the mean strain, as median over the last second."))
    runs = [run for strip in strips for run in section.uses(strip)]
    section.tables += [_sheet_table(*grid), _strip_table(runs), *_profiles(runs)]
    section.add_chart(
        "models", "What a step of the hanging sheet costs", "name", ["strain", "bending", "rest"],
        id="models_cost", kind="bars",
        note="Cost of one step of 1/60 s on one thread, in ms: the minimum over seeds.")
    section.add_chart(
        "profiles", strip_title(runs), "distance", ["height"], id="models_cantilever", held=["stiffness"],
        at="compliance", scale="linear", y_scale="linear", theory="elastica",
        note=" ".join(dict.fromkeys(sentence for strip in strips
                                    for sentence in re.split(r"(?<=\.) ", strip.settings["description"]))))


def cost(runs):
    """ms per step for each pass, ns per projection of a bending constraint, and bending constraints per
    vertex. Times are minima over runs.

    The processor time of a run is divided among the passes in proportion to their wall times. Other programs
    disturb wall times more than processor times.
    """
    settings = runs[0].config["solver"]
    steps = runs[0].metrics["time"][-1] / settings["dt"]
    least = {name: min(_seconds(run, name) for run in runs) for name in ("strain", "bending", "rest")}
    count = runs[0].summary["bending_constraints"]
    projections = steps * settings["substeps"] * settings["iterations"] * count
    return {**{name: 1e3 * seconds / steps for name, seconds in least.items()},
            "ns": 1e9 * least["bending"] / projections if count else np.nan,
            "per_vertex": count / runs[0].summary["vertices"]}


def _seconds(run, name):
    """Processor time of a pass in s. The pass "rest" is a step without the projections."""
    apart = ("strain", "bending", "set_up", "recording")
    wall = sum(t for other, t in run.passes.items() if other == name or name == "rest" and other not in apart)
    return run.cpu_s * wall / sum(run.passes.values())


def _grid(experiment):
    """(substeps, models, {(model, substeps): runs}), in the order of the config."""
    by_place = group(experiment.runs, lambda run: (run.model, run.get("/solver/substeps")))
    substeps = [s for s in experiment.sweep["/solver/substeps"] if any(key[1] == s for key in by_place)]
    models = [m for m in experiment.sweep["/bending/model"] if any(key[0] == m for key in by_place)]
    return substeps, models, by_place


def _sheet(substeps, models, runs, out):
    """Pictures: a column for each model, and a row for each number of substeps."""
    rows = {}
    for s in substeps:
        groups = {model: runs.get((model, s), []) for model in models}
        rows[f"{s} substep{'s' if s > 1 else ''}"] = medians.panels(
            [(model_name(own_runs[0]) if own_runs else model, own_runs,
              f"strain {number(summary_spread(own_runs, 'mean_strain').median, 2)}")
             for model, own_runs in groups.items()], "mean_strain", aspect=0.45)
    return cloth.sheet(rows, out, "fig_models", inches=1.25, width=220)


def sheet_title(substeps, models, runs):
    """How many models keep the sheet intact, for each number of substeps."""
    lines = []
    for s in substeps:
        groups = [runs[model, s] for model in models if (model, s) in runs]
        strains = {model_name(own_runs[0]): summary_spread(own_runs, "mean_strain").median
                   for own_runs in groups}
        torn = [name for name, strain in strains.items() if not strain < TORN]
        held = sum(strain < HOLDS for strain in strains.values())
        lines.append(f"{'One substep' if s == 1 else f'{s} substeps'}: {held} of {len(strains)} models keep "
                     f"the mean strain below {100 * HOLDS:.0f} %; " +
                     (f"it exceeds 100 % with {', '.join(torn)}" if torn else "none exceeds 100 %"))
    return ". ".join(lines)


def _sheet_table(substeps, models, runs):
    metrics = [("mean_strain", "mean strain"), ("max_stretch", "max σ₁"), ("drop", "drop", "", "m")]
    rows = []
    for own_runs in [runs[model, s] for model in models for s in substeps if (model, s) in runs]:
        name, s = model_name(own_runs[0]), own_runs[0].get("/solver/substeps")
        rows.append({"model": name, "substeps": s, "name": f"{name}, {s}",
                     "status": medians.status_text(statuses(own_runs))}
                    | {metric: summary_spread(own_runs, metric).median for metric, *_ in metrics}
                    | cost(own_runs))
    return Table.of("models", "The hanging sheet at 64 cells: medians over seeds, but minima for times", [
        "model", "substeps", *metrics, ("per_vertex", "bending constraints per vertex", ".2f"),
        ("ns", "time per projection", "", "ns"), ("strain", "strain", "", "ms per step"),
        ("bending", "bending", "", "ms per step"), ("rest", "other", "", "ms per step"),
        ("status", "runs"), ("name", "model, substeps", "", "ms per step", "CPU time", False)], rows)


PROFILE = ["model", "stiffness", ("distance", "distance from the clamp", "", "cm"),
           ("height", "height", "", "cm")]


def profile(run):
    """(rows, 2) side view of the strip in m, in the last frame: mean distance from the clamp and mean height
    of each row."""
    positions = run.positions(-1)
    rows = np.unique(np.round(run.rest_positions[:, 0], 6), return_inverse=True)[1].ravel()
    line = np.array([positions[rows == row].mean(axis=0) for row in range(rows.max() + 1)])
    clamp = max(rows[run.pinned])
    return line[clamp:, [0, 2]] - line[clamp, [0, 2]]


def heavy_strip(weight, length, rigidity):
    """(points, 2) side view in m of a heavy strip that is clamped horizontally. `weight` in N/m²."""
    return length * elastica([weight * length**3 / rigidity])[:, :, 0] * [1, -1]


def _profiles(runs):
    """The tables of the chart of side views: the runs, and the heavy elastica."""
    rows = [{"model": run.model, "name": model_name(run), "stiffness": run.get("/bending/stiffness"),
             "distance": x, "height": z} for run in runs for x, z in 100 * profile(run)]
    truth = [{"model": "heavy elastica", "distance": x, "height": z} for x, z in 100 * _truth(runs)[::10]]
    return [Table.of("profiles", "", PROFILE, rows), Table.of("elastica", "", PROFILE, truth)]


def _truth(runs):
    """The elastica with the stiffness of the matched runs: the inverse of the compliance of discrete_shells.
    Empty without such a run."""
    run = next((run for run in runs if (run.get("/bending/stiffness"), run.model)
                == ("compliance", "discrete_shells")), None)
    if run is None:
        return np.empty((0, 2))
    x = np.unique(np.round(run.rest_positions[:, 0], 6))
    free = x[-1] - np.round(run.rest_positions[run.pinned, 0], 6).max()
    gravity = -run.config["effects"][0]["acceleration"][2]
    # The hinges on the edge of the clamp bend, too. So the effective clamp ends half a row before this edge.
    return heavy_strip(run.get("/material/density") * gravity, free + (x[1] - x[0]) / 2,
                       1 / run.get("/bending/compliance"))


def strip_title(runs):
    """The title: the heights of the tips with equal k, and with equal flexural rigidity (matched runs)."""
    tips = {kind: {model_name(run): 100 * profile(run)[-1] for run in own_runs}
            for kind, own_runs in group(runs, lambda run: run.get("/bending/stiffness")).items()}
    truth, lines = _truth(runs), []
    if "k" in tips:
        drops = {name: -tip[1] for name, tip in tips["k"].items()}
        low, high = min(drops, key=drops.get), max(drops, key=drops.get)
        lines.append(f"With equal k the tips hang between {drops[low]:.1f} cm ({low}) and "
                     f"{drops[high]:.1f} cm ({high}) below the clamp")
    if "compliance" in tips and len(truth):
        matched = np.array(list(tips["compliance"].values()))
        apart = np.linalg.norm(matched[:, None] - matched[None], axis=2).max()
        off = np.linalg.norm(matched - 100 * truth[-1], axis=1).max()
        lines.append(f"With equal rigidity the tips of {len(matched)} models lie within {apart:.1f} cm of "
                     f"each other and within {off:.1f} cm of the tip of the heavy elastica")
    return ". ".join(lines)


def _strip_table(runs):
    return Table.of("cantilever", "The clamped strip", [
        "model", "stiffness", "compliance", ("below", "tip below the clamp", ".2f", "cm"),
        ("from", "tip from the clamp", ".2f", "cm"), ("mean_strain", "mean strain")],
        [(model_name(run), run.get("/bending/stiffness"), run.point["/bending"].get("compliance"), -z, x,
          run.summary["mean_strain"]) for run in runs for x, z in [100 * profile(run)[-1]]])
