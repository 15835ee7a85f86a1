"""Every bending model on the same two scenes: the hanging sheet of Fig. 5 and a clamped strip."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import style
from load import group, summary_spread, typical_frame
from report import Section, Table, figure_main
from sweeps import load_experiment

HOLDS, TORN = 0.1, 1  # mean strain; below HOLDS a sheet is cloth, above TORN it is more than twice as long
PASSES = [("strain", style.SEQUENCE[5]), ("bending", style.SEQUENCE[1]), ("rest", style.SEQUENCE[6])]


def main(results, out):
    """Draws cloth, strain and cost of every model, and the side view of the clamped strip."""
    section = Section("Every bending model on the same scenes", "models")
    sheet = load_experiment(results, "models/hanging_sheet")
    strip = load_experiment(results, "models/cantilever")
    section.text = sheet.settings["description"]
    if section.uses(sheet):
        section.pictures.append((_sheet(sheet, out), "Typical frames of the last second; strain drawn on the "
                                 "rest shape, the pin at the upper right; cost of one step of 1/60 s on one "
                                 "thread, minimum over seeds."))
    if section.uses(strip):
        section.pictures.append((_strip(strip, out), strip.settings["description"]))
    section.tables += [_sheet_table(sheet), _strip_table(strip)]
    return section


def name_of(run):
    """Name of a run's model; for k_ring with its ring."""
    return style.model_name(run.model, run.get("/bending/k_ring/k"))


def cost(runs):
    """ms per step by pass, ns per bending constraint and projection, constraints per vertex; minima over
    runs.

    Passes share the run's processor time in proportion to their wall time, which other programs disturb more.
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
    """Processor time of a pass in s; "rest" is all of a step but the projections."""
    apart = ("strain", "bending", "set_up", "recording")
    wall = sum(t for other, t in run.passes.items()
               if other not in apart) if name == "rest" else run.passes.get(name, 0)
    return run.cpu_s * wall / sum(run.passes.values())


# --- the hanging sheet ---


def _grid(experiment):
    """(substeps, models, (model, substeps) → runs); substeps and models in the order of the config."""
    by_place = group(experiment.runs, lambda run: (run.model, run.get("/solver/substeps")))
    substeps = [s for s in experiment.sweep["/solver/substeps"] if any(key[1] == s for key in by_place)]
    models = [m for m in experiment.sweep["/bending/model"] if any(key[0] == m for key in by_place)]
    return substeps, models, by_place


def _sheet(experiment, out):
    substeps, models, runs = _grid(experiment)
    samples = {key: typical_frame(some, "mean_strain") for key, some in runs.items()}
    whole = [sample for sample in samples.values() if sample[0].metrics["mean_strain"][sample[1]] < TORN]
    camera = style.camera_of(whole or samples.values())
    figure, axes = plt.subplots(len(models), 2 * len(substeps) + 1,
                                figsize=(4.0 * len(substeps) + 3.2, 2.2 * len(models)), squeeze=False,
                                layout="constrained", width_ratios=[0.8, 1] * len(substeps) + [1.3])
    costs = {key: cost(some) for key, some in runs.items()}
    most = max(sum(c[name] for name, _ in PASSES) for c in costs.values())
    for row, model in enumerate(models):
        some = next(runs[key] for key in runs if key[0] == model)
        axes[row, 0].text(-0.05, 0.5, name_of(some[0]), transform=axes[row, 0].transAxes, rotation=90,
                          ha="right", va="center", fontsize=10.5, fontweight="bold")
        for column, s in enumerate(substeps):
            sample, spread = samples.get((model, s)), summary_spread(runs.get((model, s), []), "mean_strain")
            style.draw_cloth(axes[row, 2 * column], sample, camera, width=320)
            _strain_map(axes[row, 2 * column + 1], sample, f"mean strain {style.number(spread.median, 2)}")
        _cost_bars(axes[row, -1], {s: costs.get((model, s)) for s in substeps}, 1.32 * most,
                   row == len(models) - 1)
    for column, s in enumerate(substeps):
        axes[0, 2 * column].set_title(f"{s} substep{'s' if s > 1 else ''}", fontweight="bold")
        axes[0, 2 * column + 1].set_title("its strain", fontweight="bold")
    axes[0, -1].set_title("cost", fontweight="bold")
    axes[0, -1].legend(loc="lower right", bbox_to_anchor=(1.02, 1.0), ncol=3, fontsize=8, columnspacing=0.9,
                       handlelength=1)
    style.stretch_bar(figure, axes[:, :-1], location="bottom", shrink=0.5, aspect=44, pad=0.008)
    figure.suptitle(sheet_title(substeps, models, runs), x=0.01, ha="left", fontsize=12.5)
    return style.save(figure, out, "fig_models")


def sheet_title(substeps, models, runs):
    """The title: how many models hold the sheet together, at each number of substeps."""
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
    return "\n".join(lines)


def _strain_map(axes, sample, text):
    """Draws the largest stretch of each triangle on the rest shape."""
    axes.set_axis_off()
    axes.set_aspect("equal")
    if sample is None:
        return
    run, frame = sample
    corners = run.rest_positions[run.triangles][:, :, :2]
    axes.add_collection(PolyCollection(corners,
                                       facecolors=style.stretch_colours(run.cell("max_stretch", frame) - 1),
                                       edgecolors="face", linewidths=0.2, rasterized=True))
    axes.set_xlim(corners[..., 0].min(), corners[..., 0].max())
    axes.set_ylim(corners[..., 1].min(), corners[..., 1].max())
    style.caption(axes, text)


def _cost_bars(axes, costs, limit, last):
    """Draws ms per step by pass, one bar per number of substeps."""
    known = {s: c for s, c in costs.items() if c}
    for y, (s, c) in enumerate(known.items()):
        left = 0
        for name, colour in PASSES:
            axes.barh(y, c[name], 0.55, left=left, color=colour, label=name if y == 0 else None)
            left += c[name]
        axes.annotate(f"{left:.1f} ms", (left, y), xytext=(3, 0), textcoords="offset points", va="center",
                      fontsize=8)
    axes.set_yticks(range(len(known)), labels=[f"{s} substep{'s' if s > 1 else ''}" for s in known])
    axes.set_ylim(len(known) + 0.35, -0.6)
    axes.set_xlim(0, limit)
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    if last:
        axes.set_xlabel("ms per step of 1/60 s")
    c = next(iter(known.values()))
    note = f"{c['per_vertex']:.1f} bending constraints per vertex" + (f", {c['ns']:.1f} ns each"
                                                                      if c["per_vertex"] else "")
    axes.text(0.02 * limit, len(known) - 0.05, note, fontsize=8, color=style.GREY, va="center")


def _sheet_table(experiment):
    substeps, models, runs = _grid(experiment)
    rows = []
    for model in models:
        for s in substeps:
            some = runs.get((model, s), [])
            if some:
                c, at = cost(some), lambda name: style.number(summary_spread(some, name).median)
                rows.append([name_of(some[0]), s, at("mean_strain"), at("max_stretch"), at("drop"),
                             f"{c['per_vertex']:.2f}", style.number(c["ns"]), style.number(c["strain"]),
                             style.number(c["bending"])])
    return Table("The hanging sheet at 64 cells: medians over seeds, minima of times",
                 ["model", "substeps", "mean strain", "max σ₁", "drop (m)", "bending constraints per vertex",
                  "ns each", "strain (ms per step)", "bending (ms per step)"], rows)


# --- the clamped strip ---


def profile(run, frame=-1):
    """(rows, 2) side view of the strip in m: distance from the clamp, height; means over rows across."""
    rest, positions, pinned = run.rest_positions, run.positions(frame), run.pinned
    rows = np.unique(np.round(rest[:, 0], 6), return_inverse=True)[1].ravel()
    line = np.array([positions[rows == row].mean(axis=0) for row in range(rows.max() + 1)])
    clamp = max(rows[pinned])
    return line[clamp:, [0, 2]] - line[clamp, [0, 2]]


def elastica(weight, length, rigidity, points=400):
    """(points, 2) side view in m of a heavy strip that is clamped horizontally; weight in N/m².

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


def _strip(experiment, out):
    kinds = group(experiment.runs, lambda run: run.get("/bending/stiffness"))
    order = [entry["model"] for entry in experiment.sweep["/bending"]]
    figure, axes = plt.subplots(1, 2, figsize=(10.4, 5.2), layout="constrained", sharex=True, sharey=True)
    truth = _truth(kinds.get("compliance", []))
    k = next((run.get("/bending/k") for run in kinds.get("k", [])), np.nan)
    rigidity = rigidity_of(kinds.get("compliance", [])) or np.nan
    for panel, (kind, title) in zip(axes, (("k", f"k = {k:g} for all: projections decide the stiffness"),
                                           ("compliance", f"matched: flexural rigidity {1e3 * rigidity:g} mN "
                                            "m"))):
        for i, run in enumerate(sorted(kinds.get(kind, []), key=lambda run: order.index(run.model))):
            line = 100 * profile(run)
            panel.plot(*line.T, markevery=(i % 6, 6), label=f"{name_of(run)}: {-line[-1, 1]:.1f}",
                       **style.look(run.model))
        panel.set_title(title)
        panel.set_aspect("equal")
        panel.set_xlabel("distance from the clamp (cm)")
    if truth is not None:
        axes[1].plot(*(100 * truth).T, color=style.INK, linewidth=3.5, alpha=0.25, zorder=0,
                     label=f"heavy elastica: {-100 * truth[-1, 1]:.1f}")
    axes[0].set_ylabel("height (cm)")
    figure.suptitle(strip_title(kinds, truth), x=0.01, ha="left", fontsize=11.5)
    _label_tips(axes)
    return style.save(figure, out, "fig_models_cantilever")


def _label_tips(axes):
    """Labels each tip; those that hang near the clamp have their labels in the panel."""
    for panel in axes:
        middle = np.mean(panel.get_xlim())
        tips = {line.get_label(): line.get_xdata()[-1] for line in panel.lines}
        style.label_ends(panel, x=0.36, only=lambda label: tips[label] < 0.6 * middle)
        style.label_ends(panel, x=1.0 if panel is axes[0] else 0.7,
                         only=lambda label: tips[label] >= 0.6 * middle)
        panel.text(1, 1, "name: tip below the clamp (cm)", transform=panel.transAxes, ha="right", va="top",
                   fontsize=8, color=style.GREY)


def rigidity_of(runs):
    """Flexural rigidity of the matched runs in N m: the inverse of discrete_shells' compliance. None without
    it."""
    return next((1 / run.get("/bending/compliance") for run in runs if run.model == "discrete_shells"), None)


def _truth(runs):
    """The elastica of the matched runs, None if there are none."""
    rigidity = rigidity_of(runs)
    if rigidity is None:
        return None
    run, rest = runs[0], runs[0].rest_positions
    x = np.unique(np.round(rest[:, 0], 6))
    free = x[-1] - np.round(rest[run.pinned, 0], 6).max()
    gravity = -run.config["effects"][0]["acceleration"][2]
    # The first hinges that turn are at the clamp's edge: the effective clamp is half a row behind it.
    return elastica(run.get("/material/density") * gravity, free + (x[1] - x[0]) / 2, rigidity)


def strip_title(kinds, truth):
    """The title: where the tips hang, with one k and matched."""
    tips = {kind: {name_of(run): 100 * profile(run)[-1] for run in runs} for kind, runs in kinds.items()}
    lines = []
    if tips.get("k"):
        drops = {name: -tip[1] for name, tip in tips["k"].items()}
        low, high = (pick(drops, key=drops.get) for pick in (min, max))
        lines.append(f"One k for all: the tip hangs between {drops[low]:.1f} cm ({low}) and "
                     f"{drops[high]:.1f} cm ({high})")
    if tips.get("compliance") and truth is not None:
        matched = np.array(list(tips["compliance"].values()))
        apart = np.linalg.norm(matched[:, None] - matched[None], axis=2).max()
        off = np.linalg.norm(matched - 100 * truth[-1], axis=1).max()
        lines.append(f"Matched: the tips of {len(matched)} models lie within {apart:.1f} cm of each other "
                     f"and within {off:.1f} cm of the heavy elastica's tip")
    return "\n".join(lines)


def _strip_table(experiment):
    rows = []
    for run in experiment.runs:
        tip = profile(run)[-1]
        rows.append([name_of(run), run.get("/bending/stiffness"),
                     style.number(run.point["/bending"].get("compliance", np.nan)),
                     f"{-100 * tip[1]:.2f}", f"{100 * tip[0]:.2f}", style.number(run.summary["mean_strain"])])
    return Table("The clamped strip", ["model", "stiffness", "compliance", "tip below the clamp (cm)",
                                       "tip from the clamp (cm)", "mean strain"], rows)


if __name__ == "__main__":
    figure_main(main)
