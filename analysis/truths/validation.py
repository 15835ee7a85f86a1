"""Validation: the error of a simulation against data that were measured, and the uncertainty of this error.

ASME V&V 20-2009, Standard for verification and validation in computational fluid dynamics and heat transfer;
Roache 1994, doi 10.1115/1.2910291 (two meshes). All uncertainties are standard uncertainties, in the unit of
the data.
"""
from dataclasses import dataclass
from math import hypot, isfinite, nan, sqrt

from truths.order import CAUTIOUS

COVERAGE = 2  # a grid convergence index is an uncertainty of 95 %: about two standard uncertainties


@dataclass(frozen=True)
class Validation:
    """`data`: D, measured. `simulation`: S. `u_num`: of S, from mesh and scatter. `u_input`: of S, from
    uncertain inputs. `u_data`: of D. NaN: unknown; then there is no verdict."""
    data: float
    simulation: float
    u_num: float
    u_input: float
    u_data: float

    @property
    def error(self):
        """E = S - D. It is the error of the model, up to an uncertainty of u_val."""
        return self.simulation - self.data

    @property
    def u_val(self):
        """√(u_num² + u_input² + u_D²): of E, if the three are independent."""
        return hypot(self.u_num, self.u_input, self.u_data)

    @property
    def holds(self):
        """Whether |E| ≤ u_val, without a factor of coverage: a perfect model fails in one case of three, but
        a factor of 2 would pass models with twice the error. None if a number is missing."""
        return abs(self.error) <= self.u_val if isfinite(self.error + self.u_val) else None

    def verdict(self, unit):
        """`holds` as text. `unit`: of the data, in words."""
        if self.holds is None:
            return "no verdict: runs are missing"
        return ("validated within u_val" if self.holds else
                f"model error of at least {abs(self.error) - self.u_val:.1f} {unit}")


def scatter(groups):
    """Standard deviation of one value in groups of repeated values (#groups, any), pooled over the groups.
    NaN if no group has two values."""
    groups = [group for group in groups if len(group) > 1]
    squares = sum((value - sum(group) / len(group))**2 for group in groups for value in group)
    return sqrt(squares / sum(len(group) - 1 for group in groups)) if groups else nan


def mesh_uncertainty(differences, ratio, order):
    """Standard uncertainty on a mesh, from differences (#cases) to a mesh that is `ratio` times as coarse:
    the grid convergence index of two meshes with an assumed `order`, over the factor of coverage. Takes the
    root mean square over similar cases, because the difference of one case can be small by chance."""
    mean = sqrt(sum(difference**2 for difference in differences) / len(differences))
    return CAUTIOUS * mean / (ratio**order - 1) / COVERAGE
