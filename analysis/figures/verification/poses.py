"""Bending energies of prescribed poses against closed forms."""
from runs import verified
from truths import surfaces

POISSON = 0.3
# Config → (name, energy over B by ν). laplacian has ν = 1, whatever the scene states.
POSES = {"half_cylinder": ("half-cylinder", surfaces.half_cylinder),
         "rest_curved": ("half-cylinder from the other half-cylinder",
                         lambda nu: surfaces.rest_curved_cylinder(nu, same_side=True)),
         "sphere": ("sphere from flat", surfaces.sphere),
         "half_torus": ("half torus from flat", surfaces.half_torus),
         "helix": ("developable helix", surfaces.helix)}
WITH_NORMALS = ("mid_edge", "dkt")  # models with normals as unknowns
# In a strip along a free border, as wide as a cell, these normals relax. Only the sphere has no border.
ORDERS_WITH_BORDER = dict.fromkeys(WITH_NORMALS, 1.0)
THREE_TIMES = ("discrete_shells", "isometric")


def main(results, out, section):
    rows, charted = [], []
    for config, (name, energy) in POSES.items():
        runs = verified.runs_of(results, section, config)
        for (model, family), own in verified.by_model_and_family(runs).items():
            if family in ("sphere", "tube"):
                family = {"sphere": "octahedron, subdivided", "tube": "rings"}[family]
            poisson = own[0].get("/material/poisson_ratio", 0) if config not in ("half_cylinder",) else 0
            truth = energy(1 if own[0].model == "laplacian" else poisson)
            if abs(truth) < 1e-9:  # laplacian feels only the mean curvature, which is that of the rest shape
                continue
            made = verified.converging(own, lambda run: run.summary["energy_bending_start"], truth,
                                       orders=verified.ORDERS if config == "sphere" else ORDERS_WITH_BORDER)
            rows.append({"pose": name, "model": model, "family": family, "truth": truth} | made.cells())
            charted += [{"pose": name, "model": model, "family": family, "h": 1000 * row["h"],
                         "ratio": row["value"] / truth,
                         "error": 100 * abs(row["value"] / truth - 1)} for row in made.rows]
    section.add_table("poses", "Bending energy over the closed form", [
        "pose", "model", ("family", "mesh"), ("truth", "energy / B"), *verified.columns()], rows)
    section.add_table("meshes", "", ["pose", "model", ("family", "mesh"), ("h", "mean edge", "", "mm"),
                                     ("ratio", "energy over truth"), ("error", "error", "", "%")], charted)
    section.add_chart("meshes", "Bending energy of a pose over its closed form", "h", ["ratio", "error"],
                      ["model"], id="poses", held=["pose", "family"], at="half-cylinder", y_scale="log",
                      limits=[("ratio", 1, "closed form")])
    section.text += "".join(_agreement(rows, model) for model in WITH_NORMALS)
    weights(section, rows)


def _agreement(rows, model):
    """A sentence: in how many rows a model agrees with the closed form."""
    own = [row for row in rows if row["model"] == model]
    agree = sum(row["verdict"] == "agrees" for row in own)
    return (f" {model} agrees with the closed form in {agree} of {len(own)} rows; its largest error on the "
            f"finest meshes is {max(abs(row['off']) for row in own):.1f} %." if own else "")


def weights(section, rows):
    """What the weight 3 |e|² / (A₁ + A₂) of another code gives: three times our ½-weighted energies, because
    the formula is the same up to this factor."""
    three = [{"model": row["model"], "family": row["family"], "ours": row["finest"],
              "theirs": 3 * row["finest"]}
             for row in rows if row["pose"] == "half-cylinder" and row["model"] in THREE_TIMES]
    section.add_table(
        "three_times", "The weight 3 |e|² / (A₁ + A₂) instead of |e|² / (A₁ + A₂), on the half-cylinder", [
            "model", ("family", "mesh"), ("ours", "energy over truth, ours", ".3f"),
            ("theirs", "with the weight of better-bending's code", ".3f")], three)
