"""Sharp creases: the energy has to grow without bound on finer meshes, and with the angle."""
from bendlab.results.load import group
from runs import verified

angle = lambda run: run.get("/initial/surface/sweep")
energy = lambda run: run.summary["energy_bending_start"]
DOUBLING = 1.5  # least growth when cells are halved; a crease in a strip of half-sized triangles doubles it


def main(results, out, section):
    runs = verified.runs_of(results, section, "vee")
    rows, charted = [], []
    for model, own in group(runs, verified.model).items():
        by_mesh = group(own, lambda run: run.get("/mesh/cells"))
        finest = sorted(by_mesh[max(by_mesh)], key=angle)
        rises = all(energy(b) > energy(a) for a, b in zip(finest, finest[1:]))
        turns = next((angle(a) for a, b in zip(finest, finest[1:]) if energy(b) <= energy(a)), None)
        growths = []
        for of_angle in group(own, angle).values():
            ordered = sorted(of_angle, key=lambda run: run.get("/mesh/cells"))
            growths += [energy(b) / energy(a) for a, b in zip(ordered, ordered[1:])]
        rows.append({"model": model, "growth": (min(growths), max(growths)),
                     "grows": bool(min(growths) >= DOUBLING), "rises": rises,
                     "turns": "" if turns is None else f"{turns}°"})
        charted += [{"model": model, "angle": angle(run), "energy": energy(run)} for run in finest]
    section.add_table("creases", "Energy of a crease", [
        "model", ("growth", "growth per halving of the cells", ".2f"), ("grows", "grows without bound"),
        ("rises", "rises with the angle"), ("turns", "falls from")], rows)
    section.add_table("angles", "", ["model", ("angle", "angle of the crease", "", "degrees"),
                                     ("energy", "energy over B")], charted)
    section.add_chart("angles", "Energy of a sharp crease on the finest mesh", "angle", ["energy"],
                      id="creases", scale="linear")
