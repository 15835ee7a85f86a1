"""Clamped strips: the rigidity that their shape under their weight shows, and their first frequency."""
import numpy as np

from runs import verified
from truths.cantilevers import CLAMPED_FREE

GIVEN = {"strip_small": 1e-3, "strip_large": 1e-4}  # N m
FIRST, SECOND = CLAMPED_FREE[:2]
NEAR = 0.01  # of the stated rigidity: what the verification asks of mid-edge on the finest mesh
found = lambda run: run.summary.get("stiffness_flexural_rigidity", float("nan"))
load = lambda run: -run.get("/effects/0/acceleration")[2]


def main(results, out, section):
    rows, charted = [], []
    for config, name in (("strip_small", lambda run: "small deflection"),
                         ("strip_large", lambda run: f"Γ = {load(run) * 16:.0f}")):
        runs = verified.runs_of(results, section, config)
        for (model, family, deflection), own in verified.by_model_and_family(runs, name).items():
            made = verified.converging(own, found, GIVEN[config])
            rows.append({"deflection": deflection, "model": model, "family": family} | made.cells())
            charted += [{"deflection": deflection, "model": model, "family": family,
                         "cells": row["run"].get("/mesh/cells") - 1, "share": row["value"] / GIVEN[config]}
                        for row in made.rows]
            if model == "mid_edge" and deflection == "small deflection":
                section.add_check("B from H/W over the stated B at small deflection", model,
                                  f"{family}, {charted[-1]['cells']} cells", 1,
                                  made.finest / GIVEN[config], NEAR, "plate theory")
    section.add_table("strips", "Flexural rigidity from H/W over the stated one", [
        "deflection", "model", ("family", "mesh"), *verified.columns()], rows)
    section.add_table("cells", "", ["deflection", "model", ("family", "mesh"),
                                    ("cells", "cells along the strip"),
                                    ("share", "B found over B stated", ".4f")], charted)
    frequencies(results, section)
    mid = [abs(row["off"]) for row in rows
           if row["model"] == "mid_edge" and row["deflection"] == "small deflection"]
    title = (f"Bent a little, strips with mid_edge have the stated rigidity within {max(mid):.2f} %"
             if mid else "Rigidity of strips")
    section.add_chart("cells", title, "cells", ["share"], id="strips",
                      held=["deflection", "family"], scale="log2", at="small deflection",
                      y_scale="linear", limits=[("share", 1, "as stated")])


def frequencies(results, section):
    runs = verified.runs_of(results, section, "frequency")
    rows = [{"model": model, "family": family} | verified.converging(own, frequency, 1.0).cells()
            for (model, family), own in verified.by_model_and_family(runs).items()]
    section.add_table("frequencies", "First frequency of a clamped strip over that of a beam, "
                      "3.516 (B/ρ)^(1/2) / 2π L²", ["model", ("family", "mesh"), *verified.columns()], rows)


def frequency(run):
    """The first frequency over theory, by a least squares fit of the end's height with the first two
    frequencies of a clamped beam, whose ratio is 6.267."""
    rest = run.rest_positions
    ends = rest[:, 0] > rest[:, 0].max() - 1e-6
    times = run.metrics["time"][:]
    height = np.array([run.positions(frame)[ends, 2].mean() for frame in range(len(times))])
    length = np.ptp(rest[:, 0]) * (1 - 1 / run.get("/mesh/cells"))  # the first row of cells is clamped
    stiffness = run.get("/bending/flexural_rigidity") / run.get("/material/density")
    theory = FIRST**2 / length**2 * stiffness**0.5

    def misfit(share):
        phases = [factor * share * theory * times for factor in (1, (SECOND / FIRST)**2)]
        waves = np.array([wave(phase) for phase in phases for wave in (np.cos, np.sin)]).T
        found = waves @ np.linalg.lstsq(waves, height, rcond=None)[0]
        return ((found - height)**2).sum()

    shares = np.linspace(0.5, 1.6, 200)
    middle = shares[np.argmin([misfit(share) for share in shares])]
    low, high = middle - 0.01, middle + 0.01
    for _ in range(40):
        third = (high - low) / 3
        low, high = (low, high - third) if misfit(low + third) < misfit(high - third) else (low + third, high)
    return float(low + high) / 2
