"""Checks the metrics of a run against the bounds in its config ("expect"), like config/expectations.hpp."""
from dataclasses import dataclass

from bendlab.results.load import at
from runs.sweeps import point_key

NONE = object()


@dataclass
class Expected:
    """A bound on a metric of a run."""

    metric: str
    minimum: float | None
    maximum: float | None
    why: str
    where: dict  # JSON pointer → value of the runs to which the bound applies
    measured: float | None = None  # None: the run lacks the metric

    @property
    def holds(self):
        """Whether the metric is within its bound; False if the metric is NaN or missing."""
        if self.measured is None:
            return False
        return ((self.minimum is None or self.measured >= self.minimum)
                and (self.maximum is None or self.measured <= self.maximum))

    @property
    def bound(self):
        parts = [f"at least {self.minimum:g}" if self.minimum is not None else "",
                 f"at most {self.maximum:g}" if self.maximum is not None else ""]
        return " and ".join(part for part in parts if part)

    @property
    def margin(self):
        """How far the metric is inside its bound, relative to the bound; negative if outside."""
        sides = []
        if self.measured is None:
            return -float("inf")
        for bound, sign in ((self.minimum, 1), (self.maximum, -1)):
            if bound is not None:
                sides.append(sign * (self.measured - bound) / (abs(bound) or 1))
        return min(sides)

    def same_bound(self, other):
        """Whether two bounds are equal, apart from the measured values."""
        statement = lambda bound: (bound.metric, bound.minimum, bound.maximum, bound.why, bound.where)
        return statement(self) == statement(other)

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
    """The bounds that apply to this run, with the run's metrics. [] for a missing run."""
    if not run.summary:
        return []
    return [Expected(bound.metric, bound.minimum, bound.maximum, bound.why, bound.where,
                     run.summary.get(bound.metric))
            for bound in expected_of(settings) if _is_about(bound.where, settings, run)]


def _is_about(where, settings, run):
    return all(_has(run, settings, pointer, value) for pointer, value in where.items())


def _has(run, settings, pointer, value):
    if pointer == "/defaults":  # no setting of a run, which has the settings of these defaults
        return value == run.point.get(pointer, settings.get("defaults", "recommended"))
    own = at(run.config, pointer, NONE)
    return value is None if own is NONE else _within(value, own)


def _within(written, resolved):
    """Whether a setting of a config gives the resolved setting. Objects may leave out defaults."""
    if isinstance(written, dict) and isinstance(resolved, dict):
        return all(key in resolved and _within(entry, resolved[key]) for key, entry in written.items())
    return point_key({"": written}) == point_key({"": resolved})
