"""How much longer a step takes with the bending laws of fabrics."""
from bendlab.results.load import group
from figures.performance.rows import shown, series, table
from tables.numbers import number

START = "law/"  # rows are named START + method/model/law
ONE = "one rigidity"


def main(bench, out, section):
    rows = []
    for (name, _), timed in series(bench["rows"]).items():
        if name.startswith(START):
            method, model, law = name.removeprefix(START).split("/")
            rows.append(shown(timed[-1]) | {"method": method, "model": model, "law": law.replace("_", " "),
                                            "step_ms": timed[-1]["call_ms"]})
    section.commands = [f"./bendlab bench --filter '^{START}'"]
    if not rows:
        section.missing.append("steps with bending laws")
    plain = {(row["method"], row["model"]): row["step_ms"] for row in rows if row["law"] == ONE}
    for row in rows:
        row["times"] = row["step_ms"] / plain.get((row["method"], row["model"]), float("nan"))
    laws = table("laws", "Bending laws", [
        "law", "method", "model", "vertices", ("step_ms", "time of a step", "", "ms"), "range",
        ("times", "over the time with one rigidity", ".2f")], rows)
    section.add_chart(laws, title(rows), "law", ["times"], ["model"], held=["method"], scale="band",
                      y_scale="linear", look="",
                      note="Steps of 10 iterations, single precision, one thread. A step with one rigidity "
                           "does none of the work that the other laws add.")


def title(rows):
    """The title: the law that takes the most time, for each method."""
    others = group([row for row in rows if row["law"] != ONE], lambda row: row["method"])
    if not others:
        return "Time of a step with each bending law"
    worst = {method: max(own, key=lambda row: row["times"]) for method, own in others.items()}
    return "Over the time of a step with one rigidity, a step takes at most " + ", and ".join(
        f"{number(row['times'])} with {method} ({row['law']}, {row['model']})"
        for method, row in worst.items())
