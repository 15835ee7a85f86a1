"""Bending models, solver methods and effects are listed by the program alone: a new one needs no change in
analysis/, and is drawn in a look of its own."""
import ast
import json
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
import fig_performance_effects  # noqa: E402
from bendlab.results import load  # noqa: E402
import looks  # noqa: E402
from bendlab.results import registry  # noqa: E402
import style  # noqa: E402

MOST = 2  # names in one list; more are a table, to which a new name would have to be added
# "file: the place's first names" → why they are named there.
ALLOWED = {
    "fig_5.py: crossover adaptive k_ring": "the rows of the paper's Fig. 5, and the control",
    "fig_large_forces.py: crossover adaptive lod": "the columns of the picture: the paper's springs",
    "obstacles.py: plane sphere capsule": "shapes whose distance is known exactly; others by their surface",
    "fig_stability_pin.py: none crossover dihedral": "the columns of the picture",
    "stability_reasons.py: crossover k_ring sparse_lod": "a cause that was measured for these models",
}


FAMILIES = [registry.models(), registry.methods(), fig_performance_effects.known_effects()]


def constants(node):
    """The texts in a list, tuple, set or dict, and in those directly inside of it."""
    entries = [*node.keys, *node.values] if isinstance(node, ast.Dict) else node.elts
    for entry in entries:
        if isinstance(entry, ast.Constant) and isinstance(entry.value, str):
            yield entry.value
        elif isinstance(entry, (ast.List, ast.Tuple, ast.Set)):
            yield from (part.value for part in entry.elts if isinstance(part, ast.Constant))


def tables():
    """{"file: first names": line} of all places that name more than MOST of a family."""
    found = {}
    for path in sorted((ROOT / "analysis").glob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, (ast.List, ast.Tuple, ast.Set, ast.Dict)):
                texts = list(dict.fromkeys(constants(node)))
                for family in FAMILIES:
                    names = [text for text in texts if text in family]
                    if len(names) > MOST:
                        found[f"{path.name}: {' '.join(names[:3])}"] = node.lineno
    return found


class Tables(unittest.TestCase):
    def test_no_script_lists_models_methods_or_effects(self):
        unknown = {place: line for place, line in tables().items() if place not in ALLOWED}
        self.assertEqual(unknown, {}, "read them from registry.py, or from the runs")

    def test_what_is_allowed_is_there(self):
        self.assertEqual(set(ALLOWED) - set(tables()), set())


class NewOnes(unittest.TestCase):
    def setUp(self):
        kept = [(known, dict(known)) for known in (registry._models, registry._methods)]
        self.addCleanup(lambda: [(known.clear(), known.update(was)) for known, was in kept])

    def test_a_file_tells_of_models_that_the_schema_does_not_have(self):
        before = registry.models()
        registry.learn({"crossover": "crossover", "twisted": {"made_of": "hinges", "prestressed": False}},
                       {"leapfrog": {"integrator": "bdf2"}})
        self.assertEqual(registry.models(), [*before, "twisted"])
        self.assertEqual(registry.made_of("crossover"), "springs")  # an older file does not know it
        self.assertEqual(style.family("twisted"), "hinges")
        self.assertEqual(load.method_name({"method": "leapfrog", "integrator": "bdf2"}), "leapfrog")
        self.assertEqual(load.method_name({"method": "leapfrog", "integrator": "euler"}), "leapfrog, euler")

    def test_each_new_model_and_method_looks_different(self):
        registry.learn({f"model {i}": {} for i in range(8)}, {f"method {i}": {} for i in range(4)})
        seen = [json.dumps(looks.of_model(model)) for model in registry.models()]
        self.assertEqual(len(set(seen)), len(seen))
        seen = [style.method_look(method, variant)[0] for method in registry.methods() for variant in (0, 1)]
        self.assertEqual(len(set(seen)), len(seen))

    def test_a_model_that_no_file_lists_has_a_look_too(self):
        self.assertEqual(style.look("unheard of")["marker"], "o")
        self.assertEqual(registry.models()[-1], "unheard of")


if __name__ == "__main__":
    unittest.main()
