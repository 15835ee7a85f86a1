"""The paper's promise: Fig. 5 with a third row for the recommended settings, and a table of the demands. The
promise of equal stiffness is measured on strips (promise_strip.py).

The rows: crossover springs with the pin alone, the paper's adaptive springs with the pin and its 1-ring, and
the recommended settings with the pin alone. All sheets hang in one medium for 4 s, and most then are at rest.
"""
import numpy as np

from bendlab.results.load import group, select
from draw import cloth, frames
from figures.accuracy.measures import cost
from runs.strips import cells as cells_of
from runs.sweeps import used_runs
from tables.numbers import number
from tables.section import Claim, Table, address

SCENES = {"one corner": ["upper_right"], "two corners": ["upper_left", "upper_right"], "curtain": ["top"]}
OURS, PAPER, CROSSOVER = "recommended", "paper's adaptive", "crossover"
ROWS = {CROSSOVER: "crossover, pin alone\n(the paper's Fig. 5a)",
        PAPER: "adaptive, pin + 1-ring\n(the paper's)",
        OURS: "recommended, pin alone\n(ours)"}
# (metric, offset, bound for every scene and N, label). The last one is the largest value over all frames.
METRICS = [("pin_max_stretch", 1, 0.3, "stretch − 1 at the pin, at rest"),
           ("max_stretch", 1, 0.3, "stretch − 1 anywhere, at rest"),
           ("mean_strain", 0, 0.02, "mean strain, at rest"),
           ("worst_stretch", 1, None, "stretch − 1 anywhere, at any time")]
COLUMNS = [(metric, label) for metric, *_, label in METRICS]
DROP, SAME_DROP = "drop, largest over smallest − 1", 0.02
MOST_FRAMES = 61  # of each moving cloth in the page
MOVING = 32  # N of the moving cloths in the page
MOST_CONSTRAINTS = 4  # of bending, per vertex, at N = 128
TIMED = (64, 128)  # N of the compared times


def main(results, out, section):
    ours = used_runs(section, results, "recommended", "paper/recommended_full")
    paper = used_runs(section, results, "paper/promise", "paper/promise_full")
    floor, rounded = (select(paper, bending__adaptive__m_rounding=name) for name in ("floor", "round"))
    corner = {CROSSOVER: used_runs(section, results, "paper/fig5_rest"), PAPER: floor, OURS: ours}
    corner = {name: _by_cells(_in_scene(runs, "one corner")) for name, runs in corner.items()}
    samples = {(name, n): (run, run.frames - 1) for name, runs in corner.items() for n, run in runs.items()
               if n <= 128}
    if samples:
        of_ours = [sample for (name, _), sample in samples.items() if name == OURS]
        camera = cloth.camera_of(of_ours or samples.values(), aspect=None)
        close = cloth.camera_of(samples.values(), zoom=0.05)
        section.pictures += [
            (_sheet(samples, camera, "max_stretch", out, "fig_5_promise"),
             "Sheets after 4 s in a medium with about the drag of air. The text in a corner says whether a "
             "sheet is at rest. The number is a median over the last second, as in the tables. All panels "
             "have one camera. Back faces are bluish."),
            (_sheet(samples, close, "pin_max_stretch", out, "fig_5_promise_pin"),
             "The pin (dot) and the triangles around it, in the last frames. The region shown is a twentieth "
             "of the sheet wide.")]
    moving = {address(name): runs[MOVING] for name, runs in corner.items() if MOVING in runs}
    section.frames = frames.of_runs(moving, MOST_FRAMES)
    iterations = used_runs(section, results, "paper/recommended_iterations_full")
    section.tables += [_goals_table(ours, floor, rounded), _iterations_table(iterations),
                       _numbers_table("runs_recommended", ours, OURS),
                       _numbers_table("runs_paper", paper, PAPER)]
    section.claims += [_sound_claim(ours, corner), _cost_claim(ours, floor)]


def _in_scene(runs, scene):
    return [run for run in runs if run.get("/pins/vertices") == SCENES[scene]]


def _by_cells(runs):
    return {cells_of(run): run for run in sorted(runs, key=cells_of)}


def _sheet(samples, camera, metric, out, picture):
    """Draws a row of panels per setting, with a panel per N. The text in each panel is the median of a metric
    over the last second, as in tables and claims. `samples`: (setting, N) → (run, frame)."""
    whole = metric == "max_stretch"
    panel = lambda n, sample: cloth.Panel(
        sample, camera, f"N = {n}", f"{'largest' if whole else 'pin'} σ₁ − 1 = "
        f"{number(_worst([sample[0]], metric, 1), 3)}" if sample else "", whole)
    cells = sorted({n for _, n in samples})
    rows = {title: [panel(n, samples.get((name, n))) for n in cells] for name, title in ROWS.items()}
    return cloth.sheet(rows, out, picture, inches=2.3)


def _worst(runs, metric, offset):
    """The largest value of a metric, minus `offset`. NaN if a run lacks the metric."""
    values = [run.summary.get(metric, np.nan) for run in runs]
    return float(np.max(values)) - offset if values else np.nan


def _drop_ratio(runs, scene):
    """Largest drop over smallest drop, minus 1, of the runs of a scene."""
    drops = [run.summary.get("drop", np.nan) for run in _in_scene(runs, scene)]
    return max(drops) / min(drops) - 1 if drops and np.isfinite(drops).all() else np.nan


def _least_ms(runs, n):
    """The least CPU time per frame of all scenes with n cells, in ms. (Other programs can only add time.)"""
    return min((cost(run) for run in runs if cells_of(run) == n), default=np.nan)


def _goals_table(ours, floor, rounded):
    """A row per demand of the promise, with values for the paper's springs and for ours, and the bound."""
    def per_vertex(runs):
        run = _by_cells(_in_scene(runs, "one corner")).get(128)
        return run.summary["bending_constraints"] / run.summary["vertices"] if run else None

    both = (floor, ours)
    rows = [(f"{label}, largest of all scenes and N", *(_worst(runs, metric, offset) for runs in both), bound)
            for metric, offset, bound, label in METRICS]
    rows += [(f"{DROP}: {scene}", *(_drop_ratio(runs, scene) for runs in both), SAME_DROP)
             for scene in SCENES]
    rows.append(("bending constraints per vertex, N = 128", *map(per_vertex, both), MOST_CONSTRAINTS))
    for n in TIMED:
        paper_ms, our_ms, rounded_ms = (_least_ms(runs, n) for runs in (floor, ours, rounded))
        rows += [(f"CPU time per frame, N = {n} (least of the scenes), ms", paper_ms, our_ms, paper_ms),
                 (f"CPU time per frame, m rounded to the nearest, N = {n}, ms", rounded_ms, None, None)]
    return Table.of(
        "promise", "The demands of the promise, for one corner, two corners and the curtain, on every N",
        [("what", "demand"), ("paper", "the paper's adaptive springs"), ("ours", "recommended"),
         ("bound", "at most")], rows)


def _iterations_table(runs):
    groups = group(runs, lambda run: run.get("/solver/iterations"))
    rows = [(iterations, *(_worst(own_runs, metric, offset) for metric, offset, *_ in METRICS),
             *(100 * _drop_ratio(own_runs, scene) for scene in SCENES),
             *(_least_ms(own_runs, n) for n in TIMED)) for iterations, own_runs in sorted(groups.items())]
    return Table.of(
        "iterations", "The recommended settings with different numbers of iterations: largest values of "
        "three scenes and of every N up to 256",
        ["iterations", *COLUMNS, *((scene, f"{DROP}: {scene}", ".1f", "%") for scene in SCENES),
         *((f"ms_{n}", f"CPU time per frame, N = {n}", "", "ms") for n in TIMED)], rows)


def _numbers_table(id, runs, name):
    rounding = lambda run: run.get("/bending/adaptive/m_rounding", "–")
    rows = [{"scene": scene, "rounding": rounding(run), "N": cells_of(run), "drop": run.summary.get("drop"),
             "ms": cost(run), "status": run.status}
            | {metric: _worst([run], metric, offset) for metric, offset, *_ in METRICS}
            for scene in SCENES
            for run in sorted(_in_scene(runs, scene), key=lambda run: (rounding(run), cells_of(run)))]
    return Table.of(id, f"Each run: {name}", [
        "scene", ("rounding", "m by"), "N", *COLUMNS, ("drop", "drop", ".3f", "m"),
        ("ms", "CPU time per frame", ".2f", "ms"), ("status", "verdict")], rows)


def _is_whole(runs):
    """Whether all runs are complete, and all scenes have runs with the same N, also with N = 128."""
    cells = [sorted(_by_cells(_in_scene(runs, scene))) for scene in SCENES]
    return 128 in cells[0] and cells[0] == cells[1] == cells[2] and all(run.complete for run in runs)


def _sound_claim(ours, corner):
    numbers = {f"{label}, largest of all scenes and N": _worst(ours, metric, offset)
               for metric, offset, _, label in METRICS}
    holds = all(value <= bound for value, (*_, bound, _) in zip(numbers.values(), METRICS) if bound)
    numbers |= {f"{name.split()[-1]}, one corner, N = 128: stretch − 1 anywhere, at rest":
                _worst([runs[128]] if 128 in runs else [], "max_stretch", 1) for name, runs in corner.items()}
    cells = sorted(map(cells_of, ours)) or [0]
    return Claim("5", "Cloth fails neither at a pin nor elsewhere if its mesh is refined (the paper's "
                 "promise, with our recommended settings).", f"at rest, in the three scenes on {cells[0]} to "
                 f"{cells[-1]} cells, no stretch − 1 is above 0.3 and no mean strain above 0.02", numbers,
                 holds if _is_whole(ours) else None)


def _cost_claim(ours, paper):
    least = {n: (_least_ms(ours, n), _least_ms(paper, n)) for n in TIMED}
    numbers = {f"{name}, N = {n}: CPU ms per frame": value for n, values in least.items()
               for name, value in zip(("recommended", "paper"), values)}
    return Claim("5", "This costs no more time than the paper's adaptive springs (the paper's promise, with "
                 "our recommended settings).", "the least CPU time per frame of the three scenes is at most "
                 "that of the paper's springs with m rounded down, on 64 and on 128 cells", numbers,
                 all(mine <= theirs for mine, theirs in least.values())
                 if _is_whole(ours) and _is_whole(paper) else None)
