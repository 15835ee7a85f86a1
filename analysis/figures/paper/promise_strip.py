"""Whether the recommended cloth is equally stiff at every resolution, measured on strips that are clamped
along one side.

With the defaults (implicit steps) a step solves for all vertices together. A projection moves only the four
vertices of a hinge, so bending spreads from triangle to triangle. With edge length a, mass per area ρ and
substeps of h, projections give a strip a rigidity of at most about ρ a⁴ / h². So the share of the stated
rigidity depends on substeps / N² alone.
"""
import numpy as np

from bendlab.results.load import group
from figures.accuracy.measures import cost
from runs import strips
from runs.sweeps import used_runs
from tables.numbers import number_text
from tables.section import Claim

GOAL = 1.05  # largest stiffness over smallest, for N = 12 to 96
DEFAULTS, PROJECTED = "the defaults", " substeps of pbd"


def main(results, out, section):
    ours = used_runs(section, results, "paper/recommended_strip")
    projected = used_runs(section, results, "paper/strip_substeps", "paper/strip_substeps_full")
    runs = [*sorted(ours, key=lambda run: (-run.get("/solver/membrane_error"), strips.cells(run))),
            *sorted(projected, key=lambda run: (run.get("/solver/substeps"), strips.cells(run)))]
    shares = {solver: {strips.cells(run): strips.share_of_droop(run) for run in own_runs}
              for solver, own_runs in group(runs, _solver).items()}
    section.add_table(
        "strips", "Share of the stated rigidity",
        ["solver", ("N", "cells along the strip, N"), ("measured", "measured over stated rigidity"),
         ("estimated", "estimate of the program"), ("ms", "CPU time per frame", "", "ms")],
        [(_solver(run), strips.cells(run), strips.share_of_droop(run),
          strips.number(run, "effective_bending_stiffness"), cost(run)) for run in runs])
    if shares:
        stated = ", ".join(number_text(rigidity, 1) for rigidity in sorted(set(map(strips.stated, runs))))
        section.add_chart(
            "strips", _title(shares), "N", ["measured", "estimated"], ["solver"], id="promise_strip",
            scale="log2", y_scale="log", look="", limits=strips.as_stated("measured"),
            note=f"Measured flexural rigidity over the stated rigidity of {stated} N m; and the program's "
            "estimate of this ratio for projections (effective_bending_stiffness).")
    section.claims += [_claim(shares), _scaling_claim(projected)]


def _solver(run):
    if run.method == "pbd":
        return f"{run.get('/solver/substeps')}{PROJECTED}"
    return DEFAULTS if run.get("/solver/membrane_error") == 0.01 else f"{DEFAULTS}, membrane_error 0.001"


def _title(shares):
    finest = max(n for by_cells in shares.values() for n in by_cells)
    kept = {solver: f"{100 * by_cells[finest]:.0f}" for solver, by_cells in shares.items()
            if finest in by_cells}
    defaults = kept.get(DEFAULTS, "–")
    title = f"A strip on {finest} cells has {defaults} % of its stated rigidity with the defaults"
    projected = [solver for solver in kept if solver.endswith(PROJECTED)]
    return title if not projected else (
        f"{title}, and {', '.join(kept[solver] for solver in projected)} % with "
        f"{', '.join(solver.removesuffix(PROJECTED) for solver in projected)}{PROJECTED}")


def _claim(shares):
    """`shares`: {solver: {N: measured share of the stated rigidity}}"""
    spreads = {solver: strips.largest_ratio(by_cells.values()) for solver, by_cells in shares.items()}
    numbers = {f"largest rigidity over smallest, {solver}": spread for solver, spread in spreads.items()}
    numbers["smallest share of the stated rigidity, the defaults"] = min(
        shares.get(DEFAULTS, {}).values(), default=np.nan)
    cells = {n for by_cells in shares.values() for n in by_cells}
    spread = spreads.get(DEFAULTS, np.nan)
    return Claim("5", "The stiffness of cloth does not change if its mesh is refined (the paper's promise, "
                 "with our recommended settings).", f"on strips of {min(cells, default=0)} to "
                 f"{max(cells, default=0)} cells the largest rigidity is at most {GOAL} times the smallest, "
                 "with the defaults", numbers, None if np.isnan(spread) else bool(spread <= GOAL))


def _scaling_claim(runs):
    """How much the shares of strips with equal substeps / N² differ."""
    of_ratio = group(runs, lambda run: run.get("/solver/substeps") / strips.cells(run)**2)
    ratios = [strips.largest_ratio(map(strips.share_of_droop, own_runs)) for own_runs in of_ratio.values()]
    pairs = [ratio for ratio in ratios if not np.isnan(ratio)]
    worst = max(pairs, default=np.nan) - 1
    return Claim("5, ours", "With projections, the share of the stated rigidity that a strip has depends on "
                 "substeps / N² alone.",
                 "the shares of strips with equal substeps / N² differ by at most 5 %",
                 {"groups compared": len(pairs), "largest difference": worst},
                 None if np.isnan(worst) else bool(worst <= 0.05))
