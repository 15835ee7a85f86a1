"""The paper's promise: Fig. 5 with a third row for the recommended settings, and a table of the demands. The
promise of equal stiffness is measured on strips (promise_strip.py).

The rows: crossover springs with the pin alone, the paper's adaptive springs with the pin and its 1-ring, and
the recommended settings with the pin alone. All sheets hang in one medium for 4 s, and most then are at rest.
"""
import re

import numpy as np

from draw import cloth, page_frames
from tables.numbers import number
from bendlab.results.load import group, select
from tables.section import Claim
from tables.table import Table
from runs.sweeps import load_experiment

SCENES = {"one corner": ["upper_right"], "two corners": ["upper_left", "upper_right"], "curtain": ["top"]}
OURS, PAPER, CROSSOVER = "recommended", "paper's adaptive", "crossover"
ROWS = {CROSSOVER: "crossover, pin alone\n(the paper's Fig. 5a)",
        PAPER: "adaptive, pin + 1-ring\n(the paper's)",
        OURS: "recommended, pin alone\n(ours)"}
# (metric, offset, bound for every scene and N, label)
GOALS = [("pin_max_stretch", 1, 0.3, "stretch − 1 at the pin, at rest"),
         ("max_stretch", 1, 0.3, "stretch − 1 anywhere, at rest"),
         ("mean_strain", 0, 0.02, "mean strain, at rest")]
EVER = ("worst_stretch", 1, "stretch − 1 anywhere, at any time")  # largest over all frames
SAME_DROP = 0.02
MOST_FRAMES = 61  # of each moving cloth in the page
MOVING = 32  # N of the moving cloths in the page
MOST_CONSTRAINTS = 4  # of bending, per vertex, at N = 128


def main(results, out, section):
    ours = section.uses(load_experiment(results, "recommended"))
    ours = ours + load_experiment(results, "paper/recommended_full").runs
    paper = section.uses(load_experiment(results, "paper/promise"))
    paper = paper + load_experiment(results, "paper/promise_full").runs
    crossover = section.uses(load_experiment(results, "paper/fig5_rest"))
    floor = [run for run in paper if run.get("/bending/adaptive/m_rounding") == "floor"]
    corner = {CROSSOVER: crossover, PAPER: _in_scene(floor, "one corner"),
              OURS: _in_scene(ours, "one corner")}
    if any(corner.values()):
        section.pictures.append((_sheets(corner, out), "Sheets after 4 s in a medium with about the drag of "
                                 "air. The text in a corner says whether a sheet is at rest. The number is a "
                                 "median over the last second, as in the tables. All panels have one camera. "
                                 "Back faces are bluish."))
        section.pictures.append((_close_ups(corner, out), "The pin (dot) and the triangles around it, in the "
                                 "last frames. The region shown is a twentieth of the sheet wide."))
    moving = {address(name): run for name, runs in corner.items() for n, run in _by_cells(runs).items()
              if n == MOVING}
    section.frames = page_frames.of_runs(moving, MOST_FRAMES)
    iterations = load_experiment(results, "paper/recommended_iterations_full").runs
    section.tables += [_goals_table(ours, paper), _iterations_table(iterations), _numbers_table(ours, OURS),
                       _numbers_table(paper, PAPER)]
    section.claims += [_sound_claim(ours, corner), _cost_claim(ours, floor)]


def address(name):
    """The id of a row of pictures in the page."""
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")


def _in_scene(runs, scene):
    return [run for run in runs if run.get("/pins/vertices") == SCENES[scene]]


def _by_cells(runs):
    return {run.get("/mesh/cells"): run for run in sorted(runs, key=lambda run: run.get("/mesh/cells"))}


def _sheets(rows, out):
    samples = _last_frames(rows)
    camera = cloth.camera_of([samples[key] for key in samples if key[0] == OURS] or samples.values(),
                             aspect=None)
    return _panels(samples, camera, "max_stretch", out, "fig_5_promise")


def _close_ups(rows, out):
    samples = _last_frames(rows)
    camera = cloth.camera_of(samples.values(), zoom=0.05)
    return _panels(samples, camera, "pin_max_stretch", out, "fig_5_promise_pin")


def _last_frames(rows):
    """(name of a row, N) → (run, index of the last frame), for N up to 128."""
    return {(name, n): (run, run.frames - 1) for name, runs in rows.items()
            for n, run in _by_cells(runs).items() if n <= 128}


def _panels(samples, camera, metric, out, picture):
    """Draws a row of panels per setting, with a panel per N, and writes the metric into each panel."""
    cells = sorted({n for _, n in samples})
    rows = {title: [cloth.Panel(samples.get((name, n)), camera, f"N = {n}",
                                _stretch_text(samples.get((name, n)), metric), metric == "max_stretch")
                    for n in cells] for name, title in ROWS.items()}
    return cloth.sheet(rows, out, picture, inches=2.3)


def _stretch_text(sample, metric):
    """The metric as text: the median over the last second, as in tables and claims."""
    if not sample:
        return ""
    where = "pin" if metric == "pin_max_stretch" else "largest"
    return f"{where} σ₁ − 1 = {number(sample[0].summary.get(metric, np.nan) - 1, 3)}"


def _worst(runs, metric, offset):
    """The largest value of a metric, minus `offset`. NaN if a run lacks the metric."""
    return max((run.summary.get(metric, np.nan) - offset for run in runs), default=np.nan,
               key=lambda value: np.inf if np.isnan(value) else value)


def _drop_ratio(runs, scene):
    """Largest drop over smallest drop, minus 1, of the runs of a scene."""
    drops = [run.summary.get("drop", np.nan) for run in _in_scene(runs, scene)]
    return max(drops) / min(drops) - 1 if drops and np.isfinite(drops).all() else np.nan


def _ms(run):
    """CPU time of the steps per frame of 1/60 s, in ms."""
    simulated = run.metrics["time"][-1]
    return 1e3 * run.step_cpu_s / (60 * simulated) if simulated > 0 else np.nan


def _at(runs, n):
    """The run with one pinned corner and n cells, or None."""
    return _by_cells(_in_scene(runs, "one corner")).get(n)


def _least_ms(runs, n):
    """The least CPU time per frame of all scenes with n cells, in ms. (Other programs can only add time.)"""
    return min((_ms(run) for run in runs if run.get("/mesh/cells") == n), default=np.nan)


def _goals_table(ours, paper):
    """A row per demand of the promise, with values for the paper's springs and for ours, and the bound."""
    floor, rounded = (select(paper, bending__adaptive__m_rounding=rounding)
                      for rounding in ("floor", "round"))
    rows = [{"what": f"{label}, largest of all scenes and N", "paper": _worst(floor, metric, offset),
             "ours": _worst(ours, metric, offset), "bound": bound}
            for metric, offset, bound, label in (*GOALS, (EVER[0], EVER[1], None, EVER[2]))]
    rows += [{"what": f"drop, largest over smallest − 1: {scene}", "paper": _drop_ratio(floor, scene),
              "ours": _drop_ratio(ours, scene), "bound": SAME_DROP} for scene in SCENES]
    per_vertex = [run.summary["bending_constraints"] / run.summary["vertices"] if run else None
                  for run in (_at(floor, 128), _at(ours, 128))]
    rows.append({"what": "bending constraints per vertex, N = 128", "paper": per_vertex[0],
                 "ours": per_vertex[1],
                 "bound": MOST_CONSTRAINTS})
    for n in (64, 128):
        paper_ms = _least_ms(floor, n)
        rows += [{"what": f"CPU time per frame, N = {n} (least of the scenes), ms", "paper": paper_ms,
                  "ours": _least_ms(ours, n), "bound": paper_ms},
                 {"what": f"CPU time per frame, m rounded to the nearest, N = {n}, ms",
                  "paper": _least_ms(rounded, n)}]
    return Table.of("promise", "The demands of the promise, for one corner, two corners and the curtain, on "
                               "every N", [
        ("what", "demand"), ("paper", "the paper's adaptive springs"), ("ours", "recommended"),
                                   ("bound", "at most")], rows)


def _iterations_table(runs):
    rows = [{"iterations": iterations}
            | {metric: _worst(own_runs, metric, offset) for metric, offset, *_ in (*GOALS, EVER)}
            | {scene: 100 * _drop_ratio(own_runs, scene) for scene in SCENES}
            | {f"ms_{n}": _least_ms(own_runs, n) for n in (64, 128)}
            for iterations, own_runs in sorted(group(
                runs, lambda run: run.get("/solver/iterations")).items())]
    return Table.of("iterations", "The recommended settings with different numbers of iterations: largest "
                                  "values of three scenes and of every N up to 256", [
                        "iterations", *((metric, label) for metric, _, *_, label in (*GOALS, EVER)),
                        *((scene, f"drop, largest over smallest − 1: {scene}", ".1f", "%")
                          for scene in SCENES),
                        *((f"ms_{n}", f"CPU time per frame, N = {n}", "", "ms") for n in (64, 128))], rows)


def _numbers_table(runs, name):
    rows = [{"scene": scene, "rounding": run.get("/bending/adaptive/m_rounding", "–"),
             "N": run.get("/mesh/cells"),
             "drop": run.summary.get("drop"), "ms": _ms(run), "status": run.status}
            | {metric: run.summary.get(metric, np.nan) - offset for metric, offset, *_ in (*GOALS, EVER)}
            for scene in SCENES for run in sorted(_in_scene(runs, scene), key=lambda run: (
                run.get("/bending/adaptive/m_rounding", ""), run.get("/mesh/cells")))]
    return Table.of("runs_recommended" if name == OURS else "runs_paper", f"Each run: {name}", [
        "scene", ("rounding", "m by"), "N", *((metric, label) for metric, _, *_, label in (*GOALS, EVER)),
        ("drop", "drop", ".3f", "m"), ("ms", "CPU time per frame", ".2f", "ms"), ("status", "verdict")], rows)


def _is_whole(runs):
    """Whether all runs are complete, and all scenes have runs with the same N, also with N = 128."""
    cells = [sorted(_by_cells(_in_scene(runs, scene))) for scene in SCENES]
    return 128 in cells[0] and cells[0] == cells[1] == cells[2] and all(run.complete for run in runs)


def _sound_claim(ours, corner):
    numbers, holds = {}, []
    for metric, offset, bound, label in GOALS:
        value = _worst(ours, metric, offset)
        numbers[f"{label}, largest of all scenes and N"] = value
        holds.append(value <= bound)
    metric, offset, label = EVER
    numbers[f"{label}, largest of all scenes and N"] = _worst(ours, metric, offset)
    numbers |= {f"{name.split()[-1]}, one corner, N = 128: stretch − 1 anywhere, at rest":
                _worst([run for run in runs if run.get("/mesh/cells") == 128], "max_stretch", 1)
                for name, runs in corner.items()}
    cells = sorted({run.get("/mesh/cells") for run in ours})
    return Claim("5", "Cloth fails neither at a pin nor elsewhere if its mesh is refined (the "
                 "paper's promise, with our recommended settings).",
                 f"at rest, in the three scenes on {min(cells, default=0)} to {max(cells, default=0)} cells, "
                 "no stretch − 1 is above 0.3 and no mean strain above 0.02",
                 numbers, all(holds) if _is_whole(ours) else None)


def _cost_claim(ours, paper):
    numbers, holds = {}, []
    for n in (64, 128):
        least = {name: _least_ms(runs, n) for name, runs in (("recommended", ours), ("paper", paper))}
        numbers |= {f"{name}, N = {n}: CPU ms per frame": value for name, value in least.items()}
        holds.append(least["recommended"] <= least["paper"])
    return Claim("5", "This costs no more time than the paper's adaptive springs (the paper's promise, with "
                 "our recommended settings).", "the least CPU time per frame of the three scenes is at most "
                 "that of the paper's springs with m rounded down, on 64 and on 128 cells", numbers,
                 all(holds) if _is_whole(ours) and _is_whole(paper) else None)
