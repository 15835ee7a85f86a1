"""Loops of textile tests against the heavy elastica, and a Möbius strip against Sadowsky's limit."""
import numpy as np

from bendlab.results.load import group
from runs import verified
from truths import moebius, strips

SIZE = 4.0  # length between the clamps over (B/ρ g)^(1/3)
MESHES = (20, 40, 80)
kind = lambda run: run.get("/initial/file").rpartition("/")[2].partition("_")[0]


def main(results, out, section):
    runs = verified.runs_of(results, section, *(f"loops_{cells}" for cells in MESHES))
    rows = []
    for (model, family, name), own in verified.by_model_and_family(runs, kind).items():
        truth = strips.hanging_loop(name, SIZE)
        for quantity, axis, expected in (("height", 2, truth.height), ("width", 0, truth.width)):
            made = verified.converging(own, lambda run, axis=axis: extent(run)[axis], expected)
            rows.append({"loop": name, "quantity": quantity, "model": model, "family": family,
                         "truth": expected} | made.cells())
    section.add_table("loops", "Height and width of a hanging loop of the length 4 (B/ρ g)^(1/3)", [
        "loop", "quantity", "model", ("family", "mesh"),
        ("truth", "expected, in (B/ρ g)^(1/3)", ".6f"), *verified.columns()], rows)
    section.add_table("errors", "", ["loop", "quantity", "model", ("off", "error on the finest mesh", "+.2f",
                                                                   "%")],
                      [{**row, "loop": f"{row['loop']}, {row['quantity']}"} for row in rows])
    section.add_chart("errors", "Hanging loops: error of height and width on 80 cells", "loop", ["off"],
                      ["model"], scale="band", joined=False, y_scale="linear",
                      limits=[("off", 0, "elastica")])
    moebius_strips(results, section)


def extent(run):
    """(3,) extent of the loop without the rows behind its clamps, over (B/ρ g)^(1/3)."""
    rest = run.rest_positions[:, 0]
    step = np.ptp(rest) / run.get("/mesh/cells")
    loop = (rest > rest.min() + step / 2) & (rest < rest.max() - step / 2)
    return np.ptp(run.positions(-1)[loop], axis=0) * SIZE / (np.ptp(rest) - 2 * step)


def moebius_strips(results, section):
    names = ("moebius_01_40", "moebius_01_80", "moebius_005_80", "moebius_0025_80")
    rows = []
    for run in verified.runs_of(results, section, *names):
        along = run.get("/mesh/cells") - 2
        length = run.get("/mesh/width") * along / (along + 2)
        width = run.get("/mesh/height") / length
        energy = run.summary["energy_bending_end"] / run.get("/bending/flexural_rigidity")
        rows.append({"model": verified.model(run), "width": round(width, 4), "cells": along,
                     "energy": energy / width, "share": energy / width / moebius.ENERGY})
    section.add_table("moebius", "Bending energy of a Möbius strip", [
        "model", ("width", "width over length", "g"), ("cells", "cells along the strip"),
        ("energy", "E L / D w", ".2f"), ("share", "over the limit of a narrow strip", ".3f")],
        sorted(rows, key=lambda row: (row["model"], -row["width"], row["cells"])))
    narrow = [row for own in group(rows, lambda row: row["model"]).values()
              for row in [min(own, key=lambda row: row["width"])]]
    if narrow:
        shares = ", ".join(f"{row['share']:.3f} times the limit with {row['model']}" for row in narrow)
        section.text += (" A strip of finite width has more energy than Sadowsky's limit: with the narrowest "
                         f"strip the energy is {shares}.")
