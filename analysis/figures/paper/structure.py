"""Figs. 2-4: for each model, the solver's springs of one pinned and one free vertex."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from bendlab.results.load import select
from draw import cloth, style
from runs.stretch import ring_of
from runs.sweeps import used_runs
from tables.section import Claim

PINNED, FREE = "#d4211c", "#7a3db8"  # the paper's red and violet


def main(results, out, section):
    runs = used_runs(section, results, "paper/structure")
    crossover, adaptive = (select(runs, bending__model=name) for name in ("crossover", "adaptive"))
    lod = sorted(select(runs, bending__model="lod"), key=lambda run: run.get("/bending/lod/t"))
    if runs:
        section.pictures.append((_picture([*crossover[:1], *adaptive, *lod], out), "The springs of one "
                                 "pinned vertex (red, right) and one free vertex (violet, left). Dark: the "
                                 "1-ring, which is pinned, too. Pinned vertices have no springs between "
                                 "them. Two vertices get a spring if the rule of one of them requires it. So "
                                 "with t = m and n the pin has springs to ring n by its own rule, and to "
                                 "ring m by the rule of the free vertices there."))
    section.claims.append(_claim(adaptive + lod))


def _title(run):
    if run.model == "crossover":
        return "Fig. 2: crossover"
    if run.model == "adaptive":
        return f"Fig. 3: adaptive, m = {run.summary['model_m']:g}, n = {run.summary['model_n']:g}"
    return f"Fig. 4: LOD, t = {run.get('/bending/lod/t') or 'm and n'}"


def _neighbours(run):
    """(vertex, vertices joined to it by a spring) of a pinned vertex and of a free vertex. The free vertex is
    to the left of the pin, so far from the pin and the boundary that its rings are complete."""
    rest, springs, pin = run.rest_positions, run.constraints("distance"), run.pin_seeds[0]
    place = rest[pin] - [0.36 * np.ptp(rest[:, 0]), 0, 0]
    for vertex in (pin, np.argmin(np.linalg.norm(rest - place, axis=1))):
        own = springs[(springs == vertex).any(axis=1)]
        yield vertex, np.unique(own[own != vertex])


def _picture(runs, out):
    columns = 2
    rows = -(-len(runs) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(9.6, 3.55 * rows), squeeze=False, layout="compressed")
    for panel in axes.flat:
        panel.set_axis_off()
        panel.set_aspect("equal")
    for panel, run in zip(axes.flat, runs):
        rest = run.rest_positions[:, :2]
        panel.add_collection(PolyCollection(rest[run.triangles], facecolors="#f6f7f8", edgecolors="#c9ced4",
                                            linewidths=0.5))
        centres = []
        for (centre, partners), colour in zip(_neighbours(run), (PINNED, FREE)):
            centres.append(rest[centre])
            lines = [(rest[centre], rest[other]) for other in partners]
            panel.add_collection(LineCollection(lines, colors=colour, linewidths=1.0, alpha=0.8))
            panel.plot(*rest[partners].T, "o", color=colour, markersize=3.2, markeredgecolor="white",
                       markeredgewidth=0.4)
            panel.plot(*rest[centre], "o", color=colour, markersize=7, markeredgecolor="white", zorder=4)
            top = rest[[centre, *partners], 1].max()
            panel.annotate(f"{len(partners)} springs", (rest[centre, 0], top), xytext=(0, 6),
                           textcoords="offset points", ha="center", va="bottom", color=colour, fontsize=9,
                           bbox=cloth.LABEL)
        panel.plot(*rest[run.pinned].T, "o", color="#111418", markersize=2.6, zorder=3)
        # The part of the mesh around the two vertices. All models have equal limits.
        (left, _), (x, y), width = rest.min(axis=0), np.mean(centres, axis=0), np.ptp(rest[:, 0])
        panel.set_xlim(left - 0.01, x + 0.5 * width)
        panel.set_ylim(y - 0.31 * width, y + 0.34 * width)
        panel.set_title(_title(run))
    return style.save(figure, out, "fig_structure")


def _claim(runs):
    numbers, right = {}, []
    for run in runs:
        m, n, t = run.summary["model_m"], run.summary["model_n"], run.get("/bending/lod/t", 0)
        other = np.where(run.pinned, n, m)  # the rule of one of the two vertices is enough for a spring
        for (centre, partners), level, name in zip(_neighbours(run), (n, m), ("pinned", "free")):
            ring = ring_of(run.triangles, centre, len(run.rest_positions))
            if run.model == "adaptive":
                wanted = (ring >= 1) & (ring <= np.maximum(level, other))
            else:
                wanted = (ring == (t or level)) | (ring == (t or other))
            wanted &= ~run.pinned if run.pinned[centre] else True
            numbers[f"{_title(run)}: springs of the {name} vertex"] = len(partners)
            right.append(set(partners) == set(np.flatnonzero(wanted)))
    return Claim("2-4", "A pinned vertex has springs to rings 1 to n, a free vertex to rings 1 to m (LOD: "
                 "only to ring t).", "the partners of the drawn vertices are exactly the vertices in these "
                 "rings, found by a breadth-first search over the mesh. Two vertices get a spring if the "
                 "rule of one of them requires it, but never two pinned vertices", numbers,
                 all(right) if right else None)
