"""Figs. 2-4: the springs of one pinned and one free vertex for each model, as the solver has them."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from draw import cloth
from draw import style
from bendlab.results.load import select
from tables.section import Claim
from runs.stretch import ring_of
from runs.sweeps import load_experiment

PINNED, FREE = "#d4211c", "#7a3db8"  # the paper's red and violet


def main(results, out, section):
    """Draws the structures and checks them against their definitions."""
    runs = section.uses(load_experiment(results, "paper/structure"))
    panels = [("Fig. 2: crossover", select(runs, bending__model="crossover"))]
    panels += [(f"Fig. 3: adaptive, m = {m:g}, n = {n:g}", [run])
               for run in select(runs, bending__model="adaptive")
               for m, n in [(run.summary["model_m"], run.summary["model_n"])]]
    panels += [("Fig. 4: LOD, " + (f"t = {run.get('/bending/lod/t')}" if run.get("/bending/lod/t")
                                   else "t = m and n"), [run])
               for run in sorted(select(runs, bending__model="lod"),
                                 key=lambda run: run.get("/bending/lod/t"))]
    panels = [(title, own_runs[0]) for title, own_runs in panels if own_runs]
    if panels:
        section.pictures.append((_picture(panels, out), "The springs of one pinned vertex (red, right) and "
                                 "one free vertex (violet, left). Dark: the 1-ring, pinned too; there are no "
                                 "springs between pinned vertices. A spring exists if the rule of either end "
                                 "asks for it: with t = m and n the pin has its own ring n, and ring m "
                                 "because of its free neighbours."))
    section.claims.append(_claim(panels))


def neighbours(run):
    """(pinned vertex, its partners, free vertex, its partners), from the springs that a run recorded."""
    springs = run.constraints("distance")
    pinned, free = int(run.pin_seeds[0]), _free_vertex(run)

    def partners(vertex):
        own = springs[(springs == vertex).any(axis=1)]
        return np.unique(own[own != vertex])

    return pinned, partners(pinned), free, partners(free)


def _free_vertex(run):
    """A vertex left of the pin, far enough from the pin and the boundary to have whole rings."""
    rest = run.rest_positions
    place = rest[run.pin_seeds[0]] - [0.36 * np.ptp(rest[:, 0]), 0, 0]
    return int(np.argmin(np.linalg.norm(rest - place, axis=1)))


def _picture(panels, out):
    columns = 2
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(9.6, 3.55 * rows), squeeze=False, layout="compressed")
    for panel in axes.flat:
        panel.set_axis_off()
        panel.set_aspect("equal")
    for panel, (title, run) in zip(axes.flat, panels):
        rest, triangles = run.rest_positions[:, :2], run.triangles
        panel.add_collection(PolyCollection(rest[triangles], facecolors="#f6f7f8", edgecolors="#c9ced4",
                                            linewidths=0.5))
        pinned, of_pinned, free, of_free = neighbours(run)
        for centre, partners, colour in ((pinned, of_pinned, PINNED), (free, of_free, FREE)):
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
        _frame_on(panel, rest, [pinned, free], [of_pinned, of_free])
        panel.set_title(title)
    return style.save(figure, out, "fig_structure")


def _frame_on(panel, rest, centres, partners):
    """Frames the part of the mesh around the two vertices, the same for every model."""
    low, high = rest.min(axis=0), rest.max(axis=0)
    middle = rest[centres].mean(axis=0)
    panel.set_xlim(low[0] - 0.01, middle[0] + 0.5 * (high[0] - low[0]))
    panel.set_ylim(middle[1] - 0.31 * (high[0] - low[0]), middle[1] + 0.34 * (high[0] - low[0]))


def _claim(panels):
    numbers, right = {}, []
    for title, run in panels:
        if run.model not in ("adaptive", "lod"):
            continue
        pinned, of_pinned, free, of_free = neighbours(run)
        m, n, t = run.summary["model_m"], run.summary["model_n"], run.get("/bending/lod/t", 0)
        for centre, partners, level, name in ((pinned, of_pinned, n, "pinned"), (free, of_free, m, "free")):
            ring = ring_of(run.triangles, centre, len(run.rest_positions))
            other = np.where(run.pinned, n, m)  # a spring exists if the rule of either end asks for it
            if run.model == "adaptive":
                wanted = (ring >= 1) & (ring <= np.maximum(level, other))
            else:
                wanted = (ring == (t or level)) | (ring == (t or other))
            wanted &= ~run.pinned if run.pinned[centre] else True
            numbers[f"{title}: springs of the {name} vertex"] = len(partners)
            right.append(set(partners) == set(np.flatnonzero(wanted)))
    return Claim("2-4", "A pinned vertex is joined to its n-ring, a free one to its m-ring; with LOD only to "
                 "the ring t.", "the partners of the drawn vertices are exactly the vertices in these rings, "
                 "found by a breadth-first walk over the mesh; a spring exists if the rule of either end "
                 "asks for it, and never between two pinned vertices", numbers, all(right) if right else None)
