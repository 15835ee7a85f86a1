"""Writes the page of stiffness: index.html, and summary.json with one object per check."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
from html_parts import Part, escape, number_text, section_part
from verdicts_html import cards_html, checks_html, tally
import charts_stiffness
import fig_stiffness_buckling
import fig_stiffness_calibrated
import fig_stiffness_convergence
import fig_stiffness_effective
import fig_stiffness_hinges
import fig_stiffness_resolution
import fig_stiffness_springs
import fig_stiffness_textile
from charts_html import chart_html, placed
from project_pages import Content, command_line, keep, kept, made_of, write
from report import write_objects

FIGURES = [fig_stiffness_hinges, fig_stiffness_springs, fig_stiffness_convergence, fig_stiffness_effective,
           fig_stiffness_resolution, fig_stiffness_calibrated, fig_stiffness_buckling, fig_stiffness_textile]
COMMAND = "./bendlab reproduce stiffness"
EVERYTHING = f"{COMMAND}      # everything, and this page"
LINKS = ["Hinges", "Springs", "Solver", "Effective", "Paper's rule", "Calibrated", "Buckling", "Textile"]
LAWS = ("<p>Every bending model is measured on strips with a known theoretical answer, and with the tests of "
        "textile laboratories. Each number has an expected number beside it, with source and tolerance, both "
        "fixed before the measurement.</p><p>Models follow one of two laws. Hinges resist in proportion to "
        "curvature: m = B κ (B in N m, the flexural rigidity). Springs between vertices resist small bending "
        "hardly at all: m = C κ³ (C in N m³). m is the moment per width, κ the curvature. H/W is how far the "
        "free end of a clamped strip hangs down over how far it reaches out.</p>")


def main(results, out):
    """Writes the page into `out` from the runs below `results`; returns its sections."""
    sections = draw(results, out)
    lay_out(out)
    return sections


def draw(results, out):
    """Draws the figures, and keeps what the page is made of."""
    out.mkdir(parents=True, exist_ok=True)
    sections = [figure.main(results, out) for figure in FIGURES]
    checks = [check for section in sections for check in section.checks]
    write_objects(out / "summary.json", [check.as_json() for check in checks])
    keep(out, sections)
    return sections


def lay_out(out):
    """Writes index.html of what is kept."""
    sections = kept(out)
    checks = [check for section in sections for check in section.checks]
    charts = charts_stiffness.charts(sections, COMMAND)
    parts = [section_part(section, EVERYTHING, [checks_html(section.checks)], link=link,
                          **placed(charts, section))
             for section, link in zip(sections, LINKS)]
    parts += [Part("rules", "Two laws, and how it is judged", LAWS, "Rules"),
              Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every check.</p>", "Data")]
    top = "".join(chart_html(chart) for chart in charts if not chart["section"])
    content = Content("How stiff is it really?", answer(checks), top + overview(sections, parts), parts,
                      {"charts": charts})
    write(out, "stiffness", content, made_of(sections, COMMAND))


def answer(checks):
    """The page's answer: how much stiffness depends on the resolution, as stated and by the paper's rule."""
    calibrated = charts_stiffness.ratios(checks, charts_stiffness.CALIBRATED)
    ruled = charts_stiffness.ratios(checks, charts_stiffness.RULED)
    if not calibrated:
        return "There are no runs yet."
    worst = {model: max(by_mesh.values()) for model, by_mesh in calibrated.items()}
    best = min(worst, key=worst.get)
    most = max(worst, key=worst.get)
    text = (f"A model that is told a flexural rigidity keeps it on finer meshes: the stiffness of "
            f"<b>{escape(best)}</b> changes by {percent(worst[best])} at most, that of <b>{escape(most)}</b> "
            f"by {percent(worst[most])}")
    if ruled:
        low, high = (choose(choose(by_mesh.values()) for by_mesh in ruled.values()) for choose in (min, max))
        text += (f". By the paper's rule the springs' stiffness changes by a factor of {number_text(low, 2)} "
                 f"to {number_text(high, 2)}")
    return text + "."


def percent(ratio):
    return f"{number_text(100 * (ratio - 1), 2)} %"


def overview(sections, parts):
    """How many checks hold in each section."""
    rows = [(f"<a href='#{part.name}'>{escape(section.title)}</a>", "", tally(section.checks))
            for section, part in zip(sections, parts)]
    return cards_html(rows)


if __name__ == "__main__":
    command_line("stiffness", __doc__, main, lay_out)
