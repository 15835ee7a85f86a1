"""Every bending model on the same two scenes: the hanging sheet of Fig. 5 and a clamped strip."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import style
from bendlab.results.load import group, summary_spread, typical_run
from report import Section, Table, figure_main
from sweeps import load_experiment

SCREEN = (14, 7.4)  # inches of 100 pixels; twelve models fill it
HOLDS, TORN = 0.1, 1  # mean strain; below HOLDS a sheet is cloth, above TORN it is more than twice as long
PASSES = [("strain", style.SEQUENCE[5]), ("bending", style.SEQUENCE[1]), ("rest", style.SEQUENCE[6])]


def main(results, out):
    """Draws cloth and cost of every model, and the side view of the clamped strip."""
    section = Section("Every bending model on the same scenes", "models")
    sheet = load_experiment(results, "models/hanging_sheet")
    strips = [load_experiment(results, f"models/{name}") for name in ("cantilever", "cantilever_rigidity")]
    section.text = sheet.settings["description"]
    if section.uses(sheet):
        section.pictures.append((_sheet(sheet, out), "The last frame of the seed nearest to the median; "
                                 "cloths of a row have one scale. Number on the cloth: mean strain, median "
                                 "of the last second. Cost of one step of 1/60 s on one thread, minimum "
                                 "over seeds."))
    runs = [run for strip in strips for run in section.uses(strip)]
    if runs:
        section.pictures.append((_strip(runs, strips[0].sweep["/bending"], out),
                                 " ".join(strip.settings["description"] for strip in strips)))
    section.tables += [_sheet_table(sheet), _strip_table(runs)]
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
    """One column per model: the cloth with each number of substeps, and below it what a step costs."""
    substeps, models, runs = _grid(experiment)
    size = SCREEN[0] * max(1, len(models) / 12), SCREEN[1]
    figure, axes = plt.subplots(len(substeps) + 1, len(models), figsize=size, layout="constrained",
                                squeeze=False, height_ratios=[1] * len(substeps) + [0.62])
    for row, s in zip(axes, substeps):
        _cloths(row, [runs.get((model, s), []) for model in models])
        row[0].text(-0.08, 0.5, f"{s} substep{'s' if s > 1 else ''}", transform=row[0].transAxes, rotation=90,
                    ha="right", va="center", fontweight="bold")
    for panel, model in zip(axes[0], models):
        panel.set_title(name_of(next(some[0] for (name, _), some in runs.items() if name == model)),
                        loc="center", fontweight="bold", fontsize=9)
    style.stretch_bar(figure, axes[:-1], aspect=30, pad=0.008, fraction=0.03)
    _costs(figure, axes[-1], models, substeps, {key: cost(some) for key, some in runs.items()})
    figure.suptitle(sheet_title(substeps, models, runs), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_models", dpi=100)


def _cloths(row, groups):
    """Draws one run of each group."""
    samples = [typical_run(some, "mean_strain") for some in groups]
    for panel, sample, camera, some in zip(row, samples, style.cameras_of(samples, aspect=0.45), groups):
        strain = style.number(summary_spread(some, "mean_strain").median, 2)
        style.draw_cloth(panel, sample, camera, width=220, text=f"strain {strain}")


def _costs(figure, row, models, substeps, costs):
    """Draws ms per step by pass below each model, one bar per number of substeps."""
    most = max(sum(c[name] for name, _ in PASSES) for c in costs.values())
    for panel, model in zip(row, models):
        known = [(s, costs[model, s]) for s in substeps if (model, s) in costs]
        for x, (_, c) in enumerate(known):
            base = 0
            for name, colour in PASSES:
                panel.bar(x, c[name], 0.6, bottom=base, color=colour,
                          label=name.replace("rest", "other") if x == 0 else None)
                base += c[name]
            panel.annotate(f"{base:.1f}", (x, base), xytext=(0, 2), textcoords="offset points", ha="center",
                           fontsize=8)
        panel.set_xticks(range(len(known)), labels=[str(s) for s, _ in known])
        panel.set_xlim(-0.6, len(substeps) - 0.4), panel.set_ylim(0, 1.12 * most)
        panel.grid(axis="x", visible=False)
        panel.tick_params(axis="x", length=0)
        panel.tick_params(axis="y", length=0, labelleft=panel is row[0])
    row[0].set_ylabel("ms per step of 1/60 s")
    row[len(row) // 2].set_xlabel("substeps")
    figure.legend(*row[0].get_legend_handles_labels(), title="cost of", loc="lower right", fontsize=8)


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


def _strip(runs, models, out):
    kinds = group(runs, lambda run: run.get("/bending/stiffness"))
    order = [entry["model"] for entry in models]
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


def _strip_table(runs):
    rows = []
    for run in runs:
        tip = profile(run)[-1]
        rows.append([name_of(run), run.get("/bending/stiffness"),
                     style.number(run.point["/bending"].get("compliance", np.nan)),
                     f"{-100 * tip[1]:.2f}", f"{100 * tip[0]:.2f}", style.number(run.summary["mean_strain"])])
    return Table("The clamped strip", ["model", "stiffness", "compliance", "tip below the clamp (cm)",
                                       "tip from the clamp (cm)", "mean strain"], rows)


if __name__ == "__main__":
    figure_main(main)
