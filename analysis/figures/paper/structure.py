"""Figs. 2-4: for each model, the solver's springs of one pinned and one free vertex."""
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
                                 "one free vertex (violet, left). Dark: the 1-ring, which is pinned, too. "
                                 "Pinned vertices have no springs between them. Two vertices get a spring if "
                                 "the rule of one of them requires it. So with t = m and n the pin has "
                                 "springs to ring n by its own rule, and to ring m by the rule of the free "
                                 "vertices there."))
    section.claims.append(_claim(panels))


def neighbours(run):
    """(pinned vertex, its partners, free vertex, its partners). Partners are vertices joined by a spring."""
    springs = run.constraints("distance")
    pinned, free = int(run.pin_seeds[0]), _free_vertex(run)

    def partners(vertex):
        own = springs[(springs == vertex).any(axis=1)]
        return np.unique(own[own != vertex])

    return pinned, partners(pinned), free, partners(free)


def _free_vertex(run):
    """A vertex to the left of the pin, so far from the pin and the boundary that its rings are complete."""
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
    """Limits the panel to the part of the mesh around the two vertices. All models have equal limits."""
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
            other = np.where(run.pinned, n, m)  # the rule of one of the two vertices is enough for a spring
            if run.model == "adaptive":
                wanted = (ring >= 1) & (ring <= np.maximum(level, other))
            else:
                wanted = (ring == (t or level)) | (ring == (t or other))
            wanted &= ~run.pinned if run.pinned[centre] else True
            numbers[f"{title}: springs of the {name} vertex"] = len(partners)
            right.append(set(partners) == set(np.flatnonzero(wanted)))
    return Claim("2-4", "A pinned vertex has springs to rings 1 to n, a free vertex to rings 1 to m (LOD: "
                 "only to ring t).", "the partners of the drawn vertices are exactly the vertices in these "
                 "rings, found by a breadth-first search over the mesh. Two vertices get a spring if the "
                 "rule of one of them requires it, but never two pinned vertices", numbers,
                 all(right) if right else None)
