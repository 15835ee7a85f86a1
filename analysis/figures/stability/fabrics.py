"""The hard cases with the bending laws of fabrics; the section's data are these runs as JSON objects."""
from figures.stability import methods
from figures.stability.cells import cells_of
from runs.fabric_laws import law_of
from runs.stability_cases import FABRIC_CASES, FABRICS


def main(results, out, section):
    cells = cells_of(results, section, FABRIC_CASES, FABRICS,
                     lambda run: (run.model, law_of(run.config), run.method))
    section.data = [methods.as_json(cell) | {"law": law_of(cell.run.config)} for cell in cells.values()]
