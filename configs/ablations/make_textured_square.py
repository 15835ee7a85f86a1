"""Writes textured_square.obj: the unit square in 32 x 32 cells whose texture coordinates, in m, are turned by 45 degrees."""
from pathlib import Path

CELLS = 32
HALF = 0.5**0.5  # cos 45° = sin 45°


def main():
    lines = [f"# unit square, {CELLS} x {CELLS} cells, texture coordinates turned by 45 degrees"]
    points = [(x / CELLS, y / CELLS) for y in range(CELLS + 1) for x in range(CELLS + 1)]
    lines += [f"v {x:g} {y:g} 0" for x, y in points]
    lines += [f"vt {HALF * (x + y):.8f} {HALF * (y - x):.8f}" for x, y in points]
    for y in range(CELLS):
        for x in range(CELLS):
            a = 1 + x + y * (CELLS + 1)
            b, c, d = a + 1, a + CELLS + 2, a + CELLS + 1
            lines += [f"f {p}/{p} {q}/{q} {r}/{r}" for p, q, r in ((a, b, c), (a, c, d))]
    Path(__file__).with_name("textured_square.obj").write_text("\n".join(lines) + "\n", encoding="ascii")


if __name__ == "__main__":
    main()
