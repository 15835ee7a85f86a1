"""Effects, bending models and solver methods are named in their own files only, so that a new one is its
struct and its file: code elsewhere asks for traits.

Excluded are comments, texts of messages, the scenes of benchmarks, and the files that choose defaults.
"""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LISTS = ("lib/bendlab/effects/effects.hpp", "lib/bendlab/bending/models.hpp",
         "lib/bendlab/solver/methods.hpp")
DEFAULTS = ("lib/bendlab/scene/scene.hpp", "lib/bendlab/scene/defaults.cpp")
BENCHMARKS = "experiments/bench/"
# A choice of other settings, two generators of meshes, and a trait of bending models.
OTHER_MEANINGS = ("none", "disc", "sphere", "prestressed")


def code_of(path):
    """The lines of a file without comments."""
    return [line.split("//")[0] for line in path.read_text(encoding="utf-8").splitlines()]


def members():
    """{struct: (name in configs, own file)} of the three families."""
    found = {}
    for path in sorted((ROOT / "lib/bendlab").rglob("*.cpp")):
        text = path.read_text(encoding="utf-8")
        kinds = re.findall(r'^constinit const \w+Kind (\w+)::kind\{\s*\.name = "(\w+)"', text, re.M)
        for struct, name in kinds:
            found[struct] = (name, path.relative_to(ROOT).as_posix())
    return found


def uses(found):
    """"FILE:LINE: what is named there" for each name outside its own file."""
    structs = re.compile(rf"(?<![\w\"/.])({'|'.join(found)})(?=::kind|>|\{{|\*| \w+ ?[={{;)])")
    struct_of = {name: struct for struct, (name, _) in found.items() if name not in OTHER_MEANINGS}
    names = re.compile(rf"\"({'|'.join(struct_of)})\"")
    told = []
    for folder in ("lib", "experiments"):
        for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
            file = path.relative_to(ROOT).as_posix()
            if file in (*LISTS, *DEFAULTS) or file.startswith(BENCHMARKS):
                continue
            for number, line in enumerate(code_of(path), 1):
                for struct in [*structs.findall(line), *(struct_of[name] for name in names.findall(line))]:
                    if found[struct][1] != file:
                        told.append(f"{file}:{number}: {struct}")
    return told


class NamesStandOnce(unittest.TestCase):
    def test_every_listed_struct_has_its_file(self):
        listed = []
        for file in LISTS:
            text = (ROOT / file).read_text(encoding="utf-8")
            listed += re.findall(r"\w+", re.search(r"listed_kinds<\w+,([^>]*)>", text)[1])
        self.assertEqual(sorted(listed), sorted(members()))

    def test_no_other_file_names_one(self):
        self.assertEqual(uses(members()), [])


if __name__ == "__main__":
    unittest.main()
