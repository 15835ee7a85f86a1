"""Validation: drape coefficients of fabrics, from the page of stiffness."""
from tables.committed import COMMITTED
from tables.section import read_objects
from tables.table import Table

PAGE = COMMITTED / "stiffness" / "page.json"


def main(results, out, section):
    textile = next((kept for kept in read_objects(PAGE) if kept["id"] == "textile"), {"tables": []})
    kept = [table for table in textile["tables"] if table["id"] == "validation"]
    if not kept:
        section.missing.append("the table of validation in results/stiffness, which ./bendlab reproduce "
                               "stiffness makes")
        return
    section.tables += [Table.of_json(table) for table in kept]
