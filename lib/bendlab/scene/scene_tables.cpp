#include "bendlab/scene/scene_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bendlab/mesh/flaws.hpp"

namespace bendlab {
namespace {

constexpr std::array<std::string_view, 4> stiffness_names = {"k", "k_per_step", "compliance", "physical"};
constexpr std::array<std::string_view, 3> chosen_precision_names = {"auto", "single", "double"};

constexpr double seed_limit = 4294967295;  // 2³² - 1: fits every generator

// ---- When a setting is read. Canonical settings also keep numbers that belong to other choices (kept_when),
// so that runs which differ in a choice differ in nothing else.

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
constexpr auto bends_by_number = bends_by<Stiffness::k, Stiffness::k_per_step, Stiffness::compliance>;
constexpr auto may_bend_by_k = read_when<Scene>(
    [](const Scene& s) { return bends_by_number(&s) && s.solver.method.kind().needs_compliance.empty(); });
// The rigidity of hinges, and of springs that push, does not depend on the curvature.
constexpr auto needs_curvature = read_when<Scene>([](const Scene& s) {
  const BendingKind& model = s.bending.model.kind();
  return s.bending.stiffness == Stiffness::physical && model.springs_only && !model.prestressed;
});
constexpr auto is_of_hinges = read_when<Scene>([](const Scene& s) {
  return s.bending.stiffness == Stiffness::physical && !s.bending.model.kind().springs_only;
});
constexpr auto starts_at_random =
    read_when<Scene>([](const Scene& s) { return s.initial.perturbation > 0 || s.initial.random > 0; });
constexpr auto counts_substeps =
    read_when<Scene>([](const Scene& s) { return s.solver.method.kind().default_substeps > 0; });
constexpr auto counts_iterations =
    read_when<Scene>([](const Scene& s) { return s.solver.method.kind().default_iterations > 0; });
constexpr auto has_precisions =
    read_when<Scene>([](const Scene& s) { return s.solver.method.kind().make_float != nullptr; });

constexpr std::string_view stiffness_meaning =
    "How stiffness is given. k: the share of a constraint's error that one projection removes; k_per_step: "
    "the share that the n projections of a substep remove together, each k' = 1 - (1 - k)^(1/n); compliance: "
    "inverse stiffness, as in XPBD; physical: the membrane_stiffness below. Absent: k if warp, weft, shear "
    "or area is given, compliance if compliance is given, else as /defaults says";

constexpr std::string_view bending_stiffness_meaning =
    "How stiffness is given: k, k_per_step or compliance, as for strain; physical: the sheet has the "
    "flexural_rigidity or quartic_coefficient below, for which each constraint gets its own compliance from "
    "the mesh. Absent: k if k is given, compliance if compliance is given, else physical";

// Formatted by hand, so that they can be read as tables.
// clang-format off
// Not constexpr, because mesh_flaws() gives the flaws' names.
const std::array mesh = {
    field<&Mesh::generator>({.name = "generator",
              .meaning = "grid: squares split into triangles; equilateral: lattice of equilateral "
                         "triangles; delaunay: irregular, from random points; disc: as many concentric "
                         "rings as cells; tube: the side of a cylinder or cone around z, with as many "
                         "columns as cells; sphere: an octahedron whose edges are split into cells, inflated",
              .choices = generator_names, .read_when = generated}),
    field<&Mesh::file>({.name = "file",
              .meaning = "Mesh file (.obj, .ply, .off, .stl) instead of a generator, relative to the "
                         "config's folder", .names_file = true}),
    field<&Mesh::width>({.name = "width", .unit = "m",
              .meaning = "Extent along x",
              .minimum = 0, .above = true,
              .read_when = generated_by<Generator::grid, Generator::equilateral, Generator::delaunay>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::height>({.name = "height", .unit = "m",
              .meaning = "Extent along y; tube: along z",
              .minimum = 0, .above = true,
              .read_when = generated_by<Generator::grid, Generator::equilateral, Generator::delaunay,
                                        Generator::tube>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::cells>({.name = "cells", .unit = "1",
              .meaning = "Resolution: cells along the width",
              .minimum = 1, .maximum = 4096, .read_when = generated}),
    field<&Mesh::diagonal>({.name = "diagonal",
              .meaning = "grid: which diagonal splits a square: the same in all, alternating, or both",
              .choices = diagonal_names, .read_when = generated_by<Generator::grid>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::rows>({.name = "rows",
              .meaning = "equilateral: direction of the rows of edges, relative to the long side. Absent: "
                         "along the sides that /pins/vertices names, else parallel",
              .choices = rows_names, .read_when = generated_by<Generator::equilateral>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::radius>({.name = "radius", .unit = "m",
              .meaning = "disc, sphere: radius; tube: radius of its lower end",
              .minimum = 0, .above = true,
              .read_when = generated_by<Generator::disc, Generator::tube, Generator::sphere>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::radius_top>({.name = "radius_top", .unit = "m",
              .meaning = "tube: radius of its upper end; absent: as the lower end",
              .minimum = 0, .above = true, .read_when = generated_by<Generator::tube>,
              .kept_when = generated, .depends_on = on_generator}),
    field<&Mesh::seed>({.name = "seed", .unit = "1",
              .meaning = "delaunay: seed of the random points; with jitter: seed of the moves",
              .minimum = 0, .maximum = seed_limit, .read_when = makes_at_random, .kept_when = may_seed_mesh}),
    field<&Mesh::refine>({.name = "refine", .unit = "1",
              .meaning = "How many times each triangle is cut into four at the middles of its edges, also in "
                         "a mesh from a file. Vertices keep their indices, the border keeps its shape, and "
                         "curved meshes keep their facets; texture coordinates are interpolated. Absent: not "
                         "refined",
              .minimum = 0, .maximum = 12}),
    field<&Mesh::jitter>({.name = "jitter", .unit = "1",
              .meaning = "Each vertex that is not on the border is moved at random within the sheet, by at "
                         "most this share of the smallest height of its triangles, also in a mesh from a "
                         "file. jitter comes after refine; seed chooses the moves. Absent: no moves",
              .minimum = 0, .maximum = 0.4}),
    field<&Mesh::scale>({.name = "scale", .unit = "1",
              .meaning = "Factor on all coordinates, also those of a mesh from a file",
              .minimum = 0, .above = true}),
    field<&Mesh::offset>({.name = "offset", .unit = "m",
              .meaning = "Added to all coordinates after scale, also to those of a mesh from a file"}),
    field<&Mesh::shuffle>({.name = "shuffle", .unit = "1",
              .meaning = "Seed of a random numbering of vertices and triangles; absent: the generator's "
                         "numbering",
              .minimum = 0, .maximum = seed_limit, .read_when = generated}),
    field<&Mesh::flaw>({.name = "flaw",
              .meaning = "A defect put into the mesh on purpose. needles, caps, degenerate (no area), "
                         "duplicate_vertices, duplicate_faces, non_manifold_edge (a third triangle at an "
                         "edge), bow_tie (triangles that share only a point): at about every twentieth "
                         "place; isolated_vertices: vertices in no triangle; pieces: cut in two; "
                         "mixed_orientation: every second triangle turned over; hole: a hole in the middle",
              .choices = mesh_flaws(), .read_when = generated}),
    field<&Mesh::bad_triangles>({.name = "bad_triangles",
              .meaning = "What to do with a mesh that has triangles without area, triangles listed twice, or "
                         "edges of three triangles. refuse: the run fails and names the first bad triangles; "
                         "regularise: simulate the mesh as it is, with a small rest height for triangles "
                         "without area; membrane_off: the same, but those triangles have no strain "
                         "constraint; repair: unite points within 2e-6 of the mesh size, remove triangles "
                         "without area, cut the sheet where it branches, orient all triangles alike. "
                         "'bendlab mesh FILE' says what each choice does to a file",
              .choices = bad_triangles_names}),
};

constexpr std::array pins = {
      field<&Pinning::vertices>({.name = "vertices",
                .meaning = "Pinned places by name: corners, sides and centre of the rest mesh's box in the "
                           "x-y plane; in a sheet that stands, z is up; top_rim and bottom_rim: the ends of "
                           "a tube; circle: the ring of vertices at a quarter of the smaller side from the "
                           "centre; interior: four vertices at 0.3 and 0.7 of both sides",
                .choices = place_names}),
      field<&Pinning::indices>({.name = "indices", .unit = "1",
                .meaning = "Pinned vertices by index (whole numbers, the first vertex is 0), in addition to "
                           "the vertices named in vertices",
                .minimum = 0}),
      field<&Pinning::ring>({.name = "ring", .unit = "1",
                .meaning = "How many rings of neighbours around each pinned vertex are pinned, too; 0: none. "
                           "The paper pins one ring, a clamp that shrinks as the mesh is refined",
                .minimum = 0, .maximum = 64}),
      field<&Pinning::distance>({.name = "distance", .unit = "m",
                .meaning = "Vertices within this distance of a pinned place are pinned too: a clamp of the "
                           "same width at every resolution",
                .minimum = 0}),
};

constexpr std::array material = {
    field<&Material::density>({.name = "density", .unit = "kg/m²",
              .meaning = "Mass per area",
              .minimum = 0, .above = true}),
    field<&Material::density_ratio>({.name = "density_ratio", .unit = "1",
              .meaning = "Factor on density in the half of the rest box with the larger x",
              .minimum = 0, .above = true}),
    field<&Material::coordinates>({.name = "coordinates",
              .meaning = "Where warp and weft run. warp: warp_direction, projected into each triangle's "
                         "plane; texture: along the mesh file's texture coordinates",
              .choices = material_coordinates_names}),
    field<&Material::warp_direction>({.name = "warp_direction", .unit = "1",
              .meaning = "Direction of the warp threads in the rest shape, of any length but zero; for a "
                         "tube, 0, 0, 1 is along its axis"}),
};

constexpr std::array strain = {
    field<&Strain::form>({.name = "form",
              .meaning = "normalised: stretch √S_ii - 1 and normalised shear, as published; green: the "
                         "entries of S themselves; angle (ours): stretch as in normalised, and as shear the "
                         "difference of the angle between warp and weft from a right angle. The gradient of "
                         "normalised shear vanishes as warp and weft become parallel, so that a projection "
                         "moves a strongly sheared triangle by many times its size; angle does not do that",
              .choices = strain_form_names, .read_when = has_triangles}),
    field<&Strain::stiffness>({.name = "stiffness",
              .meaning = stiffness_meaning, .choices = stiffness_names}),
    field<&Strain::membrane_stiffness>({.name = "membrane_stiffness", .unit = "N/m",
              .meaning = "physical: Young's modulus times thickness, the force per width that stretches warp "
                         "or weft, or shears, by 1. At 10000 N/m a sheet of 1 m and 0.2 kg/m² strains by "
                         "10⁻⁴ under its weight",
              .minimum = 0, .above = true, .read_when = strains_by<Stiffness::physical>,
              .depends_on = on_strain_stiffness}),
    field<&Strain::warp>({.name = "warp", .unit = "1",
              .meaning = "k of stretch along the warp",
              .minimum = 0, .maximum = 1, .read_when = has_triangles}),
    field<&Strain::weft>({.name = "weft", .unit = "1",
              .meaning = "k of stretch across the warp",
              .minimum = 0, .maximum = 1, .read_when = has_triangles}),
    field<&Strain::shear>({.name = "shear", .unit = "1",
              .meaning = "k of shear",
              .minimum = 0, .maximum = 1, .read_when = has_triangles}),
    field<&Strain::area>({.name = "area", .unit = "1",
              .meaning = "k of a triangle's area; 0: no area constraint",
              .minimum = 0, .maximum = 1, .read_when = has_triangles}),
    field<&Strain::compliance>({.name = "compliance", .unit = "m/N",
              .meaning = "Compliance of every strain constraint, used if stiffness is compliance; 0 is rigid",
              .minimum = 0, .read_when = strains_by<Stiffness::compliance>, .kept_when = always,
              .depends_on = on_strain_stiffness}),
};

constexpr std::array bending = {
      field<&Bending::stiffness>({.name = "stiffness",
                .meaning = bending_stiffness_meaning, .choices = stiffness_names}),
      field<&Bending::k>({.name = "k", .unit = "1",
                .meaning = "Stiffness of every bending constraint, used if stiffness is k or k_per_step",
                .minimum = 0, .maximum = 1, .read_when = bends_by<Stiffness::k, Stiffness::k_per_step>,
                .kept_when = may_bend_by_k, .depends_on = on_bending_stiffness}),
      field<&Bending::compliance>({.name = "compliance", .unit = "m/N or 1/(N m)",
                .meaning = "Inverse stiffness, used if stiffness is compliance; 0 is rigid. `bendlab models` "
                           "says what it means for each model",
                .minimum = 0, .read_when = bends_by<Stiffness::compliance>, .kept_when = bends_by_number,
                .depends_on = on_bending_stiffness}),
      field<&Bending::flexural_rigidity>({.name = "flexural_rigidity", .unit = "N m",
                .meaning = "physical: B of the moment B κ per width at curvature κ; springs have this B only "
                           "at the curvature at_curvature. Not used if only quartic_coefficient is given",
                .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
                .depends_on = on_bending_stiffness}),
      field<&Bending::quartic_coefficient>({.name = "quartic_coefficient", .unit = "N m³",
                .meaning = "physical: C of the moment C κ³ per width at curvature κ, for models made of "
                           "springs",
                .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
                .depends_on = on_bending_stiffness}),
      field<&Bending::at_curvature>({.name = "at_curvature", .unit = "1/m",
                .meaning = "physical: the curvature κ0 at which springs have the moment that "
                           "flexural_rigidity states, C = B/κ0²; 20 is a fold of 5 cm radius",
                .minimum = 0, .above = true, .read_when = bends_by<Stiffness::physical>,
                .kept_when = needs_curvature, .depends_on = on_bending_stiffness}),
      field<&Bending::deflection>({.name = "deflection",
                .meaning = "physical, models made of hinges: for which deflections flexural_rigidity holds. "
                           "large: the membrane forces the sheet to a cylinder, as in drapes and folds; "
                           "small: the sheet is bent so little that its membrane does not matter; both: "
                           "between the two, with hinge weights that make them differ as little as the mesh "
                           "allows. The summary says which share of flexural_rigidity the sheet has at small "
                           "and at large deflections",
                .choices = deflection_names, .read_when = is_of_hinges}),
};

constexpr std::array solver = {
    field<&Solver::dt>({.name = "dt", .unit = "s",
              .meaning = "Time step",
              .minimum = 1e-9, .maximum = 1e6}),
    field<&Solver::substeps>({.name = "substeps", .unit = "1",
              .meaning = "How many equal parts a time step is divided into. Absent: the method's own "
                         "number, see `bendlab methods`",
              .minimum = 1, .maximum = 100000, .read_when = counts_substeps}),
    field<&Solver::iterations>({.name = "iterations", .unit = "1",
              .meaning = "How many times each substep visits all constraints. Absent: the method's own "
                         "number, see `bendlab methods`",
              .minimum = 1, .maximum = 100000, .read_when = counts_iterations}),
    field<&Solver::precision>({.name = "precision",
              .meaning = "Precision of the solver's numbers. auto: single, but double in two cases. First, "
                         "an effect moves vertices itself (an obstacle, tethers, …), and the speed g h that "
                         "gravity adds in a substep h is too small for single precision, compared with the "
                         "rounding of a position divided by h. Second, quasi_newton has a membrane whose "
                         "strain under its weight is hidden by the rounding of positions. The run's "
                         "provenance says which precision was used",
              .choices = chosen_precision_names, .read_when = has_precisions}),
    field<&Solver::threads>({.name = "threads", .unit = "1",
              .meaning = "Threads of one run; the number of threads does not change a bit of the result",
              .minimum = 1, .maximum = 256}),
};

constexpr std::array initial = {
    field<&Initial::folds>({.name = "folds", .unit = "1",
              .meaning = "How many times the sheet starts folded, to and fro along x, into layers one above "
                         "the other; its rest shape does not change",
              .minimum = 0, .maximum = 64}),
    field<&Initial::fold_gap>({.name = "fold_gap", .unit = "m",
              .meaning = "Distance between the layers of the folded sheet",
              .minimum = 0, .above = true}),
    field<&Initial::creases>({.name = "creases", .unit = "1",
              .meaning = "How many sharp folds of 180 degrees the sheet starts with, which lay equal columns "
                         "along x flat on top of each other",
              .minimum = 0, .maximum = 4096}),
    field<&Initial::scale>({.name = "scale", .unit = "1",
              .meaning = "Factors along x, y and z on the start positions of the free vertices, relative to "
                         "the mean of the pins (without pins: to the centre): 0, 0, 0 is a point, 1, 0, 0 a "
                         "line, -1, 1, 1 a mirror image"}),
    field<&Initial::tilt>({.name = "tilt", .unit = "degrees",
              .meaning = "Rotation of the sheet at the start about the x axis through its centre; 0 is "
                         "horizontal (gravity is along -z), 90 upright",
              .minimum = -180, .maximum = 180}),
    field<&Initial::perturbation>({.name = "perturbation", .unit = "1",
              .meaning = "Largest random displacement of a free vertex along each axis at the start, "
                         "relative to the mesh's size",
              .minimum = 0, .maximum = 1}),
    field<&Initial::random>({.name = "random", .unit = "1",
              .meaning = "Above 0: every free vertex starts at a random place in a box around the centre, "
                         "which is this many times the mesh's size wide",
              .minimum = 0}),
    field<&Initial::velocity>({.name = "velocity", .unit = "m/s",
              .meaning = "Velocity of all free vertices at the start"}),
    field<&Initial::spin>({.name = "spin", .unit = "rad/s",
              .meaning = "Angular velocity at the start, about the centre of the rest box"}),
    field<&Initial::seed>({.name = "seed", .unit = "1",
              .meaning = "Seed of perturbation and random",
              .minimum = 0, .maximum = seed_limit, .read_when = starts_at_random, .kept_when = always}),
    field<&Initial::after>({.name = "after",
              .meaning = "Changes, each \"/json/pointer=value\", that turn this run into an earlier run; the "
                         "cloth starts at rest where the earlier run ends. The earlier run may have a "
                         "coarser mesh of the same flat sheet, for example, or another method. It is not "
                         "recorded"}),
};

constexpr std::array top = {
    field<&Scene::duration>({.name = "duration", .unit = "s",
              .meaning = "Simulated time of each run, at least one step. It is rounded up to whole steps of "
                         "/solver/dt",
              .minimum = 0, .above = true}),
};
// clang-format on

template <class Kind>
std::vector<std::string_view> names_of(std::span<const Kind* const> kinds) {
  std::vector<std::string_view> names;
  for (const Kind* kind : kinds) names.push_back(kind->name);
  return names;
}

// The row of a setting that chooses a member of a family.
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
         " A setting that a method does not read changes nothing, and a warning says so: see "
         "`bendlab methods`";
}

SettingRow method_row() {
  return choice_row("method", made_of_kinds<meaning_of_method>(), made_of_kinds<method_names>(),
                    Solver{}.method.name());
}

SettingRow model_row() {
  return choice_row("model", "Bending model; its own settings are in the section of its name",
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

// The section of a model's own settings stands in /bending beside the settings that all models share, so its
// name must differ from theirs.
void check_names_of_added_models() {
  for (const BendingKind* model : added_bending_models())
    if (std::ranges::find(bending, model->name, &Field::name) != bending.end() || model->name == "model")
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
      Part{"/pins", "Which vertices are held fixed", table_of<Pinning>(pins),
           [](const Scene& s) -> const void* { return &s.pins; }},
      Part{"/material", "The cloth's mass and material directions", table_of<Material>(material),
           [](const Scene& s) -> const void* { return &s.material; }},
      Part{"/material/strain", "Strain constraints of the triangles", table_of<Strain>(strain),
           [](const Scene& s) -> const void* { return &s.material.strain; }},
      Part{"/bending", "The bending model and the stiffness of its constraints", table_of<Bending>(bending),
           [](const Scene& s) -> const void* { return &s.bending; }},
      Part{"/solver", "Time stepping and projection", table_of<Solver>(solver),
           [](const Scene& s) -> const void* { return &s.solver; }},
      Part{"/initial", "The pose at time 0", table_of<Initial>(initial),
           [](const Scene& s) -> const void* { return &s.initial; }},
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
