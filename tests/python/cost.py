"""What Python costs: a step against the same step of a loop in C++, a bending model against the library's,
and import. Least of several rounds that take turns, in CPU time.

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
    """CPU seconds of each action, of a fresh cloth."""
    found = [[] for _ in actions]
    for turn in range(ROUNDS):
        for number in list(range(len(actions)))[::1 if turn % 2 else -1]:
            make, action = actions[number]
            cloth = make()
            start = time.process_time()
            action(cloth)
            found[number].append(time.process_time() - start)
    return [min(seconds) for seconds in found]


def steps(count):
    def run(cloth):
        for _ in range(count):
            cloth.step()
    return run


def main():
    print("a step by Python over a step of run(), which loops in C++")
    for cells, count in ((16, 600), (64, 120), (256, 6)):
        for solver in (bl.QuasiNewton(), bl.Pbd(levels=0)):
            scene = bl.Scene(mesh=bl.grid(1, 1, cells), pins=TWO, solver=solver)
            python, cpp = least((scene.simulate, steps(count)),
                                (scene.simulate, lambda cloth: cloth.run((count - 0.5) / 60)))
            print(f"  {cells:3}² {type(solver).__name__:11} {1e6 * python / count:8.1f} µs  "
                  f"{python / cpp:.4f} times")
    print("a step with a model in Python over one with the library's discrete shells")
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
    print(f"import bendlab, NumPy with it: {seconds:.3f} s")


if __name__ == "__main__":
    main()
