"""The classes of settings have the fields, units, defaults and ranges of the program. They print as the code
that constructs them, and refuse the values that the program refuses.

    test_settings.py PROGRAM
"""
import ast
import inspect
import json
import os
import re
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

import numpy as np

import bendlab as bl
from bendlab.settings import EFFECTS, INNER, METHODS, MODELS, PARTS, class_name

PROGRAM = sys.argv.pop(1)
ROOT = Path(__file__).resolve().parents[2]
SCHEMA = json.loads(subprocess.run([PROGRAM, "schema", "--json"], capture_output=True, check=True).stdout)


def of_schema(pointer):
    """The settings of the schema at a pointer, as {name: row}."""
    node = SCHEMA
    for key in pointer.split("/")[1:]:
        node = node["properties"][key]
    return node["properties"]


def effect_of_schema(name):
    for option in SCHEMA["properties"]["effects"]["items"]["oneOf"]:
        if option["properties"]["type"].get("const") == name:
            return {key: row for key, row in option["properties"].items() if key != "type"}
    raise KeyError(name)


class TheProgramsTables(unittest.TestCase):
    def check(self, cls, rows, names, renamed={}):
        """Compares each setting of a class with its row in the schema. `renamed`: {name: name in schema}."""
        fields = {field["name"]: field for table in cls._tables for field in table.fields}
        for name in names:
            with self.subTest(f"{cls.__name__}.{name}"):
                field, row = fields[name], rows[renamed.get(name, name)]
                self.assertIn(field["meaning"], row["description"])
                self.assertEqual(field["unit"] if field["unit"] not in ("", "1") else "",
                                 row.get("x-unit", "") if row.get("x-unit", "") not in ("", "1") else "")
                if field["default"] is not None and "default" in row:
                    self.assertEqual(field["default"], row["default"])
                    value = getattr(cls(), name)
                    self.assertEqual(list(value) if isinstance(value, tuple) else value, row["default"])
                for bound, key in (("minimum", "exclusiveMinimum" if field["above"] else "minimum"),
                                   ("maximum", "maximum")):
                    if abs(field[bound]) != float("inf") and row.get("type") in ("number", "integer"):
                        self.assertEqual(field[bound], row[key])
                if field["choices"] and "enum" in row:
                    self.assertEqual(field["choices"],
                                     [choice for choice in row["enum"] if choice is not None])
                self.assertIn(field["meaning"], inspect.getdoc(cls))

    def test_parts(self):
        classes = {"mesh": bl.Mesh, "pins": bl.Pins, "material": bl.Material, "initial": bl.Initial}
        seen = {"", "/bending", "/solver"}

        def visit(cls, pointer):
            seen.add(pointer)
            rows, own = of_schema(pointer), {field["name"] for field in cls._tables[0].fields}
            self.assertEqual(own, set(rows) - set(cls._inner))
            self.check(cls, rows, own)
            for name, inner in cls._inner.items():
                visit(inner, f"{pointer}/{name}")

        for name, cls in classes.items():
            visit(cls, f"/{name}")
        for name, cls in bl.Model._inner.items():
            visit(cls, f"/bending/{name}")
        self.assertEqual(seen, set(PARTS))

    def test_parts_below_others(self):
        woven = bl.MidEdge(rigidity=bl.Rigidity(warp=2e-5, weft=1e-5), map=bl.Map(file="stiff.ply"))
        self.assertEqual(woven._config(), {"model": "mid_edge", "rigidity": {"warp": 2e-5, "weft": 1e-5},
                                           "map": {"file": "stiff.ply"}})
        self.assertEqual(eval(repr(woven), {"MidEdge": bl.MidEdge, **INNER}), woven)
        self.assertNotEqual(woven, bl.MidEdge(rigidity=bl.Rigidity(warp=2e-5, weft=1e-5)))
        cloth = bl.Material(strain=bl.Strain(membrane=bl.Membrane(warp=900, weft=500, shear=30)))
        self.assertEqual(cloth._config(), {"strain": {"membrane": {"warp": 900, "weft": 500, "shear": 30}}})
        with self.assertRaisesRegex(TypeError, r"Rigidity\(…\)"):
            bl.MidEdge(rigidity=1e-5)

    def test_models(self):
        names = SCHEMA["properties"]["bending"]["properties"]["model"]["enum"]
        self.assertEqual([class_name(name) for name in names], list(MODELS))
        shared = of_schema("/bending")
        for name, cls in zip(names, MODELS.values()):
            rows = shared[name]["properties"] if name in shared else {}
            own = {field["name"] for field in cls._tables[0].fields}
            self.assertEqual(own, set(rows))
            self.check(cls, rows, own)
            self.check(cls, shared, {field["name"] for field in cls._tables[1].fields}, {"bending_k": "k"})

    def test_a_model_with_its_own_setting_k_has_the_shared_k_as_bending_k(self):
        ring = bl.KRing(k=3, stiffness="k", bending_k=0.25)
        self.assertEqual(ring._config(), {"model": "k_ring", "stiffness": "k", "k": 0.25, "k_ring": {"k": 3}})
        self.assertEqual(bl.Crossover(k=0.25)._config(), {"model": "crossover", "k": 0.25})

    def test_methods(self):
        rows = of_schema("/solver")
        self.assertEqual([class_name(name) for name in rows["method"]["enum"]], list(METHODS))
        seen = {"method"}
        for cls in METHODS.values():
            shared = {field["name"] for field in cls._tables[1].fields}
            seen |= {field["name"] for table in cls._tables for field in table.fields}
            self.check(cls, rows, shared)
            # Methods may differ in a default. The schema has the default of the first method.
            for field in cls._tables[0].fields:
                self.assertIn(field["name"], rows)
        self.assertEqual(seen, set(rows))

    def test_effects(self):
        for cls in EFFECTS.values():
            rows = effect_of_schema(cls._name)
            self.assertEqual({field["name"] for field in cls._tables[0].fields}, set(rows))
            self.check(cls, rows, rows)


class Values(unittest.TestCase):
    def test_repr_reads_back(self):
        scene = bl.Scene(
            mesh=bl.Mesh(generator="tube", radius=0.2, cells=12), pins=["top_rim", 3],
            material=bl.Material(density=0.3, strain=bl.Strain(form="green", membrane_stiffness=2e3)),
            bending=bl.DiscreteShells(flexural_rigidity=2e-5),
            solver=bl.Newton(integrator="euler", substeps=2),
            effects=[bl.Gravity(), bl.Wind(velocity=(0, 3, 0))], initial=bl.Initial(tilt=30), duration=2)
        self.assertEqual(eval(repr(scene), vars(bl)), scene)
        self.assertEqual(eval(repr(bl.Scene()), vars(bl)), bl.Scene())
        for family in (MODELS, METHODS, EFFECTS):
            for cls in family.values():
                required = [field for field in cls._tables[0].fields if field["required"]]
                if not required:
                    self.assertEqual(eval(repr(cls()), vars(bl)), cls())

    def test_numpy_numbers_are_numbers(self):
        self.assertEqual(bl.Mesh(cells=np.int64(7)).cells, 7)
        self.assertEqual(bl.Wind(velocity=np.array([0, 1, 2.5])).velocity, (0, 1, 2.5))
        self.assertEqual(bl.Material(density=np.float32(0.5)).density, 0.5)

    def test_settings_are_equal_if_their_values_are(self):
        self.assertEqual(bl.Wind(), bl.Wind(velocity=bl.Wind().velocity))
        self.assertNotEqual(bl.Scene(), bl.Scene(mesh=bl.grid(1, 1, 4)))
        scene = bl.Scene()
        scene.effects.append(bl.Wind())
        self.assertEqual(len(scene.config()["effects"]), 3)
        self.assertNotIn("effects", bl.Scene().config())

    def test_an_element_of_a_list_cannot_be_changed(self):
        with self.assertRaises(TypeError):
            bl.Wind().velocity[0] = 99

    def test_two_scenes_do_not_share_their_parts(self):
        first, second = bl.Scene(), bl.Scene()
        first.mesh.cells = 5
        self.assertEqual(second.mesh.cells, 32)

    def refused(self, action, *texts):
        with self.assertRaises((bl.ConfigError, TypeError)) as caught:
            action()
        for text in texts:
            self.assertIn(text, str(caught.exception))
        return caught.exception

    def test_an_error_states_the_pointer_and_the_allowed_values(self):
        error = self.refused(lambda: bl.Mesh(cells=0), "/mesh/cells", "1 to 4096")
        self.assertEqual(error.problems[0][0], "/mesh/cells")
        self.refused(lambda: bl.Mesh(cell=3), "/mesh/cell", "cells")
        self.refused(lambda: bl.Wind(velocty=(0, 1, 0)), "velocity")
        self.refused(lambda: bl.Wind(velocity=(0, 1)), "3 numbers")
        self.refused(lambda: bl.DiscreteShells(flexural_rigidity="stiff"), "flexural_rigidity")
        self.refused(lambda: bl.Scene(bending="dihedral"), "bending model", "DiscreteShells")
        self.refused(lambda: bl.Scene(effects=[bl.Newton()]), "effect")
        self.refused(lambda: bl.Scene(meshes=bl.grid(1, 1, 4)), "mesh")
        self.refused(lambda: bl.Pins(["upper_left"]))
        self.refused(lambda: bl.Scene(bl.grid(1, 1, 4)), "positional")
        self.refused(lambda: bl.Wind(velocity=(0, np.nan, 0)), "/effects/velocity", "not finite")
        self.refused(lambda: bl.Scene(pins=3.5), "Pins")
        self.refused(lambda: bl.Scene(effects=bl.Gravity()), "list of effects")
        self.assertEqual(bl.Scene(pins="top").pins.vertices, ("top",))

    def test_contradicting_settings_are_refused_when_the_scene_is_built(self):
        scene = bl.Scene(bending=bl.DiscreteShells(stiffness="k"), solver=bl.Newton())
        self.refused(scene.simulate, "/bending/stiffness")


class Texts(unittest.TestCase):
    def test_the_stub_is_valid_python_and_has_every_class(self):
        stub = ast.parse((Path(bl.__file__).parent / "__init__.pyi").read_text(encoding="utf-8"))
        names = {node.name for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(set(bl.__all__) - names, set())

    def test_examples_in_the_readmes_run(self):
        for readme in ("README.md", "lib/python/README.md"):
            examples = re.findall(r"```python\n(.*?)```", (ROOT / readme).read_text(encoding="utf-8"),
                                  re.DOTALL)
            self.assertTrue(examples)
            for number, example in enumerate(examples):
                with self.subTest(readme, number=number), tempfile.TemporaryDirectory() as place:
                    before = Path.cwd()
                    os.chdir(place)
                    try:
                        exec(example, {"__name__": "example"})
                    finally:
                        os.chdir(before)

    def test_examples_in_the_documentation_of_classes_run(self):
        for cls, name in ((bl.Model, "Opposite"), (bl.Effect, "Trap"), (bl.Measure, "Height")):
            with self.subTest(cls.__name__):
                lines = [line for line in cls.__doc__.split("\n")
                         if line.startswith(" " * 8) or not line.strip()]
                names = {"bl": bl, "np": np}
                exec(textwrap.dedent("\n".join(lines)), names)
                scene = bl.Scene(mesh=bl.grid(1, 1, 4), duration=0.05)
                if cls is bl.Measure:
                    with tempfile.TemporaryDirectory() as place:
                        self.assertIn("height", bl.run(scene, measures=[names[name]], out=place).dtype.names)
                    continue
                if cls is bl.Model:
                    scene.bending = names[name](stiffness="compliance", compliance=1e-3)
                else:
                    scene.effects = [names[name](frequency=0.5)]
                scene.simulate().step()

    def test_examples_in_the_documentation_of_the_package_run(self):
        examples = [block for block in bl.__doc__.split("\n\n") if block.startswith("    ")]
        self.assertGreater(len(examples), 1)
        exec(textwrap.dedent("\n\n".join(examples)), {})


if __name__ == "__main__":
    unittest.main()
