#!/usr/bin/env python3
"""Builds the program without an object cache, and fails if this takes more processor time than its budget.

The budget is a multiple of the time for compiling a fixed file (reference_for_build.cpp) in the same call,
because the same build may take 1.6 times as long on another machine. Usage: build_budget.py [BUDGET]
"""
import resource
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "budget"
BUDGET = 58.0  # times the reference; measured on 2026-11-27, with 18 models: 49 to 53


def processor_s(command):
    """Processor time, s, of a command and its child processes. If it fails, its output is shown."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\n{' '.join(map(str, command))} failed")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def reference_s():
    """Processor time, s, for compiling the reference. Both cores are busy, as in the build."""
    compile_it = ("g++ -std=c++20 -O2 -w -isystem /usr/include/eigen3 -c -o /dev/null "
                  f"'{Path(__file__).with_name('reference_for_build.cpp')}'")
    return processor_s(["sh", "-c", f"{compile_it} & {compile_it}; wait"]) / 2


def main(budget):
    """Compares the program's build with the reference; True if it is within the budget."""
    shutil.rmtree(BUILD, ignore_errors=True)
    # `env` replaces ccache.
    processor_s(["cmake", "--preset", "release", "-B", BUILD, "-DCMAKE_CXX_COMPILER_LAUNCHER=/usr/bin/env"])
    before = reference_s()
    built = processor_s(["cmake", "--build", BUILD, "--parallel", "2", "--target", "bendlab_program"])
    reference = (before + reference_s()) / 2
    shutil.rmtree(BUILD)
    print(f"The program takes {built:.0f} s of processor time to build, {built / reference:.1f} times the "
          f"reference ({reference:.1f} s); its budget is {budget:g} times")
    return built <= budget * reference


if __name__ == "__main__":
    within = main(float(sys.argv[1]) if len(sys.argv) > 1 else BUDGET)
    print(f"{int(within)} passed, {int(not within)} failed")
    sys.exit(0 if within else 1)
