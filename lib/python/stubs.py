"""Writes bendlab/__init__.pyi for editors, because the classes of settings are made only when Python runs.

usage: stubs.py FILE
"""
import inspect
import sys
from pathlib import Path

sys.path.pop(0)  # this folder has the package without its extension module
import bendlab as bl  # noqa: E402
from bendlab.settings import Settings  # noqa: E402

# Types of members that have settings of their own.
PARTS = {"mesh": "Mesh", "pins": "Pins | Sequence[str | int]", "material": "Material",
         "bending": "Model", "solver": "Method", "effects": "Sequence[Effect] | None", "initial": "Initial"}


def documentation(text, indent):
    return (f'{indent}"""{inspect.cleandoc(text or "")}"""'
            .replace("\n", f"\n{indent}").replace(f"\n{indent}\n", "\n\n"))


def type_of(field):
    return field["type"] + (" | None" if field["optional"] else "")


def class_stub(cls):
    """A class with a typed attribute for each setting, and a constructor by keywords."""
    fields = {field["name"]: type_of(field) for table in reversed(cls._tables) for field in table.fields}
    parts = {name: cls._inner[name].__name__ if name in cls._inner else PARTS[name]
             for name, value in inspect.getmembers(cls) if type(value).__name__ == "Part"}
    members = {**fields, **parts}
    base = cls.__mro__[1].__name__
    lines = [f"class {cls.__name__}({base if base in ('Model', 'Method', 'Effect') else 'Settings'}):",
             documentation(cls.__doc__, "    ")]
    lines += [f"    {name}: {kind}" for name, kind in members.items()]
    first = {"Mesh": "vertices: ArrayLike | None = ..., triangles: ArrayLike | None = ..., ",
             "Scene": "folder: str = ..., "}.get(cls.__name__, "")
    keywords = ", ".join(f"{name}: {kind} = ..." for name, kind in members.items())
    lines.append(f"    def __init__(self, {first}{'*, ' if keywords and not first else ''}{keywords}) "
                 "-> None: ...")
    if cls is bl.Scene:
        lines += ["    def simulate(self) -> Cloth:",
                  documentation(bl.Scene.simulate.__doc__, "        "), "        ...",
                  "    def config(self) -> dict[str, Any]:",
                  documentation(bl.Scene.config.__doc__, "        "), "        ..."]
    return "\n".join(lines).replace("(self, )", "(self)")


def plain_class(cls, base=""):
    lines = [f"class {cls.__name__}{base}:", documentation(cls.__doc__, "    ")]
    for name, member in vars(cls).items():
        if name == "__init__" or (not name.startswith("_") and callable(member)):
            lines.append(f"    def {name}{inspect.signature(member)}: ...")
    return "\n".join(lines)


CLOTH = '''class Cloth:
{documentation}
    scene: Scene
    time: float
    settled: bool
    positions: NDArray[np.float64]
    velocities: NDArray[np.float64]
    triangles: NDArray[np.int32]
    masses: NDArray[np.float64]
    pinned: NDArray[np.int32]
    pins: NDArray[np.float64]
    def __init__(self, scene: Scene) -> None: ...
    def step(self) -> None: ...
    def run(self, seconds: float, progress: bool | Callable[[float], Any] = ...) -> None: ...
    def energies(self) -> dict[str, float]: ...
    def forces(self) -> dict[str, NDArray[np.float64]]: ...'''


def text():
    settings = [value for name, value in vars(bl).items()
                if inspect.isclass(value) and issubclass(value, Settings)]
    made = [cls for cls in settings if cls._tables]
    bases = [cls for cls in (bl.Model, bl.Method, bl.Effect)]
    blocks = ['from collections.abc import Callable, Sequence\nfrom typing import Any\n\nimport numpy as np\n'
              'from numpy.typing import ArrayLike, NDArray',
              documentation(bl.__doc__, ""),
              "class ConfigError(ValueError):\n    problems: list[tuple[str, str]]",
              "class MeshError(ValueError): ...",
              f"class Settings:\n{documentation(Settings.__doc__, '    ')}"]
    blocks += [f"class {cls.__name__}(Settings):\n{documentation(cls.__doc__, '    ')}" for cls in bases]
    blocks += [class_stub(cls) for cls in made]
    blocks.append(CLOTH.format(documentation=documentation(bl.Cloth.__doc__, "    ")))
    blocks += [plain_class(cls) for cls in (bl.Setting, bl.Elements, bl.Rest, bl.Measure)]
    for function in (bl.grid, bl.run, bl.load):
        blocks.append(f"def {function.__name__}{inspect.signature(function)}:\n"
                      f"{documentation(function.__doc__, '    ')}\n    ...")
    return "\n\n".join(blocks) + "\n"


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(text(), encoding="utf-8")
