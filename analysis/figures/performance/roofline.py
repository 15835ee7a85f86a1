"""The roofline: the least time that a projection can take on a machine (Williams, Waterman & Patterson 2009,
with a bandwidth for every cache and the memory, as in Yang et al. 2020)."""
from dataclasses import dataclass

import numpy as np

BYTES = {"float": 4, "double": 8}
INDEX = 4  # bytes of the index of a vertex
POINT = 8  # scalars of a corner: position and inverse mass, read and written
# COSTS: kind of constraint → corners that are not in a register already, scalars of rest data, and flops of a
# projection. Successive springs share a corner. An addition, multiplication, division or square root is one
# flop. The comments list the parts of the formulas with their flops.
#
# Five scaled differences (30), normals (18), |e|², |n1|², |n2|² (15), sine and cosine (12), arc tangent (20),
# wrap (3), reciprocals (6), gradients (60), Σ w|∇C|² (24), step (3), four corrections (28).
HINGE = (4, 2, 219)
# Of warp and of weft each: edges (6), f (9), |f| (6), error (1), Σ w|∇C|² (10), step (2), three corrections
# (24). Of shear: edges (6), f1 and f2 (18), three products (15), inverse and test (5), a1 and a2 (16),
# gradients (18), Σ w|∇C|² (23), step (2), corrections (21).
STRAIN = (3, 4, 240)
# A triangle without directors. Edges, normal and area (21); at each of three edges (429): vectors and
# lengths (17), direction inwards (12), feet (15), the neighbour's normal (21), sine and cosine (10), arc
# tangent (20), measure (26), turn and its gradient (22); U u and its length (23), weights (12), gradients
# (126), Σ w|∇C|² (36), step (4), six corrections (42).
FACE = (6, 13, 693)
COSTS = {
    "strain": STRAIN, "strain_angle": STRAIN, "dihedral": HINGE, "bridson": HINGE, "mid_edge_average": FACE,
    "corotational_face": FACE,
    # d (3), |d| (6), Σw (1), k (l0 - l) / (l Σw) (4), two corrections (14).
    "crossover": (1, 1, 28), "dense": (1, 1, 28),
    # Kx (24), |Kx| (6), gradients (16), Σ w|∇C|² (24), step (4), four corrections (28).
    "isometric": (4, 6, 102),
    # A ring of 13 corners with the padding: Kx (72), |Kx| (6), gradients (52), Σ w|∇C|² (78), step (4),
    # corrections (91).
    "laplacian": (13, 15, 303),
    # FACE (693), three directors with their angles (6), gradients (9), Σ w|∇C|² (6), corrections (6).
    "mid_edge": (9, 16, 720),
    # d and |d| (9), C (1), ∇C (3), Σ w|∇C|² (12), step (2), two corrections (14).
    "choi_ko": (2, 1, 41),
    # choi_ko (41), load and shares (25), first guess (20), two series of 8 terms (28), three Newton steps,
    # each with both series again (16 + 28), last step (20). The rest data include α and λ.
    "choi_ko_compliance": (2, 4, 266)}


@dataclass
class Machine:
    """What was measured of the machine: bytes per second of a triad by the size of its arrays in bytes, and
    operations per second by precision."""
    bandwidths: dict
    peaks: dict

    def bandwidth(self, size):
        """The bandwidth of the cache or memory that holds `size` bytes, bytes/s."""
        sizes = sorted(self.bandwidths)
        return np.interp(np.log(size), np.log(sizes), [self.bandwidths[measured] for measured in sizes])

    def share(self, row):
        """The least possible time, divided by the measured time of a row; None if it is not known."""
        kind, scalar = row["name"].rpartition("/")[0], BYTES[row["scalar"]]
        if not self.bandwidths or not self.peaks:
            return None
        if kind == "solve":  # each entry is read twice, and multiplies three numbers each time
            rate = row["bytes_per_second"]
            size = rate * row["call_ms"] / 1e3 / 2
            return float(rate * max(1 / self.bandwidth(size), 2 * 3 / scalar / self.peaks[row["scalar"]]))
        if kind not in COSTS:
            return None
        corners, rest, flops = COSTS[kind]
        streamed, point = corners * INDEX + rest * scalar, POINT * scalar
        size = row["constraints"] * streamed + row["vertices"] * point / 2
        points = row["vertices"] / row["constraints"]  # even the best order has to load every vertex once
        least_s = max(flops / self.peaks[row["scalar"]],
                      (streamed + corners * point) / self.bandwidth(min(self.bandwidths)),
                      (streamed + points * point) / self.bandwidth(size))
        return float(1e9 * least_s / row["ns_per_constraint"])
