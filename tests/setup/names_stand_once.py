"""Only the file of an effect, bending model or solver method names it. So a new one needs only its struct and
its file; code elsewhere uses traits.

Comments, texts of messages, the scenes of benchmarks, and the files that choose defaults are excluded.
"""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LISTS = ("lib/bendlab/effects/effects.hpp", "lib/bendlab/bending/models.hpp",
         "lib/bendlab/solver/methods.hpp")
DEFAULTS = ("lib/bendlab/scene/scene.hpp", "lib/bendlab/scene/defaults.cpp")
BENCHMARKS = "experiments/bench/"
# These names also mean other things: a choice of other settings, two mesh generators, and a trait of models.
OTHER_MEANINGS = ("none", "disc", "sphere", "prestressed")
# Likewise, but in one file: two kinds of constraints, a column of a table, and a program by others.
OTHER_USES = {("lib/bendlab/constraints/face_bend.hpp", "mid_edge"),
              ("lib/bendlab/constraints/quadratic_bend.hpp", "laplacian"),
              ("experiments/cli/stiffness_command.cpp", "moment"),
              ("experiments/dialects/newton.cpp", "newton")}


def code_of(path):
    """The lines of a file without comments."""
    return [line.split("//")[0] for line in path.read_text(encoding="utf-8").splitlines()]


def members():
    """{struct: (name in configs, own file)} of the three families."""
    own_files = {}
    for path in sorted((ROOT / "lib/bendlab").rglob("*.cpp")):
        text = path.read_text(encoding="utf-8")
        kinds = re.findall(r'^constinit const \w+Kind (\w+)::kind\{\s*\.name = "(\w+)"', text, re.M)
        for struct, name in kinds:
            own_files[struct] = (name, path.relative_to(ROOT).as_posix())
    return own_files


def uses(own_files):
    """"FILE:LINE: STRUCT" for each name outside its own file."""
    structs = re.compile(rf"(?<![\w\"/.])({'|'.join(own_files)})(?=::kind|>|\{{|\*| \w+ ?[={{;)])")
    struct_of = {name: struct for struct, (name, _) in own_files.items() if name not in OTHER_MEANINGS}
    names = re.compile(rf"\"({'|'.join(struct_of)})\"")
    places = []
    for folder in ("lib", "experiments"):
        for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
            file = path.relative_to(ROOT).as_posix()
            if file in (*LISTS, *DEFAULTS) or file.startswith(BENCHMARKS):
                continue
            for number, line in enumerate(code_of(path), 1):
                for struct in [*structs.findall(line), *(struct_of[name] for name in names.findall(line)
                                                         if (file, name) not in OTHER_USES)]:
                    if own_files[struct][1] != file:
                        places.append(f"{file}:{number}: {struct}")
    return places


class NamesStandOnce(unittest.TestCase):
    def test_every_listed_struct_has_its_file(self):
        listed = []
        for file in LISTS:
            text = (ROOT / file).read_text(encoding="utf-8")
            listed += re.findall(r"\w+", re.search(r"listed_kinds<\w+,([^>]*)>", text)[1])
        self.assertEqual(sorted(listed), sorted(members()))

    def test_no_other_file_names_a_struct(self):
        self.assertEqual(uses(members()), [])


if __name__ == "__main__":
    unittest.main()
