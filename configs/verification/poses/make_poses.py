"""Writes the start poses of loops_*.json, fold_*.json and moebius_*.json: grids with alternating diagonals that
are rolled to loops without weight, folded back, or rolled to a Möbius strip of vanishing width."""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "analysis"))
from truths import moebius, strips  # noqa: E402
from truths.collocation import interpolation  # noqa: E402

LENGTH = 0.2  # m, between the clamps
SIZE = 4.0  # of the loops, length over (B/ρ g)^(1/3)
LOOPS = {"ring": (20, 40, 80), "heart": (20, 40, 80), "pear": (20, 40, 80)}
ACROSS = 2  # cells across a loop
FOLDS = (20, 40, 80)
MOEBIUS = {0.1: (40, 80, 160), 0.025: (40, 80, 160)}  # width over length → cells along the strip


def triangles(along, across):
    """(#T, 3) of a grid with alternating diagonals, numbered as the generator `grid` does."""
    found = []
    for j in range(across):
        for i in range(along):
            a = j * (along + 1) + i
            b, c, d = a + 1, a + along + 2, a + along + 1
            found += [(a, b, c), (a, c, d)] if (i + j) % 2 == 0 else [(a, b, d), (b, c, d)]
    return np.array(found)


def write(name, rows):
    """`rows`: (#across + 1, #along + 1, 3) positions in m."""
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in rows.reshape(-1, 3)]
    found = triangles(rows.shape[1] - 1, rows.shape[0] - 1) + 1
    lines += ["f {} {} {}".format(*corners) for corners in found]
    (HERE / f"{name}.obj").write_text("\n".join(lines) + "\n", encoding="ascii")


def loop(kind, cells):
    shape = strips.hanging_loop(kind, SIZE, weight=0)
    s = np.linspace(0, SIZE, cells + 1)
    scale, step = LENGTH / SIZE, LENGTH / cells
    middle = np.array([np.interp(s, shape.s, shape.x), 0 * s, np.interp(s, shape.s, shape.y)]).T * scale
    tangents = np.array([[np.cos(shape.theta[end]), 0, np.sin(shape.theta[end])] for end in (0, -1)])
    middle = np.concatenate([middle[:1] - step * tangents[:1], middle, middle[-1:] + step * tangents[1:]])
    across = step * (np.arange(ACROSS + 1) - ACROSS / 2)
    write(f"{kind}_{cells}", middle + across[:, None, None] * np.array([0, 1, 0]))


def fold(cells):
    """A strip that turns back over itself. Only its ends are those of the folded heavy elastica."""
    exact = strips.free_fold()
    t = np.linspace(0, 1, 20 * cells + 1)
    angle = np.pi * (3 * t**2 - 2 * t**3) + 1.2 * np.sin(np.pi * t)**2 * t
    integral = lambda f: np.concatenate([[0], np.cumsum((f[1:] + f[:-1]) / 2)]) / (len(t) - 1)
    x, z = integral(np.cos(angle)), integral(np.sin(angle))
    x += t * (exact.x[-1] / exact.s[-1] - x[-1])
    middle = LENGTH * np.array([x, 0 * x, z - t * z[-1]]).T[::20]
    step = LENGTH / cells
    middle = np.concatenate([middle[:1] - [[step, 0, 0]], middle, middle[-1:] - [[step, 0, 0]]])
    across = step * (np.arange(ACROSS + 1) - ACROSS / 2)
    write(f"fold_{cells}", middle + across[:, None, None] * np.array([0, 1, 0]))


def moebius_strip(width, cells):
    line = moebius.midline()
    turn = np.array([[-1], [1], [-1]])  # half a turn about the axis of symmetry
    s = np.linspace(0, 0.5, cells // 2 + 1)
    at = interpolation(line.s, s).T
    place, across = line.position @ at, line.across @ at
    place = np.concatenate([place, (turn * place)[:, -2::-1]], axis=1)
    across = np.concatenate([across, (turn * across)[:, -2::-1]], axis=1)
    # The strip goes on behind its ends: s = -a is s = 1 - a on the other side of the strip.
    place = np.concatenate([place[:, -2:-1], place, place[:, 1:2]], axis=1)
    across = np.concatenate([-across[:, -2:-1], across, -across[:, 1:2]], axis=1)
    count = max(2, round(width * cells / 2))  # of cells across the strip
    offsets = width * (np.arange(count + 1) / count - 0.5)
    write(f"moebius_{width:g}_{cells}", LENGTH * (place.T + offsets[:, None, None] * across.T))


if __name__ == "__main__":
    for kind, meshes in LOOPS.items():
        for cells in meshes:
            loop(kind, cells)
    for cells in FOLDS:
        fold(cells)
    for width, meshes in MOEBIUS.items():
        for cells in meshes:
            moebius_strip(width, cells)
