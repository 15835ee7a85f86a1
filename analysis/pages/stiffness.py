"""The page of stiffness: how stiff every model is, against theory and textile tests."""
from figures.stiffness import (buckling, calibrated, convergence, effective, fabrics, hinges, napkin,
                               resolution, springs, textile)
from pages.project import Content, Figure, Page
from tables.numbers import number_text
from tables.section import write_objects
from web.html_parts import Part, escape
from web.verdicts import cards_html, checks_html, tally

LAWS = ("<p>Every bending model is measured on strips with a known theoretical answer, and with the tests of "
        "textile laboratories. Each measured number is compared with an expected number. The source and the "
        "tolerance of the expected number were fixed before the measurement.</p><p>Models follow one of two "
        "laws. Hinges resist in proportion to curvature: m = B κ (B in N m, the flexural rigidity). Springs "
        "between vertices hardly resist small bending: m = C κ³ (C in N m³). m is the moment per width, κ "
        "the curvature. In H/W of a clamped strip, H is how far the free end hangs down, and W is how far "
        "this end reaches out.</p>")

FIGURES = [
    Figure(hinges, "Hinges against the heavy elastica", "Hinges",
           "A strip is clamped at one end and hangs by its own weight in static equilibrium. All hinge "
           "models have the same flexural rigidity B. Gravity is chosen so that Γ = ρ g L³/B is about 0.3, "
           "1, 10 and 100. The length L begins half a row of cells behind the clamp's edge, at the first "
           "hinge that turns. With Γ = 100 and fewer than 48 cells, the fold at the clamp is narrower than "
           "three rows of cells; these runs are not checked."),
    Figure(springs, "Ring springs: does the moment grow as κ³?", "Springs",
           "The strips have only springs to ring t (vertices t edges away), on an equilateral lattice. On a "
           "sheet of curvature κ a spring of t edges of length a is shorter by t (t² − 1) a³ κ²/24. So the "
           "moment is C κ³ with C = c_t k a⁴, for springs of stiffness k. On an infinite lattice c_2 = "
           "0.1522, c_3 = 3.393, c_4 = 27.51. On the strips the springs end at the free sides, so that C is "
           "summed over the strip's springs. These formulas are exact while the edges keep their lengths. "
           "The springs of a bent sheet stretch a soft membrane, which reduces C. For each ring, C and the "
           f"exponent p are checked in the run whose R⁴/(α C) is nearest to {number_text(springs.RATIO, 1)} "
           "(α: compliance of the membrane, R: length of the springs)."),
    Figure(convergence, "Does the stiffness depend on the solver? XPBD and k", "Solver",
           "A compliance (XPBD) defines an energy. Thus there is one answer, the static equilibrium, and "
           "runs with more substeps are nearer to this equilibrium. Springs work against the membrane and "
           "need more substeps than hinges. The membrane of the first chart is soft (10⁻⁵ m/N). With a stiff "
           "membrane, a strip with springs that falls from the flat state can come to rest with creases, in "
           "another equilibrium. A stiffness k defines no energy: more iterations or a smaller time step "
           "only make the sheet stiffer."),
    Figure(effective, "Share of the stated stiffness that the solver gives", "Effective",
           "If the solver does not converge, the cloth is softer than stated. For every run with a "
           "compliance or a physical stiffness, the program estimates how soft the cloth is. The metric "
           "effective_bending_stiffness is the share of the stated stiffness, computed from the multipliers "
           "of the last second; a second run is not needed. Here each estimate is compared with the measured "
           "share: the stiffness of the run's strip (B or C from H/W) over the stiffness in the static "
           "equilibrium of the same energies."),
    Figure(resolution, "Stiffness against resolution, by the paper's rule", "Paper's rule",
           "The paper states that the stiffness of adaptive springs stays the same when the resolution "
           "changes. Here every model has the paper's settings: k = 0.5, 1/60 s, 10 iterations, levels from "
           "eq. 6. Gravity is reduced to a tenth, so that the finest strips still have a measurable shape. "
           "The stiffness is B from H/W. For springs, this B is valid only at the curvature under this load. "
           "Below about 10⁻⁶ N m the fold at the clamp is narrower than three rows of cells, so that B also "
           "depends on the mesh."),
    Figure(calibrated, "Calibrated stiffness against resolution", "Calibrated"),
    Figure(buckling, "Lateral buckling", "Buckling",
           "The strip's width is vertical, so that the weight acts in the strip's plane. The strip stays in "
           "this plane until Γ = ρ g L³/D reaches Γ*; then the strip deflects sideways. Just above Γ* the "
           "squared deflection grows linearly with the load. Γ* is the zero of a line through two points. "
           "The length L begins half a row of cells behind the clamp's edge; for springs to ring t, it "
           "begins t/4 rows behind this edge. A lattice of hinges has Poisson's ratio −1/3, springs have "
           "1/3. Springs without linear stiffness have Γ* = 0 and a deflection proportional to the root of "
           "the load. Springs that push in the flat sheet (prestressed) have a Γ* as hinges do."),
    Figure(textile, "Textile tests: bending length, drape, catenary", "Textile",
           "ASTM D1388: a strip hangs at 41.5° if its overhang is twice the bending length. Drape: a round "
           "specimen lies on a round table; the drape coefficient is the share of the overhanging ring that "
           "its shadow covers. Nothing is tuned: bending rigidity and weight of four fabrics are the "
           "published numbers, and the drape coefficient is a result. Real fabrics have friction between "
           "their yarns (2HB in the same tables); these simulations have no friction. So each fabric is a "
           "line between two bending lengths: with B, and with B + HB/(0.5/cm). We do "
           "not know the size of the specimen and the table, so two sizes are simulated. A sheet without "
           "bending that hangs between two lines has the shape of a catenary. ASTM D1388 and the catenary "
           "are verification: theory gives the answer, and the check shows whether the program solves its "
           "equations. Drape is validation by ASME V&V 20-2009: the check shows whether the equations "
           "describe cloth. The error E = S − D (simulation minus measurement) is compared with its standard "
           "uncertainty u_val = √(u_num² + u_input² + u_D²). u_num comes from the scatter over seeds and "
           f"from the difference between meshes of {textile.COARSE} and {textile.FINE} cells along the "
           "radius. u_input comes from friction (B may have any value between those of both lengths), from "
           f"directions in which B was not measured ({100 * textile.DIRECTIONS:.0f} % of B), and from "
           f"errors of measurement of B ({100 * textile.RIGIDITY:.0f} %, our assumption) and of the weight "
           f"({100 * textile.WEIGHT:.0f} %, our assumption). u_D is {100 * textile.DRAPE:.0f} % of D, our "
           "assumption. A drape coefficient is validated if |E| ≤ u_val; otherwise the error of the model is "
           "at least |E| − u_val. There is no factor of coverage: a perfect model would fail in one row of "
           "three. Fabrics shear, but this model does not shear; u_val does not cover this difference."),
    Figure(fabrics, "Fabrics: direction, softening, friction, folds, maps", "Fabrics",
           "A woven sheet has different rigidities along the warp and along the weft. A narrow strip that "
           "is cut at the angle φ to the warp may also curve across and twist: its rigidity is 1/S11(φ), "
           "S being the inverse of the matrix D of an orthotropic plate. D(φ) is the rigidity of a wide "
           "sheet that bends to a cylinder. The program fits hinges and springs to D(φ). Near the sides of a "
           "strip, hinges and springs are missing, so a narrow strip does not have 1/S11(φ). Other strips "
           "have a moment that softens, internal friction (the moment is B κ ± HB), folds that "
           "stay (beyond the curvature κy the slope of the moment is h B), or three times the rigidity "
           "in one half. Each strip is compared with the formula of its own law. A single rigidity does "
           "not give the measured drape coefficients of all fabrics. Two possible causes are internal "
           "friction and the direction. The last table has the drape with friction, and by direction, "
           "validated as in the section before, but with mid_edge on a coarser mesh. A simulation with "
           "friction leaves friction out of u_input; a simulation by direction leaves the direction out. "
           "u_num comes from the scatter over seeds and from meshes of "
           f"{textile.COARSE} and {textile.USUAL} cells. "
           "If the config states no bias, the rigidity at 45° follows from warp and weft by Huber's formula "
           "for plates; the table has drapes with this bias, and with half of it."),
    Figure(napkin, "A disc that hangs over a round table", "Napkin",
           "A disc lies on a round table, where it is clamped, and hangs over the table's edge. Under a "
           "small gravity the overhang sags equally all around. The sag pulls the rim of the disc inwards, "
           "to a smaller circle. The rim is too long for this circle, so above a critical gravity it forms "
           "waves. The critical gravity and the "
           "number of waves follow from the second variation of the energy of a plate "
           "(analysis/truths/napkin.py). In the simulation, the squared amplitude of the waves is "
           "extrapolated to 0."),
]


def content(sections, out):
    rows = [(f"<a href='#{section.id}'>{escape(section.title)}</a>", "", tally(section.checks))
            for section in sections]
    parts = [Part("rules", "Two laws of bending, and how they are judged", LAWS, "Rules"),
             Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every check.</p>", "Data")]
    return Content(answer(sections), cards_html(rows), parts,
                   verdicts=lambda section: [checks_html(section.checks)])


def answer(sections):
    """The page's answer: how the stiffness depends on the resolution, as stated and by the paper's rule."""
    rows = next((section.table("summary") for section in sections if section.id == "calibrated"), [])
    rows = sorted(rows, key=lambda row: row["ratio"])
    stated, ruled = ([row for row in rows if row["rule"] == rule] for rule in calibrated.RULES)
    if not stated:
        return ("The answer needs runs of configs/stiffness/calibrated.json that are missing."
                if any(section.origins for section in sections) else "There are no runs yet.")
    worst = {row["name"]: row for row in stated}
    best = min(worst.values(), key=lambda row: row["ratio"])
    kept = all(row["ratio"] <= 1 + calibrated.LIMITS[row["family"]] for row in stated)
    text = (f"If the flexural rigidity is stated, a model has {'the' if kept else 'nearly the'} same "
            f"stiffness on finer meshes: the stiffness of {_change(best)}, the stiffness of "
            f"{_change(stated[-1])}")
    ratios = [row["ratio"] for row in ruled if row["name"] in resolution.CLAIMED]
    if ratios:
        text += (". By the paper's rule, the stiffness of the paper's springs changes by a factor of "
                 f"{number_text(ratios[0], 2)} to {number_text(ratios[-1], 2)}")
    return text + "."


def _change(row):
    low, high = row["cells"]
    return (f"<b>{escape(row['name'])}</b> changes by at most {number_text(100 * (row['ratio'] - 1), 2)} % "
            f"({escape(row['mesh'])}, {low} to {high} cells)")


def write_data(sections, results, out):
    write_objects(out / "summary.json", [check.as_json() for section in sections for check in section.checks])


PAGE = Page("stiffness", "How stiff is it really?", "./bendlab reproduce stiffness", FIGURES, content,
            write_data)
