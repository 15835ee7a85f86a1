#include "bendlab/scene/scene_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bendlab/mesh/flaws.hpp"
#include "bendlab/scene/fabrics.hpp"

namespace bendlab {
namespace {

constexpr std::array<std::string_view, 4> stiffness_names = {"k", "k_per_step", "compliance", "physical"};
constexpr std::array<std::string_view, 2> rest_curvature_names = {"mesh", "flat"};
constexpr std::array<std::string_view, 3> chosen_precision_names = {"auto", "single", "double"};

constexpr double seed_limit = 4294967295;  // 2³² - 1: fits every generator

// ---- When a setting is read (read_when). to_json() also writes some settings that are not read (kept_when),
// so that two runs with different choices differ only in the choice.

template <Generator... any>
constexpr auto generated_by = read_when<Scene>([](const Scene& s) {
  return !s.mesh.file && ((s.mesh.generator == any) || ...);
});
template <Stiffness... any>
constexpr auto strains_by = read_when<Scene>([](const Scene& s) {
  return ((s.material.strain.stiffness == any) || ...);
});
template <Stiffness... any>
constexpr auto bends_by = read_when<Scene>([](const Scene& s) {
  return ((s.bending.stiffness == any) || ...);
});

constexpr std::string_view on_generator = "/mesh/generator",
                           on_strain_stiffness = "/material/strain/stiffness",
                           on_bending_stiffness = "/bending/stiffness";
constexpr auto always = read_when<Scene>([](const Scene&) { return true; });
constexpr auto generated = read_when<Scene>([](const Scene& s) { return !s.mesh.file; });
constexpr auto makes_at_random = read_when<Scene>(
    [](const Scene& s) { return s.mesh.jitter.value_or(0) > 0 || generated_by<Generator::delaunay>(&s); });
constexpr auto may_seed_mesh = read_when<Scene>([](const Scene& s) { return !s.mesh.file || s.mesh.jitter; });
constexpr auto has_triangles =
    read_when<Scene>([](const Scene& s) { return s.solver.method.kind().membrane == Membrane::triangles; });
constexpr auto has_directions = read_when<Scene>(
    [](const Scene& s) { return has_triangles(&s) && s.material.strain.form != StrainForm::stvk; });
constexpr auto bends_by_number = bends_by<Stiffness::k, Stiffness::k_per_step, Stiffness::compliance>;
constexpr auto may_bend_by_k = read_when<Scene>(
    [](const Scene& s) { return bends_by_number(&s) && s.solver.method.kind().needs_compliance.empty(); });
// Only springs that do not push have a rigidity that depends on the curvature.
constexpr auto needs_curvature = read_when<Scene>([](const Scene& s) {
  const BendingKind& model = s.bending.model.kind();
  return s.bending.stiffness == Stiffness::physical && model.springs_only && !model.prestressed;
});
constexpr auto is_of_hinges = read_when<Scene>([](const Scene& s) {
  return s.bending.stiffness == Stiffness::physical && !s.bending.model.kind().springs_only;
});
constexpr auto is_shell =
    read_when<Scene>([](const Scene& s) { return s.material.youngs_modulus.has_value(); });
constexpr auto states_membrane = read_when<Scene>([](const Scene& s) {
  return strains_by<Stiffness::physical>(&s) && !is_shell(&s) && !s.material.strain.membrane.is_given();
});
constexpr auto states_rigidity = read_when<Scene>([](const Scene& s) {
  return bends_by<Stiffness::physical>(&s) && !is_shell(&s) && !s.bending.rigidity.is_given() &&
         s.bending.softening.curvatures.empty();
});
constexpr auto takes_poisson_ratio = read_when<Scene>([](const Scene& s) {
  return s.bending.model.kind().takes_poisson_ratio || s.material.strain.form == StrainForm::stvk ||
         is_shell(&s) || s.bending.rigidity.is_given();
});
constexpr auto has_flat_generator = read_when<Scene>([](const Scene& s) {
  return generated_by<Generator::grid, Generator::equilateral, Generator::delaunay>(&s);
});
constexpr auto has_hinges =
    read_when<Scene>([](const Scene& s) { return is_made_of_hinges(s.bending.model.kind()); });
constexpr auto starts_at_random =
    read_when<Scene>([](const Scene& s) { return s.initial.perturbation > 0 || s.initial.random > 0; });
constexpr auto counts_substeps =
    read_when<Scene>([](const Scene& s) { return s.solver.method.kind().default_substeps > 0; });
constexpr auto counts_iterations =
    read_when<Scene>([](const Scene& s) { return s.solver.method.kind().default_iterations > 0; });
constexpr auto has_precisions =
    read_when<Scene>([](const Scene& s) { return s.solver.method.kind().make_float != nullptr; });

constexpr std::string_view stiffness_meaning =
    "How stiffness is given. k: a projection removes the fraction k of a constraint's error. k_per_step: the "
    "n projections of a substep together remove the fraction k, and a single projection 1 - (1 - k)^(1/n). "
    "compliance: inverse stiffness, as in XPBD. physical: membrane_stiffness is used. Absent: k if warp, "
    "weft, shear or area is given, compliance if compliance is given, otherwise as in /defaults";

constexpr std::string_view bending_stiffness_meaning =
    "How stiffness is given. k, k_per_step and compliance: as in /material/strain. physical: "
    "flexural_rigidity or quartic_coefficient is used, and the compliance of each constraint is computed "
    "from the mesh. Absent: k if k is given, compliance if compliance is given, otherwise physical";

std::span<const std::string_view> fabric_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Fabric& fabric : fabrics()) list.push_back(fabric.name);
    return list;
  }();
  return names;
}

// The tables are formatted by hand.
// clang-format off
// Not constexpr, because mesh_flaws() is called for the names of the flaws.
const std::array mesh = {
    field<&Mesh::generator>({.name = "generator",
              .meaning = "How the mesh is made. grid: squares split into triangles. equilateral: equilateral "
                         "triangles, in whole rows, to which the extents are rounded. delaunay: irregular, "
                         "from random points. disc: concentric rings; cells is the number of rings. "
                         "tube: the side of a cylinder or cone around z; cells is "
                         "the number of columns. sphere: an inflated octahedron whose edges are split into "
                         "cells parts",
              .choices = generator_names, .read_when = generated}),
    field<&Mesh::file>({.name = "file",
              .meaning = "Mesh file (.obj, .ply, .off, .stl), used instead of a generator. The path is "
                         "relative to the config's folder", .names_file = true}),
    field<&Mesh::width>({.name = "width", .unit = "m",
              .meaning = "Extent along x",
              .minimum = 0, .above = true,
              .read_when = generated_by<Generator::grid, Generator::equilateral, Generator::delaunay>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::height>({.name = "height", .unit = "m",
              .meaning = "Extent along y, but for a tube along z",
              .minimum = 0, .above = true,
              .read_when = generated_by<Generator::grid, Generator::equilateral, Generator::delaunay,
                                        Generator::tube>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::cells>({.name = "cells", .unit = "1",
              .meaning = "Resolution: cells along the width",
              .minimum = 1, .maximum = 4096, .read_when = generated}),
    field<&Mesh::diagonal>({.name = "diagonal",
              .meaning = "grid: which diagonal splits a square. same: the same diagonal in all squares; "
                         "alternating: the diagonal changes from square to square; both: both diagonals",
              .choices = diagonal_names, .read_when = generated_by<Generator::grid>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::rows>({.name = "rows",
              .meaning = "equilateral: direction of the rows of edges, relative to the long side. Absent: "
                         "parallel to the sides in /pins/vertices, or parallel to the long side if there are "
                         "none",
              .choices = rows_names, .read_when = generated_by<Generator::equilateral>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::radius>({.name = "radius", .unit = "m",
              .meaning = "Radius of a disc or sphere, or of the lower end of a tube",
              .minimum = 0, .above = true,
              .read_when = generated_by<Generator::disc, Generator::tube, Generator::sphere>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::radius_top>({.name = "radius_top", .unit = "m",
              .meaning = "Radius of the upper end of a tube. Absent: equal to radius",
              .minimum = 0, .above = true, .read_when = generated_by<Generator::tube>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::seed>({.name = "seed", .unit = "1",
              .meaning = "Seed of the random points of delaunay, and of the random moves of jitter",
              .minimum = 0, .maximum = seed_limit, .read_when = makes_at_random, .kept_when = may_seed_mesh}),
    field<&Mesh::aspect>({.name = "aspect", .unit = "1",
              .meaning = "Height of a cell divided by its width: a sheet with fewer cells along the height "
                         "is made, and then stretched along the height",
              .minimum = 0.001, .maximum = 1000, .read_when = has_flat_generator, .kept_when = generated,
              .depends_on = on_generator}),
    field<&Mesh::refine>({.name = "refine", .unit = "1",
              .meaning = "How many times each triangle is cut into four at the middles of its edges, also in "
                         "a mesh from a file. The original vertices keep their indices, and the surface "
                         "keeps its shape. Texture coordinates are interpolated. Absent: not refined",
              .minimum = 0, .maximum = 12}),
    field<&Mesh::jitter>({.name = "jitter", .unit = "1",
              .meaning = "Moves each vertex that is not on the border at random within the sheet, by at most "
                         "this fraction of the smallest height of its triangles, also in a mesh from a file. "
                         "refine is applied first. seed is the seed of the random moves. Absent: no moves",
              .minimum = 0, .maximum = 0.4}),
    field<&Mesh::scale>({.name = "scale", .unit = "1",
              .meaning = "Factor for all coordinates, also of a mesh from a file",
              .minimum = 0, .above = true}),
    field<&Mesh::offset>({.name = "offset", .unit = "m",
              .meaning = "Added to all coordinates after scale, also in a mesh from a file"}),
    field<&Mesh::shuffle>({.name = "shuffle", .unit = "1",
              .meaning = "Seed of a random numbering of vertices and triangles; absent: the generator's "
                         "numbering",
              .minimum = 0, .maximum = seed_limit, .read_when = generated}),
    field<&Mesh::flaw>({.name = "flaw",
              .meaning = "A defect that is added to the mesh on purpose. needles, caps, degenerate (no "
                         "area), duplicate_vertices, duplicate_faces, non_manifold_edge (a third triangle at "
                         "an edge) and bow_tie (triangles that share only a point) are added at about every "
                         "twentieth vertex, edge or triangle. isolated_vertices: vertices in no triangle. "
                         "pieces: the mesh is cut in two. mixed_orientation: every second triangle is "
                         "reversed. hole: a hole in the middle",
              .choices = mesh_flaws(), .read_when = generated}),
    field<&Mesh::bad_triangles>({.name = "bad_triangles",
              .meaning = "What to do with a mesh that has triangles without area, triangles listed twice, or "
                         "edges of three triangles. refuse: the run fails and lists the first bad triangles. "
                         "regularise: the mesh is simulated as it is, with a small rest height for triangles "
                         "without area. membrane_off: like regularise, but triangles without area have no "
                         "strain constraint. repair: points within 2e-6 of the mesh size are united, "
                         "triangles without area are removed, the sheet is cut where it branches, and all "
                         "triangles are oriented alike. 'bendlab mesh FILE' prints what each choice does to "
                         "a file",
              .choices = bad_triangles_names}),
};

constexpr std::array pins = {
      field<&Pinning::vertices>({.name = "vertices",
                .meaning = "Pinned vertices by name: the corners, sides and centre of the rest mesh's box. "
                           "Left to right is x; bottom to top is y, or z in an upright sheet. top_rim and "
                           "bottom_rim: the ends of a tube. circle: the vertices on a circle around the "
                           "centre, whose radius is a quarter of the smaller side. interior: four vertices "
                           "at 0.3 and 0.7 of width and height",
                .choices = place_names}),
      field<&Pinning::indices>({.name = "indices", .unit = "1",
                .meaning = "Pinned vertices by index (whole numbers, the first vertex is 0), in addition to "
                           "those in vertices",
                .minimum = 0}),
      field<&Pinning::hold_x>({.name = "hold_x",
              .meaning = "Vertices, by the names of `vertices`, that keep their coordinate x, and are free "
                         "along y and z: a diaphragm or a roller, for example. The sheet can turn "
                         "about them",
              .choices = place_names}),
      field<&Pinning::hold_y>({.name = "hold_y",
              .meaning = "Vertices that keep their coordinate y", .choices = place_names}),
      field<&Pinning::hold_z>({.name = "hold_z",
              .meaning = "Vertices that keep their coordinate z", .choices = place_names}),
      field<&Pinning::hold_x_indices>({.name = "hold_x_indices", .unit = "1",
              .meaning = "Vertices that keep their coordinate x, by index", .minimum = 0}),
      field<&Pinning::hold_y_indices>({.name = "hold_y_indices", .unit = "1",
              .meaning = "Vertices that keep their coordinate y, by index", .minimum = 0}),
      field<&Pinning::hold_z_indices>({.name = "hold_z_indices", .unit = "1",
              .meaning = "Vertices that keep their coordinate z, by index", .minimum = 0}),
      field<&Pinning::symmetry>({.name = "symmetry",
              .meaning = "Axes along which the vertices of hold_x, hold_y or hold_z are held on a plane of "
                         "symmetry: the sheet keeps its slope there, too. Needs the bending model dkt, whose "
                         "unknowns are the slopes at vertices",
              .choices = coordinate_axis_names}),
      field<&Pinning::ring>({.name = "ring", .unit = "1",
                .meaning = "How many rings of neighbours around each pinned vertex are pinned, too. The "
                           "paper pins one ring; such a clamp becomes smaller if the mesh is refined",
                .minimum = 0, .maximum = 64}),
      field<&Pinning::distance>({.name = "distance", .unit = "m",
                .meaning = "Vertices are pinned, too, within this distance of a vertex that vertices or "
                           "indices list, or of an edge between two such vertices. Such a clamp has the "
                           "same width at every resolution",
                .minimum = 0}),
};

// Not constexpr, because fabric_names() is called.
const std::array material = {
    field<&Material::fabric>({.name = "fabric",
              .meaning = "A fabric whose measured density, rigidity, friction and softening become the "
                         "defaults of this config; `bendlab fabrics` lists the fabrics and their sources. "
                         "Absent: no fabric",
              .choices = fabric_names()}),
    field<&Material::density>({.name = "density", .unit = "kg/m²",
              .meaning = "Mass per area",
              .minimum = 0, .above = true}),
    field<&Material::youngs_modulus>({.name = "youngs_modulus", .unit = "Pa",
              .meaning = "Young's modulus E of a shell of thickness h. membrane_stiffness is then E h, "
                         "flexural_rigidity is E h³ / (12 (1 - ν²)), and the default of "
                         "/material/strain/form is stvk. Absent: the two stiffnesses are stated themselves",
              .minimum = 0, .above = true}),
    field<&Material::thickness>({.name = "thickness", .unit = "m",
              .meaning = "Thickness h of a shell that has a youngs_modulus",
              .minimum = 0, .above = true, .read_when = is_shell}),
    field<&Material::poisson_ratio>({.name = "poisson_ratio", .unit = "1",
              .meaning = "Poisson's ratio ν of the sheet: a strip that is bent along its length curves by -ν "
                         "times as much across its width. Read by the bending models that `bendlab models` "
                         "says can have one; other models imply a ratio, which the summary of a run states "
                         "as model_poisson_ratio",
              .minimum = -0.99, .maximum = 0.499, .read_when = takes_poisson_ratio, .kept_when = always}),
    field<&Material::density_ratio>({.name = "density_ratio", .unit = "1",
              .meaning = "Factor for the density in the half of the cloth with the larger x",
              .minimum = 0, .above = true}),
    field<&Material::coordinates>({.name = "coordinates",
              .meaning = "Directions of warp and weft. warp: the warp is warp_direction, projected into the "
                         "plane of each triangle. texture: warp and weft follow the texture coordinates of "
                         "the mesh file",
              .choices = material_coordinates_names}),
    field<&Material::warp_direction>({.name = "warp_direction", .unit = "1",
              .meaning = "Direction of the warp threads in the rest shape; any length above 0. For a tube, "
                         "0, 0, 1 is the direction of the axis"}),
};

constexpr std::array strain = {
    field<&Strain::form>({.name = "form",
              .meaning = "How strain is measured, with S = FᵀF. normalised: stretch √S_ii - 1 and normalised "
                         "shear, as published. green: S_ii - 1 and S_ij. angle (ours): stretch as in "
                         "normalised; shear is the difference between a right angle and the angle between "
                         "warp and weft. Where warp and weft are nearly parallel, the gradient of normalised "
                         "shear is nearly 0, and a projection moves a triangle by many times its size. angle "
                         "does not have this problem. stvk: an isotropic sheet with /material/poisson_ratio "
                         "(Saint Venant-Kirchhoff); needs a compliance or a physical stiffness. Absent: stvk "
                         "with /material/youngs_modulus, otherwise angle",
              .choices = strain_form_names, .read_when = has_triangles}),
    field<&Strain::stiffness>({.name = "stiffness",
              .meaning = stiffness_meaning, .choices = stiffness_names}),
    field<&Strain::membrane_stiffness>({.name = "membrane_stiffness", .unit = "N/m",
              .meaning = "Used if stiffness is physical: Young's modulus times thickness, which is the force "
                         "per width for a strain or shear of 1. With 10000 N/m, a sheet of 1 m and 0.2 kg/m² "
                         "has a strain of 10⁻⁴ under its weight",
              .minimum = 0, .above = true, .read_when = states_membrane,
              .kept_when = strains_by<Stiffness::physical>, .depends_on = on_strain_stiffness}),
    field<&Strain::warp>({.name = "warp", .unit = "1",
              .meaning = "k of stretch along the warp",
              .minimum = 0, .maximum = 1, .read_when = has_directions, .kept_when = has_triangles}),
    field<&Strain::weft>({.name = "weft", .unit = "1",
              .meaning = "k of stretch across the warp",
              .minimum = 0, .maximum = 1, .read_when = has_directions, .kept_when = has_triangles}),
    field<&Strain::shear>({.name = "shear", .unit = "1",
              .meaning = "k of shear",
              .minimum = 0, .maximum = 1, .read_when = has_directions, .kept_when = has_triangles}),
    field<&Strain::area>({.name = "area", .unit = "1",
              .meaning = "k of a triangle's area; 0: no area constraint",
              .minimum = 0, .maximum = 1, .read_when = has_directions, .kept_when = has_triangles}),
    field<&Strain::compliance>({.name = "compliance", .unit = "m/N",
              .meaning = "Compliance of every strain constraint, used if stiffness is compliance; 0 is rigid",
              .minimum = 0, .read_when = strains_by<Stiffness::compliance>, .kept_when = always,
              .depends_on = on_strain_stiffness}),
};

constexpr std::array bending = {
    field<&Bending::rest_curvature>({.name = "rest_curvature",
              .meaning = "Where hinges have no moment. mesh: in the rest shape of the mesh; flat: where the "
                         "sheet is flat, so that a curved mesh is bent from the start",
              .choices = rest_curvature_names, .read_when = has_hinges}),
      field<&Bending::stiffness>({.name = "stiffness",
                .meaning = bending_stiffness_meaning, .choices = stiffness_names}),
      field<&Bending::k>({.name = "k", .unit = "1",
                .meaning = "Stiffness of every bending constraint, used if stiffness is k or k_per_step",
                .minimum = 0, .maximum = 1, .read_when = bends_by<Stiffness::k, Stiffness::k_per_step>,
                .kept_when = may_bend_by_k, .depends_on = on_bending_stiffness}),
      field<&Bending::compliance>({.name = "compliance", .unit = "m/N or 1/(N m)",
                .meaning = "Inverse stiffness, used if stiffness is compliance; 0 is rigid. `bendlab models` "
                           "prints what the compliance means for each model",
                .minimum = 0, .read_when = bends_by<Stiffness::compliance>, .kept_when = bends_by_number,
                .depends_on = on_bending_stiffness}),
      field<&Bending::flexural_rigidity>({.name = "flexural_rigidity", .unit = "N m",
                .meaning = "Used if stiffness is physical: B, where the moment per width at the curvature κ "
                           "is B κ. Springs have this B only at the curvature at_curvature. Not used if only "
                           "quartic_coefficient is given",
                .minimum = 0, .above = true, .read_when = states_rigidity,
                .kept_when = bends_by<Stiffness::physical>, .depends_on = on_bending_stiffness}),
      field<&Bending::quartic_coefficient>({.name = "quartic_coefficient", .unit = "N m³",
                .meaning = "Used if stiffness is physical, for models made of springs: C, where the moment "
                           "per width at the curvature κ is C κ³",
                .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
                .depends_on = on_bending_stiffness}),
      field<&Bending::at_curvature>({.name = "at_curvature", .unit = "1/m",
                .meaning = "Used if stiffness is physical: the curvature κ0 at which springs have the moment "
                           "B κ0, so C = B/κ0². 20 is a fold of 5 cm radius",
                .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
                .kept_when = needs_curvature, .depends_on = on_bending_stiffness}),
      field<&Bending::deflection>({.name = "deflection",
                .meaning = "Used if stiffness is physical, for models made of hinges: at which deflections "
                           "the sheet has flexural_rigidity. large: when the membrane forces the sheet into "
                           "a cylinder, as in drapes and folds. small: when the sheet is bent so little that "
                           "the membrane has no influence. both: a compromise, with hinge weights for which "
                           "the rigidities at small and large deflections differ as little as possible. The "
                           "summary of a run contains the fraction of flexural_rigidity at small and at "
                           "large deflections",
                .choices = deflection_names, .read_when = is_of_hinges}),
};

constexpr std::array rigidity = {
    field<&DirectedRigidity::warp>({.name = "warp", .unit = "N m",
              .meaning = "Rigidity of a narrow strip along the warp, as a cantilever test measures it",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
    field<&DirectedRigidity::weft>({.name = "weft", .unit = "N m",
              .meaning = "Rigidity of a narrow strip along the weft",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
    field<&DirectedRigidity::bias>({.name = "bias", .unit = "N m",
              .meaning = "Rigidity of a narrow strip at 45 degrees to the warp. Absent: the sheet resists "
                         "twist as in Huber's theory of plates, D12 + 2 D66 = √(D11 D22)",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
};

constexpr std::array softening = {
    field<&Softening::half_at>({.name = "half_at", .unit = "1/m",
              .meaning = "Curvature κ½ at which the secant rigidity M/κ is half of flexural_rigidity: M = B "
                         "κ / (1 + κ/κ½)",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
    field<&Softening::curvatures>({.name = "curvatures", .unit = "1/m",
              .meaning = "A measured curve, instead of half_at: curvatures, ascending, without 0. The moment "
                         "is linear between the points, and goes on with its last slope",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
    field<&Softening::moments>({.name = "moments", .unit = "N",
              .meaning = "The moment per width at each of the curvatures. The first moment over the first "
                         "curvature is flexural_rigidity",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
};

constexpr std::array hysteresis = {
    field<&BendingFriction::hb>({.name = "hb", .unit = "N",
              .meaning = "HB: the moment per width is B κ + HB while the sheet bends, and B κ - HB while it "
                         "unbends. Laboratories state 2HB; 1 gf cm/cm is 0.00981 N",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
    field<&BendingFriction::slip>({.name = "slip", .unit = "1/m",
              .meaning = "The friction grows from 0 to HB while the curvature changes by this number, and "
                         "from -HB to HB while it changes by twice this number. Absent: HB / (5 B)",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
};

constexpr std::array plasticity = {
    field<&BendingPlasticity::yield_at>({.name = "yield_at", .unit = "1/m",
              .meaning = "Curvature κy beyond which a fold stays. A sheet that was bent to κ keeps the "
                         "curvature (1 - hardening) (κ - κy)",
              .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
    field<&BendingPlasticity::hardening>({.name = "hardening", .unit = "1",
              .meaning = "Slope of the moment beyond `yield_at`, relative to flexural_rigidity. The moment "
                         "at which the fold yields again grows, too",
              .minimum = 0, .maximum = 0.99, .read_when = bends_by<Stiffness::physical>,
              .depends_on = on_bending_stiffness}),
};

constexpr std::array membrane = {
    field<&DirectedMembrane::warp>({.name = "warp", .unit = "N/m",
              .meaning = "Force per width for a strain of 1 along the warp",
              .minimum = 0, .above = true, .read_when = strains_by<Stiffness::physical>,
              .depends_on = on_strain_stiffness}),
    field<&DirectedMembrane::weft>({.name = "weft", .unit = "N/m",
              .meaning = "Force per width for a strain of 1 along the weft",
              .minimum = 0, .above = true, .read_when = strains_by<Stiffness::physical>,
              .depends_on = on_strain_stiffness}),
    field<&DirectedMembrane::shear>({.name = "shear", .unit = "N/m",
              .meaning = "Force per width for a shear of 1. Absent: √(warp weft)",
              .minimum = 0, .above = true, .read_when = strains_by<Stiffness::physical>,
              .depends_on = on_strain_stiffness}),
};

constexpr std::array solver = {
    field<&Solver::dt>({.name = "dt", .unit = "s",
              .meaning = "Time step",
              .minimum = 1e-9, .maximum = 1e6}),
    field<&Solver::substeps>({.name = "substeps", .unit = "1",
              .meaning = "How many equal parts a time step is divided into. Absent: the default of the "
                         "method, see `bendlab methods`",
              .minimum = 1, .maximum = 100000, .read_when = counts_substeps}),
    field<&Solver::iterations>({.name = "iterations", .unit = "1",
              .meaning = "How many times each substep visits all constraints. Absent: the default of the "
                         "method, see `bendlab methods`",
              .minimum = 1, .maximum = 100000, .read_when = counts_iterations}),
    field<&Solver::precision>({.name = "precision",
              .meaning = "Precision of the solver's numbers. auto: single precision, but double in two "
                         "cases. First, a substep is so short that the speed which gravity adds is small "
                         "compared with rounding errors, and the solver stores whole positions: quasi_newton "
                         "and kang_cho always do, pbd if an effect moves vertices directly (an obstacle, "
                         "tethers, …). Second, quasi_newton with the stated membrane, whose strain under the "
                         "cloth's weight is less than 5 times the rounding errors. The provenance of a run "
                         "contains the precision that was used",
              .choices = chosen_precision_names, .read_when = has_precisions}),
    field<&Solver::threads>({.name = "threads", .unit = "1",
              .meaning = "Number of threads of a run. The result is exactly the same for any number of "
                         "threads",
              .minimum = 1, .maximum = 256}),
};

constexpr std::array initial = {
    field<&Initial::file>({.name = "file",
              .meaning = "Mesh file (.obj, .ply, .off) whose points are the positions of all vertices at the "
                         "start, also of pinned vertices. The file has the triangles of the rest mesh in the "
                         "same order. The path is relative to the config's folder",
              .names_file = true}),
    field<&Initial::folds>({.name = "folds", .unit = "1",
              .meaning = "How many times the sheet is folded at the start, back and forth along x, into "
                         "layers above each other. The rest shape is not folded",
              .minimum = 0, .maximum = 64}),
    field<&Initial::fold_gap>({.name = "fold_gap", .unit = "m",
              .meaning = "Distance between the layers of the folded sheet",
              .minimum = 0, .above = true}),
    field<&Initial::creases>({.name = "creases", .unit = "1",
              .meaning = "Number of sharp folds of 180 degrees at the start. The folds divide the sheet "
                         "along x into equal strips that lie flat on top of each other",
              .minimum = 0, .maximum = 4096}),
    field<&Initial::scale>({.name = "scale", .unit = "1",
              .meaning = "Factors along x, y and z for the start positions of the free vertices, relative to "
                         "the mean of the pins or, without pins, to the centre. For example, 0, 0, 0 gives a "
                         "point, 1, 0, 0 a line, and -1, 1, 1 a mirror image"}),
    field<&Initial::tilt>({.name = "tilt", .unit = "degrees",
              .meaning = "Rotation of the sheet at the start, about the x axis through the centre of the "
                         "sheet. 0 is horizontal (gravity acts along -z), 90 is upright",
              .minimum = -180, .maximum = 180}),
    field<&Initial::perturbation>({.name = "perturbation", .unit = "1",
              .meaning = "Largest random displacement of a free vertex along each axis at the start, "
                         "relative to the mesh's size",
              .minimum = 0, .maximum = 1}),
    field<&Initial::random>({.name = "random", .unit = "1",
              .meaning = "If above 0, every free vertex starts at a random position in a cube around the "
                         "centre. The side of the cube is this number times the mesh's size",
              .minimum = 0}),
    field<&Initial::velocity>({.name = "velocity", .unit = "m/s",
              .meaning = "Velocity of all free vertices at the start"}),
    field<&Initial::spin>({.name = "spin", .unit = "rad/s",
              .meaning = "Angular velocity at the start, about the centre of the rest box"}),
    field<&Initial::seed>({.name = "seed", .unit = "1",
              .meaning = "Seed of perturbation and random",
              .minimum = 0, .maximum = seed_limit, .read_when = starts_at_random, .kept_when = always}),
    field<&Initial::after>({.name = "after",
              .meaning = "The cloth starts at rest where an earlier run ends. The earlier run has the "
                         "settings of this run with these changes, each of the form \"/json/pointer=value\". "
                         "The earlier run may have another method, for example, or a coarser mesh of the "
                         "same flat sheet. The earlier run is not recorded. Only the shape is taken over: "
                         "internal friction and folds that stay begin anew"}),
};

// The same settings for /mesh/surface and /initial/surface.
constexpr std::array surface = {
    field<&NamedSurface::shape>({.name = "shape",
              .meaning = "none: the mesh stays as it is. cylinder: rolled up along `direction` to the "
                         "radius, without strain; a tube becomes round. annulus: the width becomes the angle "
                         "`sweep`, the height goes from the inner to the outer radius. helix: a tangent "
                         "developable of a helix of the radius and pitch. helix_flat: the same surface, "
                         "flat. torus: of the radius, with the half of a tube of inner_radius. sphere: the "
                         "width becomes the angle `sweep` about the axis, the height goes from the angle "
                         "polar_from to the angle polar_to off the axis. dome: a disc becomes the part of a "
                         "sphere up to the angle polar_to off the axis. twist: the cross-sections turn by "
                         "`sweep` along the width, and not at its right end. vee: folded at the middle of "
                         "the width by the angle `sweep`, without strain",
              .choices = surface_shape_names}),
    field<&NamedSurface::radius>({.name = "radius", .unit = "m",
              .meaning = "Radius of the cylinder, helix or sphere, outer radius of the annulus, or distance "
                         "of the torus's tube from the axis",
              .minimum = 0, .above = true}),
    field<&NamedSurface::inner_radius>({.name = "inner_radius", .unit = "m",
              .meaning = "Inner radius of the annulus, or radius of the torus's tube",
              .minimum = 0, .above = true}),
    field<&NamedSurface::pitch>({.name = "pitch", .unit = "m",
              .meaning = "Rise of the helix in a turn", .minimum = 0, .above = true}),
    field<&NamedSurface::ruling>({.name = "ruling", .unit = "m",
              .meaning = "Length parameter of the helix's tangents: the surface has the tangents from this "
                         "length to twice this length",
              .minimum = 0, .above = true}),
    field<&NamedSurface::direction>({.name = "direction", .unit = "degrees",
              .meaning = "Direction in which the cylinder is rolled up: 0 along the width, 90 along the "
                         "height",
              .minimum = -360, .maximum = 360}),
    field<&NamedSurface::sweep>({.name = "sweep", .unit = "degrees",
              .meaning = "Angle, see shape", .minimum = -720, .maximum = 720}),
    field<&NamedSurface::polar_from>({.name = "polar_from", .unit = "degrees",
              .meaning = "Angle off the axis of a sphere, see shape", .minimum = 0, .maximum = 180}),
    field<&NamedSurface::polar_to>({.name = "polar_to", .unit = "degrees",
              .meaning = "Angle off the axis of a sphere or dome, see shape", .minimum = 0, .maximum = 180}),
};

// The same settings for all maps.
constexpr std::array map = {
    field<&MaterialMap::file>({.name = "file",
              .meaning = "A PLY file whose points or faces have the property `property`: a triangle of the "
                         "mesh takes the value at the nearest place of the file's surface. Or a PNG image, "
                         "whose grey from 0 (black) to 1 (white) lies on the texture coordinates; on a flat "
                         "sheet without texture coordinates it covers the sheet. The path is relative to the "
                         "config's folder",
              .names_file = true}),
    field<&MaterialMap::property>({.name = "property", .meaning = "Name of the property in a PLY file"}),
    field<&MaterialMap::low>({.name = "low", .unit = "1", 
              .meaning = "Factor where the map has the value 0. A factor must be above 0: state low for an "
                         "image with black parts"}),
    field<&MaterialMap::high>({.name = "high", .unit = "1",
              .meaning = "Factor where the map has the value 1. With the defaults of low and high, the map's "
                         "values are the factors"}),
};

// The same settings for the membrane and for bending.
constexpr std::array keyframes = {
    field<&Schedule::times>({.name = "times", .unit = "s",
              .meaning = "Times of the keyframes, ascending. The factor is linear between keyframes, and the "
                         "same before the first and after the last keyframe",
              .minimum = 0}),
    field<&Schedule::factors>({.name = "factors", .unit = "1",
              .meaning = "Factor on the stiffness at each of the times",
              .minimum = 0, .above = true}),
};

FieldTable keyframe_table() {
  return table_of<Schedule>(keyframes);
}

FieldTable map_table() {
  return table_of<MaterialMap>(map);
}

FieldTable surface_table() {
  return table_of<NamedSurface>(surface);
}

constexpr std::array top = {
    field<&Scene::duration>({.name = "duration", .unit = "s",
              .meaning = "Simulated time of a run, at least one step. The time is rounded up to whole steps "
                         "of /solver/dt",
              .minimum = 0, .above = true}),
};
// clang-format on

template <class Kind>
std::vector<std::string_view> names_of(std::span<const Kind* const> kinds) {
  std::vector<std::string_view> names;
  for (const Kind* kind : kinds) names.push_back(kind->name);
  return names;
}

// The row of a setting that chooses a model, method or effect.
SettingRow choice_row(std::string_view name, std::string_view meaning,
                      std::span<const std::string_view> names, std::optional<std::string_view> usual) {
  Field row{{.name = name, .meaning = meaning, .required = !usual, .choices = names}};
  row.type = FieldType::text;
  return {row, usual ? Value(std::string(*usual)) : Value()};
}

std::vector<std::string_view> method_names() {
  return names_of(methods());
}
std::vector<std::string_view> model_names() {
  return names_of(bending_models());
}
std::vector<std::string_view> effect_names() {
  return names_of(effects());
}

std::string meaning_of_method() {
  std::string text = "How a time step moves the cloth.";
  for (const MethodKind* method : methods()) text += fmt::format(" {}: {}.", method->name, method->summary);
  return text +
         " `bendlab methods` lists the settings that each method reads. Other settings have no effect, and "
         "the run gets a warning";
}

SettingRow method_row() {
  return choice_row("method", made_of_kinds<meaning_of_method>(), made_of_kinds<method_names>(),
                    Solver{}.method.name());
}

SettingRow model_row() {
  return choice_row("model", "Bending model. The settings of a model are in the section /bending/<model>",
                    made_of_kinds<model_names>(), Bending{}.model.name());
}

SettingRow type_row() {
  return choice_row("type", "Type of the effect", made_of_kinds<effect_names>(), std::nullopt);
}

Section section_of(std::string pointer, std::string meaning, const FieldTable& table,
                   const std::optional<SettingRow>& first = std::nullopt) {
  Section section{std::move(pointer), std::move(meaning), {}};
  if (first) section.rows.push_back(*first);
  std::ranges::move(rows_of(table), std::back_inserter(section.rows));
  return section;
}

// A model's section is /bending/<model>, so a model must not have the name of another setting in /bending.
void check_names_of_added_models() {
  for (const BendingKind* model : added_bending_models())
    if (std::ranges::find(bending, model->name, &Field::name) != bending.end() || model->name == "model" ||
        std::ranges::find(scene_parts(), fmt::format("/bending/{}", model->name), &Part::pointer) !=
            scene_parts().end())
      throw std::invalid_argument(
          fmt::format("the bending model '{}' has the same name as the setting /bending/{}; choose another "
                      "name",
                      model->name, model->name));
}

std::vector<Section> make_sections() {
  std::vector<Section> sections;
  for (const Part& part : scene_parts()) {
    const std::optional<SettingRow> first = part.pointer == "/bending"  ? std::optional(model_row())
                                            : part.pointer == "/solver" ? std::optional(method_row())
                                                                        : std::nullopt;
    Section& section = sections.emplace_back(
        section_of(std::string(part.pointer), std::string(part.meaning), part.table, first));
    if (part.pointer == "/bending") {
      check_names_of_added_models();
      for (const BendingKind* model : bending_models())
        if (!model->settings.fields.empty())
          sections.push_back(section_of(fmt::format("/bending/{}", model->name),
                                        fmt::format("Bending model {}: {}", model->name, model->summary),
                                        model->settings));
    }
    if (part.pointer == "/solver")
      for (const MethodKind* method : methods())
        for (SettingRow& row : rows_of(method->settings))
          if (std::ranges::none_of(section.rows,
                                   [&](const SettingRow& r) { return r.field.name == row.field.name; }))
            section.rows.push_back(std::move(row));
  }
  return sections;
}

}  // namespace

std::span<const Part> scene_parts() {
  static const std::array parts = {
      Part{"/mesh", "The rest mesh: generated, or read from a file", table_of<Mesh>(mesh),
           [](const Scene& s) -> const void* { return &s.mesh; }},
      Part{"/mesh/surface",
           "The surface that the generated mesh becomes. Pins and loads name vertices by their places in "
           "the flat mesh",
           surface_table(), [](const Scene& s) -> const void* { return &s.mesh.surface; },
           [](const Scene& s) { return !s.mesh.surface.is_given(); }},
      Part{"/pins", "Which vertices are held fixed", table_of<Pinning>(pins),
           [](const Scene& s) -> const void* { return &s.pins; }},
      Part{"/material", "The cloth's mass and material directions", table_of<Material>(material),
           [](const Scene& s) -> const void* { return &s.material; }},
      Part{"/material/strain", "Strain constraints of the triangles", table_of<Strain>(strain),
           [](const Scene& s) -> const void* { return &s.material.strain; }},
      Part{"/material/density_map", "Factors on the density by place", map_table(),
           [](const Scene& s) -> const void* { return &s.material.density_map; },
           [](const Scene& s) { return !s.material.density_map.is_given(); }},
      Part{"/material/strain/map", "Factors on the stiffness of the membrane by place", map_table(),
           [](const Scene& s) -> const void* { return &s.material.strain.map; },
           [](const Scene& s) { return !s.material.strain.map.is_given(); }},
      Part{"/material/strain/over_time", "A factor on the stiffness of the membrane over time",
           keyframe_table(),
           [](const Scene& s) -> const void* { return &s.material.strain.over_time; },
           [](const Scene& s) { return !s.material.strain.over_time.is_given(); }},
      Part{"/material/strain/membrane",
           "Stiffness of the membrane by direction, instead of membrane_stiffness",
           table_of<DirectedMembrane>(membrane),
           [](const Scene& s) -> const void* { return &s.material.strain.membrane; },
           [](const Scene& s) { return !s.material.strain.membrane.is_given(); }},
      Part{"/bending", "The bending model and the stiffness of its constraints", table_of<Bending>(bending),
           [](const Scene& s) -> const void* { return &s.bending; }},
      Part{"/bending/rigidity",
           "Rigidities of narrow strips by direction. They replace flexural_rigidity, the rigidity of a wide "
           "sheet. Along the warp and the weft, strip and sheet agree if /material/poisson_ratio is 0. Warp "
           "and weft follow /material/coordinates",
           table_of<DirectedRigidity>(rigidity),
           [](const Scene& s) -> const void* { return &s.bending.rigidity; },
           [](const Scene& s) { return !s.bending.rigidity.is_given(); }},
      Part{"/bending/softening", "A moment that grows less than in proportion to the curvature",
           table_of<Softening>(softening),
           [](const Scene& s) -> const void* { return &s.bending.softening; },
           [](const Scene& s) { return !s.bending.softening.is_given(); }},
      Part{"/bending/hysteresis",
           "Internal friction of the cloth: unbending takes less moment than bending, and a bent sheet keeps "
           "a part of its curvature, at most HB over flexural_rigidity",
           table_of<BendingFriction>(hysteresis),
           [](const Scene& s) -> const void* { return &s.bending.hysteresis; },
           [](const Scene& s) { return !s.bending.hysteresis.is_given(); }},
      Part{"/bending/plasticity", "Folds that stay", table_of<BendingPlasticity>(plasticity),
           [](const Scene& s) -> const void* { return &s.bending.plasticity; },
           [](const Scene& s) { return !s.bending.plasticity.is_given(); }},
      Part{"/bending/map", "Factors on the flexural rigidity by place, if stiffness is physical", map_table(),
           [](const Scene& s) -> const void* { return &s.bending.map; },
           [](const Scene& s) { return !s.bending.map.is_given(); }},
      Part{"/bending/over_time", "A factor on the bending stiffness over time, also on its friction",
           keyframe_table(), [](const Scene& s) -> const void* { return &s.bending.over_time; },
           [](const Scene& s) { return !s.bending.over_time.is_given(); }},
      Part{"/bending/hysteresis_map", "Factors on /bending/hysteresis/hb by place", map_table(),
           [](const Scene& s) -> const void* { return &s.bending.hysteresis_map; },
           [](const Scene& s) { return !s.bending.hysteresis_map.is_given(); }},
      Part{"/bending/plasticity_map", "Factors on /bending/plasticity/yield_at by place", map_table(),
           [](const Scene& s) -> const void* { return &s.bending.plasticity_map; },
           [](const Scene& s) { return !s.bending.plasticity_map.is_given(); }},
      Part{"/solver", "Time stepping and projection", table_of<Solver>(solver),
           [](const Scene& s) -> const void* { return &s.solver; }},
      Part{"/initial", "The pose at time 0", table_of<Initial>(initial),
           [](const Scene& s) -> const void* { return &s.initial; }},
      Part{"/initial/surface",
           "The surface on which all vertices, also pinned vertices, lie at time 0. The rest shape stays "
           "that of /mesh",
           surface_table(), [](const Scene& s) -> const void* { return &s.initial.surface; },
           [](const Scene& s) { return !s.initial.surface.is_given(); }},
  };
  return parts;
}

const FieldTable& scene_table() {
  static const FieldTable table = table_of<Scene>(top);
  return table;
}

std::span<const Section> scene_sections() {
  return made_of_kinds<make_sections>();
}

const SettingRow& effect_type_row() {
  return made_of_kinds<type_row>();
}

std::vector<std::string_view> choices_that_read(const Field& field) {
  const std::size_t slash = field.depends_on.rfind('/');
  const Part& part = *std::ranges::find(scene_parts(), field.depends_on.substr(0, slash), &Part::pointer);
  const Field& decisive = *part.table.find(field.depends_on.substr(slash + 1));
  Scene scene;
  std::vector<std::string_view> choices;
  for (const std::string_view choice : decisive.choices) {
    decisive.put(const_cast<void*>(part.in(scene)), std::string(choice));
    if (field.is_read(&scene)) choices.push_back(choice);
  }
  return choices;
}

std::vector<SettingRow> rows_of(const FieldTable& table) {
  std::vector<SettingRow> rows;
  for (const Field& field : table.fields)
    rows.push_back({field, field.required ? Value() : table.default_of(field)});
  return rows;
}

}  // namespace bendlab
