"""Cantilevers: inextensible strips that are clamped at an end, under their weight, a load or a moment.

Weight: lengths are in units of ℓ = (B/(ρ g))^(1/3), as in strips.py; Γ = length³ = ρ g L³/B. Loads and
moments at the end: numbers are relative to the length L."""
import numpy as np

from truths.elastica import continued, curve
from truths.strips import Strip

# Roots of cos β cosh β = -1: Weaver, Timoshenko and Young 1990, Vibration problems in engineering, art. 5.10
CLAMPED_FREE = (1.8751040687119611, 4.694091132974175, 7.854757438237613)


def cantilever(length, clamp=0.0):
    """A strip clamped at (0, 0) at the angle `clamp` above the horizontal; the other end is free. Γ =
    length³. `height` and `width` span the strip; the free end is at x[-1], y[-1]. Rohde 1953, Q. Appl. Math.
    11, 337."""
    def solve_at(size, before):
        return curve(lambda p: (size, 0.0, -size, 1.0),
                     lambda a, b, p: [a[0], a[1], a[2] - clamp, b[3]],
                     before.solution.y if before else lambda t: clamp + 0 * t, [])
    whole = continued(solve_at, min(length, 1.0), length)
    x, y, theta, _ = whole.solution.y
    return Strip(whole.s, x, y, theta, whole.farthest(1) + whole.farthest(1, -1.0),
                 whole.farthest(0) + whole.farthest(0, -1.0), 0.0, 0.0, whole.error, whole)


def small_deflection(length):
    """Deflection in ℓ of the free end of a horizontally clamped strip, for length → 0: ρ g L⁴/(8 B), the
    solution of Euler and Bernoulli. Exact deflection: less by a share of Γ²/80 for small Γ = length³."""
    return length**4 / 8


def natural_frequency(length, mode=1):
    """ω in units of (g/ℓ)^(1/2) of small vibrations of a clamped strip without gravity: β² (B/ρ)^(1/2) / L²
    with cos β cosh β = -1 (modes 1 to 3; β has an error of 1e-15)."""
    return (CLAMPED_FREE[mode - 1] / length)**2


def end_shear(load):
    """(deflection, shortening) over the length of an inextensible cantilever with a transverse dead load at
    its end; `load`: P L²/B per width. Bisshopp and Drucker 1945, doi 10.1090/qam/13360. Error below 1e-11."""
    def solve_at(size, before):
        return curve(lambda p: (1.0, 0.0, size, 0.0), lambda a, b, p: [a[0], a[1], a[2], b[3]],
                     before.solution.y if before else lambda t: 0 * t, [])
    x, y = continued(solve_at, min(load, 1.0), load).solution.y[:2, -1]
    return float(y), float(1 - x)


def end_moment(share):
    """(deflection, shortening) over the length of an inextensible cantilever with an end moment; `share`:
    M L/(2 π B), 1 for a whole circle. Closed form: an arc of angle 2 π share."""
    angle = 2 * np.pi * share
    return float((1 - np.cos(angle)) / angle), float(1 - np.sin(angle) / angle)
