"""Units and meanings of the numbers of runs and of their settings, as the run files state them."""


class Meanings:
    """Of some runs: what the file of the first run that knows a name says. ("", "") for an unknown name."""

    def __init__(self, runs):
        kinds = {}
        for run in runs:  # runs of one kind know the same names
            if run.file:
                kinds.setdefault((run.get("/bending/model"), run.get("/solver/method"),
                                  len(run.get("/effects", []))), run)
        self._runs = list(kinds.values())

    def setting(self, pointer):
        """(unit, meaning) of a setting by its JSON pointer."""
        return self._find("settings", pointer)

    def number(self, name):
        """(unit, meaning) of a number of a run's summary."""
        return self._find("summary", name)

    def _find(self, part, name):
        found = (run.about[part][name] for run in self._runs if name in run.about.get(part, {}))
        return tuple(next(found, ("", "")))
