// Every warning is given if and only if its condition holds, and states its number.
#include "experiments/run/warnings.hpp"
#include "experiments/run/set_up.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "tests/catch.hpp"

namespace bendlab::warnings_test {
namespace {

using Catch::Matchers::ContainsSubstring;
namespace fs = std::filesystem;

using Summary = std::map<std::string, double>;

Experiment experiment_of(const std::string& settings) {
  return parse_experiment(R"({"name": "warned", "defaults": "paper", )" + settings + "}", "test");
}

// The warnings of the first run, which ended with this summary.
std::vector<Warning> warnings_with(const std::string& settings, const Summary* summary,
                                   RunStatus status = RunStatus::complete) {
  const Experiment experiment = experiment_of(settings);
  const BuiltScene scene = build_scene(experiment.runs.front().scene());
  return warnings_of({experiment, experiment.runs.front(), scene, summary, status});
}

std::set<std::string> codes_of(const std::string& settings, const Summary* summary = nullptr,
                               RunStatus status = RunStatus::complete) {
  std::set<std::string> codes;
  for (const Warning& warning : warnings_with(settings, summary, status)) codes.insert(warning.code);
  return codes;
}

std::string message_of(const std::string& code, const std::string& settings,
                       const Summary* summary = nullptr) {
  for (const Warning& warning : warnings_with(settings, summary))
    if (warning.code == code) return warning.message;
  return "";
}

using Codes = std::set<std::string>;

}  // namespace

TEST_CASE("warnings: a config with default settings has no warnings", "[warnings]") {
  CHECK(codes_of(R"("mesh": {"cells": 4})").empty());
}

TEST_CASE("warnings: a seed that nothing reads", "[warnings]") {
  const std::string mesh = R"("mesh": {"cells": 4}, )";
  CHECK(codes_of(mesh + R"("initial": {"seed": 7})") == Codes{"inert_seed"});
  CHECK(codes_of(mesh + R"("sweep": {"/initial/seed": [1, 2]})") == Codes{"inert_seed"});
  CHECK(codes_of(mesh + R"("sweep": {"/initial": [{"seed": 1}, {"seed": 2}]})") == Codes{"inert_seed"});
  CHECK(codes_of(mesh + R"("initial": {"perturbation": 1e-6}, "sweep": {"/initial/seed": [1, 2]})").empty());
  CHECK(codes_of(mesh + R"("initial": {"random": 1, "seed": 2})").empty());
  CHECK(codes_of(R"("mesh": {"cells": 4, "seed": 2})") == Codes{"inert_seed"});
  CHECK(codes_of(R"("mesh": {"cells": 4, "generator": "delaunay", "seed": 2})").empty());
}

TEST_CASE("warnings: a piece of the mesh without a pin", "[warnings]") {
  const std::string pieces = R"("mesh": {"cells": 4, "flaw": "pieces"}, )";
  CHECK(codes_of(pieces + R"("pins": {"vertices": ["upper_right"]})") == Codes{"piece_without_pin"});
  CHECK(codes_of(pieces + R"("pins": {"vertices": []})").empty());
  CHECK(codes_of(pieces + R"("pins": {"vertices": ["left", "right"]})")
            .empty());  // the cut runs from bottom to top
  CHECK(codes_of(R"("mesh": {"cells": 4}, "pins": {"vertices": ["upper_right"]})").empty());
}

TEST_CASE("warnings: an effect that needs pins in a scene without pins", "[warnings]") {
  const auto codes = [](const std::string& pins, const std::string& effect) {
    return codes_of(R"("mesh": {"cells": 4}, "pins": {"vertices": [)" + pins +
                    R"(]}, "effects": [{"type": "gravity"}, )" + effect + "]");
  };
  const std::string moving = R"({"type": "moving_pins", "times": [0, 1], "offsets": [0, 0, 0, 0, 0, 1]})",
                    tethers = R"({"type": "tethers"})";
  CHECK(codes("", moving) == Codes{"effect_without_pins"});
  CHECK(codes("", tethers) == Codes{"effect_without_pins"});
  CHECK(codes("", R"({"type": "viscous_drag"})").empty());
  CHECK(codes(R"("top")", moving).empty());
  CHECK(codes(R"("top")", tethers).empty());
  const Experiment by_default =
      parse_experiment(R"({"name": "d", "mesh": {"cells": 4}, "pins": {"vertices": []}})", "test");
  CHECK(set_up(by_default, by_default.runs.front()).empty());
}

TEST_CASE("warnings: friction without obstacles", "[warnings]") {
  const auto codes = [](const std::string& more) {
    return codes_of(R"("mesh": {"cells": 4}, "effects": [{"type": "gravity"}, {"type": "friction"})" + more +
                    "]");
  };
  CHECK(codes("") == Codes{"friction_without_obstacle"});
  CHECK(codes(R"(, {"type": "plane", "point": [0, 0, -1]})").empty());
}

TEST_CASE("warnings: triangles that face different sides under a pressure, a moment or dkt", "[warnings]") {
  const auto codes = [](const std::string& policy, const std::string& more) {
    return codes_of(R"("mesh": {"cells": 4, "flaw": "mixed_orientation", "bad_triangles": ")" + policy +
                    R"("}, )" + more);
  };
  const std::string pressure = R"("effects": [{"type": "pressure", "pressure": 1}])",
                    moment = R"("effects": [{"type": "moment", "vertices": ["left"], "moment": 1e-5}])",
                    dkt =
                        R"("bending": {"model": "dkt", "compliance": 1e5}, "solver": {"method": "newton"}, )"
                        R"("material": {"strain": {"membrane_stiffness": 1e4}})";
  for (const std::string& more : {pressure, moment, dkt}) {
    CAPTURE(more);
    CHECK(codes("regularise", more).contains("mixed_sides"));
    CHECK(!codes("repair", more).contains("mixed_sides"));
  }
  CHECK(codes("regularise", R"("effects": [{"type": "gravity"}])").empty());
  // In a grid of 4 by 4 cells every second triangle is reversed: all 40 shared edges join a reversed and an
  // unreversed triangle.
  CHECK_THAT(
      message_of(
          "mixed_sides",
          R"("mesh": {"cells": 4, "flaw": "mixed_orientation", "bad_triangles": "regularise"}, )" + pressure),
      ContainsSubstring("40 of 40"));
}

TEST_CASE("warnings: a fabric whose friction or softening the run leaves out", "[warnings]") {
  const auto leaves_out = [](const std::string& fabric, const std::string& bending, const char* method) {
    return codes_of(R"("mesh": {"cells": 4}, "effects": [{"type": "gravity"}], "material": {"fabric": ")" +
                    fabric + R"(", "strain": {"membrane_stiffness": 1e3}}, "bending": {"model": ")" +
                    bending + R"(}, "solver": {"method": ")" + method + "\"}")
        .contains("fabric_without_friction");
  };
  CHECK(!leaves_out("cotton_broad", R"(discrete_shells")", "newton"));
  CHECK(leaves_out("cotton_broad", R"(prestressed")", "newton"));
  CHECK(leaves_out("cotton_broad", R"(discrete_shells", "discrete_shells": {"measure": "tan"})", "newton"));
  CHECK(leaves_out("cotton_broad", R"(discrete_shells")", "equilibrium"));
  CHECK(!leaves_out("feng_1", R"(mid_edge")", "newton"));
  CHECK(leaves_out("feng_1", R"(mid_edge", "plasticity": {"yield_at": 50})", "newton"));
}

TEST_CASE("warnings: a rigidity and a friction in other units", "[warnings]") {
  const auto codes = [](const char* bending) {
    return codes_of(
        R"("mesh": {"cells": 4}, "effects": [{"type": "gravity"}], "bending": {"model": "mid_edge", )" +
        std::string(bending) + "}");
  };
  CHECK(!codes(R"("flexural_rigidity": 1e-5, "hysteresis": {"hb": 6e-4})").contains("units"));
  CHECK(codes(R"("flexural_rigidity": 1e-5, "hysteresis": {"hb": 0.04})").contains("units"));
  CHECK(codes(R"("rigidity": {"warp": 1e-12, "weft": 2e-12})").contains("units"));
  CHECK(!codes(R"("rigidity": {"warp": 1e-7, "weft": 2e-7})").contains("units"));
}

TEST_CASE("warnings: a kinetic friction larger than the static friction", "[warnings]") {
  const auto codes = [](const char* coefficients) {
    return codes_of(R"("mesh": {"cells": 4}, "effects": [{"type": "gravity"},
        {"type": "plane", "point": [0, 0, -1]}, {"type": "friction", )" +
                    std::string(coefficients) + "}]");
  };
  CHECK(codes(R"("static": 0.2, "kinetic": 0.21)") == Codes{"doubtful_effect"});
  CHECK(codes(R"("static": 0.2, "kinetic": 0.2)").empty());
}

// ρ = 0.2 kg/m² and ½ ρ_air C_D = 0.77 kg/m³. The terminal speed is 1.6 m/s, reached within 0.16 s.
TEST_CASE("warnings: substeps that are too long for the wind", "[warnings]") {
  const auto with = [](const char* pins, const char* effects, const char* dt) {
    return R"("mesh": {"cells": 4}, "material": {"density": 0.2}, "solver": {"substeps": 1, "dt": )" +
           std::string(dt) + R"(}, "pins": {"vertices": [)" + pins + R"(]}, "effects": [)" + effects + "]";
  };
  const char* const gravity_first = R"({"type": "gravity"}, {"type": "wind", "velocity": [0, 0, 0]})";
  const char* const wind_first = R"({"type": "wind", "velocity": [0, 0, 0]}, {"type": "gravity"})";
  for (const char* effects : {gravity_first, wind_first}) {
    CHECK(codes_of(with("", effects, "0.1")).empty());
    CHECK_THAT(message_of("doubtful_effect", with("", effects, "0.2")),
               ContainsSubstring("Set /solver/substeps to about 3"));
  }
  const char* const gale = R"({"type": "gravity"}, {"type": "wind", "velocity": [0, 20, 0]})";
  CHECK(codes_of(with("\"top\"", gale, "0.01")).empty());
  CHECK(codes_of(with("\"top\"", gale, "0.02")) == Codes{"doubtful_effect"});
}

TEST_CASE("warnings: cloth that starts inside an obstacle", "[warnings]") {
  const auto with = [](const std::string& obstacle) {
    return R"("mesh": {"cells": 4}, "pins": {"vertices": []}, "effects": [{"type": "gravity"}, )" + obstacle +
           "]";
  };
  CHECK_THAT(message_of("starts_inside", with(R"({"type": "plane", "point": [0, 0, 0.3]})")),
             ContainsSubstring("25 of 25 vertices") && ContainsSubstring("/effects/1 (plane)") &&
                 ContainsSubstring("0.305 m deep"));
  CHECK(codes_of(with(R"({"type": "plane", "point": [0, 0, 0]})")).empty());
  CHECK(codes_of(with(R"({"type": "plane", "point": [0, 0, -0.001], "thickness": 0.002})")).empty());
  // Obstacles are 5 mm thick.
  CHECK(codes_of(with(R"({"type": "sphere", "centre": [0, 0, 0], "radius": 0.3})")) ==
        Codes{"starts_inside"});
  CHECK(codes_of(with(R"({"type": "sphere", "centre": [0, 0, -0.3], "radius": 0.3})")).empty());
}

TEST_CASE("warnings: cloth much thicker than its edges are long", "[warnings]") {
  const auto with = [](const std::string& thickness) {  // the mean edge of 4 cells is about 0.29 m
    return R"("mesh": {"cells": 4}, "pins": {"vertices": []}, "effects": [{"type": "gravity"},
        {"type": "self_collision", "thickness": )" +
           thickness + "}]";
  };
  CHECK(codes_of(with("0.5")).empty());
  CHECK(codes_of(with("0.7")) == Codes{"doubtful_effect"});
  CHECK_THAT(message_of("doubtful_effect", with("0.7")),
             ContainsSubstring("/effects/1") && ContainsSubstring("thickness to about 0.14 m"));
}

TEST_CASE("warnings: a vertex far from its neighbours", "[warnings]") {
  const fs::path file = fs::temp_directory_path() / ("bendlab far " + std::to_string(getpid()) + ".obj");
  const auto codes = [&](double far) {
    std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\nv " << far << " " << far
                        << " 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 6\n";
    const std::string settings =
        R"("pins": {"indices": [0], "ring": 0}, "effects": [], "mesh": {"file": ")" + file.string() + R"("})";
    const std::string message = message_of("far_vertex", settings);
    if (!message.empty()) CHECK_THAT(message, ContainsSubstring("vertex 5 lies "));
    return codes_of(settings);
  };
  CHECK(codes(2).empty());
  CHECK(codes(100).empty());
  CHECK(codes(1000) == Codes{"far_vertex"});
  fs::remove(file);
}

TEST_CASE("warnings: settings that the method or the model does not read", "[warnings]") {
  const auto with = [](const std::string& settings) {
    return R"("mesh": {"cells": 4}, "effects": [{"type": "gravity"}], )" + settings;
  };
  const auto newton = [&](const std::string& settings) {
    return with(R"("bending": {"stiffness": "compliance", "compliance": 1}, "material": {"strain":
                   {"stiffness": "compliance", "compliance": 1e-4}}, )" +
                settings);
  };
  const std::string single = R"("solver": {"method": "newton", "precision": "single", "iterations": 9})";
  CHECK(codes_of(newton(single)) == Codes{"inert_setting"});
  CHECK_THAT(message_of("inert_setting", newton(single)), ContainsSubstring("/solver/precision"));
  CHECK(codes_of(newton(R"("solver": {"method": "newton", "iterations": 9})")).empty());
  CHECK(codes_of(with(R"("solver": {"precision": "double"})")).empty());
  const std::string swept =
      R"("solver": {"first": "bending"}, "sweep": {"/solver/method": ["newton", "pbd"]})";
  CHECK(codes_of(newton(swept)).empty());
  const std::string rings = R"("k_ring": {"rings": "last"})";
  CHECK_THAT(message_of("inert_setting", with(R"("bending": {)" + rings + "}")),
             ContainsSubstring("/bending/k_ring/rings"));
  CHECK(codes_of(with(R"("bending": {"model": "k_ring", )" + rings + "}")).empty());
  const auto disc = [](const std::string& settings) {
    return R"("pins": {"vertices": []}, "effects": [{"type": "gravity"}],
               "mesh": {"generator": "disc", "cells": 4, )" +
           settings + "}";
  };
  CHECK(codes_of(disc(R"("radius": 0.3)")).empty());
  CHECK_THAT(message_of("inert_setting", disc(R"("width": 2, "rows": "parallel")")),
             ContainsSubstring("/mesh/width, /mesh/rows"));
  CHECK_THAT(
      message_of("inert_setting", with(R"("bending": {"model": "none", "softening": {"half_at": 50}})")),
      ContainsSubstring("/bending/softening/half_at"));
  const auto over_time = [&](const std::string& times) {
    return with(R"("duration": 1, "solver": {"method": "newton", "iterations": 9}, "material": {"strain":
                   {"stiffness": "compliance", "compliance": 1e-4}}, "bending": {"stiffness": "compliance",
                   "compliance": 1, "over_time": {"factors": [1, 1, 5], "times": )" +
                times + "}}");
  };
  CHECK_THAT(message_of("inert_setting", over_time("[0, 1, 2]")), ContainsSubstring("/bending/over_time"));
  CHECK(codes_of(over_time("[0, 0.5, 2]")).empty());
}

TEST_CASE("warnings: settings that a swept object replaces", "[warnings]") {
  const auto with = [](const std::string& bending, const std::string& sweep) {
    return R"("mesh": {"cells": 4}, "effects": [{"type": "gravity"}], "bending": {)" + bending +
           R"(}, "sweep": {)" + sweep + "}";
  };
  const char* const objects = R"("/bending": [{"model": "dihedral", "k": 0.1}, {"model": "lod", "k": 0.1}])";
  const char* const without_k = R"("/bending": [{"model": "dihedral"}, {"model": "lod"}])";
  CHECK(codes_of(with(R"("k": 0.2)", objects)).empty());
  CHECK(codes_of(with(R"("k": 0.2)", without_k)) == Codes{"replaced_setting"});
  CHECK_THAT(message_of("replaced_setting", with(R"("k": 0.2)", without_k)), ContainsSubstring("/bending/k"));
  CHECK(codes_of(with(R"("k": 0.5)", without_k)).empty());  // equals the default, so no warning
  CHECK(codes_of(with(R"("k": 0.2)", without_k + std::string(R"(, "/bending/k": [0.2])"))).empty());
  CHECK(codes_of(with(R"("k": 0.2)", R"("/bending/model": ["dihedral", "lod"])")).empty());
  // A sweep of two objects.
  CHECK_THAT(
      message_of("replaced_setting", with(R"("k": 0.2)", without_k + std::string(R"(, "/mesh": [{}])"))),
      ContainsSubstring("states /bending/k, /mesh/cells"));
}

TEST_CASE("warnings: a setting unread in a run may be read in its reference or in the run before",
          "[warnings]") {
  const std::string mesh = R"("mesh": {"cells": 4}, )";
  CHECK(codes_of(mesh + R"("initial": {"seed": 7, "after": ["/initial/perturbation=0.01"]})").empty());
  CHECK(codes_of(mesh + R"("material": {"strain": {"stiffness": "k", "compliance": 1e-3}},
      "accuracy": {"solver": ["/material/strain/stiffness=compliance"]})")
            .empty());
}

TEST_CASE("warnings: an extent that looks like other units", "[warnings]") {
  const auto sheet = [](double width, const std::string& effects) {
    return R"("mesh": {"cells": 4, "width": )" + std::to_string(width) + R"(, "height": )" +
           std::to_string(width) + R"(}, "effects": )" + effects;
  };
  const std::string gravity = R"([{"type": "gravity"}])";
  for (const double right : {0.05, 0.3, 1.0, 3.0, 6.0}) CHECK(codes_of(sheet(right, gravity)).empty());
  for (const double wrong : {0.0005, 0.005, 10.0, 1000.0})
    CHECK(codes_of(sheet(wrong, gravity)) == Codes{"units"});
  CHECK_THAT(message_of("units", sheet(1000, gravity)), ContainsSubstring("1e+03 m long"));
  CHECK(codes_of(sheet(0.3, R"([{"type": "gravity", "acceleration": [0, 0, -0.03]}])")).empty());
  CHECK(codes_of(sheet(1000, "[]")).empty());  // without gravity any length is possible
  // Everything is in millimetres, including gravity.
  CHECK(codes_of(sheet(1000, R"([{"type": "gravity", "acceleration": [0, 0, -9810]}])")).empty());
}

TEST_CASE("warnings: a gravity, density or stiffness that looks like a value in other units", "[warnings]") {
  const auto sheet = [](const std::string& settings) {
    return R"("mesh": {"cells": 4, "diagonal": "both"}, )" + settings;
  };
  const auto gravity = [&](const std::string& g) {
    return sheet(R"("effects": [{"type": "gravity", "acceleration": [0, 0, )" + g + "]}]");
  };
  CHECK(codes_of(gravity("-9810")) == Codes{"units"});
  CHECK_THAT(message_of("units", gravity("-9810")), ContainsSubstring("is it in mm/s²"));
  CHECK(codes_of(sheet(R"("material": {"density": 0.0002})")) == Codes{"units"});
  CHECK(codes_of(sheet(R"("material": {"density": 0.002})")).empty());
  // 1 m of cloth with 0.2 kg/m² pulls with 1.96 N/m.
  const auto membrane = [&](const std::string& y) {
    return sheet(R"("material": {"strain": {"membrane_stiffness": )" + y + "}}");
  };
  CHECK(codes_of(membrane("1.9")) == Codes{"units"});
  CHECK(codes_of(membrane("2.1")).empty());
  // Bending lengths (B / 1.962)^(1/3) of 4.98 and 5.02 m.
  const auto bending = [&](const std::string& b) {
    return sheet(R"("bending": {"model": "dihedral", "flexural_rigidity": )" + b + "}");
  };
  CHECK(codes_of(bending("242")).empty());
  CHECK(codes_of(bending("248")) == Codes{"units"});
}

TEST_CASE("warnings: a stated rigidity on a mesh whose diagonals are all parallel", "[warnings]") {
  const auto on = [](const std::string& mesh) {
    return R"("bending": {"model": "dihedral", "flexural_rigidity": 1e-5}, "mesh": {"cells": 12, )" + mesh +
           "}";
  };
  CHECK(codes_of(on(R"("diagonal": "same")")) == Codes{"uneven_stiffness"});
  CHECK_THAT(message_of("uneven_stiffness", on(R"("diagonal": "same")")),
             ContainsSubstring("equilateral") && ContainsSubstring("alternating"));
  for (const char* even : {R"("diagonal": "alternating")", R"("diagonal": "both")",
                           R"("generator": "delaunay")", R"("generator": "equilateral")"})
    CHECK(codes_of(on(even)).empty());
  CHECK(codes_of(R"("mesh": {"cells": 12}, "bending": {"model": "dihedral", "stiffness": "physical"})")
            .empty());  // no stated rigidity
}

TEST_CASE("warnings: a rigid membrane that iterations leave stretched", "[warnings]") {
  const Summary stretched = {{"mean_strain", 0.08}}, short_enough = {{"mean_strain", 0.02}};
  const std::string mesh = R"("mesh": {"cells": 4})";
  CHECK(codes_of(mesh, &stretched) == Codes{"unconverged"});
  CHECK_THAT(message_of("unconverged", mesh, &stretched), ContainsSubstring("mean strain is 0.08"));
  CHECK(codes_of(mesh, &short_enough).empty());
  const Summary at_its_end = {{"mean_strain", 0.02}, {"mean_strain_last", 0.1}},
                neck = {{"max_stretch", 1.4}};
  CHECK(codes_of(mesh, &at_its_end) == Codes{"unconverged"});
  CHECK(codes_of(mesh, &neck) == Codes{"unconverged"});
  CHECK(codes_of(mesh).empty());  // unknown before the run
  CHECK(codes_of(mesh + R"(, "material": {"strain": {"stiffness": "compliance", "compliance": 0.01}})",
                 &stretched)
            .empty());  // its compliance allows this stretch
  CHECK(codes_of(mesh + R"(, "material": {"strain": {"stiffness": "compliance"}})", &stretched) ==
        Codes{"unconverged"});
  CHECK(codes_of(mesh + R"(, "material": {"strain": {"warp": 0.1}})", &stretched).empty());
}

TEST_CASE("warnings: a membrane whose waves are too fast for the solver", "[warnings]") {
  // With legs of 1/4 m, 0.2 kg/m², one substep of 1/60 s and ten projections, C²/n = 1 at a compliance of h²
  // / (ρ a² n).
  const double critical = 1.0 / 3600 / (0.2 * 0.0625 * 10);
  const auto with = [](double compliance, const std::string& solver) {
    return R"("mesh": {"cells": 4}, "material": {"strain": {"stiffness": "compliance", "compliance": )" +
           fmt::format("{}", compliance) + R"(}}, "solver": {"iterations": 10, )" + solver + "}";
  };
  CHECK(codes_of(with(1.05 * critical, R"("substeps": 1)")).empty());
  CHECK(codes_of(with(0.95 * critical, R"("substeps": 1)")) == Codes{"membrane_courant"});
  CHECK(codes_of(with(0.3 * critical, R"("substeps": 2)")).empty());  // a quarter of C²
  CHECK(codes_of(with(0.6 * critical, R"("substeps": 1, "sweep": "symmetric")")).empty());
  const std::string message = message_of("membrane_courant", with(critical / 9, R"("substeps": 1)"));
  CHECK_THAT(message, ContainsSubstring("about 10 times") && ContainsSubstring("10 /solver/substeps"));
  // Coarse levels help if there are fewer substeps than mean edges across the sheet, √2 / 0.285 = 5.
  const double stiff = critical / 1e4;
  const std::string few = R"("substeps": 4)", many = R"("substeps": 5)";
  CHECK_THAT(message_of("membrane_courant", with(stiff, few)), ContainsSubstring("levels: 12"));
  CHECK_THAT(message_of("membrane_courant", with(stiff, many)), !ContainsSubstring("levels"));
  // They do not give the full stiffness: the stretch is larger by 1.6 (C²/n)^0.44, with C²/n = 1e4 / 16.
  CHECK_THAT(message_of("membrane_courant", with(stiff, R"("substeps": 4, "levels": 12)")),
             ContainsSubstring("about 28 times"));
  CHECK(codes_of(with(stiff, R"("substeps": 5, "levels": 12)")) == Codes{"membrane_courant"});
}

TEST_CASE("warnings: a membrane is expected to be soft only in cloth that is held", "[warnings]") {
  const auto with = [](const char* pins, const char* effects) {
    return R"("mesh": {"cells": 4}, "material": {"strain": {"stiffness": "compliance", "compliance": 1e-6}},
      "solver": {"substeps": 1, "iterations": 1}, "pins": {"vertices": [)" +
           std::string(pins) + R"(]}, "effects": [{"type": "gravity"})" + effects + "]";
  };
  CHECK(codes_of(with("", "")).empty());
  CHECK(codes_of(with("", R"(, {"type": "self_collision"})")).empty());
  CHECK(codes_of(with("\"top\"", "")) == Codes{"membrane_courant"});
  CHECK(codes_of(with("", R"(, {"type": "plane", "point": [0, 0, -1]})")) == Codes{"membrane_courant"});
  const Summary measured = {{"mean_strain", 1e-4}};  // after the run, soft_solver uses this instead
  CHECK(codes_of(with("\"top\"", ""), &measured).empty());
  const Summary unmeasured = {{"mean_strain", 0.02}};  // with coarse levels, and stretched
  CHECK(codes_of(with("\"top\"", ""), &unmeasured) == Codes{"membrane_courant"});
}

TEST_CASE("warnings: implicit steps that do not converge", "[warnings]") {
  const auto with = [](const char* solver) {
    return R"("mesh": {"cells": 4}, "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}},
      "bending": {"stiffness": "physical"}, "solver": )" +
           std::string(solver);
  };
  const Summary left = {{"step_residual", 2.5}}, converged = {{"step_residual", 1.9}};
  const std::string stated = with(R"({"method": "quasi_newton", "membrane": "stated", "iterations": 10})"),
                    softened = with(R"({"method": "quasi_newton", "membrane": "auto", "iterations": 2})"),
                    vbd = with(R"({"method": "vbd", "iterations": 100000})"),
                    newton = with(R"({"method": "newton"})");
  CHECK(codes_of(stated, &left) == Codes{"lagging"});
  CHECK(codes_of(stated, &converged).empty());
  CHECK_THAT(message_of("lagging", stated, &left), ContainsSubstring("2.5 times") &&
                                                       ContainsSubstring("1 substep × 10 iterations") &&
                                                       ContainsSubstring("/solver/membrane: auto"));
  CHECK_THAT(message_of("lagging", softened, &left),
             ContainsSubstring("/solver/iterations") && !ContainsSubstring("/solver/membrane"));
  CHECK_THAT(message_of("lagging", vbd, &left), ContainsSubstring("quasi_newton"));
  CHECK_THAT(message_of("lagging", newton, &left), ContainsSubstring("/solver/iterations"));

  // Friction moves cloth with a part of its weight.
  const auto on_plane = [&](const char* solver) {
    return with(solver) + R"(, "effects": [{"type": "gravity"}, {"type": "plane", "point": [0, 0, -1]}])";
  };
  const Summary slides = {{"step_residual", 1.1}}, turns = {{"step_residual", 0.2}};
  const std::string slow = on_plane(R"({"method": "vbd", "iterations": 100000})"),
                    few = on_plane(R"({"method": "quasi_newton"})"),
                    fast = on_plane(R"({"method": "newton"})");
  CHECK(codes_of(slow, &turns) == Codes{"lagging"});
  CHECK(codes_of(few, &turns).empty());
  CHECK_THAT(message_of("lagging", few, &slides), ContainsSubstring("/solver/substeps and iterations"));
  CHECK_THAT(message_of("lagging", fast, &slides), ContainsSubstring("/solver/substeps"));
}

// C² = (Y/ρ) (h/cell)² = 2 (1/60)² / 0.2² / c, where c is the compliance, ρ = 0.5 kg/m² and cells are 0.2 m
// wide.
TEST_CASE("warnings: vbd with few iterations for its membrane", "[warnings]") {
  const auto with = [](int iterations) {
    return fmt::format(R"("mesh": {{"generator": "grid", "cells": 5}}, "bending": {{"stiffness": "physical"}},
      "material": {{"density": 0.5, "strain": {{"stiffness": "compliance", "compliance": 1e-4}}}},
      "solver": {{"method": "vbd", "substeps": 1, "dt": 0.016666666667, "iterations": {}}})",
                       iterations);
  };
  CHECK(codes_of(with(13)) == Codes{"vbd_reach"});  // C² = 138.9
  CHECK(codes_of(with(14)).empty());
}

TEST_CASE("warnings: a run that ends before its equilibrium", "[warnings]") {
  const std::string settings =
      R"("mesh": {"cells": 4}, "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}},
      "bending": {"stiffness": "physical"}, "solver": {"method": "equilibrium"})";
  const Summary unbalanced = {{"unbalanced", 49}}, balanced = {{"unbalanced", 1e-8}, {"settled_at", 0.5}};
  CHECK_THAT(message_of("no_equilibrium", settings, &unbalanced), ContainsSubstring("49 times the loads"));
  CHECK(codes_of(settings, &balanced).empty());
  CHECK_THAT(message_of("no_equilibrium", settings, &unbalanced), ContainsSubstring("A longer /duration"));
  CHECK_THAT(message_of("no_equilibrium", settings + R"(, "pins": {"vertices": []})", &unbalanced),
             ContainsSubstring("Nothing holds the cloth"));
  const auto rolled = [&](const char* ring) {
    return message_of("no_equilibrium",
                      settings + R"(, "effects": [{"type": "moment", "vertices": ["right"], "moment": 1e-3}],
      "pins": {"vertices": ["left"], "ring": )" +
                          ring + "}",
                      &unbalanced);
  };
  CHECK_THAT(rolled("0"), ContainsSubstring("pin the next row"));
  CHECK_THAT(rolled("1"), ContainsSubstring("method newton"));
  for (const RunStatus status : {RunStatus::interrupted, RunStatus::diverged})
    CHECK(codes_of(settings, &unbalanced, status).empty());  // the run was stopped or diverged

  const fs::path folder = fs::temp_directory_path() / fmt::format("bendlab warnings test {}", getpid());
  const auto warned = [&](const char* duration) {
    const Experiment experiment = experiment_of(settings + R"(, "duration": )" + duration);
    const RunOutcome outcome = execute_run(experiment, experiment.runs.front(), folder);
    return std::ranges::any_of(outcome.warnings, [](const Warning& w) { return w.code == "no_equilibrium"; });
  };
  CHECK(warned("0.02"));
  CHECK_FALSE(warned("2"));
  fs::remove_all(folder);
}

TEST_CASE("warnings: a load of which pins take a part", "[warnings]") {
  const std::string mesh = R"("mesh": {"cells": 4}, "pins": {"vertices": ["left"], "ring": 0}, )";
  const auto load = [](const char* place, const char* spread) {
    return fmt::format(
        R"("effects": [{{"type": "load", "vertices": ["{}"], "force": [0, 0, -1], "spread": "{}"}}])", place,
        spread);
  };
  // One of the five vertices of this side is pinned, and bears the load of half a cell of four.
  CHECK_THAT(message_of("doubtful_effect", mesh + load("bottom", "equal")),
             ContainsSubstring("1 of the 5 vertices") && ContainsSubstring("20 % of the force"));
  CHECK_THAT(message_of("doubtful_effect", mesh + load("bottom", "length")), ContainsSubstring("12 %"));
  CHECK(codes_of(mesh + load("right", "equal")).empty());
  const std::string at_rest = R"("solver": {"method": "equilibrium"}, "bending": {"stiffness": "physical"}, )"
                              R"("material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}}, )";
  CHECK(codes_of(mesh + at_rest + load("bottom", "equal")).contains("doubtful_effect"));
}

// A sheet of an elastic material: its model, the rest of its material, and its pins, as JSON.
std::string shell(const std::string& model, const std::string& material, const std::string& pins) {
  return R"("mesh": {"cells": 4}, "solver": {"method": "equilibrium"}, "bending": {"stiffness": "physical", )"
         R"("model": ")" +
         model +
         R"("}, "material": {"strain": {"stiffness": "physical", "form": "stvk"}, )"
         R"("youngs_modulus": 1e6, "thickness": 0.05)" +
         material + R"(}, "pins": {)" + pins + "}";
}

TEST_CASE("warnings: a border that is held across is no plane of symmetry", "[warnings]") {
  const auto codes = [](const std::string& pins, const std::string& model = "dkt") {
    return codes_of(shell(model, "", pins));
  };
  const Codes warned = {"no_symmetry_plane"};
  CHECK(codes(R"("vertices": ["right"], "hold_x": ["left"])") == warned);
  CHECK(codes(R"("vertices": ["top"], "hold_y": ["bottom"])", "mid_edge") == warned);
  CHECK(codes(R"("vertices": ["right"], "hold_x": ["left"], "symmetry": ["x"])").empty());
  CHECK(codes(R"("vertices": ["right"], "hold_y": ["left"], "hold_z": ["left"])").empty());  // a support
  CHECK(codes(R"("vertices": ["right"], "hold_x": ["centre"])").empty());
  CHECK(codes(R"("vertices": ["right"], "hold_x": ["left"])", "none").empty());  // bears no moment anyway
}

TEST_CASE("warnings: equilateral triangles that do not fill the stated extents of a shell", "[warnings]") {
  const auto message = [](const char* width, const char* material) {
    return message_of(
        "other_extent",
        fmt::format(R"("pins": {{"vertices": ["left"]}}, "mesh": {{"generator": "equilateral", "height": 1,
      "cells": 8, "width": {}}}, "bending": {{"stiffness": "physical"}},
      "material": {{"strain": {{"stiffness": "physical"}}{}}})",
                    width, material));
  };
  const char* const shell = R"(, "youngs_modulus": 1e6, "thickness": 0.05)";
  // The rows are parallel to the pinned side. An edge is an eighth of the long side, and rows are √3/2 edges
  // apart: 9 rows instead of 9.24.
  CHECK_THAT(message("1", shell), ContainsSubstring("0.9743 m by 1 m instead of 1 m by 1 m"));
  CHECK(message("0.866025", shell).empty());
  CHECK(message("1", "").empty());
}

TEST_CASE("warnings: a bending model with another Poisson's ratio than the membrane", "[warnings]") {
  const auto codes = [](const char* model, const std::string& ratio) {
    return codes_of(shell(model, R"(, "poisson_ratio": )" + ratio, R"("vertices": ["left"])"));
  };
  CHECK(codes("discrete_shells", "0.3").contains("other_poisson_ratio"));
  CHECK(!codes("discrete_shells", "0").contains("other_poisson_ratio"));
  for (const char* model : {"mid_edge", "dkt", "none"}) CHECK(codes(model, "0.3").empty());
}

TEST_CASE("warnings: prestressed springs that stretch the sheet", "[warnings]") {
  const auto with = [](const char* excess, const char* k) {
    return R"("mesh": {"cells": 4}, "bending": {"model": "prestressed", "k": )" + std::string(k) +
           R"(, "prestressed": {"excess": )" + excess + "}}";
  };
  CHECK(codes_of(with("0.02", "1")).empty());
  CHECK(codes_of(with("0.05", "0.1")).empty());
  CHECK(codes_of(with("0.05", "0.5")) == Codes{"k_overshoot"});
  CHECK(codes_of(with("0.2", "0.1")) == Codes{"k_overshoot"});
  CHECK(codes_of(R"("mesh": {"cells": 4}, "bending": {"model": "dihedral", "k": 1})").empty());
}

TEST_CASE("warnings: nothing can move", "[warnings]") {
  CHECK(codes_of(R"("mesh": {"cells": 4}, "pins": {"vertices": ["top"], "distance": 5})") ==
        Codes{"all_pinned"});
  CHECK(codes_of(R"("mesh": {"cells": 4}, "pins": {"vertices": ["top"], "distance": 0.5})").empty());
}

TEST_CASE("warnings: for a stretched membrane only remedies that the scene does not have are advised",
          "[warnings]") {
  const auto remedy = [](const std::string& effects, const std::string& pins, const char* iterations) {
    const Summary stretched = {{"mean_strain", 0.08}};
    return message_of("unconverged",
                      R"("mesh": {"cells": 4}, "effects": [{"type": "gravity"})" + effects +
                          R"(], "pins": {"vertices": [)" + pins +
                          R"(]}, "solver": {"substeps": 3, "iterations": )" + iterations + "}",
                      &stretched);
  };
  const std::string tethers = R"(, {"type": "tethers"})", corner = R"("upper_right")";
  CHECK_THAT(remedy("", corner, "5"),
             ContainsSubstring("15 /solver/substeps × 1") && ContainsSubstring("tethers"));
  CHECK_THAT(remedy("", corner, "1"), ContainsSubstring("twice the /solver/substeps"));
  CHECK_THAT(remedy(tethers, corner, "5"), !ContainsSubstring("tethers"));
  CHECK_THAT(remedy("", "", "5"), !ContainsSubstring("tethers"));
}

TEST_CASE("warnings: a rigidity that the kind of stiffness does not read", "[warnings]") {
  const std::string mesh = R"("mesh": {"cells": 4, "generator": "equilateral"}, )";
  CHECK(codes_of(mesh + R"("bending": {"model": "dihedral", "flexural_rigidity": 1e-5, "stiffness": "k"})") ==
        Codes{"inert_stiffness"});
  CHECK(codes_of(mesh +
                 R"("bending": {"model": "dihedral", "flexural_rigidity": 1e-5, "stiffness": "physical"})")
            .empty());
  CHECK(codes_of(mesh +
                 R"("bending": {"model": "dihedral", "flexural_rigidity": 1e-5, "k": 0.5, "stiffness": "k"},
                           "sweep": {"/bending/stiffness": ["k", "physical"]})")
            .empty());
  CHECK(codes_of(mesh + R"("bending": {"model": "dihedral", "flexural_rigidity": null, "stiffness": "k"})")
            .empty());
  CHECK_THAT(message_of("inert_stiffness", mesh + R"("bending": {"k": 0.5, "stiffness": "physical"})"),
             ContainsSubstring("Choose k or k_per_step"));
  CHECK(codes_of(mesh + R"("material": {"strain": {"compliance": 1e-4, "stiffness": "k"}})") ==
        Codes{"inert_stiffness"});
  CHECK(codes_of(mesh + R"("bending": {"stiffness": "physical"}, "sweep": {"/bending/k": [0.1, 0.2]})") ==
        Codes{"inert_stiffness"});
}

TEST_CASE("warnings: a density in g/m²", "[warnings]") {
  CHECK(codes_of(R"("mesh": {"cells": 4}, "material": {"density": 200})") == Codes{"units"});
  CHECK(codes_of(R"("mesh": {"cells": 4}, "material": {"density": 2})").empty());
}

TEST_CASE("warnings: effects whose rounding hides gravity in single precision", "[warnings]") {
  const std::string on_a_plane = R"("mesh": {"cells": 4}, "pins": {"vertices": []},
      "effects": [{"type": "gravity"}, {"type": "plane", "point": [0, 0, -1]}], )";
  const auto solver = [](const char* precision, int substeps) {
    return std::string(R"("solver": {"precision": ")") + precision + R"(", "substeps": )" +
           std::to_string(substeps) + "}";
  };
  CHECK(codes_of(on_a_plane + solver("single", 4096)) == Codes{"single_precision"});
  CHECK(codes_of(on_a_plane + solver("single", 1)).empty());
  CHECK(codes_of(on_a_plane + solver("auto", 4096)).empty());
  // Constraints alone do not have this problem.
  CHECK(codes_of(R"("mesh": {"cells": 4}, )" + solver("single", 4096)).empty());
}

TEST_CASE("precision auto chooses double if the rounding of an effect hides gravity", "[scene]") {
  const auto precision_with = [](const std::string& effects, int substeps) {
    return build_scene(experiment_of(R"("mesh": {"cells": 4}, "effects": [{"type": "gravity"})" + effects +
                                     R"(], "solver": {"substeps": )" + std::to_string(substeps) + "}")
                           .runs.front()
                           .scene())
        .precision;
  };
  CHECK(precision_with("", 4096) == Precision::single_precision);
  CHECK(precision_with(R"(, {"type": "viscous_drag"})", 4096) == Precision::single_precision);
  CHECK(precision_with(R"(, {"type": "tethers"})", 4096) == Precision::double_precision);
  CHECK(precision_with(R"(, {"type": "tethers"})", 1) == Precision::single_precision);
  // On an incline with 256 substeps cloth slid 1.9 m in single precision instead of 0.75 m (ε d / g h² = 4).
  // With 32 substeps it slid below the static limit. Each of 10 projections adds a rounding.
  const std::string plane = R"(, {"type": "plane", "point": [0, 0, -1]})",
                    friction = plane + R"(, {"type": "friction"})";
  CHECK(precision_with(friction, 256) == Precision::double_precision);
  CHECK(precision_with(plane, 256) == Precision::single_precision);
  CHECK(precision_with(friction, 8) == Precision::double_precision);
  CHECK(precision_with(friction, 1) == Precision::single_precision);
}

TEST_CASE("precision auto chooses double if rounded positions hide the strain that quasi_newton needs",
          "[scene]") {
  // ε Y / (ρ g l) is 0.007 for l = 1/12 m and Y = 10⁴ N/m, 7 for a thousandth of the size, and 0.7 for Y =
  // 10⁶ N/m.
  const auto scene_of = [](double size, double compliance, const std::string& solver) {
    return R"("mesh": {"cells": 12, "scale": )" + std::to_string(size) +
           R"(}, "material": {"density": 0.2, "strain": {"stiffness": "compliance", "compliance": )" +
           std::to_string(compliance) +
           R"(}}, "bending": {"model": "none"}, "effects": [{"type": "gravity"}], "solver": {)" + solver +
           "}";
  };
  const std::string implicit = R"("method": "quasi_newton", "membrane": "stated")";
  const auto precision_of = [&](double size, double compliance, const std::string& solver) {
    return build_scene(experiment_of(scene_of(size, compliance, solver)).runs.front().scene()).precision;
  };
  CHECK(precision_of(1, 1e-4, implicit) == Precision::single_precision);
  CHECK(precision_of(1e-3, 1e-4, implicit) == Precision::double_precision);
  CHECK(precision_of(1, 1e-6, implicit) == Precision::double_precision);
  CHECK(precision_of(1, 1e-6, R"("method": "quasi_newton", "membrane": "auto")") ==
        Precision::single_precision);
  CHECK(precision_of(1e-3, 1e-4, R"("method": "pbd")") ==
        Precision::single_precision);  // pbd stores moves apart
  const std::string single = implicit + R"(, "precision": "single")";
  CHECK(codes_of(scene_of(1, 1e-6, single)) == Codes{"single_precision"});
  CHECK(codes_of(scene_of(1, 1e-4, single)).empty());
}

TEST_CASE("single precision stores moves apart if rounding is a hundredth of the move by gravity",
          "[scene]") {
  // ε d 60² s² / (9.81 × h s) with d = √2 m is 0.0062 for 10 substeps and 0.014 for 15 substeps.
  const auto apart = [](const std::string& effects, int substeps) {
    return build_scene(experiment_of(R"("mesh": {"cells": 4}, "effects": [)" + effects +
                                     R"(], "solver": {"substeps": )" + std::to_string(substeps) + "}")
                           .runs.front()
                           .scene())
        .input.moves_apart;
  };
  const std::string gravity = R"({"type": "gravity"})";
  CHECK_FALSE(apart(gravity, 1));
  CHECK_FALSE(apart(gravity, 10));
  CHECK(apart(gravity, 15));
  CHECK(apart("", 1));
}

TEST_CASE("warnings: each has a unique code, and is read back from JSON", "[warnings]") {
  std::set<std::string_view> codes;
  for (const WarningKind& kind : warning_kinds()) {
    CHECK(codes.insert(kind.code).second);
    CHECK(std::ranges::all_of(kind.code, [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; }));
    CHECK_FALSE(kind.meaning.empty());
  }
  const std::vector<Warning> warnings = {
      {"units", "1000 m"}, {"inert_seed", "\"quoted\""}, {"lagging", "is behind", 3, "3 times"}};
  const std::vector<Warning> back = warnings_of(Json::parse(to_json(warnings).dump()));
  REQUIRE(back.size() == 3);
  CHECK(back[0].measured.empty());
  CHECK(back[2].severity == 3);
  CHECK(back[2].measured == "3 times");
  CHECK(back[1].code == "inert_seed");
  CHECK(back[1].message == "\"quoted\"");
  CHECK(warnings_of(Json()).empty());
}

}  // namespace bendlab::warnings_test
