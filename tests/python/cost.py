"""The cost of Python: a step in a Python loop against the same step in a C++ loop, a bending model in Python
against the library's, and the import. Least CPU time of several rounds, in which the cases alternate.

    PYTHONPATH=build/release/python python3 tests/python/cost.py
"""
import subprocess
import sys
import time
from pathlib import Path

import bendlab as bl

sys.path.insert(0, str(Path(__file__).resolve().parent))
from models import FoldAngle  # noqa: E402

ROUNDS = 9
TWO = ["upper_left", "upper_right"]


def least(*actions):
    """Least CPU time of each action, s. Each round uses a new cloth."""
    times = [[] for _ in actions]
    for turn in range(ROUNDS):
        for number in list(range(len(actions)))[::1 if turn % 2 else -1]:
            make, action = actions[number]
            cloth = make()
            start = time.process_time()
            action(cloth)
            times[number].append(time.process_time() - start)
    return [min(seconds) for seconds in times]


def steps(count):
    def run(cloth):
        for _ in range(count):
            cloth.step()
    return run


def main():
    print("ratio: a step() called from Python to a step of run(), which loops in C++")
    for cells, count in ((16, 600), (64, 120), (256, 6)):
        for solver in (bl.QuasiNewton(), bl.Pbd(levels=0)):
            scene = bl.Scene(mesh=bl.grid(1, 1, cells), pins=TWO, solver=solver)
            python, cpp = least((scene.simulate, steps(count)),
                                (scene.simulate, lambda cloth: cloth.run((count - 0.5) / 60)))
            print(f"  {cells:3}² {type(solver).__name__:11} {1e6 * python / count:8.1f} µs  "
                  f"{python / cpp:.4f} times")
    print("ratio: a step with a model in Python to a step with the library's discrete shells")
    for cells in (16, 64):
        for solver in (bl.Pbd(levels=0), bl.QuasiNewton(), bl.Newton()):
            def scene(model):
                return bl.Scene(mesh=bl.grid(1, 1, cells), pins=TWO, solver=solver,
                                bending=model(stiffness="compliance", compliance=1e5))
            python, library = least((scene(FoldAngle).simulate, steps(3)),
                                    (scene(bl.DiscreteShells).simulate, steps(3)))
            print(f"  {cells:3}² {type(solver).__name__:11} {1e3 * python / 3:8.2f} ms  "
                  f"{python / library:.1f} times")
    code = "import time; start = time.perf_counter(); import bendlab; print(time.perf_counter() - start)"
    seconds = min(float(subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout)
                  for _ in range(ROUNDS))
    print(f"import bendlab, including NumPy: {seconds:.3f} s")


if __name__ == "__main__":
    main()
