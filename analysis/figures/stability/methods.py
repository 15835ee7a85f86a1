"""The hard cases with other solver methods; the section's data are these runs as JSON objects."""
from figures.stability.cells import cells_of
from runs.stability_cases import METHOD_CASES, METHODS
from tables.numbers import rounded


def main(results, out, section):
    cells = cells_of(results, section, METHOD_CASES, METHODS, lambda run: (run.model, run.method))
    section.data = [as_json(cell) for cell in cells.values()]


def as_json(cell):
    return {"case": cell.case.name, "title": cell.case.title, "model": cell.model, "method": cell.run.method,
            "verdict": cell.verdict, "worst": rounded(cell.worst.as_json()),
            "seconds": rounded(cell.run.cpu_s), "why": "", "config": cell.run.experiment,
            "point": cell.run.point}
