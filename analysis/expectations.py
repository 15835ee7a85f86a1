"""Whether a run keeps what its config expects of it, by the rules of config/expectations.hpp."""
from dataclasses import dataclass

from bendlab.results.load import at
from sweeps import point_key

NONE = object()


@dataclass
class Expected:
    """A bound on a number of a run's summary."""

    metric: str
    minimum: float | None
    maximum: float | None
    why: str
    where: dict  # JSON pointer → value of the runs that it is about
    measured: float | None = None  # None: the run has no such number

    @property
    def holds(self):
        """False also for NaN and for a number that is not there."""
        if self.measured is None:
            return False
        return ((self.minimum is None or self.measured >= self.minimum)
                and (self.maximum is None or self.measured <= self.maximum))

    @property
    def bound(self):
        """The bound as text."""
        parts = [f"at least {self.minimum:g}" if self.minimum is not None else "",
                 f"at most {self.maximum:g}" if self.maximum is not None else ""]
        return " and ".join(part for part in parts if part)

    @property
    def margin(self):
        """How far the number is inside its bound, as a share of the bound; negative outside."""
        sides = []
        if self.measured is None:
            return -float("inf")
        for bound, sign in ((self.minimum, 1), (self.maximum, -1)):
            if bound is not None:
                sides.append(sign * (self.measured - bound) / (abs(bound) or 1))
        return min(sides)

    def same_bound(self, other):
        """Whether it is the same statement as another, about any run."""
        told = lambda each: (each.metric, each.minimum, each.maximum, each.why, each.where)
        return told(self) == told(other)

    @property
    def limit(self):
        """The side of the bound that the number is nearest to."""
        if self.minimum is None or self.maximum is None or self.measured is None:
            return self.maximum if self.minimum is None else self.minimum
        return min(self.minimum, self.maximum, key=lambda bound: abs(self.measured - bound))


def expected_of(settings):
    """The bounds that a config states."""
    return [Expected(entry["metric"], entry.get("min"), entry.get("max"), entry.get("why", ""),
                     entry.get("where", {})) for entry in settings.get("expect", [])]


def check(settings, run):
    """The bounds that are about this run, each with what was measured. [] for a run that is not there."""
    if not run.summary:
        return []
    return [Expected(each.metric, each.minimum, each.maximum, each.why, each.where,
                     run.summary.get(each.metric))
            for each in expected_of(settings) if _is_about(each.where, settings, run)]


def _is_about(where, settings, run):
    return all(_has(run, settings, pointer, value) for pointer, value in where.items())


def _has(run, settings, pointer, value):
    if pointer == "/defaults":  # no setting of a run, which has the settings that it stands for
        return value == run.point.get(pointer, settings.get("defaults", "recommended"))
    found = at(run.config, pointer, NONE)
    return value is None if found is NONE else _within(value, found)


def _within(value, found):
    """Whether a setting as written is what a resolved config has: an object may leave out defaults."""
    if isinstance(value, dict) and isinstance(found, dict):
        return all(key in found and _within(entry, found[key]) for key, entry in value.items())
    return point_key({"": value}) == point_key({"": found})
