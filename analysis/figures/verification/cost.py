"""What the better model costs: error against CPU time of models with a linear rigidity, on two meshes."""
from bendlab.results.load import by_model, group
from figures.accuracy.measures import front_rows, levels_rows, levels_table, table
from runs import verified


def main(results, out, section):
    runs = verified.runs_of(results, section, "cost", "cost_dkt")
    meshes = group(runs, verified.family)
    fronts = [row for family, own in meshes.items() for of_model in by_model(own).values()
              for row in front_rows(of_model, scene=family)]
    levels = [row for family, own in meshes.items()
              for row in levels_rows(own, family, "physical", "the stated cloth")]
    section.tables = [levels_table(levels), table("fronts", "The front (the best runs) of each model", [
        ("scene", "mesh"), "model", "settings", "ms", "error_physical"], fronts)]
    section.add_chart("fronts", "Error against time: a strip of 12 cells that falls and comes to rest", "ms",
                      ["error_physical"], ["model"], id="cost", held=["scene"], y_scale="log",
                      note="Each curve is the front of a model: the runs for which no other run of the model "
                           "has less time and a smaller error.")
    for family, own in meshes.items():
        least = {row["model"]: row["least"] for row in levels if row["scene"] == family}
        if {"mid_edge", "discrete_shells"} <= least.keys():
            section.text += (f" Least errors on the mesh with {family.removesuffix(' diagonal')} diagonal"
                             f"{'' if family.endswith('diagonal') else 's'}: mid_edge "
                             f"{least['mid_edge']:.2g} %, discrete_shells {least['discrete_shells']:.2g} %.")
