#include "experiments/config/config_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/flaws.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/parameters/names.hpp"
#include "bendlab/parameters/registry.hpp"
#include "bendlab/solver/method.hpp"
#include "bendlab/solver/precision.hpp"
#include "experiments/config/config.hpp"
#include "experiments/config/defaults.hpp"

namespace bendlab {
namespace {

using enum ParameterType;
using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 4> config_stiffness_kinds = {
    stiffness_kind_names[0], stiffness_kind_names[1], stiffness_kind_names[2], "physical"};
constexpr std::array<std::string_view, 3> precisions = {"auto", precision_names[0], precision_names[1]};
constexpr std::array listed_measures_on_request = {
#define BENDLAB_MEASURE(name)
#define BENDLAB_MEASURE_ON_REQUEST(name) std::string_view(#name),
#include "experiments/measures/measures.def"
#undef BENDLAB_MEASURE
#undef BENDLAB_MEASURE_ON_REQUEST
};

Registry<std::string_view>& measures_on_request() {
  static Registry<std::string_view> names("measure", listed_measures_on_request);
  return names;
}

constexpr std::array<std::string_view, 1> allowed = {name_in(run_status_names, RunStatus::implausible)};

constexpr std::span<const std::string_view> nothing;
constexpr std::array<std::string_view, 1> default_pins = {"upper_right"};
constexpr std::array<double, 3> default_warp = {1, 0, 0}, zero_vector = {0, 0, 0}, ones = {1, 1, 1};
constexpr std::span<const double> no_indices;

constexpr double largest_seed = 4294967295;  // 2³² - 1: fits every generator

constexpr std::string_view stiffness_meaning =
    "How stiffness is given. k: the share of a constraint's error that one projection removes; k_per_step: "
    "the share that the n projections of a substep remove together, each k' = 1 - (1 - k)^(1/n); "
    "compliance: inverse stiffness, as in XPBD; physical: the membrane_stiffness below. Absent: k where "
    "warp, weft, shear or area is given, compliance where that is, else as /defaults says";

constexpr std::string_view bending_stiffness_meaning =
    "How stiffness is given: k, k_per_step or compliance, as for strain; physical: the sheet has the "
    "flexural_rigidity or quartic_coefficient below, for which each constraint gets its own compliance from "
    "the mesh. Absent: k where k is given, compliance where that is, else physical";

// Formatted by hand, to be read as tables.
// clang-format off
constexpr std::array top_level = {
    Parameter{.name = "name", .type = text, .unit = "", .default_value = {},
              .meaning = "Name of the experiment and of its results folder: letters, digits, '_' and '-'",
              .required = true},
    Parameter{.name = "description", .type = text, .unit = "", .default_value = "",
              .meaning = "What the experiment is for; does not affect its runs"},
    Parameter{.name = "allow", .type = texts, .unit = "", .default_value = Names(nothing),
              .meaning = "Verdicts that do not fail the command: implausible, for a sweep that studies "
                         "failure. The verdict is still printed; does not affect the runs",
              .choices = allowed},
    Parameter{.name = "defaults", .type = text, .unit = "", .default_value = "recommended",
              .meaning = "Which settings a config gets that it does not state. recommended: implicit steps "
                         "(quasi_newton) of a membrane in N/m, sound at every resolution; "
                         "pbd with coarse levels where a config states what only projections take, k for "
                         "example; fast: fewer iterations, in less time than the paper's settings take; "
                         "reference: implicit steps that converge (newton), slow; paper: those with which we "
                         "repeat the paper (adaptive springs with k 0.5, the pin's neighbours pinned, one "
                         "substep of 10 iterations, published shear, gravity alone)",
              .choices = defaults_names},
    Parameter{.name = "duration", .type = number, .unit = "s", .default_value = 4.0,
              .meaning = "Simulated time of each run; at least a step. It is rounded up to whole steps of "
                         "/solver/dt",
              .minimum = 0, .above = true},
    Parameter{.name = "settled_speed", .type = number, .unit = "m/s", .default_value = 0.0,
              .meaning = "The run ends early when no vertex has been faster than this for half a simulated "
                         "second (checked 60 times a simulated second); its summary then has settled_at. "
                         "0: it never ends early",
              .minimum = 0},
};

// Not constexpr: the flaws' names come from the mesh room.
const std::array mesh = {
    Parameter{.name = "generator", .type = text, .unit = "", .default_value = "grid",
              .meaning = "grid: squares split into triangles; equilateral: lattice of equilateral "
                         "triangles; delaunay: irregular, from random points; disc: as many concentric "
                         "rings as cells; tube: the side of a cylinder or cone around z, with as many "
                         "columns as cells; sphere: an octahedron whose edges are split into cells, inflated",
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
              .meaning = "grid: which diagonal splits a square: the same in all, alternating, or both",
              .choices = diagonal_names},
    Parameter{.name = "rows", .type = text, .unit = "", .default_value = "parallel",
              .meaning = "equilateral: direction of the rows of edges, relative to the long side. Absent: "
                         "along the sides that /pins/vertices names, else parallel",
              .choices = rows_names},
    Parameter{.name = "radius", .type = number, .unit = "m", .default_value = 0.5,
              .meaning = "disc, sphere: radius; tube: radius of its lower end",
              .minimum = 0, .above = true},
    Parameter{.name = "radius_top", .type = number, .unit = "m", .default_value = {},
              .meaning = "tube: radius of its upper end; absent: as the lower end",
              .minimum = 0, .above = true},
    Parameter{.name = "seed", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "delaunay: seed of the random points; with jitter: of the moves",
              .minimum = 0, .maximum = largest_seed},
    Parameter{.name = "refine", .type = integer, .unit = "1", .default_value = {},
              .meaning = "Each triangle is cut into four at the middles of its edges, so many times, also of "
                         "a mesh from a file. Vertices keep their numbers, the border its shape and curved "
                         "meshes their facets; texture coordinates are interpolated. Absent: not at all",
              .minimum = 0, .maximum = 12},
    Parameter{.name = "jitter", .type = number, .unit = "1", .default_value = {},
              .meaning = "Each vertex inside is moved at random within the sheet, by at most this share of "
                         "the smallest height of its triangles, also of a mesh from a file and after "
                         "refine; seed chooses the moves. Absent: not at all",
              .minimum = 0, .maximum = 0.4},
    Parameter{.name = "scale", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "Factor on all coordinates, also of a mesh from a file",
              .minimum = 0, .above = true},
    Parameter{.name = "offset", .type = numbers, .unit = "m",
              .default_value = std::span<const double>(zero_vector),
              .meaning = "Added to all coordinates after scale, also of a mesh from a file",
              .length = 3},
    Parameter{.name = "shuffle", .type = integer, .unit = "1", .default_value = {},
              .meaning = "Seed of a random numbering of vertices and triangles; absent: the generator's "
                         "numbering",
              .minimum = 0, .maximum = largest_seed},
    Parameter{.name = "flaw", .type = text, .unit = "", .default_value = "none",
              .meaning = "A defect put into the mesh on purpose. needles, caps, degenerate (no area), "
                         "duplicate_vertices, duplicate_faces, non_manifold_edge (a third triangle at an "
                         "edge), bow_tie (triangles that share only a point): at about every twentieth "
                         "place; isolated_vertices: vertices in no triangle; pieces: cut in two; "
                         "mixed_orientation: every second triangle turned over; hole: a hole in the middle",
              .choices = mesh_flaws()},
    Parameter{.name = "bad_triangles", .type = text, .unit = "", .default_value = "refuse",
              .meaning = "What to do with a mesh that has triangles without area, triangles listed twice, or "
                         "edges of three triangles. refuse: the run fails and names the first ones; "
                         "regularise: simulate the mesh as it is, with a small rest height for triangles "
                         "without area; membrane_off: the same, but those triangles have no strain "
                         "constraint; repair: unite points within 2e-6 of the mesh size, "
                         "remove triangles without area, cut the "
                         "sheet where it branches, orient all triangles alike. 'bendlab mesh FILE' says "
                         "what each does to a file",
              .choices = bad_triangles_names},
};

// Not constexpr: the names come from the mesh room.
const std::array<Parameter, 4>& pins() {
  static const std::array<Parameter, 4> table = {
      Parameter{.name = "vertices", .type = texts, .unit = "", .default_value = Names(default_pins),
                .meaning = "Pinned places by name: corners, sides and centre of the rest mesh's box in the "
                           "x-y plane, or of a sheet that stands, where z is up; top_rim and bottom_rim: "
                           "the ends of a tube; circle: the ring of vertices at a quarter of the smaller "
                           "side from the centre; interior: four vertices at 0.3 and 0.7 of both sides",
                .choices = vertex_selectors()},
      Parameter{.name = "indices", .type = numbers, .unit = "1", .default_value = no_indices,
                .meaning = "Pinned vertices by index (whole numbers, the first vertex is 0), in addition to "
                           "those of vertices",
                .minimum = 0},
      Parameter{.name = "ring", .type = integer, .unit = "1", .default_value = 0,
                .meaning = "How many rings of neighbours of each pinned vertex are pinned too; 0: none. The "
                           "paper pins one ring, a clamp that shrinks as the mesh is refined",
                .minimum = 0, .maximum = 64},
      Parameter{.name = "distance", .type = number, .unit = "m", .default_value = 0.0,
                .meaning = "Vertices within this distance of a pinned place are pinned too: a clamp of the "
                           "same width at every resolution",
                .minimum = 0},
  };
  return table;
}

constexpr std::array material = {
    Parameter{.name = "density", .type = number, .unit = "kg/m²", .default_value = 0.2,
              .meaning = "Mass per area",
              .minimum = 0, .above = true},
    Parameter{.name = "density_ratio", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "Factor on density in the half of the rest box with the larger x",
              .minimum = 0, .above = true},
    Parameter{.name = "coordinates", .type = text, .unit = "", .default_value = "warp",
              .meaning = "Where warp and weft run. warp: warp_direction, projected into each triangle's "
                         "plane; texture: along the mesh file's texture coordinates",
              .choices = material_coordinates_names},
    Parameter{.name = "warp_direction", .type = numbers, .unit = "1",
              .default_value = std::span<const double>(default_warp),
              .meaning = "Direction of the warp threads in the rest shape, of any length but zero; for a "
                         "tube, 0, 0, 1 is along its axis",
              .length = 3},
};

constexpr std::array strain = {
    Parameter{.name = "form", .type = text, .unit = "", .default_value = "angle",
              .meaning = "normalised: stretch √S_ii - 1 and normalised shear, as published; green: the "
                         "entries of S themselves; angle (ours): stretch as in normalised, and as shear the "
                         "difference of the angle between warp and weft from a right angle. The gradient of "
                         "normalised shear vanishes as warp and weft become parallel, so that a projection "
                         "moves a strongly sheared triangle by many times its size; angle does not do that",
              .choices = strain_form_names},
    Parameter{.name = "stiffness", .type = text, .unit = "", .default_value = "physical",
              .meaning = stiffness_meaning, .choices = config_stiffness_kinds},
    Parameter{.name = "membrane_stiffness", .type = number, .unit = "N/m", .default_value = {},
              .meaning = "physical: Young's modulus times thickness, the force per width that stretches "
                         "warp or weft, or shears, by 1. Absent: 10000, at which 1 m of 0.2 kg/m² strains "
                         "by 10⁻⁴ under its weight",
              .minimum = 0, .above = true},
    Parameter{.name = "warp", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "k of stretch along the warp",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "weft", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "k of stretch across the warp",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "shear", .type = number, .unit = "1", .default_value = 1.0,
              .meaning = "k of shear",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "area", .type = number, .unit = "1", .default_value = 0.0,
              .meaning = "k of a triangle's area; 0: no such constraint",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "compliance", .type = number, .unit = "m/N", .default_value = 0.0,
              .meaning = "Compliance of every strain constraint, used if stiffness is compliance; 0 is rigid",
              .minimum = 0},
};

const std::array<Parameter, 8>& bending() {
  static const std::vector<std::string_view> models = [] {
    std::vector<std::string_view> names;
    for (const BendingModel* model : bending_models()) names.push_back(model->name);
    return names;
  }();
  static const std::array<Parameter, 8> table = {
      Parameter{.name = "model", .type = text, .unit = "", .default_value = default_bending_model,
                .meaning = "Bending model; its own settings are in the section of its name",
                .choices = models},
      Parameter{.name = "stiffness", .type = text, .unit = "", .default_value = "physical",
                .meaning = bending_stiffness_meaning, .choices = config_stiffness_kinds},
      Parameter{.name = "k", .type = number, .unit = "1", .default_value = 0.5,
                .meaning = "Stiffness of every bending constraint, used if stiffness is k or k_per_step",
                .minimum = 0, .maximum = 1},
      Parameter{.name = "compliance", .type = number, .unit = "m/N or 1/(N m)", .default_value = 0.0,
                .meaning = "Inverse stiffness, used if stiffness is compliance; 0 is rigid. `bendlab models` "
                           "says what it means for each model",
                .minimum = 0},
      Parameter{.name = "flexural_rigidity", .type = number, .unit = "N m", .default_value = {},
                .meaning = "physical: B of the moment B κ per width at curvature κ; springs have it at "
                           "at_curvature only. Absent: 1e-5, a light cotton, unless quartic_coefficient is "
                           "given",
                .minimum = 0, .above = true},
      Parameter{.name = "quartic_coefficient", .type = number, .unit = "N m³", .default_value = {},
                .meaning = "physical: C of the moment C κ³ per width at curvature κ, for models made of "
                           "springs",
                .minimum = 0, .above = true},
      Parameter{.name = "at_curvature", .type = number, .unit = "1/m", .default_value = {},
                .meaning = "physical: the curvature κ0 at which springs have the moment that "
                           "flexural_rigidity states, C = B/κ0². Absent: 20, a fold of 5 cm radius",
                .minimum = 0, .above = true},
      Parameter{.name = "deflection", .type = text, .unit = "", .default_value = "large",
                .meaning = "physical, models made of hinges: for which deflections flexural_rigidity holds. "
                           "large: the membrane forces the sheet to a cylinder, as in drapes and folds; "
                           "small: the sheet is bent so little that its membrane does not matter; both: "
                           "between the two, with hinge weights that make them differ as little as the mesh "
                           "allows. The summary says what share of it the sheet has at small and at large "
                           "deflections",
                .choices = deflection_names},
  };
  return table;
}

// Settings that several methods share; Method::shared says which a method reads.
constexpr std::array shared_by_methods = {
    Parameter{.name = "dt", .type = number, .unit = "s", .default_value = 1.0 / 60,
              .meaning = "Time step",
              .minimum = 1e-9, .maximum = 1e6},
    Parameter{.name = "substeps", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "How many equal parts a time step is divided into. The default is that of "
                         "quasi_newton; other methods have their own",
              .minimum = 1, .maximum = 100000},
    Parameter{.name = "iterations", .type = integer, .unit = "1", .default_value = 5,
              .meaning = "How many times each substep visits all constraints. The default is that of "
                         "quasi_newton; other methods have their own",
              .minimum = 1, .maximum = 100000},
    Parameter{.name = "sweep", .type = text, .unit = "", .default_value = "forward",
              .meaning = "Order within an iteration. forward: from the first constraint to the last; "
                         "symmetric: forward, then backward, which avoids jitter at small time steps and "
                         "takes twice as many projections",
              .choices = sweep_names},
    Parameter{.name = "order", .type = text, .unit = "", .default_value = "colour",
              .meaning = "colour: in groups, in which no two constraints share a vertex; mesh: one after "
                         "another, as the model lists them; pins: one after another, those nearest to a "
                         "pinned vertex first",
              .choices = constraint_order_names},
    Parameter{.name = "first", .type = text, .unit = "", .default_value = "strain",
              .meaning = "Which constraints are projected first in an iteration",
              .choices = first_constraint_names},
    Parameter{.name = "precision", .type = text, .unit = "", .default_value = "auto",
              .meaning = "Precision of the solver's numbers. auto: single, but double if an effect moves "
                         "vertices itself (an obstacle, tethers, …) and what gravity adds to a speed in a "
                         "substep h is too small for single precision (g h against the rounding of a "
                         "position over h), or if quasi_newton has a membrane whose strain under its "
                         "weight a rounded position hides; the run's provenance says which was used",
              .choices = precisions},
    Parameter{.name = "threads", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "Threads of one run; their number does not change a bit of the result",
              .minimum = 1, .maximum = 256},
};

const std::vector<Parameter>& solver() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Method* method : methods()) all.push_back(method->name);
    return all;
  }();
  static const std::string meaning = [] {
    std::string text = "How a time step moves the cloth.";
    for (const Method* method : methods()) text += fmt::format(" {}: {}.", method->name, method->summary);
    return text +
           " A setting that a method does not read changes nothing, and a warning tells of it: see "
           "`bendlab methods`";
  }();
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> rows = {
        Parameter{.name = "method", .type = text, .unit = "", .default_value = "quasi_newton",
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
              .meaning = "How many times the sheet starts folded, to and fro along x, into layers one above "
                         "the other; its rest shape does not change",
              .minimum = 0, .maximum = 64},
    Parameter{.name = "fold_gap", .type = number, .unit = "m", .default_value = 0.01,
              .meaning = "Distance between the layers of the folded sheet",
              .minimum = 0, .above = true},
    Parameter{.name = "creases", .type = integer, .unit = "1", .default_value = 0,
              .meaning = "How many sharp folds of 180 degrees the sheet starts with, which lay equal columns "
                         "along x flat on top of each other",
              .minimum = 0, .maximum = 4096},
    Parameter{.name = "scale", .type = numbers, .unit = "1", .default_value = std::span<const double>(ones),
              .meaning = "Factors along x, y and z on the start positions of the free vertices, relative to "
                         "the mean of the pins (without pins: to the centre): 0, 0, 0 is a point, 1, 0, 0 a "
                         "line, -1, 1, 1 a mirror image",
              .length = 3},
    Parameter{.name = "tilt", .type = number, .unit = "degrees", .default_value = 0.0,
              .meaning = "Rotation of the sheet at the start about the x axis through its centre; 0 is "
                         "horizontal (gravity is along -z), 90 upright",
              .minimum = -180, .maximum = 180},
    Parameter{.name = "perturbation", .type = number, .unit = "1", .default_value = 0.0,
              .meaning = "Largest random displacement of a free vertex along each axis at the start, "
                         "relative to the mesh's size",
              .minimum = 0, .maximum = 1},
    Parameter{.name = "random", .type = number, .unit = "1", .default_value = 0.0,
              .meaning = "Above 0: every free vertex starts at a random place in a box around the centre, "
                         "which is this many times the mesh's size wide",
              .minimum = 0},
    Parameter{.name = "velocity", .type = numbers, .unit = "m/s",
              .default_value = std::span<const double>(zero_vector),
              .meaning = "Velocity of all free vertices at the start",
              .length = 3},
    Parameter{.name = "spin", .type = numbers, .unit = "rad/s",
              .default_value = std::span<const double>(zero_vector),
              .meaning = "Angular velocity at the start, about the centre of the rest box",
              .length = 3},
    Parameter{.name = "seed", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "Seed of perturbation and random",
              .minimum = 0, .maximum = largest_seed},
    Parameter{.name = "after", .type = texts, .unit = "", .default_value = {},
              .meaning = "Changes, each \"/json/pointer=value\", that turn this run into an earlier one; the "
                         "cloth starts at rest where that one ends. It may have a coarser mesh of the same "
                         "flat sheet, for example, or another method, and is not recorded"},
};

const std::array<Parameter, 3>& output() {
  static const std::array<Parameter, 3> table = {
      Parameter{.name = "frames_per_second", .type = number, .unit = "1/s", .default_value = 30.0,
                .meaning = "Recorded frames per simulated second, at most one a step",
                .minimum = 0, .maximum = 1e6, .above = true},
      Parameter{.name = "constraints", .type = boolean, .unit = "", .default_value = false,
                .meaning = "true: the run file lists every constraint; false: only their counts and hash"},
      Parameter{.name = "measures", .type = texts, .unit = "", .default_value = Names(),
                .meaning = "Measures to take in addition to those that every run has; `bendlab measures` "
                           "says what each finds out, the names of its numbers, and its cost",
                .choices = measures_on_request().rows()},
  };
  return table;
}

constexpr std::array accuracy = {
    Parameter{.name = "solver", .type = texts, .unit = "", .default_value = {},
              .meaning = "Changes, each \"/json/pointer=value\", that turn this run into a reference with "
                         "the same energies, its equilibrium for example; the summary then has the errors "
                         "against it, error_solver_rms and others. The reference is a separate run, below "
                         "<results>/<experiment>/references, computed once for all runs that differ only in "
                         "what is changed here"},
    Parameter{.name = "solver_coarser", .type = texts, .unit = "", .default_value = {},
              .meaning = "Further changes that make a second reference, half as fine; its distance from the "
                         "first one is error_solver_reference_gap"},
    Parameter{.name = "physical", .type = texts, .unit = "", .default_value = {},
              .meaning = "Changes that turn this run into the stated cloth, even with another model or "
                         "resolution; the summary then has error_physical_rms and others. The reference's "
                         "pose is interpolated at this run's vertices"},
    Parameter{.name = "physical_coarser", .type = texts, .unit = "", .default_value = {},
              .meaning = "Further changes that make a second reference, half as fine; its distance from the "
                         "first one is error_physical_reference_gap"},
    Parameter{.name = "start_from_end", .type = boolean, .unit = "", .default_value = false,
              .meaning = "true: the reference starts where this run ends, so that both come to the same "
                         "equilibrium if the scene has many. Each run then has its own reference"},
    Parameter{.name = "align", .type = text, .unit = "", .default_value = "none",
              .meaning = "How the reference's pose is moved onto this run's before they are compared. none: "
                         "not at all; vertical: by the best rotation about the vertical through the middle "
                         "of the pins (without pins: of the mesh); rigid: by the best rigid motion",
              .choices = align_by_names},
    Parameter{.name = "over_time", .type = boolean, .unit = "", .default_value = false,
              .meaning = "true: compare all frames that both recorded at the same time, instead of the last "
                         "frame of each. The errors are then means over these frames, with the largest as "
                         "…_worst, and the error of the energy is among them"},
};

constexpr std::array quality = {
    Parameter{.name = "needle_ratio", .type = number, .unit = "1", .default_value = 4.0,
              .meaning = "A triangle is a needle if its longest edge is at least this many times its "
                         "shortest",
              .minimum = 1},
    Parameter{.name = "cap_angle", .type = number, .unit = "degrees", .default_value = 160.0,
              .meaning = "A triangle is a cap if one of its angles is at least this large",
              .minimum = 90, .maximum = 180},
    Parameter{.name = "small_angle", .type = number, .unit = "degrees", .default_value = 10.0,
              .meaning = "The metric small_angles counts triangles with an angle below this",
              .minimum = 0, .maximum = 60},
};

constexpr std::array cover = {
    Parameter{.name = "strength", .type = integer, .unit = "1", .default_value = {},
              .meaning = "Every combination of the values of this many axes occurs in some run: 2 covers "
                         "every pair of values",
              .minimum = 1, .maximum = 6, .required = true},
    Parameter{.name = "seed", .type = integer, .unit = "1", .default_value = 1,
              .meaning = "Another seed gives other runs that cover as much",
              .minimum = 0, .maximum = largest_seed},
};

constexpr std::array expectation = {
    Parameter{.name = "metric", .type = text, .unit = "", .default_value = {},
              .meaning = "Name of a number in the run's summary",
              .required = true},
    Parameter{.name = "min", .type = number, .unit = "", .default_value = {},
              .meaning = "Smallest value that is right, in the metric's unit; give min, max or both"},
    Parameter{.name = "max", .type = number, .unit = "", .default_value = {},
              .meaning = "Largest value that is right, in the metric's unit"},
    Parameter{.name = "why", .type = text, .unit = "", .default_value = {},
              .meaning = "Where the bound comes from",
              .required = true},
};

// clang-format on

constexpr std::array lists = {
    ConfigList{"effects",
               "What acts on the cloth besides its constraints: a list of {\"type\": name, settings}. Only "
               "some types, obstacles for example, may be listed more than once. Absent: gravity and "
               "viscous_drag of 1 N s/m³, about that of air; an empty list: nothing"},
    ConfigList{"sweep",
               "What to vary: {\"/json/pointer\": [values]}; \"all\" instead of the list stands for every "
               "choice of a setting. There is one run per combination, and the last pointer varies fastest. "
               "A pointer may also name a whole object, or the whole list of effects"},
    ConfigList{"cover",
               "Runs a part of a large sweep: with \"cover\": 3 every combination of values of any three "
               "axes occurs in at least one run. A greedy search keeps the runs few; they are the same on "
               "every machine. Values that do not go together are left out, and 'bendlab plan' lists them. "
               "A number (the strength), or an object"},
    ConfigList{"expect", "Bounds that 'bendlab run' checks on every run, each with its reason"},
    ConfigList{"because",
               "Why settings are as they are, with sources: {\"/json/pointer\": text}; does not affect the "
               "runs"},
};

// A model's settings stand in /bending beside those that all models share.
void check_names_of_added_models() {
  for (const BendingModel* model : added_bending_models())
    if (std::ranges::find(bending(), model->name, &Parameter::name) != bending().end())
      throw std::invalid_argument(
          fmt::format("the bending model '{}' has the name of a setting, /bending/{}; choose another name",
                      model->name, model->name));
}

std::vector<ConfigSection> make_sections() {
  static std::deque<std::string> pointers;  // the models' sections refer to these texts
  std::vector<ConfigSection> sections = {
      {"", "The experiment", top_level},
      {"/mesh", "The rest mesh: generated, or read from a file", mesh},
      {"/pins", "Which vertices are held fixed", pins()},
      {"/material", "The cloth's mass and material directions", material},
      {"/material/strain", "Strain constraints of the triangles", strain},
      {"/bending", "The bending model and the stiffness of its constraints", bending()},
  };
  check_names_of_added_models();
  for (const BendingModel* model : bending_models())
    if (!model->parameters.empty())
      sections.push_back(
          {pointers.emplace_back(fmt::format("/bending/{}", model->name)),
           pointers.emplace_back(fmt::format("Bending model {}: {}", model->name, model->summary)),
           model->parameters});
  const std::array<ConfigSection, 5> rest = {{
      {"/solver", "Time stepping and projection", solver()},
      {"/initial", "The pose at time 0", initial},
      {"/output", "What is measured and recorded", output()},
      {"/accuracy", "Errors of the run, measured against references", accuracy},
      {"/quality", "When a triangle counts as bad", quality},
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

void add_measure_on_request(std::string_view name) {
  measures_on_request().add(name);
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
  return "Checks only runs that have these values: {\"/json/pointer\": value}; absent: every run";
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
