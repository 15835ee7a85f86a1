"""Cloth with exchangeable bending models: scenes, steps, sweeps, and models of your own.

    import bendlab as bl

    scene = bl.Scene(mesh=bl.grid(1, 1, 32), pins=["upper_left", "upper_right"],
                     bending=bl.DiscreteShells(flexural_rigidity=1e-5),
                     effects=[bl.Gravity(), bl.Wind(velocity=(0, 3, 0))])
    cloth = scene.simulate()
    cloth.run(0.1)
    cloth.positions.shape
"""


def load(place):
    """For a folder of results: its runs, sorted by their configs. For a run file: the run. See
    bendlab.results.load.Run."""
    from pathlib import Path
    from bendlab.results import load as results
    return results.load_runs(place) if Path(place).is_dir() else results.load_run(place)


try:
    from bendlab import _core
except ImportError as error:
    _why = f"{error}"

    def __getattr__(name):
        raise AttributeError(f"bendlab.{name} needs the extension module, which this Python cannot load "
                             f"({_why}); only load() works. Start Python by `./bendlab python`, which builds "
                             "it")
else:
    from bendlab._core import ConfigError, MeshError
    from bendlab.own import Elements, Measure, Rest, Setting
    from bendlab.runs import run
    from bendlab.scene import Cloth, Initial, Material, Mesh, Pins, Scene, grid
    from bendlab.settings import EFFECTS, INNER, METHODS, MODELS, Effect, Method, Model

    globals().update({**MODELS, **METHODS, **EFFECTS, **INNER})
    __all__ = ["Cloth", "ConfigError", "Effect", "Elements", "Initial", "Material", "Measure", "Mesh",
               "MeshError", "Method", "Model", "Pins", "Rest", "Scene", "Setting", "grid", "load", "run",
               *MODELS, *METHODS, *EFFECTS, *INNER]
