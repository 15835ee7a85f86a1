"""The single pinned corner, frame by frame: does the strain fail first, and which remedies help?"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np

import style
from report import Section, Table, figure_main
from sweeps import load_experiment

NEEDLE = 4.0  # longest over shortest edge; from here on the run file's metrics count a needle
CAP = 160.0  # degrees; a triangle with a larger angle is a cap
STRETCHED = 1.0  # stretch - 1; above it a triangle's strain has failed: more than twice its length at rest
NEAR = 2  # rings around the pinned vertices; triangles within are followed
MODELS = ["none", "crossover", "dihedral"]


@dataclass
class Story:
    """The worst of the triangles at the pin of one run, by frame (F)."""

    run: object
    time: np.ndarray  # s
    stretch: np.ndarray  # largest principal stretch - 1
    ratio: np.ndarray  # largest ratio of longest to shortest edge
    angle: np.ndarray  # largest angle, degrees
    correction: np.ndarray  # largest displacement of a vertex by constraints in a frame, in mean edges

    def first(self, values, bound):
        """Time at which `values` first exceed a bound, inf if never."""
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
        """Time at which constraints first move a vertex farther than an edge in one frame."""
        return self.first(self.correction, 1)

    @property
    def mean_strain(self):
        """Mean strain of the whole sheet, median over the last half second."""
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
    return Story(run, run.metrics["time"], stretch, ratio, angle,
                 _corrections(run, frames, np.unique(at_pin)))


def _shape(rest, frames, triangles):
    """(F) largest stretch - 1, ratio of edges and angle (degrees) of the given triangles."""
    a, b, c = (frames[:, triangles[:, i]] for i in range(3))
    q = np.stack([rest[triangles[:, i]] - rest[triangles[:, 0]] for i in (1, 2)], axis=2)[:, :2]
    f = np.stack([b - a, c - a], axis=3) @ np.linalg.inv(q)
    along, across = (f**2).sum(axis=2)[..., 0], (f**2).sum(axis=2)[..., 1]
    # The larger eigenvalue of fᵀf
    squared = (along + across) / 2 + np.hypot((along - across) / 2, f.prod(axis=3).sum(axis=2))
    edges = np.sort(np.linalg.norm([b - a, c - b, a - c], axis=3), axis=0)
    short, middle, long = np.maximum(edges, 1e-12)
    cosine = (short**2 + middle**2 - long**2) / (2 * short * middle)
    angle = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
    return np.sqrt(squared).max(axis=1) - 1, (long / short).max(axis=1), angle.max(axis=1)


def _corrections(run, frames, vertices):
    """(F) largest displacement of a vertex by constraints in a frame, over the mean edge.

    It is the distance from the free flight x + (x - x before) + h² g.
    """
    time, free = run.metrics["time"], vertices[~run.pinned[vertices]]
    x = frames[:, free]
    forces = sum(np.array(effect["acceleration"]) for effect in run.get("/effects")
                 if effect["type"] == "gravity")
    step = np.diff(time).mean()
    moved = np.linalg.norm(x[2:] - 2 * x[1:-1] + x[:-2] - step**2 * forces, axis=2).max(axis=1)
    triangles = run.triangles
    edge = np.linalg.norm(run.rest_positions[triangles[:, 0]] - run.rest_positions[triangles[:, 1]],
                          axis=1).mean()
    return np.concatenate([[0, 0], moved / edge])


def remedy(run):
    """How a run differs from the published sheet with a bare pin and ten iterations, as text."""
    solver, strain = run.get("/solver"), run.get("/material/strain")
    parts = [name for name, has in [("1-ring pinned", run.get("/pins/ring") > 0),
                                    (f"{solver['iterations']} "
                                     f"iteration{'s' if solver['iterations'] > 1 else ''}",
                                     solver["iterations"] != 10),
                                    (f"{solver['substeps']} substeps", solver["substeps"] > 1),
                                    ("mesh order", solver["order"] == "mesh"),
                                    ("nearest to the pin first", solver["order"] == "pins"),
                                    ("bending first", solver["first"] == "bending"),
                                    ("plain shear and stretch", strain["form"] == "green"),
                                    ("shear as an angle", strain["form"] == "angle"),
                                    (f"shear k = {strain['shear']:g}", strain["shear"] < 1),
                                    ("tethers",
                                     any(effect["type"] == "tethers" for effect in run.get("/effects")))]
             if has]
    return ", ".join(parts) or "as published"


def main(results, out):
    section = Section("Is the degenerate triangle the cause?", "pin")
    stories = [story(run) for name in ("bending", "solver", "tethers", "strain")
               for run in section.uses(load_experiment(results, f"one_pin/{name}"))]
    force = [story(run) for run in section.uses(load_experiment(results, "one_pin/force"))]
    section.text = ("A sheet of 64 × 64 cells hangs from one vertex with the published settings: ten "
                    "iterations, k = 0.5, one step of 1/60 s. In each frame the worst triangle within "
                    f"{NEAR} rings of the pin is measured: its stretch, its shape, and how far constraints "
                    "moved a vertex from its free flight. A triangle is degenerate if its longest edge is "
                    f"more than {NEEDLE:g} times the shortest or an angle exceeds {CAP:g}°. Its strain has "
                    f"failed above a stretch of {1 + STRETCHED:g}. A correction overshoots if it is longer "
                    "than an edge. " + plain_text(stories))
    if stories:
        section.pictures.append((_frames(stories, out), "The bare pin frame by frame, with three bending "
                                 "models and every remedy. Lines: the worst triangle near the pin. Dashed: "
                                 "bounds."))
        section.pictures.append((_remedies(stories, out), "Largest stretch near the pin and mean strain of "
                                 "the sheet (medians over the last half second), and the cost of the remedy. "
                                 "The two orders without colours project one constraint after another, with "
                                 "the oracle (the scalar code)."))
        section.tables.append(_table("At the pin", stories))
    if force:
        section.pictures.append((_force(force, out), "The case of the follow-up paper: a force of three "
                                 "times the weight, sideways and down."))
        section.tables.append(_table("Under a force of three times the weight", force))
    section.stories = stories
    return section


def _frames(stories, out):
    """Draws stretch, shape and correction by frame: one column per model, one line per remedy."""
    shown = [s for s in stories if s.run.model in MODELS]
    remedies = sorted({remedy(s.run) for s in shown}, key=lambda name: (name != "as published", name))
    looks = dict(zip(remedies, [dict(color=colour, linestyle=line) for line in ("-", (0, (3, 1)))
                                for colour in (style.INK, *style.SEQUENCE)]))
    rows = [("stretch", "stretch − 1", STRETCHED), ("ratio", "longest / shortest edge", NEEDLE),
            ("correction", "correction (edges)", 1)]
    figure, axes = plt.subplots(len(rows), len(MODELS), figsize=(12.6, 8), layout="constrained", sharex=True,
                                sharey="row")
    for column, model in enumerate(MODELS):
        for s in (s for s in shown if s.run.model == model):
            name = remedy(s.run)
            for row, (field, _, _) in enumerate(rows):
                axes[row, column].plot(s.time, np.maximum(getattr(s, field), 1e-3), label=name,
                                       linewidth=2.2 if name == "as published" else 1, **looks[name])
        axes[0, column].set_title(style.model_name(model))
        axes[-1, column].set_xlabel("time (s)")
    for row, (_, label, bound) in enumerate(rows):
        axes[row, 0].set_ylabel(label)
        for panel in axes[row]:
            panel.set_yscale("log")
            panel.axhline(bound, color=style.GREY, linewidth=0.8, linestyle="--")
    axes[0, 1].set_ylim(1e-2, 1e3), axes[1, 1].set_ylim(1, 1e3), axes[2, 1].set_ylim(1e-2, 1e3)
    figure.suptitle(message(stories), x=0.01, ha="left", fontsize=11.5)
    for panel in axes[:, -1]:
        style.label_ends(panel)
    return style.save(figure, out, "fig_stability_pin_frames")


def message(stories):
    """The title: the order of events."""
    failed = [s for s in stories if np.isfinite(s.failed_at)]
    before = sum(s.failed_at <= s.degenerate_at for s in failed)
    overshot = [s for s in failed if np.isfinite(s.overshot_at)]
    after = sum(s.overshot_at >= s.degenerate_at for s in overshot)
    return (f"In {before} of {len(failed)} runs that fail, a triangle at the pin is stretched to twice its "
            f"length before one is degenerate;\ncorrections overshoot in {len(overshot)} of them, in {after} "
            "of these not before a triangle is degenerate")


def plain_text(stories):
    """What the runs with plain strain constraints and the bare pin show about overshooting."""
    plain = [s for s in stories if remedy(s.run) == "plain shear and stretch"]
    failed = [s for s in plain if np.isfinite(s.failed_at)]
    quiet = [s for s in failed if not np.isfinite(s.overshot_at)]
    if not failed:
        return ""
    text = (f"With the plain strain constraints the pin fails in {len(failed)} of {len(plain)} runs, and in "
            f"{len(quiet)} of these no correction ever overshoots. ")
    if len(quiet) == len(failed):
        text += ("So the failure at the pin is one of convergence: one vertex carries the whole weight. "
                 "Overshooting makes the rest of the sheet fail too.")
    return text


def _baseline(stories, model):
    return next((s for s in stories if s.run.model == model and remedy(s.run) == "as published"), None)


def _remedies(stories, out):
    shown = [s for s in stories if s.run.model in MODELS]
    names = sorted({remedy(s.run) for s in shown},
                   key=lambda name: -np.median([np.log(s.worst) for s in shown if remedy(s.run) == name]))
    panels = [(lambda s: s.worst, "stretch − 1 near the pin", STRETCHED),
              (lambda s: s.mean_strain, "mean strain of the sheet", None),
              (lambda s: s.run.cpu_s / _baseline(stories, s.run.model).run.cpu_s,
               "CPU time, as published = 1", 1)]
    figure, axes = plt.subplots(1, len(panels), figsize=(12.6, 4.6), layout="constrained", sharey=True)
    for panel, (value, label, bound) in zip(axes, panels):
        for place, model in enumerate(MODELS):
            some = [s for s in shown if s.run.model == model]
            panel.plot([value(s) for s in some],
                       [names.index(remedy(s.run)) + 0.2 * (place - 1) for s in some],
                       label=style.model_name(model), **style.look(model, linestyle="", markersize=5))
        if bound:
            panel.axvline(bound, color=style.GREY, linewidth=0.8, linestyle="--")
        panel.set_xscale("log")
        panel.set_xlabel(label)
    axes[0].set_yticks(range(len(names)), labels=names)
    axes[0].invert_yaxis()
    axes[-1].set_xlim(0.5, 16)
    axes[-1].set_xticks([1, 2, 4, 8], labels=["1", "2", "4", "8"])
    axes[-1].minorticks_off()
    axes[-1].legend(loc="upper left", bbox_to_anchor=(1, 1))
    always = [name for name in names if all(s.worst < STRETCHED for s in shown if remedy(s.run) == name)]
    figure.suptitle("Remedies that keep the stretch at the pin below 2 with each of these models: "
                    + (", ".join(always) or "none"), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_stability_pin_remedies")


def _force(stories, out):
    figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
    settings = [(ring, substeps) for ring in (0, 1) for substeps in (1, 4)]
    models = list(dict.fromkeys(s.run.model for s in stories))
    for s in stories:
        place = settings.index((s.run.get("/pins/ring"), s.run.get("/solver/substeps")))
        axes.plot(models.index(s.run.model) + 0.16 * (place - 1.5), s.worst, "os^D"[place],
                  color=style.SEQUENCE[place])
    for place, (ring, substeps) in enumerate(settings):
        axes.plot([], [], "os^D"[place], color=style.SEQUENCE[place],
                  label=f"{'1-ring pinned' if ring else 'bare pin'}, {substeps} "
                  f"substep{'s' if substeps > 1 else ''}")
    axes.axhline(STRETCHED, color=style.GREY, linewidth=0.8, linestyle="--")
    axes.set_yscale("log")
    axes.set_xticks(range(len(models)), labels=[style.model_name(model) for model in models])
    axes.set_ylabel("stretch − 1 near the pin")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    held = [s for s in stories if s.worst < STRETCHED]
    axes.set_title(f"A large force: {len(held)} of {len(stories)} settings keep the stretch at the pin below "
                   "2")
    return style.save(figure, out, "fig_stability_pin_force")


def _table(caption, stories):
    def time(t):
        return f"{t:.2f}" if np.isfinite(t) else "never"

    rows = []
    for s in sorted(stories, key=lambda s: (s.run.model, remedy(s.run))):
        base = _baseline(stories, s.run.model)
        rows.append([s.run.model, remedy(s.run), time(s.overshot_at), time(s.degenerate_at),
                     time(s.failed_at), style.number(s.worst), style.number(s.mean_strain),
                     f"{s.run.cpu_s / base.run.cpu_s:.2f}" if base else "–"])
    return Table(caption, ["model", "remedy", "overshoots at (s)", "degenerate at (s)", "strain fails at (s)",
                           "stretch − 1, last ½ s", "mean strain", "CPU time relative to published"], rows)


if __name__ == "__main__":
    figure_main(main)
