"""Units and meanings of the metrics and settings of runs, as the run files state them."""


class Meanings:
    """Units and meanings of metrics and settings, each from the file of the first run that has the name.
    ("", "") for an unknown name."""

    def __init__(self, runs):
        kinds = {}
        for run in runs:  # runs with equal keys have the same names
            if run.file:
                kinds.setdefault((run.get("/bending/model"), run.get("/solver/method"),
                                  len(run.get("/effects", []))), run)
        self._runs = list(kinds.values())

    def setting(self, pointer):
        """(unit, meaning) of a setting by its JSON pointer."""
        return self._find("settings", pointer)

    def number(self, name):
        """(unit, meaning) of a metric of a run's summary."""
        return self._find("summary", name)

    def _find(self, part, name):
        stated = (run.about[part][name] for run in self._runs if name in run.about.get(part, {}))
        return tuple(next(stated, ("", "")))
