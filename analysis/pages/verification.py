"""The page of verification: poses, shells and strips against closed forms and other programs."""
from figures.verification import buckling, cost, creases, locking, loops, manufactured, poses, shells, \
    strips, validation
from pages.project import Content, Figure, Page
from tables.section import write_objects
from web.html_parts import Part, escape
from web.verdicts import cards_html, checks_html

RULES = ("<p>Verification asks whether the program solves its equations; validation asks whether equations "
         "describe cloth. This page keeps them apart: all sections but the last are verification. In these "
         "sections every number has a truth from outside the program: a closed form, a published value, or "
         "CalculiX, a program that others wrote.</p><p>Each row states the observed order of convergence on "
         "its three finest meshes, beside the order in theory if there is a theory, and an uncertainty, the "
         "grid convergence index of Roache (1994). A row <em>agrees</em> if its error on the finest mesh is "
         "smaller than this uncertainty, or if its limit is within 1 % of the truth. A row that converges "
         "to another number states that number. Irregular meshes are not refined evenly, so that their "
         "observed order means little.</p>")

FIGURES = [
    Figure(poses, "Energies of poses", "Poses",
           "A pose is prescribed, and the program states its bending energy without a step. The poses are "
           "those of Chen, Kaufman and Vouga 2026 (Better Bending), on meshes with one diagonal, "
           "alternating diagonals, irregular triangles, and irregular triangles that are four times as "
           "long as wide. Hinges have the weight |e|² / (A₁ + A₂), not a calibrated one."),
    Figure(creases, "Sharp creases", "Creases",
           "A sheet is folded along a line. The energy of the smooth sheet is infinite, so that the energy "
           "has to grow without bound on finer meshes. It also has to rise with the angle, because cloth "
           "must not help a fold to shut."),
    Figure(manufactured, "Manufactured solution", "Manufactured",
           "A smooth pose of a flat square is prescribed, both bent and stretched, with Poisson's ratio "
           "0.3. The program states the elastic forces, and their virtual work on a smooth displacement is "
           "compared with the exact work. So the forces are tested, not only the energies."),
    Figure(strips, "Strips under their weight, and their frequency", "Strips",
           "A strip is clamped at one end and sinks by a thousandth of its length, or hangs with Γ = ρ g "
           "L³ / B = 10 and 100. The rigidity B is computed from H/W of the free end by the heavy "
           "elastica. Hinges are calibrated as in all other scenes, so that they have the stated rigidity "
           "if the membrane forces the sheet into a cylinder. The first frequency is that of a strip "
           "without weight after a small push."),
    Figure(locking, "Does the membrane lock?", "Locking",
           "Triangles of the membrane have constant strain. If no edges of the mesh lie along the straight "
           "lines of a developable surface, such a mesh cannot bend without strain, and a stiff membrane "
           "makes the sheet too stiff. The table shows by how much, for soft and stiff membranes, two "
           "forms of strain, and meshes whose edges lie along these lines or not."),
    Figure(loops, "Loops and a Möbius strip", "Loops",
           "A strip whose ends are held together hangs as a ring, a heart or a pear, as in Peirce's and "
           "Plaut's tests (doi 10.1177/0040517514553877). The truth is the heavy elastica. A Möbius strip "
           "that does not stretch has the energy of Sadowsky's functional if it is narrow."),
    Figure(shells, "Shells under loads", "Shells",
           "Static equilibria with large displacements (cantilevers, slit ring) and small displacements "
           "(roof, cylinder, hemispheres, twisted beam). The membrane is that of Saint Venant and "
           "Kirchhoff, made of triangles with constant strain. Such triangles are too stiff where the "
           "membrane bends in its own plane."),
    Figure(buckling, "Lateral buckling and wrinkles", "Buckling",
           "A strip whose width is upright bends sideways above a critical load. A sheet that is pulled at "
           "its ends, which keep their width, wrinkles along the pull. The law of the wave length (Cerda "
           "and Mahadevan 2003) holds if waves are short compared with the width."),
    Figure(cost, "Does the better model pay?", "Cost",
           "A clamped strip falls and comes to rest. Each model is computed with ten solver settings, and "
           "its error is the distance to the equilibrium of a mesh of 104 cells, relative to the strip's "
           "diagonal. Hinges are calibrated for large deflections."),
    Figure(validation, "Validation: drape of fabrics", "Validation",
           "The only section about real cloth. The comparison error E is the simulated minus the measured "
           "drape coefficient, and u_val is its standard uncertainty (ASME V&V 20). The inputs are on the "
           "<a href='../stiffness/index.html#textile'>page of stiffness</a>."),
]


def content(sections, out):
    rows = [(f"<a href='#{section.id}'>{escape(section.title)}</a>", escape(_counted(section)), "")
            for section in sections]
    parts = [Part("rules", "How it is judged", RULES, "Rules"),
             Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every row.</p>", "Data")]
    return Content(answer(sections), cards_html(rows), parts,
                   verdicts=lambda section: [checks_html(section.checks)] if section.checks else [])


def _rows(section):
    return [row for table in section.tables for row in table.rows if "verdict" in row]


def _counted(section):
    rows = _rows(section)
    good = "validated within u_val" if section.id == "validation" else "agrees"
    holding = sum(row["verdict"] == good for row in rows)
    verb = {"agrees": "agree"}.get(good, good)
    return f"{holding} of {len(rows)} rows {verb}" if rows else ""


def answer(sections):
    """How near mid-edge bending is to its truths, compared with discrete shells."""
    rows = [row for section in sections if section.id == "strips" for row in section.table("strips")
            if row["deflection"] == "small deflection"]
    if not rows:
        return "There are no runs yet."
    worst = lambda model: max((abs(row["off"]) for row in rows if row["model"] == model),
                              default=float("nan"))
    return (f"Bent a little, a strip with <b>mid-edge</b> bending has its stated rigidity within "
            f"<b>{worst('mid_edge'):.2f} %</b> on every kind of mesh; with hinges (discrete shells) it is up "
            f"to {worst('discrete_shells'):.0f} % off, however fine the mesh is.")


def write_data(sections, results, out):
    write_objects(out / "summary.json", [{"section": section.id} | {
        name: value for name, value in row.items() if not isinstance(value, tuple)}
        for section in sections for row in _rows(section)])


PAGE = Page("verification", "Are the equations solved?", "./bendlab reproduce verification", FIGURES, content,
            write_data)
