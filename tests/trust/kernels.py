"""Methods that factorise in double precision have different bits with different kernels of OpenBLAS. A run
that was computed with other kernels is reused with a warning. The default method has the same bits in single
precision, and gives no warning. 'rerun' names the kernels.

    kernels.py PROGRAM      exit 1 if not; 77 if OpenBLAS has no other kernels to choose
"""
import json
import os
import sys
import tempfile
from pathlib import Path

from program import differences, run, run_files, write_config

KERNELS = ("Prescott", "Haswell")
SUPPLE = {"material": {"strain": {"stiffness": "compliance", "compliance": 1e-6}}}


def main(program):
    wrong = 0
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)

        def check(holds, what):
            nonlocal wrong
            if not holds:
                wrong += 1
                print(f"WRONG: {what}", flush=True)

        def compute(name, kernels, out="out"):
            done = run(program, "run", f"{name}.json", "--out", out, "--json", folder=folder,
                       env={**os.environ, "OPENBLAS_CORETYPE": kernels})
            if done.returncode not in (0, 6):
                raise SystemExit(done.stderr)
            return json.loads(done.stdout.splitlines()[0]), done.stderr

        common = {"mesh": {"cells": 24}, "duration": 0.2, "effects": [{"type": "gravity"}]}
        write_config(folder, "moves", **common)
        write_config(folder, "rests", **common, **SUPPLE, solver={"method": "equilibrium"})
        write_config(folder, "solves", **common, solver={"method": "newton"})
        write_config(folder, "begins", **common, **SUPPLE,
                     initial={"after": ["/solver/method=equilibrium", "/duration=0.1"]})
        bits = {}
        for name in ("moves", "rests", "solves", "begins"):
            compute(name, KERNELS[0])
            outcome, errors = compute(name, KERNELS[1])
            check(outcome["reused"], f"{name} was not reused")
            check(("BLAS kernels for Prescott" in errors) == (name != "moves"), f"{name}: printed {errors!r}")
            _, errors = compute(name, KERNELS[0])
            check("BLAS" not in errors, f"{name}: with the same kernels printed {errors!r}")
            compute(name, KERNELS[1], "other")
            first, = run_files(folder / "out" / name)
            second, = run_files(folder / "other" / name)
            bits[name] = differences(first, second)
            again = run(program, "rerun", first, "--json", folder=folder,
                        env={**os.environ, "OPENBLAS_CORETYPE": KERNELS[1]})
            changed = json.loads(again.stdout)["changed"]
            if "blas_kernels" not in changed:
                print("skipped: OpenBLAS does not choose its kernels here")
                return 77
        check(not bits["moves"], f"a motion depends on the kernels: {bits['moves']}")
    print(f"{wrong} wrong answers; parts that differ with the kernels: "
          f"{ {name: len(parts) for name, parts in bits.items()} }")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
