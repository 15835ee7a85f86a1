"""Only the program lists bending models, solver methods and effects. A new model, method or effect needs no
change in analysis/, and is drawn in its own look."""
import ast
import json
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
from bendlab.results import load, registry  # noqa: E402
from figures.performance import effects  # noqa: E402
from tables import looks  # noqa: E402

# Allowed names in a list. A list with more names is a table, to which a new name would have to be added.
MOST = 2
# {"file: first names of the list": reason why these names are listed there}.
ALLOWED = {
    "figures/paper/fig_5.py: crossover adaptive k_ring": "the rows of the paper's Fig. 5, and the control",
    "figures/paper/large_forces.py: crossover adaptive lod": "the columns of the picture: its springs",
    "figures/performance/roofline.py: dihedral bridson mid_edge_average":
        "flops counted in the formulas of kernels; other kinds have no share of the roofline",
    "runs/obstacles.py: plane sphere capsule": "shapes of known distance; other shapes by their surface",
    "figures/stability/pin.py: none crossover dihedral": "the columns of the picture",
    "runs/stability_reasons.py: crossover k_ring sparse_lod": "a cause that was measured for these models",
}


FAMILIES = [registry.models(), registry.methods(), effects.known_effects()]


def constants(node):
    """The texts in a list, tuple, set or dict, and in the lists, tuples and sets directly inside it."""
    entries = [*node.keys, *node.values] if isinstance(node, ast.Dict) else node.elts
    for entry in entries:
        if isinstance(entry, ast.Constant) and isinstance(entry.value, str):
            yield entry.value
        elif isinstance(entry, (ast.List, ast.Tuple, ast.Set)):
            yield from (part.value for part in entry.elts if isinstance(part, ast.Constant))


def scripts():
    """{path from analysis/: text} of its files, without the Python package and installed packages."""
    home = ROOT / "analysis"
    paths = [path.relative_to(home) for path in sorted(home.rglob("*.py"))]
    return {path: (home / path).read_text(encoding="utf-8") for path in paths
            if not {"bendlab", "node_modules"} & set(path.parts)}


def tables():
    """{"file: first names": line} of all lists with more than MOST names of a family."""
    lines = {}
    for path, source in scripts().items():
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, (ast.List, ast.Tuple, ast.Set, ast.Dict)):
                texts = list(dict.fromkeys(constants(node)))
                for family in FAMILIES:
                    names = [text for text in texts if text in family]
                    if len(names) > MOST:
                        lines[f"{path}: {' '.join(names[:3])}"] = node.lineno
    return lines


class Tables(unittest.TestCase):
    def test_no_script_lists_models_methods_or_effects(self):
        unknown = {place: line for place, line in tables().items() if place not in ALLOWED}
        self.assertEqual(unknown, {}, "read these names from registry.py or from the runs")

    def test_every_allowed_list_exists(self):
        self.assertEqual(set(ALLOWED) - set(tables()), set())


class NewOnes(unittest.TestCase):
    def setUp(self):
        kept = [(known, dict(known)) for known in (registry._models, registry._methods)]
        self.addCleanup(lambda: [(known.clear(), known.update(before)) for known, before in kept])

    def test_models_that_are_not_in_the_schema_come_from_a_run_file(self):
        before = registry.models()
        registry.learn({"crossover": "crossover", "twisted": {"made_of": "hinges", "prestressed": False}},
                       {"leapfrog": {"integrator": "bdf2"}})
        self.assertEqual(registry.models(), [*before, "twisted"])
        # A file without the entry "made_of" changes nothing.
        self.assertEqual(registry.made_of("crossover"), "springs")
        self.assertEqual(looks.family("twisted"), "hinges")
        self.assertEqual(load.method_name({"method": "leapfrog", "integrator": "bdf2"}), "leapfrog")
        self.assertEqual(load.method_name({"method": "leapfrog", "integrator": "euler"}), "leapfrog, euler")

    def test_each_new_model_and_method_looks_different(self):
        registry.learn({f"model {i}": {} for i in range(8)}, {f"method {i}": {} for i in range(4)})
        of_models = [json.dumps(looks.of_model(model)) for model in registry.models()]
        self.assertEqual(len(set(of_models)), len(of_models))
        of_methods = [looks.method_look(method, variant)[0] for method in registry.methods()
                      for variant in (0, 1)]
        self.assertEqual(len(set(of_methods)), len(of_methods))

    def test_a_model_that_is_listed_nowhere_has_a_look(self):
        self.assertEqual(looks.of_model("unheard of")["mark"], "o")
        self.assertEqual(registry.models()[-1], "unheard of")


if __name__ == "__main__":
    unittest.main()
