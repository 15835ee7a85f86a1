"""The measured numbers in our READMEs: the words around each number, and its value.

STATED: {README: [(words, values)]}. Braces in the words, as in `{:.1f}`, stand for a value from committed
results. Words without braces have no committed data: the text after the words states how to repeat the
measurement, and its date; or it is the path, from the README, of the file with the constant, and then a
pattern of the constant in this file.
"""
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
from figures.performance.measured import rows_of  # noqa: E402


def read(path):
    return (ROOT / "results" / path).read_text(encoding="utf-8")


def rows(page, **patterns):
    """The rows of the summary of a page whose values match these patterns."""
    return [row for row in json.loads(read(f"{page}/summary.json"))
            if all(re.fullmatch(pattern, str(row.get(key))) for key, pattern in patterns.items())]


def table(page, id, /, **values):
    """The rows with these values, in the table of a page with this id."""
    found = [each for section in json.loads(read(f"{page}/page.json")) for each in section["tables"]
             if each.get("id") == id]
    if len(found) != 1:
        raise ValueError(f"results/{page}/page.json has {len(found)} tables '{id}'")
    return [row for row in found[0]["rows"] if values.items() <= row.items()]


def column(page, id, name, /, **values):
    """The numbers in a column of the rows with these values, at least one."""
    numbers = [row[name] for row in table(page, id, **values) if row[name] is not None]
    if not numbers:
        raise ValueError(f"results/{page}/page.json: table '{id}' has no '{name}' with {values}")
    return numbers


def cost(name, *sizes, key="ns_per_constraint"):
    """The costs of a kernel: in single precision at these sizes, of the oracle, in double precision."""
    single = [bench[f"{name}/{size}", "float", 1][key] for size in sizes]
    return [*single, bench[f"{name}_oracle/128", "float", 1][key], bench[f"{name}/128", "double", 1][key]]


ERROR, MS = "error_physical_rms", "ms_per_frame"
# The stretch at rest of a sheet of 128² cells that hangs from one corner.
torn, mended = (column("paper", "rest", "whole", case=case, N=128)[0] + 1
                for case in ("crossover, pin alone", "adaptive, pin + 1-ring"))
rigid = column("paper", "strips", "measured", solver="the defaults")
strips = [run for run in rows("accuracy", experiment="accuracy_front_cantilever.*")
          if run.get(ERROR, 1) <= 0.01 and run["settings"]["method"] == "pbd"]
strip = min(strips, key=lambda run: run[MS])
# Error by the solver of the curtain: {(substeps, iterations, model): error}.
curtain = {(run["settings"]["substeps"], run["settings"]["iterations"], run["model"]): run["error_solver_rms"]
           for run in rows("accuracy", experiment="accuracy_front.*", cells="24")
           if run["model"] != "choi_ko" and run.get("error_solver_rms", 0) > 0
           and run["settings"]["method"] == "pbd"}
# Ratios of the error with iterations to the error with as many substeps.
gains = [curtain[1, substeps, model] / error for (substeps, iterations, model), error in curtain.items()
         if substeps in (16, 64, 256) and iterations == 1]
hinge = [100 * curtain[64, 4, "dihedral"], 100 * curtain[256, 1, "dihedral"]]
paper = rows("accuracy", experiment="accuracy_paper_64", model="adaptive")[0]
coarse = rows("accuracy", experiment="accuracy_paper_cells_slow", cells="8")[0]
beat = rows("accuracy", experiment="accuracy_beat")
nearest = min((run for run in beat if run[MS] <= paper[MS]), key=lambda run: run[ERROR])
fastest = min((run for run in beat if run[ERROR] <= paper[ERROR]), key=lambda run: run[MS])
ratio = {model: max(column("stiffness", "summary", "ratio", name=model, rule="stated stiffness"))
         for model in ("discrete_shells", "adaptive")}
ruled = column("stiffness", "ratios", "ratio", model="adaptive")
irregular = column("stiffness", "calibrated", "share", name="dihedral", mesh="delaunay")
lost = [(100 * (1 - row["C_moment"]), row["ratio"])
        for row in table("stiffness", "springs", ring=2, cells=24)]
pin = {row["remedy"]: (row["mean_strain"], row["cost"]) for row in table("stability", "pin", model="none")}
fails = {model: 100 * len(rows("stability", model=model, verdict="red")) / len(rows("stability", model=model))
         for model in ("none", "adaptive", "dihedral", "mid_edge")}
cut, free = (rows("stability", case=f"{case}: 1 s", model="adaptive", precision="single")[0]["worst"]["value"]
             for case in ("time_step_cut", "time_step"))
minutes = {page: sum(row["seconds"] for row in rows(page)) / 60 for page in ("stability", "plain")}
bench = {(row["name"], row["scalar"], row["threads"]): row
         for row in rows_of(json.loads(read("performance/bench.json")))}
large, step = bench["set_up/256", "float", 1], cost("step", 128, key="call_ms")

# B over the stated B of a strip of 20 cells that is bent a little, on grids; least errors of a falling strip.
shares = {model: [row["share"] for row in table("verification", "cells", model=model, cells=20)
                  if row["deflection"] == "small deflection" and row["family"] != "irregular"]
          for model in ("mid_edge", "discrete_shells")}
least = {name: min(column("verification", "levels", "least", name=name))
         for name in ("mid_edge", "dihedral", "discrete_shells")}

laws = json.loads(read("stability/fabrics.json"))
narrow = [row["share"] for model in ("discrete_shells", "prestressed")
          for row in table("stiffness", "directions", model=model)]

SMALL = "./bendlab run configs/stiffness/small_deflection.json, 2026-11-22"
CUT = "./bendlab run configs/stability/time_step_cut_slow.json, 2026-11-22"
REPRODUCE = "time ./bendlab reproduce, 2026-11-22"
WAITS = "two cores of an Intel Xeon, no object cache, 2026-11-29; tests/setup/waits.sh measures it"
STATED = {}
STATED["README.md"] = [
    ("the worst triangle is stretched to {:.0f} times its length", torn),
    ("the pin and is stretched to {:.1f} times its length", mended),
    ("is ever stretched to more than {:.2f} times its length",
     max(column("paper", "runs_recommended", "worst_stretch")) + 1),
    ("varies by at most {:.0f} % from 12 to 96", 100 * (max(rigid) / min(rigid) - 1)),
    ("3.5 minutes for the build", WAITS),
    ("8 minutes more to the paper's page, and 7 minutes more to the end", REPRODUCE),
    ("9 minutes, of which 6.5 are the build", WAITS + "; program 3.5, tests 3.1, ctest 2.5"),
    ("its length has {:.3f} to {:.3f} of the stated B, but {:.2f} to {:.2f} with `discrete_shells`",
     min(shares["mid_edge"]), max(shares["mid_edge"]), min(shares["discrete_shells"]),
     max(shares["discrete_shells"])),
    ("where `mid_edge` has {:.1f} %", least["mid_edge"]),
    ("of hinges stays above {:.0f} %", min(least["dihedral"], least["discrete_shells"])),
    ("varies by at most {:.1f} % from 12 to 96 cells (irregular", 100 * (ratio["discrete_shells"] - 1)),
    ("On a cantilever of {:.0f} cells, hinges with `pbd` reach an error of 1 % of its diagonal in {:.2f} ms",
     strip["cells"], strip[MS]),
    ("and `mid_edge` in {:.1f} ms. Springs do not",
     min(run[MS] for run in strips if run["model"] == "mid_edge")),
    ("`adaptive` fails in {:.0f} %, `mid_edge` in {:.0f} %, and `dihedral`, like cloth without bending, in "
     "{:.0f} %", fails["adaptive"], fails["mid_edge"], fails["dihedral"]),
    ("varies by a factor of {:.0f} to {:.0f} from 12", min(ruled), max(ruled)),
    ("(`pin_zone`), the stiffness varies by at most {:.0f} %", 100 * (ratio["adaptive"] - 1))]
buckled = {model: [row["over"] for row in table("verification", "loads", model=model, cells=10)]
           for model in ("mid_edge", "dkt")}
STATED["lib/bendlab/bending/README.md"] = [
    ("buckle at {:.2f} to {:.2f} of the load of plate theory with `mid_edge`, and at {:.2f} to {:.2f}",
     min(buckled["mid_edge"]), max(buckled["mid_edge"]), min(buckled["dkt"]), max(buckled["dkt"])),
    ("takes 15 % less time with `dkt`",
     "./bendlab bench --filter law/quasi_newton, rows one_rigidity, 2026-11-28"),
    ("A wide sheet then has 0.75 of the stated", SMALL), ("and 0.93 on irregular meshes", SMALL),
    ("are 4 times as stiff", SMALL + ": model_large_deflection_most over _least"),
    ("are 1.4 times as stiff",
     "configs/models/k_ring.json, physical, ring 2 alone: model_quartic_anisotropy"),
    ("`dihedral` by {:.0f} to {:.0f} %", 100 * (1 - max(irregular)), 100 * (1 - min(irregular))),
    ("loses {:.0f} % of its C at a ratio of {:,.0f}, and {:.0f} % at {:,.0f}",
     *min(pair for pair in lost if pair[0] > 10), *min(pair for pair in lost if pair[0] > 28))]
STATED["lib/bendlab/solver/README.md"] = [
    ("hung 14 % of its size too high", "quasi_newton 1 × 10, two corners, against equilibrium, 2026-11-23"),
    ("at 985 degrees per second",
     "no effects, membrane k, 6 cells, scale 0.9, 1.1, 128 substeps, 2026-11-24"),
    ("the motion was wrong by 16 %",
     "quasi_newton 1 × 60, 3 cells, density_ratio 20, against newton, 2026-11-24"),
    ("the mean strain was {:.1f} with the published shear", pin["as published"][0]),
    ("{:.2f} with the angle, which took {:.2f} times the CPU time", *pin["shear as an angle"]),
    ("the published shear was {:.0f} (`configs/one_pin`)", pin["40 iterations"][0]),
    ("moves {:.0f} times its size away", free), ("its reach stays at {:.2f} sizes", cut),
    ("a mean strain of 387", "./bendlab run configs/stability/time_step.json, 2026-11-22"),
    ("its mean strain at 0.05", CUT), ("into 134 parts", CUT)]
STATED["lib/python/README.md"] = [
    ("`quasi_newton` 4.1 times as long, and a step of `pbd` 24 times", "tests/python/cost.py, 2026-11-26")]
STATED["configs/README.md"] = [
    ("the stated rigidities within {:.1f} % on 42 cells",
     100 * max(abs(row["share"] - 1) for row in table("stiffness", "directions", model="mid_edge"))),
    ("up to {:.0f} times too soft or {:.1f} times", 1 / min(narrow), max(narrow))]
STATED["experiments/README.md"] = [
    ("writes a checkpoint every 10 s", "run/run_control.hpp", "checkpoint_interval_s = 10;"),
    ("than 1 % of its time", "run/checkpoint.cpp", r"largest_share = 0\.01;"),
    ("reach about 90 %", "measures/effective_stiffness.hpp", "substeps_for_90_percent"),
    ("than 50 ms are repeated", "advise/runs.cpp", r"long_enough = 0\.05;"),
    ("a mean strain up to 1 %", "measures/effective_stiffness.cpp", r"stretched = 0\.01;"),
    ("an error above 20 %, 10 % more strain", "advise/trial.hpp",
     r"(?s)largest_error = 0\.2;.*largest_strain = 0\.1;"),
    ("stretched to 1.5 times the", "advise/trial.hpp", r"largest_stretch = 1\.5;")]
STATED["experiments/bench/README.md"] = [
    ("about 35 minutes", "./bendlab bench, 2026-11-28: 38, 35 and 33 minutes"),
    ("(xx, yy, xy) | {:.1f} ns | {:.1f} ns | {:.0f} ns | {:.1f} ns", *cost("strain", 128, 1024)),
    ("| crossover spring | {:.1f} ns | {:.1f} ns | {:.0f} ns | {:.1f} ns", *cost("crossover", 128, 1024)),
    ("(`adaptive`) | {:.1f} ns | | {:.0f} ns | {:.1f} ns", *cost("dense", 128)),
    ("| {:.1f} ms (two threads: {:.1f} ms) | | {:.0f} ms | {:.1f} ms",
     step[0], bench["step/128", "float", 2]["call_ms"], *step[1:]),
    ("adds {:.0f} % of wall time", 100 * (bench["recording/128", "float", 2]["wall_ratio"] - 1)),
    ("side by side** are {:.1f} times as fast", bench["sweep/64", "float", 2]["speed_up"]),
    ("the {:.1f} million springs", large["constraints"] / 1e6),
    ("takes {:.1f} s and {:.0f} bytes of memory", large["call_ms"] / 1e3, large["peak_bytes_per_spring"])]
STATED["analysis/README.md"] = [
    ("takes about 24 minutes", REPRODUCE),
    ("takes about 55 minutes", "./bendlab reproduce accuracy at 8d6c50c2, 2026-11-28"),
    ("errors of 20, 5 and 1 %", "figures/accuracy/measures.py", r"LEVELS = \(20, 5, 1\)"),
    ("ten minutes at rest", "../configs/stability/rest_slow.json", '"duration": 600'),
    ("in all of {:.0f} comparisons, by {:.1f} to {:.0f} times", len(gains), min(gains), max(gains)),
    ("of `dihedral` is {:.2f} % in 64 substeps and {:.2f} % in 256", *hinge),
    ("against the stated cloth is {:.1f} %", 100 * paper[ERROR]),
    ("a mesh of {:.0f}² cells", fastest["cells"]),
    ("an equal error in {:.2f} % of the time", 100 * fastest[MS] / paper[MS]),
    ("the error is then {:.1f} %, in {:.1f} % of the time", 100 * coarse[ERROR],
     100 * coarse[MS] / paper[MS]),
    ("can be cut to {:.1f} % of its value: with `" + nearest["model"] + "` springs",
     100 * nearest[ERROR] / paper[ERROR]),
    ("on {:.0f}² cells in {:.0f} substeps", nearest["cells"], nearest["settings"]["substeps"]),
    ("{:,.0f} runs, {:.0f} minutes of", len(rows("stability")), minutes["stability"]),
    ("methods: {:.0f} judged runs, {:.0f} minutes", len(laws), sum(run["seconds"] for run in laws) / 60),
    ("makes {:,.0f} runs of plain scenes", len(rows("plain"))),
    ("in {:.0f} minutes of processor time, and checks", minutes["plain"]),
    ("counts {:.0f} runs that broke a bound", len(rows("plain", verdict="silent")))]
STATED["tests/mutants/README.md"] = [("(93.3 %)", "mutate.py with seed 1 and 190 mutants, 2026-11-22")]
# Statements of our READMEs without a number.
HOLDS = {
    "Springs do not": not {run["model"] for run in strips} & {
        "crossover", "k_ring", "adaptive", "lod", "sparse_lod", "prestressed", "choi_ko"},
    "`dihedral`, like cloth without bending,": fails["dihedral"] == fails["none"] > fails["adaptive"],
    "More iterations do not help": pin["40 iterations"][0] > pin["shear as an angle"][0],
    "Single precision is enough for many substeps": hinge[1] < hinge[0] and min(gains) > 1,
}
