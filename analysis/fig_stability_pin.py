"""The single pinned corner, frame by frame: do triangles degenerate before the strain fails, and what removes the failure?"""
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np

import style
from load import load_experiment
from report import Section, Table, figure_main

NEEDLE = 4.0  # ratio of longest to shortest edge, at which the run files' metrics count a needle
CAP = 160.0  # degrees
STRETCHED = 1.0  # stretch - 1 from which a triangle's strain has failed: twice as long as it should be
NEAR = 2  # rings around the pinned vertices whose triangles are followed
MODELS = ["none", "crossover", "dihedral"]
LOOKS = {"none": ":", "crossover": "-", "dihedral": "--"}


@dataclass
class Story:
    """What happens at the pin of one run, by frame (F): the worst of the triangles there."""

    run: object
    time: np.ndarray  # s
    stretch: np.ndarray  # largest principal stretch - 1
    ratio: np.ndarray  # largest ratio of longest to shortest edge
    angle: np.ndarray  # largest angle, degrees
    correction: np.ndarray  # largest displacement of a vertex by constraints within a frame, in mean edges

    def first(self, values, bound):
        """Time at which `values` exceed a bound, inf if never."""
        beyond = np.flatnonzero(values > bound)
        return self.time[beyond[0]] if len(beyond) else np.inf

    @property
    def degenerate_at(self):
        """Time of the first needle or cap."""
        return min(self.first(self.ratio, NEEDLE), self.first(self.angle, CAP))

    @property
    def failed_at(self):
        return self.first(self.stretch, STRETCHED)

    @property
    def overshot_at(self):
        """Time at which a vertex is first moved farther than an edge within a frame."""
        return self.first(self.correction, 1)

    @property
    def mean_strain(self):
        """Of the whole sheet, median over the last half second."""
        return float(np.median(self.run.metrics["mean_strain"][self.time > self.time[-1] - 0.5]))

    @property
    def worst(self):
        """Largest stretch - 1, median over the last half second."""
        return float(np.median(self.stretch[self.time > self.time[-1] - 0.5]))


def story(run):
    rest, triangles, pinned = run.rest_positions, run.triangles, run.pinned
    near = pinned.copy()
    for _ in range(NEAR):
        near[np.unique(triangles[near[triangles].any(axis=1)])] = True
    at_pin = triangles[near[triangles].any(axis=1) & ~pinned[triangles].all(axis=1)]
    frames = run.trajectory()
    stretch, ratio, angle = _shape(rest, frames, at_pin)
    return Story(run, run.metrics["time"], stretch, ratio, angle, _corrections(run, frames, np.unique(at_pin)))


def _shape(rest, frames, triangles):
    """(F) largest stretch - 1, ratio of edges and angle (degrees) of some triangles."""
    a, b, c = (frames[:, triangles[:, i]] for i in range(3))
    q = np.stack([rest[triangles[:, i]] - rest[triangles[:, 0]] for i in (1, 2)], axis=2)[:, :2]
    f = np.stack([b - a, c - a], axis=3) @ np.linalg.inv(q)
    along, across = (f**2).sum(axis=2)[..., 0], (f**2).sum(axis=2)[..., 1]
    squared = (along + across) / 2 + np.hypot((along - across) / 2, f.prod(axis=3).sum(axis=2))  # the larger eigenvalue of fᵀf
    edges = np.sort(np.linalg.norm([b - a, c - b, a - c], axis=3), axis=0)
    short, middle, long = np.maximum(edges, 1e-12)
    cosine = (short**2 + middle**2 - long**2) / (2 * short * middle)
    angle = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
    return np.sqrt(squared).max(axis=1) - 1, (long / short).max(axis=1), angle.max(axis=1)


def _corrections(run, frames, vertices):
    """Of each frame the farthest that constraints moved a vertex, over the mean edge: how far it is from where it would have
    flown, x + (x - x before) + h² g."""
    time, free = run.metrics["time"], vertices[~run.pinned[vertices]]
    x = frames[:, free]
    forces = sum(np.array(effect["acceleration"]) for effect in run.get("/effects") if effect["type"] == "gravity")
    step = np.diff(time).mean()
    moved = np.linalg.norm(x[2:] - 2 * x[1:-1] + x[:-2] - step**2 * forces, axis=2).max(axis=1)
    triangles = run.triangles
    edge = np.linalg.norm(run.rest_positions[triangles[:, 0]] - run.rest_positions[triangles[:, 1]], axis=1).mean()
    return np.concatenate([[0, 0], moved / edge])


def remedy(run):
    """What a run has that the sheet as published, with a bare pin and ten iterations, has not."""
    solver, strain = run.get("/solver"), run.get("/material/strain")
    parts = [name for name, has in [
        ("1-ring pinned", run.get("/pins/ring") > 0),
        (f"{solver['iterations']} iteration{'s' if solver['iterations'] > 1 else ''}", solver["iterations"] != 10),
        (f"{solver['substeps']} substeps", solver["substeps"] > 1),
        ("mesh order", solver["order"] == "mesh"),
        ("nearest to the pin first", solver["order"] == "pins"),
        ("bending first", solver["first"] == "bending"),
        ("plain shear and stretch", strain["form"] == "green"),
        ("shear as an angle", strain["form"] == "angle"),
        (f"shear k = {strain['shear']:g}", strain["shear"] < 1),
        ("tethers", any(effect["type"] == "tethers" for effect in run.get("/effects")))] if has]
    return ", ".join(parts) or "as published"


def main(results, out):
    section = Section("Is the degenerate triangle the cause?", "pin")
    stories = [story(run) for name in ("bending", "solver", "tethers", "strain")
               for run in section.uses(load_experiment(results, f"one_pin/{name}"))]
    force = [story(run) for run in section.uses(load_experiment(results, "one_pin/force"))]
    section.text = (
        "A sheet of 64 × 64 cells hangs from one vertex, as published: ten iterations, k = 0.5, one step of 1/60 s. Within "
        f"{NEAR} rings of the pin each frame is asked for its worst triangle: its stretch, its shape, and how far constraints "
        "moved a vertex in that frame from where it would have flown. A triangle is degenerate when its longest edge is 4 "
        "times the shortest or an angle exceeds 160°, its strain has failed at a stretch of 2, and a correction overshoots "
        "when it is longer than an edge. With the plain strain constraints no correction ever overshoots, and the pin fails "
        "all the same: what fails there is convergence, because one vertex carries the whole weight. Overshooting is what "
        "makes the rest of the sheet fail too.")
    if stories:
        section.pictures.append((_frames(stories, out), "The bare pin, with three bending models and every remedy, frame by frame. "
                                 "Lines: worst of the triangles near the pin. Bounds are dashed."))
        section.pictures.append((_remedies(stories, out), "Largest stretch near the pin, and mean strain of the sheet, medians over the "
                                 "last half second, and what the remedy costs. (The two orders without colours run one "
                                 "constraint after another, on the reference implementation.)"))
        section.tables.append(_table("At the pin", stories))
    if force:
        section.pictures.append((_force(force, out), "The follow-up paper's case: three times gravity, sideways and down."))
        section.tables.append(_table("Under a force of three times the weight", force))
    section.stories = stories
    return section


def _frames(stories, out):
    """Stretch, shape and correction by frame: one column per model, one line per remedy."""
    shown = [s for s in stories if s.run.model in MODELS]
    remedies = sorted({remedy(s.run) for s in shown}, key=lambda name: (name != "as published", name))
    colours = dict(zip(remedies, [style.INK, *style.SEQUENCE, "#a6761d", "#7570b3", "#e7298a", "#66a61e"]))
    rows = [("stretch", "stretch − 1", STRETCHED), ("ratio", "longest / shortest edge", NEEDLE),
            ("correction", "correction (edges)", 1)]
    figure, axes = plt.subplots(len(rows), len(MODELS), figsize=(12.6, 8), layout="constrained", sharex=True, sharey="row")
    for column, model in enumerate(MODELS):
        for s in (s for s in shown if s.run.model == model):
            name = remedy(s.run)
            for row, (field, _, _) in enumerate(rows):
                axes[row, column].plot(s.time, np.maximum(getattr(s, field), 1e-3), color=colours[name],
                                       linewidth=2.2 if name == "as published" else 1, label=name)
        axes[0, column].set_title(style.MODEL_NAMES[model])
        axes[-1, column].set_xlabel("time (s)")
    for row, (_, label, bound) in enumerate(rows):
        axes[row, 0].set_ylabel(label)
        for panel in axes[row]:
            panel.set_yscale("log")
            panel.axhline(bound, color=style.GREY, linewidth=0.8, linestyle="--")
    axes[0, 1].set_ylim(1e-2, 1e3), axes[1, 1].set_ylim(1, 1e3), axes[2, 1].set_ylim(1e-2, 1e3)
    style.legend_below(figure, axes[0, 0], 6)
    figure.suptitle(message(stories), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_stability_pin_frames")


def message(stories):
    """What the order of events says."""
    failed = [s for s in stories if np.isfinite(s.failed_at)]
    before = sum(s.failed_at <= s.degenerate_at for s in failed)
    overshot = [s for s in failed if np.isfinite(s.overshot_at)]
    after = sum(s.overshot_at >= s.degenerate_at for s in overshot)
    return (f"Triangles at the pin are stretched to twice their length before one is degenerate in {before} of {len(failed)} "
            f"runs that fail;\ncorrections overshoot in {len(overshot)} of them, in {after} not before a triangle is degenerate")


def _baseline(stories, model):
    return next((s for s in stories if s.run.model == model and remedy(s.run) == "as published"), None)


def _remedies(stories, out):
    shown = [s for s in stories if s.run.model in MODELS]
    names = sorted({remedy(s.run) for s in shown},
                   key=lambda name: -np.median([np.log(s.worst) for s in shown if remedy(s.run) == name]))
    panels = [(lambda s: s.worst, "stretch − 1 near the pin", STRETCHED), (lambda s: s.mean_strain, "mean strain of the sheet", None),
              (lambda s: s.run.cpu_s / _baseline(stories, s.run.model).run.cpu_s, "CPU time, as published = 1", 1)]
    figure, axes = plt.subplots(1, len(panels), figsize=(12.6, 4.6), layout="constrained", sharey=True)
    for panel, (value, label, bound) in zip(axes, panels):
        for place, model in enumerate(MODELS):
            some = [s for s in shown if s.run.model == model]
            panel.plot([value(s) for s in some], [names.index(remedy(s.run)) + 0.2 * (place - 1) for s in some], "o",
                       color=style.MODEL_COLOURS[model], markersize=5, label=style.MODEL_NAMES[model])
        if bound:
            panel.axvline(bound, color=style.GREY, linewidth=0.8, linestyle="--")
        panel.set_xscale("log")
        panel.set_xlabel(label)
    axes[0].set_yticks(range(len(names)), labels=names)
    axes[0].invert_yaxis()
    axes[-1].set_xlim(0.5, 16), axes[-1].set_xticks([1, 2, 4, 8], labels=["1", "2", "4", "8"]), axes[-1].minorticks_off()
    axes[-1].legend(loc="upper left", bbox_to_anchor=(1, 1))
    always = [name for name in names if all(s.worst < STRETCHED for s in shown if remedy(s.run) == name)]
    figure.suptitle("What keeps the stretch at the pin below 2, whichever of these models bends the sheet: "
                    + (", ".join(always) or "nothing here"), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_stability_pin_remedies")


def _force(stories, out):
    figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
    settings = [(ring, substeps) for ring in (0, 1) for substeps in (1, 4)]
    models = list(dict.fromkeys(s.run.model for s in stories))
    for s in stories:
        place = settings.index((s.run.get("/pins/ring"), s.run.get("/solver/substeps")))
        axes.plot(models.index(s.run.model) + 0.16 * (place - 1.5), s.worst, "o", color=style.SEQUENCE[place])
    for place, (ring, substeps) in enumerate(settings):
        axes.plot([], [], "o", color=style.SEQUENCE[place],
                  label=f"{'1-ring pinned' if ring else 'bare pin'}, {substeps} substep{'s' if substeps > 1 else ''}")
    axes.axhline(STRETCHED, color=style.GREY, linewidth=0.8, linestyle="--")
    axes.set_yscale("log")
    axes.set_xticks(range(len(models)), labels=[style.MODEL_NAMES[model] for model in models])
    axes.set_ylabel("stretch − 1 near the pin")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    held = [s for s in stories if s.worst < STRETCHED]
    axes.set_title(f"A large force: {len(held)} of {len(stories)} settings keep the stretch at the pin below 2")
    return style.save(figure, out, "fig_stability_pin_force")


def _table(caption, stories):
    def time(t):
        return f"{t:.2f}" if np.isfinite(t) else "never"

    rows = []
    for s in sorted(stories, key=lambda s: (s.run.model, remedy(s.run))):
        base = _baseline(stories, s.run.model)
        rows.append([s.run.model, remedy(s.run), time(s.overshot_at), time(s.degenerate_at), time(s.failed_at),
                     style.number(s.worst), style.number(s.mean_strain),
                     f"{s.run.cpu_s / base.run.cpu_s:.2f}" if base else "–"])
    return Table(caption, ["model", "remedy", "overshoots at (s)", "degenerate at (s)", "strain fails at (s)",
                           "stretch − 1, last ½ s", "mean strain", "CPU over as published"], rows)


if __name__ == "__main__":
    figure_main(main)
