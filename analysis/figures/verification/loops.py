"""Loops and folds of textile tests against the heavy elastica; a Möbius strip against Sadowsky's limit."""
import numpy as np

from runs import verified
from truths import moebius, strips

SIZE = 4.0  # length of a loop between its clamps over (B/ρ g)^(1/3)
MESHES = (20, 40, 80)


def loop(run):
    """The name of a run's loop."""
    if run.name.startswith("verification_loops"):
        return run.get("/initial/file").rpartition("/")[2].partition("_")[0]
    return run.name.split("_")[1]


def truth_of(name):
    """The strip, and its length over (B/ρ g)^(1/3)."""
    if name == "fold":
        strip = strips.free_fold()
        return strip, strip.s[-1]
    return strips.standing_ring(SIZE) if name == "standing" else strips.hanging_loop(name, SIZE), SIZE


def main(results, out, section):
    runs = verified.runs_of(results, section, *(f"{kind}_{cells}" for kind in ("loops", "standing", "fold")
                                                for cells in MESHES))
    rows = []
    for (model, family, name), own in verified.by_model_and_family(runs, loop).items():
        truth, length = truth_of(name)
        for quantity, axis, expected in (("height", 2, truth.height), ("width", 0, truth.width)):
            made = verified.converging(own, lambda run, axis=axis: extent(run, length)[axis], expected)
            rows.append({"loop": name, "quantity": quantity, "model": model, "family": family,
                         "truth": expected} | made.cells())
    section.add_table("loops", "Height and width of strips that hang, stand or are folded. Loops are "
                      f"{SIZE:g} (B/ρ g)^(1/3) long", [
        "loop", "quantity", "model", ("family", "mesh"),
        ("truth", "expected, in (B/ρ g)^(1/3)", ".6f"), *verified.columns()], rows)
    section.add_table("errors", "", ["loop", "quantity", "model", ("off", "error on the finest mesh", "+.2f",
                                                                   "%")],
                      [{**row, "loop": f"{row['loop']}, {row['quantity']}"} for row in rows])
    section.add_chart("errors", "Error of height and width on 80 cells", "loop", ["off"],
                      ["model"], id="loops", scale="band", joined=False, y_scale="linear",
                      limits=[("off", 0, "elastica")])
    moebius_strips(results, section)


def extent(run, length):
    """(3,) extent of the strip without the rows behind its clamps, over (B/ρ g)^(1/3)."""
    rest = run.rest_positions[:, 0]
    step = np.ptp(rest) / run.get("/mesh/cells")
    inside = (rest > rest.min() + step / 2) & (rest < rest.max() - step / 2)
    return np.ptp(run.positions(-1)[inside], axis=0) * length / np.ptp(rest[inside])


def moebius_strips(results, section):
    runs = verified.runs_of(results, section, *(f"moebius_{width}_{cells}" for width in ("01", "0025")
                                                for cells in (40, 80, 160)))
    along = lambda run: run.get("/mesh/cells") - 2  # without the clamps
    width = lambda run: round(run.get("/mesh/height") / run.get("/mesh/width") * (1 + 2 / along(run)), 4)
    energy = lambda run: (run.summary["energy_bending_end"] / run.get("/bending/flexural_rigidity")
                          / width(run))
    rows = [{"model": model, "family": family, "width": over}
            | verified.converging(own, energy, moebius.ENERGY, lambda run: 1 / along(run)).cells()
            for (model, family, over), own in verified.by_model_and_family(runs, width).items()]
    for row in rows:  # the truth is a limit, which no strip of finite width reaches
        del row["verdict"]
    section.add_table("moebius", "Energy E L / B w of a Möbius strip over the limit of a narrow strip, "
                      f"{moebius.ENERGY:.3f}", ["model", ("family", "mesh"), ("width", "width over length"),
                                                *verified.columns()[:-1]], rows)
