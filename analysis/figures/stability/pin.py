"""A sheet that hangs from one corner, frame by frame: what fails first, and which remedies help?"""
import numpy as np

from bendlab.results.load import group
from runs.stretch import principal_stretches, ring_of
from runs.sweeps import used_runs
from tables.table import Table

NEEDLE = 4.0  # longest over shortest edge; from here on the run file's metrics count a needle
CAP = 160.0  # degrees; a triangle with a larger angle is a cap
STRETCHED = 1.0  # stretch - 1; above it a triangle's strain has failed: more than twice its length at rest
NEAR = 2  # rings around the pinned vertices; triangles within are followed
MODELS = ["none", "crossover", "dihedral"]
PUBLISHED = "as published"


class Story:
    """The worst triangle near the pin of one run, and the times (s) of what fails first, inf if never."""

    def __init__(self, run):
        rest, triangles, pinned = run.rest_positions, run.triangles, run.pinned
        near = ring_of(triangles, pinned, len(rest)) <= NEAR
        at_pin = triangles[near[triangles].any(axis=1) & ~pinned[triangles].all(axis=1)]
        frames, time = run.trajectory(), run.metrics["time"]
        self.run, self.model, self.remedy, self.time = run, run.model, remedy(run), time
        # Arrays over frames: the largest stretch - 1, the largest ratio of longest to shortest edge, and the
        # largest displacement of a vertex by constraints, in mean edges.
        self.stretch = principal_stretches(rest, frames, at_pin)[0].max(axis=1) - 1
        self.ratio, angle = _shape(frames, at_pin)
        self.correction = _corrections(run, frames, np.unique(at_pin))
        first = lambda values, bound: next(iter(time[values > bound]), np.inf)
        self.failed = first(self.stretch, STRETCHED)
        self.degenerate = min(first(self.ratio, NEEDLE), first(angle, CAP))
        self.overshot = first(self.correction, 1)
        last = time > time[-1] - 0.5
        self.worst = float(np.median(self.stretch[last]))
        self.mean_strain = float(np.median(run.metrics["mean_strain"][last]))  # of the whole sheet


def _shape(frames, triangles):
    """Two arrays (F) of maxima over these triangles: ratio of longest to shortest edge, angle in degrees."""
    corners = frames[:, triangles]
    edges = np.sort(np.linalg.norm(np.roll(corners, -1, axis=2) - corners, axis=3), axis=2)
    short, middle, long = np.moveaxis(np.maximum(edges, 1e-12), 2, 0)
    cosine = (short**2 + middle**2 - long**2) / (2 * short * middle)
    return (long / short).max(axis=1), np.degrees(np.arccos(np.clip(cosine, -1, 1))).max(axis=1)


def _corrections(run, frames, vertices):
    """(F) largest displacement of a vertex by constraints in a frame, in mean edge lengths. The displacement
    is the distance from the free flight x + (x - previous x) + h² g."""
    x = frames[:, vertices[~run.pinned[vertices]]]
    gravity = sum(np.array(effect["acceleration"]) for effect in run.get("/effects")
                  if effect["type"] == "gravity")
    step = np.diff(run.metrics["time"]).mean()
    moved = np.linalg.norm(x[2:] - 2 * x[1:-1] + x[:-2] - step**2 * gravity, axis=2).max(axis=1)
    first, second, _ = run.rest_positions[run.triangles.T]
    return np.concatenate([[0, 0], moved / np.linalg.norm(first - second, axis=1).mean()])


def remedy(run):
    """Text: how a run's settings differ from the published settings (one pinned vertex, ten iterations)."""
    solver, strain = run.get("/solver"), run.get("/material/strain")
    iterations = solver["iterations"]
    return ", ".join(name for name, has in {
        "1-ring pinned": run.get("/pins/ring") > 0,
        f"{iterations} iteration{'s' if iterations > 1 else ''}": iterations != 10,
        f"{solver['substeps']} substeps": solver["substeps"] > 1,
        "mesh order": solver["order"] == "mesh",
        "nearest to the pin first": solver["order"] == "pins",
        "bending first": solver["first"] == "bending",
        "plain shear and stretch": strain["form"] == "green",
        "shear as an angle": strain["form"] == "angle",
        f"shear k = {strain['shear']:g}": strain["shear"] < 1,
        "tethers": any(effect["type"] == "tethers" for effect in run.get("/effects"))}.items()
        if has) or PUBLISHED


def main(results, out, section):
    configs = [f"one_pin/{name}" for name in ("bending", "solver", "tethers", "strain")]
    stories = [Story(run) for run in used_runs(section, results, *configs)]
    force = [Story(run) for run in used_runs(section, results, "one_pin/force")]
    section.text += " " + plain_text(stories)
    drawn = [story for story in stories if story.model in MODELS]
    if drawn:
        held = [name for name, same_remedy in group(drawn, lambda story: story.remedy).items()
                if all(story.worst < STRETCHED for story in same_remedy)]
        section.add_chart(
            _frames(drawn), message(stories), "time", ["stretch", "ratio", "correction"], ["remedy"],
            held=["model"], scale="linear", y_scale="log", look="", limits=[
                ("stretch", STRETCHED, "strain has failed"), ("ratio", NEEDLE, "degenerate"),
                ("correction", 1, "overshoots")],
            note="Each curve is the worst triangle near the pin in every other frame.")
        section.add_chart(
            _table("pin", "At the pin", stories),
            "Remedies that keep the stretch at the pin below 2 with each of these models: "
            + (", ".join(held) or "none"), "remedy", ["worst", "mean_strain", "cost"], id="pin_remedies",
            scale="band", y_scale="log", limits=[("worst", STRETCHED, "twice as long")],
            note="Largest stretch near the pin and mean strain of the sheet (medians over the last half "
                 "second), and CPU time over CPU time of the published settings. The orders 'mesh order' and "
                 "'nearest to the pin first' use the oracle, the scalar code that projects one constraint "
                 "after another.")
    if force:
        held = sum(story.worst < STRETCHED for story in force)
        section.add_chart(
            _table("pin_force", "Under a force of three times the weight", force),
            f"A large force: {held} of {len(force)} settings keep the stretch at the pin below 2", "model",
            ["worst"], ["setting"], scale="band", y_scale="log", look="",
            limits=[("worst", STRETCHED, "twice as long")],
            note="The case of the follow-up paper: a force of three times the weight, sideways and down.")


def _frames(stories):
    """A table of stretch, shape and correction in every other frame."""
    rows = [{"model": story.model, "remedy": story.remedy, "time": time, "stretch": max(stretch, 0),
             "ratio": ratio, "correction": max(correction, 0)}
            for story in sorted(stories, key=lambda story: (story.remedy != PUBLISHED, story.remedy))
            for time, stretch, ratio, correction in zip(
                story.time[::2], story.stretch[::2], story.ratio[::2], story.correction[::2])]
    return Table.of("pin_frames", "", [
        "model", "remedy", ("time", "time", "", "s"), ("stretch", "stretch − 1"),
        ("ratio", "longest over shortest edge"), ("correction", "correction", "", "edges")], rows)


def message(stories):
    """The title: does a triangle fail first in strain or in shape, and when do corrections overshoot?"""
    failed = [story for story in stories if np.isfinite(story.failed)]
    before = sum(story.failed <= story.degenerate for story in failed)
    overshot = [story for story in failed if np.isfinite(story.overshot)]
    after = sum(story.overshot >= story.degenerate for story in overshot)
    return (f"In {before} of {len(failed)} failed runs, a triangle at the pin is stretched to twice its "
            f"length before a triangle is degenerate. Corrections overshoot in {len(overshot)} failed runs, "
            f"in {after} of these runs only after a triangle is degenerate")


def plain_text(stories):
    """What the runs with plain strain constraints and the bare pin show about overshooting."""
    plain = [story for story in stories if story.remedy == "plain shear and stretch"]
    failed = [story for story in plain if np.isfinite(story.failed)]
    quiet = sum(np.isinf(story.overshot) for story in failed)
    if not failed:
        return ""
    text = (f"With plain shear and stretch, the strain at the pin fails in {len(failed)} of {len(plain)} "
            f"runs, and in {quiet} of these runs no correction overshoots. ")
    if quiet == len(failed):
        text += ("So the cause of the failure at the pin is that the solver does not converge: one vertex "
                 "carries the whole weight. Overshooting makes the rest of the sheet fail, too.")
    return text


def _table(id, caption, stories):
    published = {story.model: story.run.cpu_s for story in reversed(stories) if story.remedy == PUBLISHED}
    rows = []
    for story in sorted(stories, key=lambda story: (story.model, story.remedy)):
        run, substeps = story.run, story.run.get("/solver/substeps")
        rows.append({name: getattr(story, name) for name in ("model", "remedy", "overshot", "degenerate",
                                                             "failed", "worst", "mean_strain")} | {
            "cost": run.cpu_s / published[story.model] if story.model in published else None,
            "setting": f"{'1-ring pinned' if run.get('/pins/ring') else 'bare pin'}, {substeps} "
                       f"substep{'s' if substeps > 1 else ''}"})
    return Table.of(id, caption, [
        "model", "remedy", ("overshot", "overshoots at", ".2f", "s"),
        ("degenerate", "degenerate at", ".2f", "s"), ("failed", "strain fails at", ".2f", "s"),
        ("worst", "stretch − 1, last ½ s"), ("mean_strain", "mean strain"),
        ("cost", "CPU time over published settings", ".2f")], rows)
