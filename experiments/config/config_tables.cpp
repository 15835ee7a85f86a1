#include "experiments/config/config_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/flaws.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/parameters/names.hpp"
#include "bendlab/solver/method.hpp"
#include "bendlab/solver/precision.hpp"
#include "experiments/config/config.hpp"

namespace bendlab {
namespace {

using enum ParameterType;
using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 4> bending_stiffness_kinds = {
    stiffness_kind_names[0], stiffness_kind_names[1], stiffness_kind_names[2], "physical"};
constexpr std::array<std::string_view, 3> precisions = {"auto", precision_names[0], precision_names[1]};
constexpr std::array measures_on_request = {
#define BENDLAB_MEASURE(name)
#define BENDLAB_MEASURE_ON_REQUEST(name) std::string_view(#name),
#include "experiments/measures/measures.def"
#undef BENDLAB_MEASURE
#undef BENDLAB_MEASURE_ON_REQUEST
};

constexpr std::array<std::string_view, 1> allowed = {name_in(run_status_names, RunStatus::implausible)};

constexpr std::span<const std::string_view> nothing;
constexpr std::array<std::string_view, 1> default_pins = {"upper_right"};
constexpr std::array<double, 3> default_warp = {1, 0, 0}, zero_vector = {0, 0, 0}, ones = {1, 1, 1};
constexpr std::span<const double> no_indices;

constexpr double largest_seed = 4294967295;  // 2³² - 1: fits every generator

constexpr std::string_view stiffness_meaning =
    "How stiff: k is the share of the error a projection removes; k_per_step uses k' = 1 - (1 - k)^(1/n) for "
    "n projections per substep, so that an isolated constraint loses the share k in all; compliance is "
    "XPBD's";

constexpr std::string_view bending_stiffness_meaning =
    "How stiff: k, k_per_step and compliance as for strain; physical is XPBD's with a compliance of each "
    "constraint's own, found from the mesh so that the sheet has the flexural_rigidity or "
    "quartic_coefficient below";

// One setting, few lines: these are to be read as tables.
// clang-format off
constexpr std::array top_level = {
    Parameter{.name = "name", .type = text, .unit = "", .default_value = {},
              .meaning = "Name of the experiment and of its results folder: letters, digits, '_' and '-'",
              .required = true},
    Parameter{.name = "description", .type = text, .unit = "", .default_value = "",
              .meaning = "What the experiment is for; does not change it"},
    Parameter{.name = "allow", .type = texts, .unit = "", .default_value = Names(nothing),
              .meaning = "What runs may come to without failing the command: implausible, for a sweep that studies what fails. "
                         "The runs' status is told all the same; does not change them",
              .choices = allowed},
    Parameter{.name = "duration", .type = number, .unit = "s", .default_value = 4.0,
              .meaning = "Simulated time of each run",
              .minimum = 0, .above = true},
    Parameter{.name = "settled_speed", .type = number, .unit = "m/s", .default_value = 0.0,
              .meaning = "The run ends early once no vertex has been faster for half a simulated second; its summary "
                         "then has settled_at. Looked at 60 times a simulated second; 0: it never ends early",
              .minimum = 0},
};

// Not constexpr: the flaws' names come from the mesh room.
const std::array mesh = {
    Parameter{.name = "generator", .type = text, .unit = "", .default_value = "grid",
              .meaning = "grid: squares split into triangles; equilateral: lattice of equilateral "
                         "triangles; delaunay: irregular, seeded; disc: concentric rings, as many as cells; "
                         "tube: the side of a cylinder or cone around z, with cells around it; sphere: closed, an octahedron "
                         "whose edges are split into cells, blown up",
              .choices = generator_names},
    Parameter{.name = "file", .type = text, .unit = "", .default_value = {},
              .meaning = "Mesh file (.obj, .ply, .off, .stl) instead of a generator, relative to the "
                         "config's folder"},
    Parameter{.name = "width", .type = number, .unit = "m", .default_value = 1.0,
              .meaning = "Extent along x",
              .minimum = 0, .above = true},
    Parameter{.name = "height", .type = number, .unit = "m", .default_value = 1.0,
              .meaning = "Extent along y; tube: along z",
              .minimum = 0, .above = true},
    Parameter{.name = "cells", .type = integer, .unit = "1", .default_value = 32,
              .meaning = "Resolution: cells along the width",
              .minimum = 1, .maximum = 4096},
    Parameter{.name = "diagonal", .type = text, .unit = "", .default_value = "same",
              .meaning = "grid: which diagonal splits a square: the same everywhere, alternating, or both",
              .choices = diagonal_names},
    Parameter{.name = "rows", .type = text, .unit = "", .default_value = "parallel",
              .meaning = "equilateral: direction of the rows of edges against the long side",
              .choices = rows_names},
    Parameter{.name = "radius", .type = number, .unit = "m", .default_value = 0.5,
              .meaning = "disc, sphere: its radius; tube: that of its lower end",
              .minimum = 0, .above = true},
    Parameter{.name = "radius_top", .type = number, .unit = "m", .default_value = {},
              .meaning = "tube: radius of its upper end; absent: that of the lower end",
              .minimum = 0, .above = true},
    Parameter{.name = "seed", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "delaunay: seed of the random points",
              .minimum = 0, .maximum = largest_seed},
    Parameter{.name = "scale", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "Factor on all coordinates, of a file's mesh too",
              .minimum = 0, .above = true},
    Parameter{.name = "offset", .type = numbers, .unit = "m", .default_value = std::span<const double>(zero_vector),
              .meaning = "Added to all coordinates after that, of a file's mesh too",
              .length = 3},
    Parameter{.name = "shuffle", .type = integer, .unit = "1", .default_value = {},
              .meaning = "Seed by which vertices and triangles are numbered at random; absent: as the generator numbers them",
              .minimum = 0, .maximum = largest_seed},
    Parameter{.name = "flaw", .type = text, .unit = "", .default_value = "none",
              .meaning = "What is wrong with the mesh, on purpose: about every twentieth place is a needle, a cap, "
                         "without area, there twice, has a fin or touches in a point alone; or the mesh has vertices "
                         "in no triangle, is cut in two, has triangles that run the other way round, or a hole",
              .choices = mesh_flaws()},
    Parameter{.name = "bad_triangles", .type = text, .unit = "", .default_value = "refuse",
              .meaning = "What becomes of a mesh with triangles that have no area, are there twice or branch. refuse: "
                         "the run ends with the first offenders; regularise: simulated as it is, a triangle without "
                         "area with a small rest height; membrane_off: the same, but such a triangle has no strain "
                         "constraint; repair: equal points united, triangles without area removed, branches cut, all "
                         "oriented alike. 'bendlab mesh' says what each does to a file",
              .choices = bad_triangles_names},
};

// Not constexpr: the names come from the mesh room.
const std::array<Parameter, 4>& pins() {
  static const std::array<Parameter, 4> table = {
      Parameter{.name = "vertices", .type = texts, .unit = "", .default_value = Names(default_pins),
                .meaning = "Pinned places by name, on the box of the rest mesh: corners, sides and centre of its x-y "
                           "face; top_rim and bottom_rim are the ends of a tube; circle is the ring of vertices a quarter of "
                           "the smaller side from the centre, interior four vertices at 0.3 and 0.7 of both sides",
                .choices = vertex_selectors()},
      Parameter{.name = "indices", .type = numbers, .unit = "1", .default_value = no_indices,
                .meaning = "Pinned vertices by index (whole numbers, the first vertex is 0), besides the "
                           "named ones",
                .minimum = 0},
      Parameter{.name = "ring", .type = integer, .unit = "1", .default_value = 1,
                .meaning = "Rings around each pinned vertex that are pinned too (the paper: 1; 0: the "
                           "vertex alone)",
                .minimum = 0, .maximum = 64},
      Parameter{.name = "distance", .type = number, .unit = "m", .default_value = 0.0,
                .meaning = "What lies within this distance of a pinned place is pinned too: a clamp that is as wide at "
                           "every resolution",
                .minimum = 0},
  };
  return table;
}

constexpr std::array material = {
    Parameter{.name = "density", .type = number, .unit = "kg/m²", .default_value = 0.2,
              .meaning = "Mass per area",
              .minimum = 0, .above = true},
    Parameter{.name = "density_ratio", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "How many times as heavy the cloth is beyond the middle of its rest box along x",
              .minimum = 0, .above = true},
    Parameter{.name = "coordinates", .type = text, .unit = "", .default_value = "warp",
              .meaning = "Material coordinates: warp_direction projected into each triangle's plane, or the "
                         "mesh file's texture coordinates",
              .choices = material_coordinates_names},
    Parameter{.name = "warp_direction", .type = numbers, .unit = "1",
              .default_value = std::span<const double>(default_warp),
              .meaning = "Direction of the warp threads in the rest shape, of any length but zero; 0, 0, 1 runs "
                         "along a tube",
              .length = 3},
};

constexpr std::array strain = {
    Parameter{.name = "form", .type = text, .unit = "", .default_value = "normalised",
              .meaning = "normalised: stretch √S_ii - 1 and normalised shear, as published; green: the entries of S "
                         "themselves; angle (ours): stretch as normalised, and of shear the angle that warp and weft "
                         "lack to a right one. The gradient of normalised shear vanishes as they become parallel, so that "
                         "a projection throws a strongly sheared triangle many times its size; the angle's does not",
              .choices = strain_form_names},
    Parameter{.name = "stiffness", .type = text, .unit = "", .default_value = "k",
              .meaning = stiffness_meaning, .choices = stiffness_kind_names},
    Parameter{.name = "warp", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "k of the stretch along the warp",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "weft", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "k of the stretch across the warp",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "shear", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "k of the shear",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "area", .type = number, .unit = "1", .default_value = 0.0,
              .meaning = "k of the triangle's area; 0: no such constraint",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "compliance", .type = number, .unit = "m/N", .default_value = 0.0,
              .meaning = "Compliance of every strain constraint where stiffness is compliance; 0 is rigid",
              .minimum = 0},
};

const std::array<Parameter, 8>& bending() {
  static const std::vector<std::string_view> models = [] {
    std::vector<std::string_view> names;
    for (const BendingModel* model : bending_models()) names.push_back(model->name);
    return names;
  }();
  static const std::array<Parameter, 8> table = {
      Parameter{.name = "model", .type = text, .unit = "", .default_value = "adaptive",
                .meaning = "Bending model; its own settings are in the object of its name",
                .choices = models},
      Parameter{.name = "stiffness", .type = text, .unit = "", .default_value = "k",
                .meaning = bending_stiffness_meaning, .choices = bending_stiffness_kinds},
      Parameter{.name = "k", .type = number, .unit = "1", .default_value = 0.5,
                .meaning = "Stiffness of every bending constraint",
                .minimum = 0, .maximum = 1},
      Parameter{.name = "compliance", .type = number, .unit = "m/N or 1/(N m)", .default_value = 0.0,
                .meaning = "Inverse stiffness where stiffness is compliance; 0 is rigid. Of what, `bendlab models` "
                           "says for each model",
                .minimum = 0},
      Parameter{.name = "flexural_rigidity", .type = number, .unit = "N m", .default_value = {},
                .meaning = "physical: B of the moment B κ per width, for models on hinges and arcs; for springs "
                           "together with at_curvature",
                .minimum = 0, .above = true},
      Parameter{.name = "quartic_coefficient", .type = number, .unit = "N m³", .default_value = {},
                .meaning = "physical: C of the moment C κ³ per width, for models made of springs",
                .minimum = 0, .above = true},
      Parameter{.name = "at_curvature", .type = number, .unit = "1/m", .default_value = {},
                .meaning = "physical: curvature κ0 at which springs have the moment of flexural_rigidity, C = B/κ0²",
                .minimum = 0, .above = true},
      Parameter{.name = "deflection", .type = text, .unit = "", .default_value = "large",
                .meaning = "physical, hinges: where flexural_rigidity holds. large: where the membrane holds the "
                           "sheet to a cylinder, as in drapes and folds; small: where it is bent so little that "
                           "its membrane does not matter; both: between the two, with hinges weighted so that "
                           "they differ as little as the mesh allows. What the mesh then has of it at the other "
                           "is told beside the results",
                .choices = deflection_names},
  };
  return table;
}

// What methods share; each reads some of it, see Method::shared.
constexpr std::array shared_by_methods = {
    Parameter{.name = "dt", .type = number, .unit = "s", .default_value = 1.0 / 60,
              .meaning = "Time step",
              .minimum = 0, .above = true},
    Parameter{.name = "substeps", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "Equal parts of a time step",
              .minimum = 1, .maximum = 100000},
    Parameter{.name = "iterations", .type = integer, .unit = "1", .default_value = 10,
              .meaning = "Rounds over all constraints per substep",
              .minimum = 1, .maximum = 100000},
    Parameter{.name = "sweep", .type = text, .unit = "", .default_value = "forward",
              .meaning = "Each iteration visits the constraints forward, or (symmetric) forward and then "
                         "backward, which is quiet at small time steps and projects twice as often",
              .choices = sweep_names},
    Parameter{.name = "order", .type = text, .unit = "", .default_value = "colour",
              .meaning = "colour: grouped so that no two of a group share a vertex; mesh: as the model "
                         "lists them, one after another; pins: so too, but nearest to a pinned vertex first",
              .choices = constraint_order_names},
    Parameter{.name = "first", .type = text, .unit = "", .default_value = "strain",
              .meaning = "Which kind is projected first within an iteration",
              .choices = first_constraint_names},
    Parameter{.name = "precision", .type = text, .unit = "", .default_value = "auto",
              .meaning = "Floating-point numbers of the solver. auto: single, but double where an effect moves vertices itself "
                         "(an obstacle, tethers, …) and what gravity does in a substep is too small for single precision "
                         "(g h against the rounding of a position over h); the run's provenance says which was taken",
              .choices = precisions},
    Parameter{.name = "threads", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "Threads of one run; the result has the same bits for any number",
              .minimum = 1, .maximum = 256},
};

const std::vector<Parameter>& solver() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Method* method : methods()) all.push_back(method->name);
    return all;
  }();
  static const std::string meaning = [] {
    std::string text = "How a step moves the cloth.";
    for (const Method* method : methods()) text += fmt::format(" {}: {}.", method->name, method->summary);
    return text + " What a method does not read is no part of the run: see `bendlab methods`";
  }();
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> rows = {
        Parameter{.name = "method", .type = text, .unit = "", .default_value = default_method().name.data(),
                  .meaning = meaning, .choices = names}};
    rows.insert(rows.end(), shared_by_methods.begin(), shared_by_methods.end());
    for (const Method* method : methods())
      for (const Parameter& row : method->parameters)
        if (std::ranges::find(rows, row.name, &Parameter::name) == rows.end()) rows.push_back(row);
    return rows;
  }();
  return table;
}

constexpr std::array initial = {
    Parameter{.name = "folds", .type = integer, .unit = "1", .default_value = 0,
              .meaning = "How many times the rest sheet is folded, to and fro along x, into layers that lie one "
                         "above the other; its rest shape stays as it is",
              .minimum = 0, .maximum = 64},
    Parameter{.name = "fold_gap", .type = number, .unit = "m", .default_value = 0.01,
              .meaning = "Distance between the layers of the folded sheet",
              .minimum = 0, .above = true},
    Parameter{.name = "creases", .type = integer, .unit = "1", .default_value = 0,
              .meaning = "Into how many sharp folds the rest sheet is laid, each by 180 degrees, in equal columns along x "
                         "flat on top of each other",
              .minimum = 0, .maximum = 4096},
    Parameter{.name = "scale", .type = numbers, .unit = "1", .default_value = std::span<const double>(ones),
              .meaning = "Factors by which the free vertices start farther from the mean of the pins, or from the centre, "
                         "along x, y and z: 0, 0, 0 is a point, 1, 0, 0 a line, -1, 1, 1 a mirror image",
              .length = 3},
    Parameter{.name = "tilt", .type = number, .unit = "degrees", .default_value = 0.0,
              .meaning = "Rotation of the rest sheet about the x axis through its centre; 0 is horizontal, "
                         "gravity is along -z",
              .minimum = -180, .maximum = 180},
    Parameter{.name = "perturbation", .type = number, .unit = "1", .default_value = 0.0,
              .meaning = "Largest random displacement of a free vertex along each axis, relative to the "
                         "mesh's size",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "random", .type = number, .unit = "1", .default_value = 0.0,
              .meaning = "Above 0, every free vertex starts anywhere in a box around the centre, this many sizes of the mesh "
                         "wide",
              .minimum = 0},
    Parameter{.name = "velocity", .type = numbers, .unit = "m/s", .default_value = std::span<const double>(zero_vector),
              .meaning = "Of all free vertices at the start",
              .length = 3},
    Parameter{.name = "spin", .type = numbers, .unit = "rad/s", .default_value = std::span<const double>(zero_vector),
              .meaning = "Angular velocity at the start, about the centre of the rest box",
              .length = 3},
    Parameter{.name = "seed", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "Seed of the perturbation and of the random start",
              .minimum = 0, .maximum = largest_seed},
    Parameter{.name = "after", .type = texts, .unit = "", .default_value = {},
              .meaning = "The cloth starts at rest where the same run ends with these settings changed, each "
                         "\"/json/pointer=value\": on a coarser mesh of the flat sheet, for example, or settled by "
                         "another method. That run is not recorded"},
};

constexpr std::array output = {
    Parameter{.name = "frames_per_second", .type = number, .unit = "1/s", .default_value = 30.0,
              .meaning = "Recorded frames per simulated second",
              .minimum = 0, .above = true},
    Parameter{.name = "constraints", .type = boolean, .unit = "", .default_value = false,
              .meaning = "Whether the run file lists every constraint (else their counts and hash)"},
    Parameter{.name = "measures", .type = texts, .unit = "", .default_value = Names(),
              .meaning = "What the summary has besides what every run's has; `bendlab measures` says what each finds out, what "
                         "its numbers are called and what it costs",
              .choices = measures_on_request},
};

constexpr std::array accuracy = {
    Parameter{.name = "solver", .type = texts, .unit = "", .default_value = {},
              .meaning = "Settings, each \"/json/pointer=value\", that turn this run into the reference of its own "
                         "energies, its equilibrium for example; the summary then has error_solver_rms and others. The "
                         "reference is a run of its own below <results>/<experiment>/references, made once for all runs "
                         "that differ only in what is set here"},
    Parameter{.name = "solver_coarser", .type = texts, .unit = "", .default_value = {},
              .meaning = "Settings besides those of solver that give a second reference, half as fine: how far the two are "
                         "apart is error_solver_reference_gap"},
    Parameter{.name = "physical", .type = texts, .unit = "", .default_value = {},
              .meaning = "Settings that turn this run into the stated cloth, with another model or resolution too; the "
                         "summary then has error_physical_rms and others. Its pose is interpolated at this run's vertices"},
    Parameter{.name = "physical_coarser", .type = texts, .unit = "", .default_value = {},
              .meaning = "Settings besides those of physical that give a second reference, half as fine: how far the two "
                         "are apart is error_physical_reference_gap"},
    Parameter{.name = "start_from_end", .type = boolean, .unit = "", .default_value = false,
              .meaning = "Whether the reference starts where this run ends, so that both lie in the same basin: for scenes "
                         "with many equilibria. Each run then has a reference of its own"},
    Parameter{.name = "align", .type = text, .unit = "", .default_value = "none",
              .meaning = "How the reference's pose is brought over this run's before they are compared: not at all, by the "
                         "best turn about the vertical through the middle of the pins (the mesh's, without pins), or by the "
                         "best rigid motion",
              .choices = align_by_names},
    Parameter{.name = "over_time", .type = boolean, .unit = "", .default_value = false,
              .meaning = "Whether all recorded frames are compared that both have at the same time, instead of the last "
                         "one of each: the errors are means over these frames, with …_worst beside them, and the energy's"},
};

constexpr std::array quality = {
    Parameter{.name = "needle_ratio", .type = number, .unit = "1", .default_value = 4.0,
              .meaning = "A triangle with a larger ratio of longest to shortest edge is a needle",
              .minimum = 1},
    Parameter{.name = "cap_angle", .type = number, .unit = "degrees", .default_value = 160.0,
              .meaning = "A triangle with a larger angle is a cap",
              .minimum = 90, .maximum = 180},
    Parameter{.name = "small_angle", .type = number, .unit = "degrees", .default_value = 10.0,
              .meaning = "A triangle with a smaller angle is counted in the metric small_angles",
              .minimum = 0, .maximum = 60},
};

constexpr std::array cover = {
    Parameter{.name = "strength", .type = integer, .unit = "1", .default_value = {},
              .meaning = "Of how many axes every combination of values occurs: 2 for every pair of values",
              .minimum = 1, .maximum = 6, .required = true},
    Parameter{.name = "seed", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "Another seed gives other runs, with the same promise",
              .minimum = 0, .maximum = largest_seed},
};

constexpr std::array expectation = {
    Parameter{.name = "metric", .type = text, .unit = "", .default_value = {},
              .meaning = "Which number of the run's summary",
              .required = true},
    Parameter{.name = "min", .type = number, .unit = "", .default_value = {},
              .meaning = "Smallest value that is right, in the metric's unit; min or max or both must be "
                         "there"},
    Parameter{.name = "max", .type = number, .unit = "", .default_value = {},
              .meaning = "Largest value that is right, in the metric's unit"},
    Parameter{.name = "why", .type = text, .unit = "", .default_value = {},
              .meaning = "Where the bound comes from",
              .required = true},
};

// clang-format on

constexpr std::array lists = {
    ConfigList{"effects",
               "What acts on the cloth besides its constraints: a list of {\"type\": name, settings}, each "
               "type at most once. Absent: gravity alone; an empty list: nothing"},
    ConfigList{"sweep",
               "What to vary: {\"/json/pointer\": [values]}, \"all\" instead of the list for every choice of "
               "a setting. One run per combination, the last pointer "
               "fastest; a pointer may also name a whole object, or the whole list of effects"},
    ConfigList{"cover",
               "A part of a large sweep instead of all of it: with \"cover\": 3 every value of any three "
               "axes occurs "
               "together in at least one run, in as few runs as a greedy search finds, the same on every "
               "machine. What "
               "does not go together is left out; 'bendlab plan' says what that was. A number, or an object"},
    ConfigList{"expect", "Bounds that 'bendlab run' checks on every run, each with its reason"},
};

std::vector<ConfigSection> make_sections() {
  static std::deque<std::string> pointers;  // what the sections of the models refer to
  std::vector<ConfigSection> sections = {
      {"", "The experiment", top_level},
      {"/mesh", "The rest mesh: generated, or read from a file", mesh},
      {"/pins", "Which vertices are held", pins()},
      {"/material", "The cloth's mass and material directions", material},
      {"/material/strain", "Strain constraints of the triangles", strain},
      {"/bending", "The bending model and how stiff its constraints are", bending()},
  };
  for (const BendingModel* model : bending_models())
    if (!model->parameters.empty())
      sections.push_back(
          {pointers.emplace_back(fmt::format("/bending/{}", model->name)),
           pointers.emplace_back(fmt::format("Bending model {}: {}", model->name, model->summary)),
           model->parameters});
  const std::array<ConfigSection, 5> rest = {{
      {"/solver", "Time stepping and projection", solver()},
      {"/initial", "The pose at time 0", initial},
      {"/output", "What the run file holds", output},
      {"/accuracy", "Errors of the run, measured against references", accuracy},
      {"/quality", "From where on a triangle counts as bad", quality},
  }};
  sections.insert(sections.end(), rest.begin(), rest.end());
  return sections;
}

std::string range_text(const Parameter& row) {
  const bool low = std::isfinite(row.minimum), high = std::isfinite(row.maximum);
  if (low && high && !row.above) return fmt::format(" from {} to {}", row.minimum, row.maximum);
  const std::string least =
      low ? fmt::format(" {} {}", row.above ? "above" : "of at least", row.minimum) : "";
  const std::string most = high ? fmt::format(" of at most {}", row.maximum) : "";
  return least + (low && high ? " and" : "") + most;
}

}  // namespace

std::span<const ConfigSection> config_sections() {
  static const std::vector<ConfigSection> sections = make_sections();
  return sections;
}

const ConfigSection* find_section(std::string_view pointer) {
  const auto found = std::ranges::find(config_sections(), pointer, &ConfigSection::pointer);
  return found == config_sections().end() ? nullptr : &*found;
}

std::string_view section_key(const ConfigSection& section) {
  return section.pointer.substr(section.pointer.rfind('/') + 1);
}

std::vector<const ConfigSection*> child_sections(std::string_view pointer) {
  std::vector<const ConfigSection*> children;
  for (const ConfigSection& section : config_sections())
    if (!section.pointer.empty() && section.pointer.substr(0, section.pointer.rfind('/')) == pointer)
      children.push_back(&section);
  return children;
}

std::span<const ConfigList> config_lists() {
  return lists;
}

const Parameter& effect_type_parameter() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> result;
    for (const Effect* effect : effects()) result.push_back(effect->name);
    return result;
  }();
  static const Parameter row = {.name = "type",
                                .type = text,
                                .unit = "",
                                .default_value = {},
                                .meaning = "Which effect",
                                .required = true,
                                .choices = names};
  return row;
}

std::span<const Parameter> cover_parameters() {
  return cover;
}

std::span<const Parameter> expectation_parameters() {
  return expectation;
}

std::string_view expectation_where_meaning() {
  return "Only runs that have these values: {\"/json/pointer\": value}; absent: every run";
}

std::vector<std::string_view> names_of(std::span<const Parameter> table) {
  std::vector<std::string_view> names;
  for (const Parameter& row : table) names.push_back(row.name);
  return names;
}

std::string expected_text(const Parameter& row) {
  const std::string choices = fmt::format("one of {}", fmt::join(row.choices, ", "));
  const std::string length = row.length == 0 ? "" : fmt::format("{} ", row.length);
  switch (row.type) {
    case boolean:
      return "true or false";
    case integer:
      return "a whole number" + range_text(row);
    case number:
      return "a number" + range_text(row);
    case text:
      return row.choices.empty() ? "a text" : choices;
    case numbers:
      return fmt::format("a list of {}numbers{}", length, range_text(row));
    case texts:
      return fmt::format("a list of {}texts{}", length, row.choices.empty() ? "" : ", each " + choices);
  }
  throw std::logic_error("expected_text: unknown type");
}

}  // namespace bendlab
