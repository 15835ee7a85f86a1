"""Checks the metrics of a run against the bounds in its config ("expect"), like config/expectations.hpp."""
import math
from dataclasses import dataclass, field, replace

from bendlab.results.load import at
from runs.sweeps import point_key

NONE = object()  # in place of a setting that the run lacks; the setting may be null


@dataclass
class Expected:
    """A bound on a metric of a run. Bounds are equal (==) even if their measured values differ."""

    metric: str
    minimum: float | None
    maximum: float | None
    why: str
    where: dict  # JSON pointer → value of the runs to which the bound applies
    measured: float | None = field(default=None, compare=False)  # None: the run lacks the metric
    diverged: bool = field(default=False, compare=False)  # metrics then describe only the frames before

    @property
    def holds(self):
        """Whether the metric is within its bound; False if it is NaN or missing, or if the run diverged."""
        return self.margin >= 0

    @property
    def bound(self):
        sides = (("at least", self.minimum), ("at most", self.maximum))
        return " and ".join(f"{side} {limit:g}" for side, limit in sides if limit is not None)

    @property
    def margin(self):
        """How far the metric is inside its bound, relative to the bound; negative if outside."""
        if self.measured is None or self.diverged:
            return -math.inf
        return min(sign * (self.measured - bound) / (abs(bound) or 1)
                   for bound, sign in ((self.minimum, 1), (self.maximum, -1)) if bound is not None)

    @property
    def limit(self):
        """The minimum or the maximum, whichever is nearer to the metric."""
        if self.minimum is None or self.maximum is None or self.measured is None:
            return self.maximum if self.minimum is None else self.minimum
        return min(self.minimum, self.maximum, key=lambda bound: abs(self.measured - bound))


def expected_of(settings):
    return [Expected(entry["metric"], entry.get("min"), entry.get("max"), entry.get("why", ""),
                     entry.get("where", {})) for entry in settings.get("expect", [])]


def check(settings, run):
    """The bounds that apply to this run, with the run's metrics. [] for a run without an end."""
    diverged = run.status == "diverged"
    if not run.summary and not diverged:
        return []
    return [replace(bound, measured=run.summary.get(bound.metric), diverged=diverged)
            for bound in expected_of(settings)
            if all(_has(run, settings, pointer, value) for pointer, value in bound.where.items())]


def _has(run, settings, pointer, value):
    if pointer == "/defaults":  # no setting of a run, which has the settings of these defaults
        return value == run.point.get(pointer, settings.get("defaults", "recommended"))
    own = at(run.config, pointer, NONE)
    return value is None if own is NONE else _within(value, own)


def _within(written, resolved):
    """Whether a setting of a config gives the resolved setting. Objects may leave out defaults."""
    if isinstance(written, dict) and isinstance(resolved, dict):
        return all(key in resolved and _within(entry, resolved[key]) for key, entry in written.items())
    return point_key(written) == point_key(resolved)
