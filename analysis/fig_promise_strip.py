"""Whether the recommended cloth is as stiff at every resolution: strips, clamped along one side.

The defaults take implicit steps, which couple the whole strip. A projection moves the four vertices of a
hinge only, so that bending travels from triangle to triangle. In a substep h it passes on at most a rigidity
of about ρ a⁴ / h² (a: edge length, ρ: mass per area): what the strip then has of the stated rigidity depends
on substeps / N² alone.
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import strips
import style
from bendlab.results.load import group
from report import Claim, Section, Table, figure_main
from sweeps import load_experiment

GOAL = 1.05  # largest stiffness over smallest, N = 12 to 96
DEFAULTS, FINER = "the defaults", "the same, membrane_error 0.001"
LOOKS = {DEFAULTS: ("#22262b", "o"), FINER: ("#7f7f7f", "v"), 8: ("#d55e00", "o"), 32: ("#009e73", "s"),
         128: ("#0072b2", "^"), 256: ("#7a3b8f", "D")}


def main(results, out):
    """Draws the measured share of the stated rigidity over resolution, and judges the promise by it."""
    section = Section("As stiff at every resolution? The recommended cloth on strips", "5")
    ours = section.uses(load_experiment(results, "paper/recommended_strip"))
    projected = section.uses(load_experiment(results, "paper/strip_substeps"))
    projected = projected + load_experiment(results, "paper/strip_substeps_full").runs
    shares = {DEFAULTS if error == 0.01 else FINER: shares_of(some) for error, some in
              sorted(group(ours, lambda run: run.get("/solver/membrane_error")).items(), reverse=True)}
    substeps = {number: shares_of(some) for number, some in
                sorted(group(projected, lambda run: run.get("/solver/substeps")).items())}
    shares |= substeps
    section.text = (
        "Strips of the recommended cloth, 20 cm long, hang at rest under a hundredth of gravity; their "
        "shape tells their rigidity. At 96 cells the edges are 2.4 mm long, as on a sheet of 1 m with 411 "
        "cells. The defaults take implicit steps. For comparison, strips of the same rigidity by "
        "projections (pbd; with a rigid membrane and tethers), one iteration in each substep. A projection "
        "of a hinge moves its four vertices only, so that bending travels from triangle to triangle: in a "
        "substep h the solver passes on a rigidity of about ρ a⁴ / h² at most (a: edge length). Half the "
        "edge needs four times as many substeps. Each substep also costs four times as much there, so that "
        "keeping the rigidity costs N⁴: this is what stands in the way of the paper's promise, with any "
        "model whose projections are local. Solvers that couple the whole cloth do not have this limit.")
    if shares:
        section.pictures.append((_picture(shares, out), "Measured flexural rigidity over the stated one, "
                                 "1e-5 N m. Dashed: what the program estimates for projections, without "
                                 "measuring (effective_bending_stiffness)."))
    section.tables.append(_table(shares))
    section.claims += [_claim(shares), _scaling_claim(substeps)]
    return section


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


def _picture(shares, out):
    figure, axes = plt.subplots(figsize=(7.2, 4.2), layout="constrained")
    for solver, by_cells in shares.items():
        cells, (measured, estimated, _) = list(by_cells), np.transpose(list(by_cells.values()))
        colour, mark = LOOKS.get(solver, (style.INK, "o"))
        axes.plot(cells, measured, color=colour, marker=mark, label=_name(solver))
        axes.plot(cells, estimated, color=colour, linestyle="--", linewidth=0.9)
    axes.axhspan(1 / GOAL, GOAL, color=style.GRID, zorder=0)
    axes.set_ylabel("rigidity / stated rigidity")
    style.resolution_axis(axes, sorted({n for by_cells in shares.values() for n in by_cells}))
    axes.set_xlabel("cells along the strip, N")
    style.plain_log(axes)
    axes.set_title(_title(shares), loc="left")
    style.label_ends(axes)
    return style.save(figure, out, "fig_5_promise_strip")


def spread_of(by_cells):
    """Largest share over smallest; NaN where a strip was not measured."""
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
        f"{title},\nand {', '.join(kept[each] for each in substeps)} % with {', '.join(map(str, substeps))} "
        "substeps of pbd")


def _table(shares):
    rows = [[_name(solver), n, style.number(measured, 3), style.number(estimated, 3), style.number(ms, 3)]
            for solver, by_cells in shares.items() for n, (measured, estimated, ms) in by_cells.items()]
    return Table("Share of the stated rigidity", ["solver", "N", "measured", "estimated by the program",
                                                  "CPU ms per frame"], rows)


def _claim(shares):
    numbers = {f"largest rigidity over smallest, {_name(solver)}": spread_of(by_cells)
               for solver, by_cells in shares.items()}
    ours = shares.get(DEFAULTS, {})
    numbers["share of the stated rigidity, smallest, the defaults"] = min(
        (measured for measured, *_ in ours.values()), default=np.nan)
    cells = sorted({n for by_cells in shares.values() for n in by_cells})
    spread = spread_of(ours)
    return Claim("5", "Cloth that does not change its stiffness when its mesh is refined (the paper's "
                 "promise, with our recommended settings).",
                 f"on strips of {min(cells, default=0)} to {max(cells, default=0)} cells the largest "
                 f"rigidity is at most {GOAL} times the smallest, with the defaults",
                 numbers, None if np.isnan(spread) else bool(spread <= GOAL))


def _scaling_claim(shares):
    """How far the shares of runs by projections, {substeps: {N: …}}, with the same substeps / N² differ."""
    of_ratio = {}
    for substeps, by_cells in shares.items():
        for n, (measured, *_) in by_cells.items():
            of_ratio.setdefault(substeps / n**2, []).append(measured)
    pairs = [values for values in of_ratio.values() if len(values) > 1 and np.isfinite(values).all()]
    worst = max((max(values) / min(values) - 1 for values in pairs), default=np.nan)
    return Claim("5, ours", "By projections, what a strip has of its stated rigidity depends on "
                 "substeps / N² alone.",
                 "shares of strips with the same substeps / N² differ by at most 5 %",
                 {"groups compared": len(pairs), "largest difference": worst},
                 None if np.isnan(worst) else bool(worst <= 0.05))


if __name__ == "__main__":
    figure_main(main)
