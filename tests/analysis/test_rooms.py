"""Each folder of analysis/ imports only modules of earlier folders in a list. There are no import cycles."""
import ast
import unittest
from pathlib import Path

ANALYSIS = Path(__file__).resolve().parents[2] / "analysis"
ROOMS = ["bendlab", "truths", "oracle", "tables", "runs", "draw", "figures", "web", "sweep", "pages"]


def modules():
    """{name of a module of a room: its file}"""
    return {".".join(file.relative_to(ANALYSIS).with_suffix("").parts): file
            for room in ROOMS[1:] for file in sorted((ANALYSIS / room).rglob("*.py"))}


def imported(file):
    """The names that a file imports, also inside functions."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


class Rooms(unittest.TestCase):
    def test_no_room_imports_a_later_room(self):
        wrong = [f"{name} imports {target}" for name, file in modules().items() for target in imported(file)
                 if target.split(".")[0] in ROOMS
                 and ROOMS.index(target.split(".")[0]) > ROOMS.index(name.split(".")[0])]
        self.assertEqual(wrong, [])

    def test_there_are_no_import_cycles(self):
        arrows = {name: set(imported(file)) & modules().keys() for name, file in modules().items()}
        while free := [name for name, to in arrows.items() if not to]:
            arrows = {name: to - set(free) for name, to in arrows.items() if to}
        self.assertEqual(arrows, {})


if __name__ == "__main__":
    unittest.main()
