"""Every bending model in two scenes: the hanging sheet of Fig. 5, and a clamped strip. For the matched runs
of the strip, the compliances of the models are chosen for one flexural rigidity.
"""
import numpy as np

from draw import cloth
from tables.numbers import number
from tables import looks
from bendlab.results.load import group, summary_spread, typical_run
from tables.chart import Chart
from tables.table import Table
from runs.sweeps import load_experiment

# Mean strains. Below HOLDS a sheet counts as intact, above TORN as torn (more than twice as long).
HOLDS, TORN = 0.1, 1


def main(results, out, section):
    sheet = load_experiment(results, "models/hanging_sheet")
    strips = [load_experiment(results, f"models/{name}") for name in ("cantilever", "cantilever_rigidity")]
    section.text = sheet.settings["description"]
    if section.uses(sheet):
        section.pictures.append((_sheet(sheet, out), f"{sheet_title(*_grid(sheet))}. The pictures show the "
                                 "last frame of the seed nearest to the median. A row has one scale. The "
                                 "number in a picture is the mean strain, as median over the last second."))
    runs = [run for strip in strips for run in section.uses(strip)]
    section.tables += [_sheet_table(sheet), _strip_table(runs), _profiles(runs), _elastica_table(runs)]
    section.charts = [
        Chart("models_cost", "What a step of the hanging sheet costs", "models", "name",
              ["strain", "bending", "rest"], kind="bars", note="Cost of one step of 1/60 s on one thread, "
              "in ms: the minimum over seeds."),
        Chart("models_cantilever", strip_title(runs), "profiles", "distance", ["height"], held=["stiffness"],
              at="compliance", scale="linear", y_scale="linear", theory="elastica",
              note=" ".join(strip.settings["description"] for strip in strips))]


def name_of(run):
    """Name of a run's model. The name of k_ring contains k."""
    return looks.model_name(run.model, run.get("/bending/k_ring/k"))


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
    wall = sum(t for other, t in run.passes.items()
               if other not in apart) if name == "rest" else run.passes.get(name, 0)
    return run.cpu_s * wall / sum(run.passes.values())


# --- the hanging sheet ---


def _grid(experiment):
    """(substeps, models, {(model, substeps): runs}), in the order of the config."""
    by_place = group(experiment.runs, lambda run: (run.model, run.get("/solver/substeps")))
    substeps = [s for s in experiment.sweep["/solver/substeps"] if any(key[1] == s for key in by_place)]
    models = [m for m in experiment.sweep["/bending/model"] if any(key[0] == m for key in by_place)]
    return substeps, models, by_place


def _sheet(experiment, out):
    """Pictures: a column for each model, and a row for each number of substeps."""
    substeps, models, runs = _grid(experiment)
    rows = {}
    for s in substeps:
        groups = [runs.get((model, s), []) for model in models]
        samples = [typical_run(own_runs, "mean_strain") if own_runs else None for own_runs in groups]
        rows[f"{s} substep{'s' if s > 1 else ''}"] = [
            cloth.Panel(sample, camera, name_of(own_runs[0]) if own_runs else model, _strain_text(own_runs))
            for model, own_runs, sample, camera in zip(models, groups, samples,
                                                       cloth.cameras_of(samples, aspect=0.45))]
    return cloth.sheet(rows, out, "fig_models", inches=1.25, width=220)


def _strain_text(runs):
    return f"strain {number(summary_spread(runs, 'mean_strain').median, 2)}" if runs else ""


def sheet_title(substeps, models, runs):
    """How many models keep the sheet intact, for each number of substeps."""
    lines = []
    for s in substeps:
        strain = {model: summary_spread(runs[model, s], "mean_strain").median for model in models
                  if (model, s) in runs}
        torn = [name_of(runs[model, s][0]) for model, value in strain.items() if not value < TORN]
        held = sum(value < HOLDS for value in strain.values())
        steps = "One substep" if s == 1 else f"{s} substeps"
        text = f"{steps}: {held} of {len(strain)} models keep the mean strain below {100 * HOLDS:.0f} %"
        lines.append(text + (f"; it exceeds 100 % with {', '.join(torn)}" if torn
                             else "; none exceeds 100 %"))
    return ". ".join(lines)


def _sheet_table(experiment):
    substeps, models, runs = _grid(experiment)
    rows = []
    for model in models:
        for s in substeps:
            if own_runs := runs.get((model, s), []):
                of = {name: summary_spread(own_runs, name).median
                      for name in ("mean_strain", "max_stretch", "drop")}
                name = name_of(own_runs[0])
                rows.append({"model": name, "substeps": s, "name": f"{name}, {s}"} | of | cost(own_runs))
    return Table.of("models", "The hanging sheet at 64 cells: medians over seeds, but minima for times", [
        "model", "substeps", ("mean_strain", "mean strain"), ("max_stretch", "max σ₁"),
        ("drop", "drop", "", "m"),
        ("per_vertex", "bending constraints per vertex", ".2f"), ("ns", "time per projection", "", "ns"),
        ("strain", "strain", "", "ms per step"), ("bending", "bending", "", "ms per step"),
        ("rest", "other", "", "ms per step"),
        ("name", "model, substeps", "", "ms per step", "CPU time", False)], rows)


# --- the clamped strip ---

PROFILE = ["model", "stiffness", ("distance", "distance from the clamp", "", "cm"),
           ("height", "height", "", "cm")]


def profile(run, frame=-1):
    """(rows, 2) side view of the strip in m: mean distance from the clamp and mean height of each row."""
    rest, positions, pinned = run.rest_positions, run.positions(frame), run.pinned
    rows = np.unique(np.round(rest[:, 0], 6), return_inverse=True)[1].ravel()
    line = np.array([positions[rows == row].mean(axis=0) for row in range(rows.max() + 1)])
    clamp = max(rows[pinned])
    return line[clamp:, [0, 2]] - line[clamp, [0, 2]]


def elastica(weight, length, rigidity, points=400):
    """(points, 2) side view in m of a heavy strip that is clamped horizontally. `weight` in N/m².

    D θ'' + w (L - s) cos θ = 0 with θ(0) = 0, θ'(L) = 0, by shooting and bisection.
    """
    s, load = np.linspace(0, 1, points), weight * length**3 / rigidity

    def shoot(slope):
        step, theta, angles = s[1], 0.0, [0.0]
        for at in s[:-1]:  # midpoint rule
            middle = theta + step / 2 * slope
            bend = slope - step / 2 * load * (1 - at) * np.cos(theta)
            theta, slope = theta + step * bend, slope - step * load * (1 - at - step / 2) * np.cos(middle)
            angles.append(theta)
        return slope, np.array(angles)

    low, high = 0.0, 3 * np.sqrt(2 * load) + load
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if shoot(middle)[0] > 0 else (middle, high)
    theta = shoot(low)[1]
    mean = (theta[1:] + theta[:-1]) / 2
    return length * np.c_[np.r_[0, np.cumsum(np.cos(mean))], -np.r_[0, np.cumsum(np.sin(mean))]] * s[1]


def _profiles(runs):
    rows = [{"model": run.model, "name": name_of(run), "stiffness": run.get("/bending/stiffness"),
             "distance": 100 * distance, "height": 100 * height}
            for run in runs for distance, height in profile(run)]
    return Table.of("profiles", "", PROFILE, rows)


def _elastica_table(runs):
    """The heavy elastica with the stiffness of the matched runs, for the chart of the side views."""
    truth = _truth([run for run in runs if run.get("/bending/stiffness") == "compliance"])
    rows = [] if truth is None else [{"model": "heavy elastica", "distance": 100 * distance,
                                      "height": 100 * height} for distance, height in truth[::10]]
    return Table.of("elastica", "", PROFILE, rows)


def rigidity_of(runs):
    """Flexural rigidity of the matched runs in N m: the inverse of the compliance of discrete_shells. None
    without such a run."""
    return next((1 / run.get("/bending/compliance") for run in runs if run.model == "discrete_shells"), None)


def _truth(runs):
    """The elastica with the stiffness of the matched runs. None without such runs."""
    rigidity = rigidity_of(runs)
    if rigidity is None:
        return None
    run, rest = runs[0], runs[0].rest_positions
    x = np.unique(np.round(rest[:, 0], 6))
    free = x[-1] - np.round(rest[run.pinned, 0], 6).max()
    gravity = -run.config["effects"][0]["acceleration"][2]
    # The hinges on the edge of the clamp bend, too. So the effective clamp ends half a row before this edge.
    return elastica(run.get("/material/density") * gravity, free + (x[1] - x[0]) / 2, rigidity)


def strip_title(runs):
    """The title: the heights of the tips with equal k, and with equal flexural rigidity (matched runs)."""
    kinds = group(runs, lambda run: run.get("/bending/stiffness"))
    truth = _truth(kinds.get("compliance", []))
    tips = {kind: {name_of(run): 100 * profile(run)[-1] for run in runs} for kind, runs in kinds.items()}
    lines = []
    if tips.get("k"):
        drops = {name: -tip[1] for name, tip in tips["k"].items()}
        low, high = (pick(drops, key=drops.get) for pick in (min, max))
        lines.append(f"With equal k the tips hang between {drops[low]:.1f} cm ({low}) and "
                     f"{drops[high]:.1f} cm ({high}) below the clamp")
    if tips.get("compliance") and truth is not None:
        matched = np.array(list(tips["compliance"].values()))
        apart = np.linalg.norm(matched[:, None] - matched[None], axis=2).max()
        off = np.linalg.norm(matched - 100 * truth[-1], axis=1).max()
        lines.append(f"With equal rigidity the tips of {len(matched)} models lie within {apart:.1f} cm of "
                     f"each other and within {off:.1f} cm of the tip of the heavy elastica")
    return ". ".join(lines)


def _strip_table(runs):
    rows = []
    for run in runs:
        tip = profile(run)[-1]
        rows.append({"model": name_of(run), "stiffness": run.get("/bending/stiffness"),
                     "compliance": run.point["/bending"].get("compliance"), "below": -100 * tip[1],
                     "from": 100 * tip[0], "mean_strain": run.summary["mean_strain"]})
    return Table.of("cantilever", "The clamped strip", [
        "model", "stiffness", "compliance", ("below", "tip below the clamp", ".2f", "cm"),
        ("from", "tip from the clamp", ".2f", "cm"), ("mean_strain", "mean strain")], rows)
