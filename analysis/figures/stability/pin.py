"""A sheet that hangs from one corner, frame by frame: what fails first, and which remedies help?"""
from dataclasses import dataclass

import numpy as np

from bendlab.results.load import group
from runs.sweeps import load_experiment
from tables.chart import Chart
from tables.table import Table

NEEDLE = 4.0  # longest over shortest edge; from here on the run file's metrics count a needle
CAP = 160.0  # degrees; a triangle with a larger angle is a cap
STRETCHED = 1.0  # stretch - 1; above it a triangle's strain has failed: more than twice its length at rest
NEAR = 2  # rings around the pinned vertices; triangles within are followed
MODELS = ["none", "crossover", "dihedral"]


@dataclass
class Story:
    """The worst triangle near the pin of one run, in each of F frames."""

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
        """Time of the first degenerate triangle: a needle or a cap."""
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
        """Largest stretch - 1 near the pin, median over the last half second."""
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
    """Three arrays (F) of maxima over these triangles: stretch - 1, ratio of edges, angle in degrees."""
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
    """(F) largest displacement of a vertex by constraints in a frame, in mean edge lengths.

    The displacement is the distance from the free flight x + (x - previous x) + h² g.
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
    """Text: how a run's settings differ from the published settings (one pinned vertex, ten iterations)."""
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


def main(results, out, section):
    stories = [story(run) for name in ("bending", "solver", "tethers", "strain")
               for run in section.uses(load_experiment(results, f"one_pin/{name}"))]
    force = [story(run) for run in section.uses(load_experiment(results, "one_pin/force"))]
    section.text += " " + plain_text(stories)
    drawn = [s for s in stories if s.run.model in MODELS]
    if drawn:
        section.tables += [_frames(drawn), _table("pin", "At the pin", stories)]
        section.charts += [
            Chart("pin_frames", message(stories), "pin_frames", "time", ["stretch", "ratio", "correction"],
                  ["remedy"],
                  held=["model"], scale="linear", y_scale="log", look="", limits=[
                      ("stretch", STRETCHED, "strain has failed"), ("ratio", NEEDLE, "degenerate"),
                      ("correction", 1, "overshoots")],
                  note="Each curve is the worst triangle near the pin in every other frame."),
            Chart("pin_remedies",
                  "Remedies that keep the stretch at the pin below 2 with each of these models: "
                  + (", ".join(always_held(drawn)) or "none"), "pin", "remedy",
                  ["worst", "mean_strain", "cost"], ["model"], scale="band", y_scale="log",
                  limits=[("worst", STRETCHED, "twice as long")],
                  note="Largest stretch near the pin and mean strain of the sheet (medians over the last "
                       "half second), and CPU time over CPU time of the published settings. The orders 'mesh "
                       "order' and 'nearest to the pin first' use the oracle, the scalar code that projects "
                       "one constraint after another.")]
    if force:
        held = sum(s.worst < STRETCHED for s in force)
        section.tables.append(_table("pin_force", "Under a force of three times the weight", force))
        section.charts.append(Chart(
            "pin_force",
            f"A large force: {held} of {len(force)} settings keep the stretch at the pin below 2",
            "pin_force", "model", ["worst"], ["setting"], scale="band", y_scale="log", look="",
            limits=[("worst", STRETCHED, "twice as long")],
            note="The case of the follow-up paper: a force of three times the weight, sideways and down."))


def _frames(stories):
    """Stretch, shape and correction of every other frame."""
    rows = [{"model": s.run.model, "remedy": remedy(s.run), "time": s.time[i]}
            | {name: max(getattr(s, name)[i], 1e-3) for name in ("stretch", "ratio", "correction")}
            for s in sorted(stories, key=lambda s: (remedy(s.run) != "as published", remedy(s.run)))
            for i in range(0, len(s.time), 2)]
    return Table.of("pin_frames", "",
                    ["model", "remedy", ("time", "time", "", "s"), ("stretch", "stretch − 1"),
                     ("ratio", "longest over shortest edge"),
                     ("correction", "correction", "", "edges")], rows)


def always_held(stories):
    """The remedies with which no model's stretch near the pin reaches 2."""
    return [name for name, same_remedy in group(stories, lambda s: remedy(s.run)).items()
            if all(s.worst < STRETCHED for s in same_remedy)]


def message(stories):
    """The title: does a triangle fail first in strain or in shape, and when do corrections overshoot?"""
    failed = [s for s in stories if np.isfinite(s.failed_at)]
    before = sum(s.failed_at <= s.degenerate_at for s in failed)
    overshot = [s for s in failed if np.isfinite(s.overshot_at)]
    after = sum(s.overshot_at >= s.degenerate_at for s in overshot)
    return (f"In {before} of {len(failed)} failed runs, a triangle at the pin is stretched to twice its "
            f"length before a triangle is degenerate. Corrections overshoot in {len(overshot)} failed runs, "
            f"in {after} of these runs only after a triangle is degenerate")


def plain_text(stories):
    """What the runs with plain strain constraints and the bare pin show about overshooting."""
    plain = [s for s in stories if remedy(s.run) == "plain shear and stretch"]
    failed = [s for s in plain if np.isfinite(s.failed_at)]
    quiet = [s for s in failed if not np.isfinite(s.overshot_at)]
    if not failed:
        return ""
    text = (f"With plain shear and stretch, the strain at the pin fails in {len(failed)} of {len(plain)} "
            f"runs, and in {len(quiet)} of these runs no correction overshoots. ")
    if len(quiet) == len(failed):
        text += ("So the cause of the failure at the pin is that the solver does not converge: one vertex "
                 "carries the whole weight. Overshooting makes the rest of the sheet fail, too.")
    return text


def _baseline(stories, model):
    return next((s for s in stories if s.run.model == model and remedy(s.run) == "as published"), None)


def _table(id, caption, stories):
    rows = []
    for s in sorted(stories, key=lambda s: (s.run.model, remedy(s.run))):
        base, ring, substeps = _baseline(stories,
                                         s.run.model), s.run.get("/pins/ring"), s.run.get("/solver/substeps")
        rows.append({"model": s.run.model, "remedy": remedy(s.run), "overshot": s.overshot_at,
                     "degenerate": s.degenerate_at, "failed": s.failed_at, "worst": s.worst,
                     "mean_strain": s.mean_strain, "cost": s.run.cpu_s / base.run.cpu_s if base else None,
                     "setting": f"{'1-ring pinned' if ring else 'bare pin'}, {substeps} "
                     f"substep{'s' if substeps > 1 else ''}"})
    return Table.of(id, caption, [
        "model", "remedy", ("overshot", "overshoots at", ".2f", "s"),
        ("degenerate", "degenerate at", ".2f", "s"),
        ("failed", "strain fails at", ".2f", "s"), ("worst", "stretch − 1, last ½ s"),
        ("mean_strain", "mean strain"), ("cost", "CPU time over published settings", ".2f")], rows)
