"""Lateral buckling of upright strips, and the wrinkles of a sheet that is pulled."""
import numpy as np

from bendlab.results.load import group
from runs import strips, verified
from truths import buckling

WIDTHS = {"buckling_1": 0.1, "buckling_3": 0.3, "buckling_5": 0.5, "buckling_9": 0.9}  # over the length
WAVELESS = 5e-4  # of the width of a sheet; a smaller amplitude is no wrinkle
cells = lambda run: run.get("/mesh/cells") - 1  # without the row of the clamp


def main(results, out, section):
    rows, charted = [], []
    for config, width in WIDTHS.items():
        runs = verified.runs_of(results, section, config)
        for (model, family), own in verified.by_model_and_family(runs).items():
            truth = buckling.plate_load(width, own[0].get("/material/poisson_ratio"))
            meshes = [{"h": 1 / number,
                       "value": strips.threshold([(load(run), deflection(run)) for run in at])}
                      for number, at in sorted(group(own, cells).items())]
            made = verified.of_rows(meshes, truth, verified.ORDERS.get(own[0].model))
            rows.append({"width": width, "model": model, "family": family, "truth": truth} | made.cells())
            charted += [{"model": model, "width": width, "cells": round(1 / mesh["h"]),
                         "over": mesh["value"] / truth} for mesh in meshes]
    section.add_table("buckling", "Critical load Γ* = ρ g L³ / B of an upright strip (ν = 0.3)", [
        ("width", "width over length"), "model", ("family", "mesh"), ("truth", "plate theory", ".3f"),
        *verified.columns()], rows)
    section.add_table("loads", "", ["model", ("width", "width over length"),
                                    ("cells", "cells along the strip"),
                                    ("over", "Γ* found over Γ* of theory", ".3f")], charted)
    near = [row["finest"] for row in rows if row["model"] == "mid_edge"]
    title = (f"With mid_edge, strips buckle at {100 * min(near):.1f} to {100 * max(near):.1f} % of "
             "the load of plate theory" if near else "Lateral buckling")
    section.add_chart("loads", title, "cells", ["over"], ["width"], id="buckling", held=["model"],
                      at="mid_edge", scale="log2", y_scale="linear", look="",
                      limits=[("over", 1, "plate theory")],
                      note="Γ* is where a line through the two smallest squared deflections is zero.")
    wrinkles(results, section)


def _length(run):
    return run.get("/mesh/width") * cells(run) / (cells(run) + 1)


def load(run):
    """Γ = ρ g L³ / B."""
    return (run.get("/material/density") * -run.get("/effects/0/acceleration")[1] * _length(run)**3
            / run.get("/bending/flexural_rigidity"))


def deflection(run):
    """Largest distance of a vertex from the plane at the start, over the strip's length."""
    return float(np.abs(run.positions(-1)[:, 2]).max() / _length(run))


def wrinkles(results, section):
    rows = []
    for run in verified.runs_of(results, section, "wrinkles", "wrinkles_slow"):
        rigidity = run.get("/bending/flexural_rigidity")
        tension = run.get("/effects/0/force")[0] / run.get("/mesh/height")
        law = buckling.wrinkle_length(rigidity, tension, run.get("/mesh/width"))
        length, amplitude = wave(run)
        rows.append({"rigidity": rigidity, "cells": run.get("/mesh/cells"), "law": 1000 * law,
                     "length": 1000 * length, "share": length / law, "amplitude": 1e6 * amplitude})
    rows.sort(key=lambda row: (row["rigidity"], row["cells"]))
    most = max((row["cells"] for row in rows), default=0)
    shares = [row["share"] for row in rows if row["cells"] == most and row["share"] == row["share"]]
    if shares:
        section.text += (f" On {most} cells, the wave lengths are {min(shares):.2f} to {max(shares):.2f} "
                         "of this law.")
    section.add_table("wrinkles", "Wrinkles of a sheet of 0.25 m × 0.1 m that is pulled by 10⁴ N/m", [
        ("rigidity", "B", "", "N m"), ("cells", "cells along the sheet"),
        ("law", "2 √π (B/T)^¼ √L", ".1f", "mm"), ("length", "wave length", ".1f", "mm"),
        ("share", "wave length over the law", ".2f"), ("amplitude", "amplitude", ".0f", "µm")], rows)


def wave(run):
    """(wave length, amplitude) in m across the middle of the sheet: twice the mean distance of neighbouring
    zeros of the height between its largest waves, and half the range. NaN: fewer than three zeros among waves
    of a tenth of the amplitude."""
    rest = run.rest_positions
    middle = np.abs(rest[:, 0] - (rest[:, 0].min() + rest[:, 0].max()) / 2) < 1e-9
    pose = run.positions(-1)[middle][np.argsort(rest[middle][:, 1])]
    y, z = pose[:, 1], pose[:, 2] - np.median(pose[:, 2])
    amplitude = np.ptp(z) / 2
    zeros = [(place, max(abs(z[place]), abs(z[place + 1]))) for place in range(len(z) - 1)
             if z[place] * z[place + 1] < 0]
    zeros = [y[place] - z[place] * (y[place + 1] - y[place]) / (z[place + 1] - z[place])
             for place, size in zeros if size > 0.1 * amplitude]
    if amplitude < WAVELESS * np.ptp(y) or len(zeros) < 3:
        return np.nan, amplitude
    return 2 * (zeros[-1] - zeros[0]) / (len(zeros) - 1), amplitude
