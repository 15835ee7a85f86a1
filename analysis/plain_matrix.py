"""Models × meshes of the plain scenes as HTML: how many runs broke a bound; a cell opens these. A run is its
object in summary.json, with its id in the page."""
from fig_plain import MIXED, WRONG, in_order
from html_parts import escape, heading
from bendlab.results.load import group
from plain_cases import SILENT

STEPS = {1 / 8: "up to 1 in 8", 1 / 4: "up to 1 in 4", 3 / 8: "up to 3 in 8", 1: "more"}  # one colour each
TITLE = "Models and meshes"


def matrix_html(judged):
    """The matrix of the covering arrays' runs with its caption; "" without runs."""
    mixed = [one for one in judged if one["config"] in MIXED]
    if not mixed:
        return ""
    place = lambda one: (one["settings"]["model"], one["settings"]["mesh"])
    cells = group(mixed, place)
    models, meshes = (in_order(axis, set(values))
                      for axis, values in zip(("model", "mesh"), zip(*map(place, mixed))))
    head = "".join(f"<th scope='col'>{escape(mesh)}</th>" for mesh in meshes)
    rows = "".join(
        f"<tr><th scope='row' class='t'>{escape(model)}</th>"
        + "".join(_cell(f"{model} on {mesh}", cells.get((model, mesh), [])) for mesh in meshes) + "</tr>\n"
        for model in models)
    return (f"{heading('models-and-meshes', TITLE, 3)}<figure><div class='scroll' tabindex='0' role='region' "
            f"aria-label='{TITLE}'><table class='shares matrix'><thead><tr><th class='t'>model</th>{head}"
            f"</tr></thead><tbody>{rows}</tbody></table></div><figcaption>{_caption(mixed, len(judged))}"
            "</figcaption></figure>")


def _cell(name, some):
    if not some:
        return "<td>–</td>"
    wrong = [one for one in some if one["verdict"] in WRONG]
    wrong.sort(key=lambda one: one["verdict"] != SILENT)
    text = f"{len(wrong)}/{len(some)}"
    if not wrong:
        return f"<td>{text}</td>"
    silent = sum(one["verdict"] == SILENT for one in wrong)
    step = next(i for i, most in enumerate(STEPS, 1) if len(wrong) <= most * len(some))
    told = (f"{name}: {len(wrong)} of {len(some)} runs broke a bound, "
            f"{silent or 'none'} of them without a warning")
    look = f"step-{step}{' ring' if silent else ''}"
    return (f"<td data-run='{escape(' '.join(one['id'] for one in wrong))}'><button type='button' "
            f"class='{look}' aria-label='{escape(told)}'>{text}</button></td>")


def _caption(mixed, runs):
    """What the cells count, and what colours and rings mean; `runs`: how many runs the page has."""
    told = ("Each cell: runs that broke a bound / all runs with this model on this mesh. Counted are the "
            f"{len(mixed)} runs of the covering arrays, in which all other settings are mixed evenly; the "
            f"tables below are of all {runs} runs.")
    verdicts = {one["verdict"] for one in mixed}
    if not verdicts & set(WRONG):
        return f"{told} None broke a bound."
    ring = ("A ring marks a cell with a run that was wrong without a warning." if SILENT in verdicts
            else "Each of these got a warning; a ring would mark a cell with a run that got none.")
    keys = "".join(f"<span><span class='swatch step-{i}' aria-hidden='true'></span>{name}</span>"
                   for i, name in enumerate(STEPS.values(), 1))
    return (f"{told} A coloured cell opens the runs that broke a bound. {ring}<span class='key'>Share that "
            f"broke a bound: {keys}</span>")
