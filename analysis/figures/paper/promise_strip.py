"""Whether the recommended cloth is equally stiff at every resolution, measured on strips that are clamped
along one side.

With the defaults (implicit steps) a step solves for all vertices together. A projection moves only the four
vertices of a hinge, so bending spreads from triangle to triangle. With edge length a, mass per area ρ and
substeps of h, projections give a strip a rigidity of at most about ρ a⁴ / h². So the share of the stated
rigidity depends on substeps / N² alone.
"""
import numpy as np

from runs import strips
from bendlab.results.load import group
from tables.chart import Chart
from tables.section import Claim
from tables.table import Table
from runs.sweeps import load_experiment

GOAL = 1.05  # largest stiffness over smallest, for N = 12 to 96
DEFAULTS, FINER = "the defaults", "the defaults, membrane_error 0.001"


def main(results, out, section):
    ours = section.uses(load_experiment(results, "paper/recommended_strip"))
    projected = section.uses(load_experiment(results, "paper/strip_substeps"))
    projected = projected + load_experiment(results, "paper/strip_substeps_full").runs
    shares = {DEFAULTS if error == 0.01 else FINER: shares_of(own_runs) for error, own_runs in
              sorted(group(ours, lambda run: run.get("/solver/membrane_error")).items(), reverse=True)}
    substeps = {count: shares_of(own_runs) for count, own_runs in
                sorted(group(projected, lambda run: run.get("/solver/substeps")).items())}
    shares |= substeps
    section.tables.append(_table(shares))
    if shares:
        section.charts.append(Chart(
            "promise_strip", _title(shares), "strips", "N", ["measured", "estimated"], ["solver"],
            scale="log2",
            y_scale="log", look="", limits=[("measured", 1, "as stated")],
            note="Measured flexural rigidity over the stated rigidity of 10⁻⁵ N m; and the program's "
                 "estimate of this ratio for projections (effective_bending_stiffness)."))
    section.claims += [_claim(shares), _scaling_claim(substeps)]


def shares_of(runs):
    """{N: (measured share of the stated rigidity, estimated share, CPU ms per frame)}"""
    shares = {}
    for run in sorted(runs, key=strips.cells):
        measured = run.summary.get("stiffness_flexural_rigidity", np.nan)
        stated = run.get("/bending/flexural_rigidity")
        frames = 60 * run.metrics["time"][-1] if len(run.metrics["time"]) else np.nan
        estimated = run.summary.get("effective_bending_stiffness", np.nan)
        shares[strips.cells(run)] = (measured / stated, estimated, 1e3 * run.step_cpu_s / frames)
    return shares


def _name(solver):
    return solver if isinstance(solver, str) else f"{solver} substeps of pbd"


def spread_of(by_cells):
    """Largest share over smallest share. NaN if a strip was not measured."""
    values = np.array([measured for measured, *_ in by_cells.values()])
    return values.max() / values.min() if np.isfinite(values).all() and len(values) > 1 else np.nan


def _title(shares):
    finest = max(n for by_cells in shares.values() for n in by_cells)
    kept = {solver: f"{100 * by_cells[finest][0]:.0f}" for solver, by_cells in shares.items()
            if finest in by_cells}
    substeps = [solver for solver in kept if not isinstance(solver, str)]
    title = (f"A strip on {finest} cells has {kept.get(DEFAULTS, '–')} % of its stated rigidity "
             "with the defaults")
    return title if not substeps else (
        f"{title}, and {', '.join(kept[count] for count in substeps)} % with {', '.join(map(str, substeps))} "
        "substeps of pbd")


def _table(shares):
    rows = [{"solver": _name(solver), "N": n, "measured": measured, "estimated": estimated, "ms": ms}
            for solver, by_cells in shares.items() for n, (measured, estimated, ms) in by_cells.items()]
    return Table.of("strips", "Share of the stated rigidity", [
        "solver", ("N", "cells along the strip, N"), ("measured", "measured over stated rigidity"),
        ("estimated", "estimate of the program"), ("ms", "CPU time per frame", "", "ms")], rows)


def _claim(shares):
    numbers = {f"largest rigidity over smallest, {_name(solver)}": spread_of(by_cells)
               for solver, by_cells in shares.items()}
    ours = shares.get(DEFAULTS, {})
    numbers["smallest share of the stated rigidity, the defaults"] = min(
        (measured for measured, *_ in ours.values()), default=np.nan)
    cells = sorted({n for by_cells in shares.values() for n in by_cells})
    spread = spread_of(ours)
    return Claim("5", "The stiffness of cloth does not change if its mesh is refined (the paper's "
                 "promise, with our recommended settings).",
                 f"on strips of {min(cells, default=0)} to {max(cells, default=0)} cells the largest "
                 f"rigidity is at most {GOAL} times the smallest, with the defaults",
                 numbers, None if np.isnan(spread) else bool(spread <= GOAL))


def _scaling_claim(shares):
    """How much the shares of strips with equal substeps / N² differ. `shares`: {substeps: shares_of()}."""
    of_ratio = {}
    for substeps, by_cells in shares.items():
        for n, (measured, *_) in by_cells.items():
            of_ratio.setdefault(substeps / n**2, []).append(measured)
    pairs = [values for values in of_ratio.values() if len(values) > 1 and np.isfinite(values).all()]
    worst = max((max(values) / min(values) - 1 for values in pairs), default=np.nan)
    return Claim("5, ours", "With projections, the share of the stated rigidity that a strip has depends on "
                 "substeps / N² alone.",
                 "the shares of strips with equal substeps / N² differ by at most 5 %",
                 {"groups compared": len(pairs), "largest difference": worst},
                 None if np.isnan(worst) else bool(worst <= 0.05))
