"""The page of stiffness: how stiff every model is, against theory and textile tests."""
from figures.stiffness import (buckling, calibrated, convergence, effective, hinges, resolution, springs,
                               textile)
from pages.project import Content, Figure, Page
from tables.numbers import number_text
from tables.section import write_objects
from web.html_parts import Part, escape
from web.verdicts import cards_html, checks_html, tally

LAWS = ("<p>Every bending model is measured on strips with a known theoretical answer, and with the tests of "
        "textile laboratories. Each number has an expected number beside it, with source and tolerance, both "
        "fixed before the measurement.</p><p>Models follow one of two laws. Hinges resist in proportion to "
        "curvature: m = B κ (B in N m, the flexural rigidity). Springs between vertices hardly resist small "
        "bending: m = C κ³ (C in N m³). m is the moment per width, κ the curvature. H/W is how far the free "
        "end of a clamped strip hangs down over how far it reaches out.</p>")

FIGURES = [
    Figure(hinges, "Hinges against the heavy elastica", "Hinges",
           "A strip is clamped at one end and hangs by its own weight in static equilibrium. All hinge "
           "models are given one flexural rigidity B; gravity makes Γ = ρ g L³/B about 0.3, 1, 10 and 100. L "
           "begins half a row behind the clamp's edge, at the first hinge that turns. At Γ = 100 and below "
           "48 cells the fold at the clamp is narrower than three rows; these runs are not checked."),
    Figure(springs, "Ring springs: does the moment grow as κ³?", "Springs",
           "Springs to ring t alone on an equilateral lattice. On a sheet of curvature κ a spring of t edges "
           "of length a is shorter by t (t² − 1) a³ κ²/24. So the moment is C κ³ with C = c_t k a⁴. On an "
           "infinite lattice c_2 = 0.1522, c_3 = 3.393, c_4 = 27.51; here C is summed over the strip's own "
           "springs, which end at its free sides. This holds while the edges keep their lengths. A soft "
           "membrane yields to the springs instead of bending, and C is reduced. C and p are taken where "
           f"R⁴/(α C) is nearest to {number_text(springs.RATIO, 1)} for all three rings: α is the membrane's "
           "compliance, R the springs' length."),
    Figure(convergence, "XPBD against its equilibrium; k against iterations and time step", "Solver",
           "Compliance (XPBD) states an energy. Thus there is one answer, the static equilibrium, and more "
           "substeps approach it. Springs compete with the membrane and need more substeps than hinges. The "
           "membrane of the first chart is soft (10⁻⁵ m/N): with a stiff membrane, springs that fall from "
           "the flat state can come to rest in creases, another equilibrium. k states no energy: more "
           "iterations or a smaller time step only make the sheet stiffer."),
    Figure(effective, "Share of the stated stiffness that the solver gives", "Effective",
           "Without convergence of the solver the cloth is softer than stated. Every run with a compliance "
           "or a physical stiffness estimates by how much: effective_bending_stiffness is the share of the "
           "stated stiffness, computed from the multipliers of the last second, without another run. Here "
           "each estimate is compared with the measured share: the stiffness of the run's strip (B or C from "
           "H/W) over that of the static equilibrium of the same energies."),
    Figure(resolution, "Stiffness against resolution, by the paper's rule", "Paper's rule",
           "The paper states that the stiffness of its adaptive springs stays the same when the resolution "
           "changes. Here every model has the paper's settings: k = 0.5, 1/60 s, 10 iterations, levels from "
           "eq. 6. Gravity is a tenth, so that the finest strips still have a measurable shape. The number "
           "is B from H/W, for springs a rigidity at the curvature of this load; below about 10⁻⁶ N m the "
           "fold at the clamp is narrower than three rows, so that B also depends on the mesh."),
    Figure(calibrated, "Calibrated stiffness against resolution", "Calibrated"),
    Figure(buckling, "Lateral buckling", "Buckling",
           "The strip's width stands upright and its weight acts in its plane. It stays in its plane until Γ "
           "= ρ g L³/D reaches Γ*; then it deflects sideways. Just above Γ* the squared deflection grows "
           "linearly with the load: a line through two points gives Γ*, its zero. L begins half a row behind "
           "the clamp's edge; for springs to ring t, a quarter of t rows behind. A lattice of hinges has "
           "Poisson's ratio −1/3, springs have 1/3. Springs without linear stiffness have Γ* = 0 and a "
           "deflection proportional to the root of the load. Springs that push in the flat sheet "
           "(prestressed) have a Γ* as hinges do."),
    Figure(textile, "Textile tests: bending length, drape, catenary", "Textile",
           "ASTM D1388: a strip hangs at 41.5° if its overhang is twice the bending length. Drape: a round "
           "specimen lies on a round table; the drape coefficient is the share of the overhanging ring that "
           "its shadow covers. Nothing is tuned: bending rigidity and weight of four fabrics are the "
           "published numbers, and the drape coefficient is a result. Real fabrics have friction between "
           "their yarns (2HB in the same tables), this model has none: the ends of a measured line are the "
           "bending lengths without friction and with half of 2HB at 0.5/cm added. We do not know which "
           "tester was used, so both are simulated. A sheet without bending between two lines hangs as a "
           "catenary."),
]


def content(sections, out):
    rows = [(f"<a href='#{section.id}'>{escape(section.title)}</a>", "", tally(section.checks))
            for section in sections]
    parts = [Part("rules", "Two laws, and how it is judged", LAWS, "Rules"),
             Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every check.</p>", "Data")]
    return Content(answer(sections), cards_html(rows), parts,
                   verdicts=lambda section: [checks_html(section.checks)])


def answer(sections):
    """How much stiffness depends on the resolution, as stated and by the paper's rule."""
    rows = next((section.table("summary") for section in sections if section.id == "calibrated"), [])
    stated, ruled = ([row for row in rows if row["rule"] == rule] for rule in calibrated.RULES)
    if not stated:
        return "There are no runs yet."
    worst = {name: max((row for row in stated if row["name"] == name), key=lambda row: row["ratio"])
             for name in {row["name"] for row in stated}}
    best, most = (pick(worst.values(), key=lambda row: row["ratio"]) for pick in (min, max))
    kept = all(row["ratio"] <= 1 + calibrated.LIMITS[row["family"]] for row in stated)
    text = ("A model whose flexural rigidity is stated "
            + ("keeps it on finer meshes" if kept else "nearly keeps it on finer meshes")
            + f": the stiffness of {_change(best)}, that of {_change(most)}")
    ruled = [row["ratio"] for row in ruled if row["name"] in resolution.CLAIMED]
    if ruled:
        text += (f". By the paper's rule the stiffness of its springs changes by a factor of "
                 f"{number_text(min(ruled), 2)} to {number_text(max(ruled), 2)}")
    return text + "."


def _change(row):
    low, high = row["cells"]
    return (f"<b>{escape(row['name'])}</b> changes by at most {number_text(100 * (row['ratio'] - 1), 2)} % "
            f"({escape(row['mesh'])}, {low} to {high} cells)")


def write_data(sections, results, out):
    write_objects(out / "summary.json", [check.as_json() for section in sections for check in section.checks])


PAGE = Page("stiffness", "How stiff is it really?", "./bendlab reproduce stiffness", FIGURES, content,
            write_data)
