"""The page of verification: poses, shells and strips against closed forms and other programs."""
from figures.verification import buckling, cost, creases, locking, loops, manufactured, poses, shells, \
    strips, validation
from pages.project import Content, Figure, Page
from tables.section import write_objects
from web.html_parts import Part, escape
from web.verdicts import cards_html, checks_html

OURS = ("mid_edge", "stvk")  # the model that the page recommends, and its membrane

RULES = ("<p>Verification asks whether the program solves its equations; validation asks whether equations "
         "describe cloth. This page keeps them apart: only the last section is validation. Most sections "
         "compare numbers with a truth from outside the program: a closed form, a published value, or "
         "CalculiX, a program that others wrote. Three sections have no such truth: creases, locking and "
         "cost.</p><p>In a convergence study, each row states the observed order of convergence on its "
         "three finest meshes, beside the order in theory if there is a theory. The limit is the value "
         "extrapolated to mesh size 0. The uncertainty is the grid convergence index of Roache (1994). The "
         "first rule that fits gives the verdict: fewer than three meshes (<em>too few meshes</em>); the "
         "differences between meshes do not shrink (<em>does not converge</em>); the limit is within 1 % of "
         "the truth (<em>agrees</em>); the error on the finest mesh is at most the uncertainty, and the "
         "uncertainty is at most 5 % (<em>agrees</em>); the uncertainty is above 5 % (<em>not "
         "resolved</em>); otherwise the row states the number to which it converges. Irregular meshes are "
         "not refined evenly, so their observed order means little.</p>")

FIGURES = [
    Figure(poses, "Energies of poses", "Poses",
           "A pose is prescribed, and the program states its bending energy without a step. The poses are "
           "those of Chen, Kaufman and Vouga 2026 (Better Bending), on meshes with one diagonal, "
           "alternating diagonals, irregular triangles, and irregular triangles that are four times as "
           "long as wide. In this section hinges are not calibrated: the weight of a hinge is |e|² / (A₁ + "
           "A₂), where e is the edge and A₁ and A₂ are the areas of its triangles. The code of that paper "
           "uses 3 times this weight; the last table shows its energies. B is the flexural rigidity. The "
           "unknown normals of mid_edge and dkt relax in a strip along a free border, as wide as a cell. So "
           "the order in theory of these models is 1 for poses with a border, and 2 for the sphere. "
           "laplacian has a Poisson's ratio of 1, so its truths are those for this ratio."),
    Figure(creases, "Sharp creases", "Creases",
           "A sheet is folded along a line. The energy of the smooth sheet is infinite, so the energy has "
           "to grow without bound on finer meshes. It also has to rise with the angle, because cloth must "
           "not help a fold to shut."),
    Figure(manufactured, "Manufactured solution", "Manufactured",
           "A smooth pose of a flat square is prescribed, both bent and stretched, with Poisson's ratio "
           "0.3. The program states the elastic forces, and their virtual work on a smooth displacement is "
           "compared with the exact work. So the forces are tested, not only the energies."),
    Figure(strips, "Strips under their weight, and their frequency", "Strips",
           "A clamped strip sinks by a thousandth of its length, or hangs with Γ = 10 and 100. Γ = ρ g L³ "
           "/ B compares weight and stiffness (ρ: mass per area, L: length). H is how far the free end "
           "hangs down, W how far it reaches out. The heavy elastica, the theory of a strip under its "
           "weight, turns H/W into a rigidity, which is compared with the stated B. In this section hinges "
           "are calibrated, so that they have the stated rigidity if the membrane forces the sheet into a "
           "cylinder. For the frequency, the strip starts at rest in its equilibrium under a small weight. "
           "Then the weight is removed, and the strip swings."),
    Figure(locking, "Does the membrane lock?", "Locking",
           "A cylinder contains straight lines. If edges of the mesh lie along these lines, the mesh can "
           "bend to the cylinder without strain. Otherwise the membrane must stretch, and a stiff membrane "
           "makes the sheet too stiff (locking). The table shows by how much, for soft and stiff membranes "
           "and two forms of strain."),
    Figure(loops, "Loops and a Möbius strip", "Loops",
           "A strip whose ends are held together hangs as a ring, a heart or a pear, as in Peirce's tests. "
           "'Standing' is a ring that stands on a plane, and 'fold' a strip that is folded back over itself "
           "on a plane (Plaut 2015, doi 10.1177/0040517514553877). The truth is the heavy elastica. The "
           "energy of a Möbius strip that does not stretch approaches Sadowsky's value as the width goes "
           "to 0. A strip of finite width has more energy, so these rows have no verdict."),
    Figure(shells, "Shells under loads", "Shells",
           "Static equilibria with large displacements (cantilevers, slit ring) and small displacements "
           "(roof, cylinder, hemispheres, twisted beam). The membrane is that of Saint Venant and "
           "Kirchhoff, made of triangles with constant strain. Such triangles are too stiff where the "
           "membrane bends in its own plane."),
    Figure(buckling, "Lateral buckling and wrinkles", "Buckling",
           "A strip whose width is upright bends sideways above a critical load. Romero and others 2021 (doi "
           "10.1145/3450626.3459931) test simulators with it. A sheet that is pulled at its ends, which "
           "keep their width, wrinkles along the pull. The law of the wave length (Cerda and Mahadevan "
           "2003) holds if waves are short compared with the width."),
    Figure(cost, "Does mid-edge bending pay?", "Cost",
           "A clamped strip falls and comes to rest. Each model is computed with several solver settings. "
           "The error of every model is its distance from the equilibrium of mid_edge on 104 cells, "
           "divided by the diagonal of the strip. Hinges are calibrated for large deflections."),
    Figure(validation, "Validation: drape of fabrics", "Validation",
           "The only section about real cloth. The error is the simulated minus the measured drape "
           "coefficient, and u_val is its standard uncertainty (ASME V&V 20). The section on textile tests "
           "of the page of stiffness states the inputs."),
]


def content(sections, out):
    rows = [(f"<a href='#{section.id}'>{escape(section.title)}</a>", escape(_counted(section)),
             _verdict(section)) for section in sections]
    parts = [Part("rules", "How it is judged", RULES, "Rules"),
             Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every row.</p>", "Data")]
    return Content(answer(sections), cards_html(rows), parts,
                   verdicts=lambda section: [checks_html(section.checks)] if section.checks else [])


def _rows(section):
    """The rows with a verdict. A table without a caption has rows of another table, for a chart."""
    return [row for table in section.tables if table.caption for row in table.rows if "verdict" in row]


def _agreeing(section, rows):
    good = "validated within u_val" if section.id == "validation" else "agrees"
    return sum(row["verdict"] == good for row in rows)


def _counted(section):
    rows = _rows(section)
    name = "rows" if section.id == "validation" else "rows of all models"
    return f"{_agreeing(section, rows)} of {len(rows)} {name} agree" if rows else ""


def _verdict(section):
    """(CSS class, text): how many rows of mid-edge bending agree; of validation, how many rows."""
    rows = [row for row in _rows(section) if section.id == "validation" or row["model"] in OURS]
    if not rows:
        return "open", "no verdict"
    agree = _agreeing(section, rows)
    of = "" if section.id == "validation" else "mid_edge: "
    return "yes" if agree == len(rows) else "no", f"{of}{agree} of {len(rows)}"


def answer(sections):
    """How near mid-edge bending is to its truths, compared with discrete shells."""
    rows = [row for section in sections if section.id == "strips" for row in section.table("strips")
            if row["deflection"] == "small deflection"]
    if not rows:
        return "There are no runs yet."
    worst = lambda model: max((abs(row["off"]) for row in rows if row["model"] == model),
                              default=float("nan"))
    return (f"On the finest meshes, a strip that is bent a little has its stated rigidity within "
            f"<b>{worst('mid_edge'):.2f} %</b> with <b>mid_edge</b> bending. With hinges (discrete_shells) "
            f"the error is up to {worst('discrete_shells'):.0f} %.")


def write_data(sections, results, out):
    write_objects(out / "summary.json", [{"section": section.id} | {
        name: value for name, value in row.items() if not isinstance(value, tuple)}
        for section in sections for row in _rows(section)])


PAGE = Page("verification", "Are the equations solved?", "./bendlab reproduce verification", FIGURES, content,
            write_data)
