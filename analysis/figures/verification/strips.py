"""Clamped strips under their weight: the rigidity that their shape shows, over the stated rigidity."""
from runs import verified

GIVEN = {"strip_small": 1e-3, "strip_large": 1e-4}  # N m
NEAR = 0.01  # of the stated rigidity: what the verification asks of mid-edge on the finest mesh
found = lambda run: run.summary.get("stiffness_flexural_rigidity", float("nan"))
load = lambda run: -run.get("/effects/0/acceleration")[2]


def main(results, out, section):
    rows, charted = [], []
    for config, more, name in (("strip_small", ["strip_small_dkt"], lambda run: "small deflection"),
                               ("strip_large", [], lambda run: f"Γ = {load(run) * 16:.0f}")):
        runs = verified.runs_of(results, section, config, *more)
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
    mid = [abs(row["off"]) for row in rows
           if row["model"] == "mid_edge" and row["deflection"] == "small deflection"]
    title = (f"Bent a little, strips with mid-edge bending have the stated rigidity within {max(mid):.2f} %"
             if mid else "Rigidity of strips")
    section.add_chart("cells", title, "cells", ["share"], held=["deflection", "family"], scale="log2",
                      at="small deflection", y_scale="linear", limits=[("share", 1, "as stated")])
