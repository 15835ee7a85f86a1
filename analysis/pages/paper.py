"""The page of the paper: its claims with the measured numbers, and every bending model on the same scenes."""
import csv
import json

from bendlab.results.load import group, statuses, summary_spread
from draw.frames import place_html
from figures.paper import (ablations, fig_1, fig_5, fig_6, fig_7, large_forces, maps, models, promise,
                           promise_strip, scenes, structure, where)
from pages.project import Content, Figure, Page
from runs.collected import differing, stated
from runs.repeat import runs_of
from runs.sweeps import CONFIGS, load_experiment, read_config
from tables.numbers import rounded
from tables.section import address, write_objects
from web.html_parts import Part, escape, picture_html
from web.verdicts import cards_html, claim_html, map_cells, map_html, map_mark, mark

FIRST_PICTURE = "fig_5_promise.png"
RULES = ("<p>Jong-Hyun Kim, <em>Bending Spring Model for Stable Strain-Based Dynamics in Triangular "
         "Meshes</em>: this page repeats each figure, and states the measured numbers beside each claim. The "
         "sheets are chaotic, so numbers are medians over the last simulated second and over seeds. The rule "
         "under each claim turns its numbers into a verdict.</p><p>Unless a figure says otherwise, a sheet "
         "of 1 m × 1 m in N × N cells is pinned at its upper right corner. The sheet starts horizontal and "
         "falls for 4 s. Stretch σ₁ is the largest principal stretch of a triangle: σ₁ − 1 is 0 for an "
         "unstretched triangle and 1 for a triangle that is twice as long.</p>")
DATA = ("<p><a href='summary.json'>summary.json</a>: the claims. <a href='maps.json'>maps.json</a>: every "
        "box of the maps. <a href='reference.csv'>reference.csv</a>: medians and ranges of every group of "
        "runs.</p>")
MOTION = (f"The rows of the picture above on {promise.MOVING} cells: crossover springs, the paper's adaptive "
          "springs with the ring around the pin, and the recommended settings.")

COUNTS = ["springs", "springs_beyond_ring_1"]  # the same for every seed
# Entry of the summary → offset subtracted from it
REFERENCE = {"pin_max_stretch": 1, "pin_region_stretch": 1, "max_stretch": 1, "mean_strain": 0, "drop": 0}

FIGURES = [
    Figure(maps, "Where each claim holds", "Maps", maps.TEXT),
    Figure(promise, "The paper's promise: Fig. 5 with our settings", "The promise",
           "The paper promises cloth that does not fail at a pin and does not change when its mesh is "
           "refined, at less cost. The recommended settings are the program's defaults; "
           "configs/recommended.json gives the reason for each setting. The settings are the same on every "
           "mesh. But the number of iterations was chosen on these scenes and on strips. In the first second "
           "the cloth falls and is stretched more than at rest. The table has the stretch during the fall "
           "and at rest.", "5"),
    Figure(promise_strip, "As stiff at every resolution? The recommended cloth on strips", "Strips",
           "Strips of the recommended cloth, 20 cm long, hang at rest under a hundredth of gravity. The "
           "rigidity is computed from the shape of a strip. At 96 cells the edges are 2.4 mm long, as on a "
           "sheet of 1 m with 411 cells. The defaults take implicit steps. For comparison, strips of the "
           "same rigidity are solved by projections (pbd, with a rigid membrane and tethers), with one "
           "iteration in each substep. A projection of a hinge moves only the hinge's four vertices, so that "
           "a correction reaches only the neighbouring triangles. In a substep of length h, the solver can "
           "therefore reach a rigidity of at most about ρ a⁴ / h² (a: edge length). Edges of half the length "
           "need four times as many substeps, and each substep costs four times as much. So the cost of the "
           "same rigidity grows as N⁴ with N cells per side. This cost is an obstacle to the paper's promise "
           "for every model with local projections. Solvers that couple the whole cloth do not have this "
           "limit.", "5"),
    Figure(fig_1, "One pinned vertex", "Fig. 1", figure="1"),
    Figure(structure, "The springs of a vertex", "Fig. 2-4", figure="2-4"),
    Figure(fig_5, "Crossover and adaptive springs at several resolutions", "Fig. 5", figure="5"),
    Figure(where, "Where the sheet fails: stretch against distance from the pin", "Where", figure="5"),
    Figure(fig_6, "All rings against one ring (LOD)", "Fig. 6", figure="6"),
    Figure(fig_7, "Another material by scaling n", "Fig. 7", figure="7"),
    Figure(large_forces, "Large external forces", "Large forces",
           "The author of the paper later wrote that large external forces make strain-based cloth fail. We "
           "test a storm (a wind of 21 m/s, turbulence intensity 0.5) and pins that are pulled away fast "
           "(0.85 m in 0.1 s, 52 times the acceleration of gravity). We compare the paper's springs with the "
           "paper's settings, and our default settings with the same springs and with hinges. The sheets of "
           "1 m have 48 cells per side.", "ours"),
    Figure(ablations, "Questions that the paper leaves open", "Ablations",
           "Each open question has several answers, which are compared here. All other settings are as in "
           "Fig. 5, without damping. A chart states the number of cells per side."),
    Figure(models, "Every bending model on the same scenes", "Models"),
    Figure(scenes, f"One cloth, {len(scenes.SCENES)} scenes, any bending model", "Scenes",
           "The scenes of configs/scenes with several bending models. Only /bending/model differs."),
]


def write_data(sections, results, out):
    for file, kind in (("summary.json", "claims"), ("maps.json", "maps")):
        entries = [entry for section in sections for entry in getattr(section, kind)]
        write_objects(out / file, [entry.as_json() for entry in entries])
    write_reference(results, out / "reference.csv")


def content(sections, out):
    claims = [claim for section in sections for claim in section.claims if not claim.setting]
    all_maps = [claim_map for section in sections for claim_map in section.maps]
    names = {id(claim_map): f"map-{i}" for i, claim_map in enumerate(all_maps, 1)}
    cells = [cell for claim_map in all_maps for cell in map_cells(claim_map, names[id(claim_map)])]
    settings = with_configs(cells)
    played = [{"id": address(label), "label": label, "name": label, "status": "complete",
               "title": label} for label in promise.ROWS]
    rows = [(named(claim_map.figure), f"{escape(claim_map.english)}<br><small>{escape(claim_map.sentence)}"
             "</small>", map_mark(claim_map)) for claim_map in all_maps]
    rows += [(named(claim.figure), escape(claim.claim), mark(claim)) for claim in claims]
    first = [picture_html(*picture) for section in sections for picture in section.pictures
             if picture[0] == FIRST_PICTURE]
    parts = [Part("rules", "How it is measured", RULES, "Rules"), Part("data", "As data", DATA, "Data")]
    motion = Part("motion", "The promise, in motion",
                  f"<p>{escape(MOTION)}</p>{place_html(map(address, promise.ROWS))}", "Motion")
    verdicts = lambda section: [*(map_html(claim_map, names[id(claim_map)]) for claim_map in section.maps),
                                *map(claim_html, section.claims)]
    heading = lambda section: (f"{named(section.figure)}: {section.title}"
                               if section.figure and section.claims else section.title)
    return Content(answer([judged.holds for judged in all_maps + claims]), cards_html(rows) + "".join(first),
                   parts, [motion], {"runs": cells + played, "settings": settings}, verdicts=verdicts,
                   heading=heading)


def with_configs(cells):
    """Adds to each cell the config of the first run in the cell's commands: `base` is the index of an entry
    in the returned list, and `changes` are the differences from this entry."""
    bases = {}
    for cell in cells:
        lines = cell["command"].splitlines()
        if not lines[0].startswith("./bendlab run configs/"):
            continue
        config, points = runs_of(lines[0])
        own = stated(read_config(config), points[0])
        base = bases.setdefault(config, own)
        cell |= {"base": list(bases).index(config), "changes": differing(base, own)}
        if len(lines) > 1 or len(points) > 1:
            notes = [cell["outcome"], "the config below is the config of the first run"]
            cell["outcome"] = "; ".join(filter(None, notes))
    return list(bases.values())


def answer(verdicts):
    """The answer, from the verdicts of all maps and of the claims that are judged over all settings."""
    if not verdicts:
        return "There are no runs yet."
    everywhere, nowhere, unknown = (sum(holds is kind for holds in verdicts)
                                    for kind in (True, False, None))
    return (f"Of {len(verdicts)} claims, the paper's and ours, <b>{everywhere}</b> hold at every setting "
            f"that was measured, <b>{len(verdicts) - everywhere - nowhere - unknown}</b> at some, "
            f"<b>{nowhere}</b> at none"
            + (f"; {unknown} are open, because runs are missing" if unknown else "") + ".")


def named(figure):
    """The name of a figure: "Fig. 5a" for "5a", a number in the paper; other texts with a capital letter."""
    return escape(f"Fig. {figure}" if figure[:1].isdigit() else figure.capitalize())


def write_reference(results, path):
    """Writes a CSV table: a row per point of each experiment's sweep, with medians and ranges over seeds."""
    columns = ["experiment", "cells", "model", "pin_ring", "setting", "seeds", "status", *COUNTS]
    columns += [f"{name}{'_minus_1' if offset else ''}{part}" for name, offset in REFERENCE.items()
                for part in ("", "_low", "_high")]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for config in sorted(CONFIGS.glob("paper/*.json")) + sorted(CONFIGS.glob("ablations/*.json")):
            experiment = load_experiment(results, f"{config.parent.name}/{config.stem}")
            groups = group(experiment.runs, lambda run: _setting(run, experiment.sweep))
            for setting, runs in sorted(groups.items()):
                status = " ".join(f"{count} {name}" for name, count in sorted(statuses(runs).items()))
                counts = [f"{summary_spread(runs, name).median:.0f}" for name in COUNTS]
                spreads = [summary_spread(runs, name) - offset for name, offset in REFERENCE.items()]
                numbers = [rounded(x) for s in spreads for x in (s.median, s.low, s.high)]  # None: empty
                writer.writerow([experiment.config, *setting, len(runs), status, *counts, *numbers])


def _setting(run, sweep):
    """(cells, model, pinned rings, other swept settings as text) of a run."""
    apart = ("/mesh/cells", "/bending/model", "/pins/ring", "/initial/seed")
    rest = {pointer: run.get(pointer) for pointer in sweep if pointer not in apart}
    text = " ".join(f"{pointer}={json.dumps(value)}" for pointer, value in rest.items() if value is not None)
    return run.get("/mesh/cells", 0), run.model, run.get("/pins/ring"), text


PAGE = Page("paper", "The paper, repeated", "./bendlab reproduce", FIGURES, content, write_data)
