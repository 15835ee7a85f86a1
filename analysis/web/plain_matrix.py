"""A table of models × meshes of the plain scenes as HTML: how many runs broke a bound. A click on a cell
opens these runs. The functions take runs as objects of summary.json, with the id of a run in the page."""
from bendlab.results.load import group
from figures.plain.shares import MIXED, WRONG, in_order
from runs.plain_cases import SILENT
from web.html_parts import escape, heading, matrix_table, opener

STEPS = {1 / 8: "up to 1 in 8", 1 / 4: "up to 1 in 4", 3 / 8: "up to 3 in 8", 1: "more"}  # one colour each
TITLE = "Models and meshes"


def matrix_html(judged):
    """The table of the runs of the covering arrays, with its caption; "" without such runs."""
    mixed = [run for run in judged if run["config"] in MIXED]
    if not mixed:
        return ""
    cells = group(mixed, lambda run: (run["settings"]["model"], run["settings"]["mesh"]))
    models, meshes = (in_order(axis, set(values)) for axis, values in zip(("model", "mesh"), zip(*cells)))
    rows = {escape(model): [_cell(f"{model} on {mesh}", cells.get((model, mesh), [])) for mesh in meshes]
            for model in models}
    return (f"{heading('models-and-meshes', TITLE, 3)}<figure>"
            f"{matrix_table('model', meshes, rows, TITLE, 'shares matrix')}"
            f"<figcaption>{_caption(mixed, len(judged))}</figcaption></figure>")


def _cell(name, runs):
    if not runs:
        return "<td>–</td>"
    wrong = sorted((run for run in runs if run["verdict"] in WRONG), key=lambda run: run["verdict"] != SILENT)
    text = f"{len(wrong)}/{len(runs)}"
    if not wrong:
        return f"<td>{text}</td>"
    silent = sum(run["verdict"] == SILENT for run in wrong)
    step = next(i for i, most in enumerate(STEPS, 1) if len(wrong) <= most * len(runs))
    label = (f"{name}: {len(wrong)} of {len(runs)} runs broke a bound, "
             f"{silent or 'none'} of them without a warning")
    look = f"step-{step} ring" if silent else f"step-{step}"
    return opener(" ".join(run["id"] for run in wrong), text, "", look, label)


def _caption(mixed, runs):
    """The caption: what cells count, and what colours and rings mean. `runs`: number of runs on the page."""
    text = ("A cell shows how many of the runs with its model and mesh broke a bound. The cells count the "
            f"{len(mixed)} runs of the covering arrays, in which all other settings are mixed evenly. The "
            f"table of values below counts these runs, too; the table of pairs counts all {runs} runs.")
    verdicts = {run["verdict"] for run in mixed}
    if not verdicts & set(WRONG):
        return f"{text} No run broke a bound."
    ring = ("A ring marks a cell in which a run broke a bound without a warning." if SILENT in verdicts
            else "Each of these runs got a warning; a ring would mark a cell with a run that got no warning.")
    keys = "".join(f"<span><span class='swatch step-{i}' aria-hidden='true'></span>{name}</span>"
                   for i, name in enumerate(STEPS.values(), 1))
    return (f"{text} A coloured cell opens the runs that broke a bound. {ring}<span class='key'>Share that "
            f"broke a bound: {keys}</span>")
