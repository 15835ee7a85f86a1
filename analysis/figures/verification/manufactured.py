"""A manufactured solution: the virtual work of a smooth pose's elastic forces, which a Python test stored."""
import json

from runs import verified
from tables.committed import COMMITTED


def main(results, out, section):
    section.commands = ["./bendlab python tests/python/test_manufactured.py --write"]
    file = COMMITTED / "verification" / "manufactured.json"
    if not file.exists():
        section.missing.append("results/verification/manufactured.json, which ./bendlab python "
                               "tests/python/test_manufactured.py --write makes")
        return
    rows, charted = [], []
    for stored in json.loads(file.read_text(encoding="utf-8"))["rows"]:
        meshes = [{"h": 1 / cells, "value": work} for cells, work in zip(stored["cells"], stored["work"])]
        formal = 2.0 if stored["part"] == "membrane" else verified.ORDERS.get(stored["model"])
        made = verified.of_rows(meshes, stored["truth"], formal)
        name = {"part": stored["part"], "model": stored["model"],
                "family": verified.FAMILIES[stored["family"]], "displacement": stored["displacement"]}
        rows.append(name | {"truth": stored["truth"]} | made.cells())
        if stored["part"] == "bending":
            charted += [name | {"h": 1000 * row["h"],
                                "error": 100 * abs(row["value"] / stored["truth"] - 1)} for row in made.rows]
    section.add_table("works", "Virtual work of the elastic forces over the exact work", [
        "part", "model", ("family", "mesh"), ("displacement", "virtual displacement"),
        ("truth", "exact work", ".6f", "J"), *verified.columns()], rows)
    section.add_table("errors", "", ["model", ("family", "mesh"), ("h", "cell", "", "mm"),
                                     ("error", "error", "", "%")], charted)
    section.add_chart("errors", "Virtual work of the bending forces: error over mesh size", "h", ["error"],
                      ["model"], id="manufactured", held=["family"], at="alternating")
