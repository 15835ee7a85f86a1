"""The observed order of convergence of a number on three meshes, its limit and its uncertainty.

Roache 1994, Perspective: a method for uniform reporting of grid refinement studies, doi 10.1115/1.2910291;
Celik et al. 2008, doi 10.1115/1.2960953, and ASME V&V 20-2009, section 2-4 (any ratio of mesh sizes);
Oberkampf and Roy 2010, Verification and validation in scientific computing, section 8.7 (factors of safety);
Stern et al. 2001, doi 10.1115/1.1412235 (oscillatory convergence).
"""
from dataclasses import dataclass
from math import inf, isfinite, log, nan

FACTOR = 1.25  # of safety, if three meshes show an order near the formal order (Roache 1994)
CAUTIOUS = 3.0  # of safety otherwise
NEAR = 0.1  # relative difference between observed and formal order that is still near
LOWEST = 0.5  # least order that the cautious uncertainty assumes (Oberkampf and Roy)
HIGHEST = 20.0  # larger observed orders are reported as this order
ROUNDING = 1e-12  # relative; smaller differences between meshes count as none


@dataclass(frozen=True)
class Convergence:
    """`kind`: "monotonic", "oscillatory", "divergent" or "exact" (both finer meshes have equal values up to
    rounding).
    `order`: observed; NaN unless monotonic. `limit`: the value for mesh size 0 by Richardson's extrapolation;
    the finest value if exact, the middle of the range if oscillatory, NaN if divergent. `uncertainty`: of the
    value on the finest mesh, in its unit; infinite if divergent. `index`: grid convergence index, the
    uncertainty over the absolute finest value. `factor`: factor of safety in the uncertainty, 0 if exact."""
    kind: str
    order: float
    limit: float
    uncertainty: float
    index: float
    factor: float


def converge(sizes, values, formal=None, rounding=ROUNDING):
    """The convergence of `values` on three meshes of mesh sizes `sizes`, in any order. `formal`: the order in
    theory, if known. Then the factor of safety is 1.25 if the observed order is near the formal order, else 3
    with an order between 0.5 and the formal order. Without it, the factor is 1.25 with the observed order.
    Raises ValueError unless there are three different positive sizes and three finite values."""
    if len(sizes) != 3 or len(values) != 3 or len(set(sizes)) != 3 or min(sizes) <= 0:
        raise ValueError("needs three different positive mesh sizes and three values")
    if not all(map(isfinite, values)):
        raise ValueError("needs finite values")
    (fine, f1), (middle, f2), (coarse, f3) = sorted(zip(sizes, values))
    near, far = f2 - f1, f3 - f2
    tiny = rounding * max(map(abs, values))
    if abs(near) <= tiny:
        return Convergence("exact", nan, f1, 0.0, 0.0, 0.0)
    ratios = middle / fine, coarse / middle
    if near * far < 0:
        return _oscillatory(f1, values) if abs(near) < abs(far) else _divergent()
    order = _order(far / near, *ratios)
    if order is None:
        return _divergent()
    limit = f1 - near / (ratios[0]**order - 1)
    used, factor = order, FACTOR
    if formal is not None:
        is_near = abs(order - formal) <= NEAR * formal
        used, factor = (formal, FACTOR) if is_near else (min(max(order, LOWEST), formal), CAUTIOUS)
    return _result("monotonic", order, limit, factor * abs(near) / (ratios[0]**used - 1), f1, factor)


def extrapolated(sizes, values, order):
    """Richardson's extrapolation of two values to mesh size 0, if the error is ∝ size^order."""
    (fine, f1), (coarse, f2) = sorted(zip(sizes, values))
    return f1 + (f1 - f2) / ((coarse / fine)**order - 1)


def _order(growth, ratio, next_ratio):
    """The p > 0 with growth = (coarse^p - middle^p) / (middle^p - fine^p), by bisection: the right side grows
    with p. None if there is no such p, which means that the differences do not shrink fast enough."""
    difference = lambda p: ratio**p * (next_ratio**p - 1) / (ratio**p - 1)
    if growth <= log(next_ratio) / log(ratio) * (1 + 1e-9):
        return None
    low, high = 0.0, HIGHEST
    for _ in range(100):
        p = (low + high) / 2
        low, high = (p, high) if difference(p) < growth else (low, p)
    return high


def _oscillatory(finest, values):
    """Half the range of the values is the uncertainty (Stern et al. 2001, eq. 34), times a factor of
    safety."""
    half = (max(values) - min(values)) / 2
    return _result("oscillatory", nan, (max(values) + min(values)) / 2, CAUTIOUS * half, finest, CAUTIOUS)


def _divergent():
    return Convergence("divergent", nan, nan, inf, inf, CAUTIOUS)


def _result(kind, order, limit, uncertainty, finest, factor):
    index = uncertainty / abs(finest) if finest else inf
    return Convergence(kind, order, limit, uncertainty, index, factor)
