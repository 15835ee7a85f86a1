"""The napkin: a disc that is clamped on a round table and hangs over its rim wrinkles at a critical load."""
import numpy as np

from bendlab.results.load import group
from runs import strips
from truths.napkin import Napkin

FLAT = 0.02  # a wave of less than this share of the sag is no wave: the mesh has six sides


def main(results, out, section):
    runs = strips.experiment_runs(results, section, "napkin_slow")
    rows, summary = [], []
    for own_runs in group(runs, strips.cells).values():
        own_runs.sort(key=strips.gravity)
        load, waves = theory(own_runs[0])
        found = [(strips.gravity(run), *wave(run)) for run in own_runs]
        rows += [{"cells": strips.cells(own_runs[0]), "gravity": g, "over": g / load,
                  "waves": n if amplitude > FLAT * sag else np.nan, "squared": 1e6 * amplitude**2,
                  "sag": 1e3 * sag} for g, n, amplitude, sag in found]
        wrinkled = [row for row in found if row[2] > FLAT * row[3]]
        measured = critical(wrinkled) if len(wrinkled) > 2 else np.nan
        run = own_runs[-1]
        if strips.cells(run) == max(map(strips.cells, runs)):
            section.checks += [
                strips.check(run, "gravity at which the disc wrinkles (m/s²)", load, measured, 0.03,
                             "second variation of a plate, analysis/truths/napkin.py"),
                strips.check(run, "number of waves", waves, float(wrinkled[0][1]) if wrinkled else np.nan, 0,
                             "second variation", "absolute")]
        summary.append({"cells": strips.cells(run), "theory": load, "measured": measured,
                        "error": 100 * (measured / load - 1),
                        "waves": wrinkled[0][1] if wrinkled else np.nan})
    if not rows:
        return
    section.add_table("critical", "Gravity at which a clamped disc wrinkles", [
        ("cells", "cells along the radius"), ("theory", "theory", ".4f", "m/s²"),
        ("measured", "measured", ".4f", "m/s²"), ("error", "error", "+.1f", "%")], summary)
    section.add_table("napkin", "Waves at the rim", [
        "cells", ("gravity", "gravity", "", "m/s²"),
        ("over", "gravity over the theoretical critical gravity", ".3f"),
        ("waves", "number of waves"), ("squared", "squared amplitude of the rim", ".4f", "mm²"),
        ("sag", "mean sag of the rim", ".3f", "mm")], rows)
    finest = max(summary, key=lambda row: row["cells"])
    section.add_chart("napkin", f"The disc wrinkles at {100 + finest['error']:.1f} % of the theoretical "
                      f"gravity, in {finest['waves']:.0f} waves", "over", ["squared"], ["cells"],
                      scale="linear", y_scale="linear", look="",
                      note="The squared amplitude grows from 0 at the critical load.")


def theory(run):
    """(critical gravity in m/s², number of waves)."""
    young, thickness, ratio = (run.get(f"/material/{name}")
                               for name in ("youngs_modulus", "thickness", "poisson_ratio"))
    rest = run.rest_positions
    radius = np.hypot(*rest[:, :2].T)
    membrane, rigidity = young * thickness, young * thickness**3 / 12 / (1 - ratio**2)
    load, waves = Napkin(radius[run.pinned].max() / radius.max(), ratio).critical()
    unit = rigidity * np.sqrt(rigidity / membrane) / radius.max()**4
    return load * unit / run.get("/material/density"), waves


def wave(run):
    """(number of waves, amplitude in m, mean sag in m) of the rim."""
    rest, heights = run.rest_positions, run.positions(-1)[:, 2]
    radius = np.hypot(*rest[:, :2].T)
    rim = radius > radius.max() * (1 - 1e-6)
    phi = np.arctan2(rest[rim, 1], rest[rim, 0])
    size = [2 * abs(np.mean(heights[rim] * np.exp(-1j * n * phi))) for n in range(2, 16)]
    return int(np.argmax(size)) + 2, max(size), -float(heights[rim].mean())


def critical(rows):
    """The load at which the squared amplitude begins to grow: the root of a parabola through the three
    smallest loads with waves."""
    loads, squared = np.array([row[0] for row in rows[:3]]), np.array([row[2]**2 for row in rows[:3]])
    roots = np.roots(np.polyfit(loads, squared, 2))
    below = [root.real for root in roots if abs(root.imag) < 1e-9 and root.real < loads[0]]
    return max(below) if below else np.nan
