"""Locking: how much stiffer than stated a strip is, because its membrane resists the bend."""
from runs import verified
from tables.numbers import percents

GIVEN = 2e-5  # N m
LOCKED = 1.1  # times the stated rigidity


def main(results, out, section):
    runs = verified.runs_of(results, section, "locking")
    rows = [{"model": verified.model(run), "family": mesh(run), "cells": run.get("/mesh/cells") - 1,
             "form": run.get("/material/strain/form"),
             "membrane": run.get("/material/strain/membrane_stiffness"),
             "share": run.summary.get("stiffness_flexural_rigidity", float("nan")) / GIVEN} for run in runs]
    section.add_table("locking", "Flexural rigidity from H/W over the stated one, Γ = 100", [
        "model", ("family", "mesh"), ("cells", "cells along the strip"), ("form", "strain form"),
        ("membrane", "membrane", "", "N/m"), ("share", "B found over B stated", ".3f")], rows)
    rows = [row for row in rows if row["cells"] == 24 and row["form"] == "stvk"]  # of the chart
    stiff = max((row["membrane"] for row in rows), default=0)
    own = lambda *families: [row["share"] for row in rows if row["model"] == "mid_edge"
                             and row["membrane"] == stiff and row["family"] in families]
    families = sorted({row["family"] for row in rows})
    locked = [family for family in families if max(own(family), default=0) > LOCKED]
    sound = [family for family in families if family not in locked]
    title = (f"A stiff membrane makes strips with mid_edge up to {max(own(*locked)):.2f} times as stiff as "
             f"stated ({'; '.join(locked)}); on other meshes they have {percents(own(*sound))} %"
             if locked and sound else "Locking of strips")
    section.add_table("membranes", "", ["model", ("family", "mesh"), ("membrane", "membrane", "", "N/m"),
                                        ("share", "B found over B stated", ".3f")],
                      rows)
    section.add_chart("membranes", title, "membrane", ["share"], ["family"], id="locking", held=["model"],
                      at="mid_edge", y_scale="linear", look="", limits=[("share", 1, "as stated")])


def mesh(run):
    """The kind of a run's mesh; for equilateral triangles with the direction of their rows."""
    rows = run.get("/mesh/rows")
    return verified.family(run) + (f", {rows} rows" if run.get("/mesh/generator") == "equilateral" else "")
