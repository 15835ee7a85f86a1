"""The measured numbers in our READMEs: the words in which each stands, and its value.

STATED: README → [(words, values)]. Braces in the words, as in `{:.1f}`, stand for a value, which comes from
committed results. Words without braces have no such data: the text beside them says how to repeat the
measurement, and when it was made; or it is the path, from the README, of the file that has the constant.
"""
import html
import json
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def read(path):
    return (ROOT / "results" / path).read_text(encoding="utf-8")


def rows(page, **patterns):
    """The rows of a page's summary whose values match these patterns."""
    return [row for row in json.loads(read(f"{page}/summary.json"))
            if all(re.fullmatch(pattern, str(row.get(key))) for key, pattern in patterns.items())]


def table(page, caption):
    """The rows of a page's table: heading → text."""
    text = read(f"{page}/index.html").split(f"<caption>{caption}<")[1].split("</table>")[0]
    lines = [[html.unescape(re.sub("<.*?>", "", cell)) for cell in re.findall("<t[hd].*?>(.*?)</t[hd]>", row)]
             for row in text.split("<tr")[1:]]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def measured(check, **patterns):
    return [row["measured"] for row in rows("stiffness", check=check, **patterns)]


def cost(name, *sizes, key="ns_per_constraint"):
    """The cost of something: in single precision at these sizes, by the oracle, in double precision."""
    single = [bench[f"{name}/{size}", "float", 1][key] for size in sizes]
    return [*single, bench[f"{name}_oracle/128", "float", 1][key], bench[f"{name}/128", "double", 1][key]]


CORNER, ERROR, MS = "one corner, N = 128: stretch − 1 anywhere, at rest", "error_physical_rms", "ms_per_frame"
promise, rigid = (row["numbers"] for row in rows("paper", claim="Cloth that does not .*"))
strips = [run for run in rows("accuracy", experiment="accuracy_front_cantilever.*")
          if run.get(ERROR, 1) <= 0.01]
strip = min(strips, key=lambda run: run[MS])
# (substeps, iterations, model) → error by the solver, of the curtain.
curtain = {(run["settings"]["substeps"], run["settings"]["iterations"], run["model"]): run["error_solver_rms"]
           for run in rows("accuracy", experiment="accuracy_front.*", cells="24")
           if run["model"] != "choi_ko" and run.get("error_solver_rms", 0) > 0}
# How many times smaller the error is with substeps than with as many iterations.
gains = [curtain[1, substeps, model] / error for (substeps, iterations, model), error in curtain.items()
         if substeps in (16, 64, 256) and iterations == 1]
hinge = [100 * curtain[64, 4, "dihedral"], 100 * curtain[256, 1, "dihedral"]]
paper = rows("accuracy", experiment="accuracy_paper_64", model="adaptive")[0]
coarse = rows("accuracy", experiment="accuracy_paper_cells_slow", cells="8")[0]
beat = rows("accuracy", experiment="accuracy_beat")
nearest = min((run for run in beat if run[MS] <= paper[MS]), key=lambda run: run[ERROR])
fastest = min((run for run in beat if run[ERROR] <= paper[ERROR]), key=lambda run: run[MS])
ratio = {model: max(measured("largest ratio of stiffness between two resolutions", model=model))
         for model in ("discrete_shells", "adaptive")}
ruled = measured("largest ratio of B between two resolutions", model="adaptive")
irregular = measured("stiffness, measured over stated", model="dihedral", mesh="delaunay.*")
lost = [(100 * (1 - float(row["C from m(κ) over C of the springs"])), float(row["R⁴/(α C)"]))
        for row in table("stiffness", "Ring springs") if (row["ring t"], row["cells"]) == ("2", "24")]
pin = {row["remedy"]: (float(row["mean strain"]), float(row["CPU time relative to published"]))
       for row in table("stability", "At the pin") if row["model"] == "none"}
fails = {model: 100 * len(rows("stability", model=model, verdict="red")) / len(rows("stability", model=model))
         for model in ("none", "adaptive", "dihedral")}
cut, free = (rows("stability", case=f"{case}: 1 s", model="adaptive", precision="single")[0]["worst"]["value"]
             for case in ("time_step_cut", "time_step"))
minutes = {page: sum(row["seconds"] for row in rows(page)) / 60 for page in ("stability", "plain")}
bench = {(row["name"], row["scalar"], row["threads"]): row
         for row in json.loads(read("performance/bench.json"))["rows"]}
large, step = bench["set_up/256", "float", 1], cost("step", 128, key="step_ms")
orders = [row for row in bench.values() if row["name"].startswith("convergence")]
# How many percent more strain error one order of constraints leaves than another.
by_colour, from_pins, colour_from_pins = (
    [100 * (row[f"strain_error_{one}"] / row[f"strain_error_{other}"] - 1) for row in orders]
    for one, other in (("colour", "mesh"), ("from_pins", "mesh"), ("colour_from_pins", "colour")))

SMALL = "./bendlab run configs/stiffness/small_deflection.json, 2026-11-22"
CUT = "./bendlab run configs/stability/time_step_cut_slow.json, 2026-11-22"
REPRODUCE = "time ./bendlab reproduce, 2026-11-22"
CLONE = " in a new clone without object cache, 2026-11-25"
STATED = {}
STATED["README.md"] = [
    ("the worst triangle is {:.0f} times as long as unstretched", promise[f"crossover, {CORNER}"] + 1),
    ("neighbours pinned, it is {:.1f} times as long", promise[f"adaptive, {CORNER}"] + 1),
    ("is ever more than {:.2f} times as long",
     promise["stretch − 1 anywhere, at any time, largest of all scenes and N"] + 1),
    ("varies by at most {:.0f} % from 12 to 96",
     100 * (rigid["largest rigidity over smallest, the defaults"] - 1)),
    ("2.7 minutes to the first figure", "time to the first figure" + CLONE),
    ("takes 8 minutes more, and everything 7 more", REPRODUCE),
    ("14 minutes, most of it the build", "time ./bendlab test" + CLONE),
    ("varies by at most {:.1f} % from 12 to 96 cells (irregular", 100 * (ratio["discrete_shells"] - 1)),
    ("On a cantilever of {:.0f} cells hinges with `pbd` have an error of 0.01 sizes in {:.2f} ms per frame",
     strip["cells"], strip[MS]),
    ("`adaptive` fails in {:.0f} %, and `dihedral` in {:.0f} %", fails["adaptive"], fails["dihedral"]),
    ("varies by a factor of {:.0f} to {:.0f} over these", min(ruled), max(ruled)),
    ("(`pin_zone`), by at most {:.0f} %", 100 * (ratio["adaptive"] - 1))]
STATED["lib/bendlab/bending/README.md"] = [
    ("It then has 0.75 of the stated", SMALL), ("and 0.93 on irregular meshes", SMALL),
    ("are 4 times as stiff", SMALL + ": model_large_deflection_most over _least"),
    ("differ by 1.4 times there",
     "configs/models/k_ring.json, physical, ring 2 alone: model_quartic_anisotropy"),
    ("`dihedral` by {:.0f} to {:.0f} %", 100 * (1 - max(irregular)), 100 * (1 - min(irregular))),
    ("has lost {:.0f} % of its C at {:,.0f}, and {:.0f} % at {:,.0f}",
     *min(pair for pair in lost if pair[0] > 10), *min(pair for pair in lost if pair[0] > 28))]
STATED["lib/bendlab/solver/README.md"] = [
    ("hung 14 % of its size too high", "quasi_newton 1 × 10, two corners, against equilibrium, 2026-11-23"),
    ("at 985 degrees per second",
     "no effects, membrane k, 6 cells, scale 0.9, 1.1, 128 substeps, 2026-11-24"),
    ("the motion 16 % off", "quasi_newton 1 × 60, 3 cells, density_ratio 20, against newton, 2026-11-24"),
    ("a mean strain of {:.1f} with the published shear", pin["as published"][0]),
    ("With the angle it has {:.2f}, in {:.2f} times the CPU time", *pin["shear as an angle"]),
    ("the published shear at {:.0f} (`configs/one_pin`)", pin["40 iterations"][0]),
    ("it ends {:.0f} of its sizes away", free), ("its reach stays at {:.2f} sizes", cut),
    ("a mean strain of 387", "./bendlab run configs/stability/time_step.json, 2026-11-22"),
    ("its mean strain at 0.05", CUT), ("into 134 parts", CUT)]
STATED["lib/python/README.md"] = [
    ("`quasi_newton` 4.1 times as long, and a step of `pbd` 24 times", "tests/python/cost.py, 2026-11-26")]
STATED["experiments/README.md"] = [
    ("writes one every 10 s", "run/run_control.hpp"), ("than 1 % of its time", "run/checkpoint.cpp"),
    ("reach about 90 %", "measures/effective_stiffness.hpp"), ("than 50 ms are repeated", "advise/runs.cpp"),
    ("a mean strain up to 1 %", "measures/effective_stiffness.cpp"),
    ("an error above 20 %, 10 % more strain", "advise/trial.hpp"),
    ("stretched to 1.5 times the", "advise/trial.hpp")]
STATED["experiments/bench/README.md"] = [
    ("about 30 minutes", "./bendlab bench, 2026-11-22"),
    ("(xx, yy, xy) | {:.1f} ns | {:.1f} ns | {:.0f} ns | {:.1f} ns", *cost("strain", 128, 1024)),
    ("| crossover spring | {:.1f} ns | {:.1f} ns | {:.0f} ns | {:.1f} ns", *cost("crossover", 128, 1024)),
    ("(`adaptive`) | {:.1f} ns | | {:.0f} ns | {:.1f} ns", *cost("dense", 128)),
    ("| {:.1f} ms (two threads: {:.1f} ms) | | {:.0f} ms | {:.1f} ms",
     step[0], bench["step/128", "float", 2]["step_ms"], *step[1:]),
    ("adds {:.0f} % of wall time", 100 * (bench["recording/128", "float", 2]["wall_ratio"] - 1)),
    ("side by side** are {:.1f} times as fast", bench["sweep/64", "float", 2]["speed_up"]),
    ("the {:.1f} million springs", large["constraints"] / 1e6),
    ("takes {:.1f} s and {:.0f} bytes of memory", large["set_up_s"], large["peak_bytes_per_spring"]),
    ("By colour it changes by {:.1f} to {:.0f} %", min(by_colour), max(by_colour)),
    ("leaves up to {:.0f} % less", -min(from_pins)),
    ("they leave {:.0f} to {:.0f} % more", min(colour_from_pins), max(colour_from_pins))]
STATED["analysis/README.md"] = [
    ("takes about 24 minutes", REPRODUCE), ("takes about 28 minutes", REPRODUCE),
    ("to 20, 5 and 1 %", "accuracy.py"), ("ten minutes at rest", "../configs/stability/rest_slow.json"),
    ("in all of {:.0f} comparisons, by {:.1f} to {:.0f} times", len(gains), min(gains), max(gains)),
    ("`dihedral` is {:.2f} % off in 64 substeps and {:.2f} % in 256", *hinge),
    ("On 64² cells it is {:.1f} % off", 100 * paper[ERROR]), ("A mesh of {:.0f}² cells", fastest["cells"]),
    ("error in {:.2f} % of the time", 100 * fastest[MS] / paper[MS]),
    ("it is then {:.1f} % off, in {:.1f} % of the time", 100 * coarse[ERROR], 100 * coarse[MS] / paper[MS]),
    ("can be cut to {:.1f} % of what it was: with `" + nearest["model"] + "` springs",
     100 * nearest[ERROR] / paper[ERROR]),
    ("on {:.0f}² cells in {:.0f} substeps", nearest["cells"], nearest["settings"]["substeps"]),
    ("{:,.0f} runs, {:.0f} minutes of", len(rows("stability")), minutes["stability"]),
    ("judges {:,.0f} plain runs", len(rows("plain"))),
    ("in {:.0f} minutes of processor time. One", minutes["plain"]),
    ("the program said nothing: {:.0f}", len(rows("plain", verdict="silent")))]
STATED["tests/mutants/README.md"] = [("(93.3 %)", "mutate.py with seed 1 and 190 mutants, 2026-11-22")]
# What our READMEs say without a number.
HOLDS = {
    "no model of springs does":
        {run["model"] for run in strips} <= {"isometric", "discrete_shells", "dihedral", "bridson"},
    "as often as no bending at all": fails["dihedral"] == fails["none"] > fails["adaptive"],
    "More iterations are no remedy": pin["40 iterations"][0] > pin["shear as an angle"][0],
    "Colours found in that order gain nothing": sum(row["strain_error_colour_from_pins"] for row in orders)
    > 0.99 * sum(row["strain_error_colour"] for row in orders),
    "Single precision can follow": hinge[1] < hinge[0] and min(gains) > 1,
}
