// Errors of runs against references.
#include "experiments/measures/trajectory.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "bendlab/io/without_traps.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/scene/pose_transfer.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "experiments/run/run_id.hpp"
#include "tests/catch.hpp"

namespace bendlab::accuracy_test {
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

namespace fs = std::filesystem;

// A damped strip that hangs from its clamped left side. Its energies are those of a cloth of known stiffness.
const std::string strip = R"("duration": 3,
  "mesh": {"generator": "equilateral", "width": 0.23335, "height": 0.12, "rows": "perpendicular", "cells": 8},
  "pins": {"vertices": ["left"], "ring": 0, "distance": 0.0338},
  "material": {"strain": {"form": "normalised", "stiffness": "compliance", "compliance": 1e-5}},
  "bending": {"model": "dihedral", "stiffness": "physical", "flexural_rigidity": 0.0015696},
  "effects": [{"type": "gravity"}, {"type": "viscous_drag", "coefficient": 4}],
  "output": {"frames_per_second": 2})";
const std::string equilibrium = R"(["/solver={\"method\": \"equilibrium\"}"])";
const std::string xpbd = R"(, "solver": {"iterations": 1, "sweep": "symmetric", "precision": "double"})";

class Results {
 public:
  Results() { fs::remove_all(folder); }
  ~Results() { fs::remove_all(folder); }

  std::vector<RunOutcome> run(const std::string& settings) const {
    const Experiment experiment = parse_experiment(R"({"name": "errors", "defaults": "paper",
          )" + settings + "}",
                                                   "test");
    std::vector<RunOutcome> outcomes;
    for (const RunConfig& config : experiment.runs)
      outcomes.push_back(execute_run(experiment, config, folder));
    return outcomes;
  }

  RunOutcome run_one(const std::string& settings) const { return run(settings).front(); }

  // All references in the results, with the times of their files.
  std::map<std::string, fs::file_time_type> references() const {
    std::map<std::string, fs::file_time_type> files;
    if (fs::exists(folder / "errors" / "references"))
      for (const auto& entry : fs::directory_iterator(folder / "errors" / "references"))
        files[entry.path().filename().string()] = fs::last_write_time(entry.path() / "run.vtkhdf");
    return files;
  }

  const fs::path folder = fs::temp_directory_path() / ("bendlab accuracy test " + std::to_string(getpid()));
};

std::string config_error(const std::string& settings) {
  try {
    parse_experiment(R"({"name": "errors", "defaults": "paper", )" + settings + "}", "test");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

double error(const RunOutcome& outcome, const std::string& name) {
  INFO(name << " of a run that says: " << outcome.message);
  REQUIRE(outcome.summary.contains("error_" + name));
  return outcome.summary.at("error_" + name);
}

Trajectory trajectory_of(const TriangleMesh& mesh, std::vector<double> times, std::vector<Positions> poses,
                         std::vector<double> energy = {}) {
  return {RestMesh(mesh), std::move(times), std::move(poses), std::move(energy)};
}

}  // namespace

TEST_CASE("accuracy: errors are relative to the size, for the last frame or over common times") {
  const TriangleMesh mesh = grid(3, 4, 6, 8);  // 5 m from corner to corner
  const auto shifted = [&](double by) -> Positions {
    return mesh.positions.rowwise() + Eigen::RowVector3d(0, 0, by);
  };
  const Trajectory run =
      trajectory_of(mesh, {0, 0.5, 1, 1.5}, {shifted(0), shifted(1), shifted(2), shifted(3)}, {1, 1, 3, 2});
  const Trajectory reference = trajectory_of(
      mesh, {0, 0.5 + 1e-9, 0.75, 1.5}, {shifted(0), shifted(0.5), shifted(9), shifted(1)}, {5, 4, 0, 5});

  const auto last = errors_between(run, reference, {});
  for (const char* name : {"rms", "largest", "hausdorff"})
    CHECK_THAT(last.at(name), WithinRel(2.0 / 5, 1e-12));
  CHECK_THAT(last.at("strain"), WithinAbs(0, 1e-12));
  CHECK_FALSE(last.contains("frames"));

  const auto errors = errors_between(run, reference, {.over_time = true, .energy_scale = 10});
  CHECK(errors.at("frames") == 2);  // 0.5 and 1.5 s
  CHECK_THAT(errors.at("rms"), WithinRel((0.5 + 2) / 2 / 5, 1e-12));
  CHECK_THAT(errors.at("rms_worst"), WithinRel(2.0 / 5, 1e-12));
  // At the common times, the energy of the run has grown by 0 and 1, the energy of the reference by -1 and 0.
  CHECK_THAT(errors.at("energy"), WithinRel(0.1, 1e-12));
  CHECK_THAT(errors.at("energy_worst"), WithinRel(0.1, 1e-12));

  CHECK_THROWS_WITH(
      errors_between(run, trajectory_of(mesh, {0, 0.3}, {shifted(0), shifted(1)}), {.over_time = true}),
      ContainsSubstring("frames_per_second"));
}

TEST_CASE("accuracy: a reference on another mesh is interpolated at the vertices of the run") {
  // Both poses lie in the same tilted plane. They are linear, so interpolation has no error.
  const TriangleMesh coarse = grid(1, 1, 7, 5), fine = delaunay(1, 1, 20, 3);
  const auto tilted = [](const Positions& p) {
    Positions q = p;
    q.col(1) = 0.6 * p.col(1), q.col(2) = 0.8 * p.col(1);
    return q;
  };
  const auto errors = errors_between(trajectory_of(coarse, {0}, {tilted(coarse.positions)}),
                                     trajectory_of(fine, {0}, {tilted(fine.positions)}), {});
  const double rounding = 1e-12;
  CHECK_THAT(errors.at("largest"), WithinAbs(0, rounding));
  CHECK_THAT(errors.at("hausdorff"), WithinAbs(0, rounding));
  CHECK_THAT(errors.at("strain"), WithinAbs(0, rounding));

  const auto no_fit = [&](const TriangleMesh& other) {
    return [&] { PoseTransfer(RestMesh(other), RestMesh(coarse)); };
  };
  CHECK_THROWS_WITH(no_fit(grid(0.5, 1, 9, 9))(), ContainsSubstring("outside"));
  CHECK_THROWS_WITH(no_fit(grid(2, 1, 20, 9))(), ContainsSubstring("different outlines"));
  CHECK_THROWS_WITH(no_fit(tube(0.5, 0.5, 1, 9))(), ContainsSubstring("one flat sheet"));
}

TEST_CASE("accuracy: an equilibrium is its own reference") {
  const Results results;
  const RunOutcome outcome =
      results.run(strip + R"(, "accuracy": {"solver": )" + equilibrium +
                  R"(}, "sweep": {"/solver": [{"method": "equilibrium"}, {"iterations": 1}]})")[0];
  // Positions have the same bits. The comparison itself adds and subtracts a few thousand numbers.
  for (const char* name : {"solver_rms", "solver_largest", "solver_hausdorff", "solver_strain"})
    CHECK_THAT(error(outcome, name), WithinAbs(0, 1e-12));
  CHECK(outcome.message.empty());
}

TEST_CASE("accuracy: the error of the solver falls with the number of substeps, finally with its square") {
  const Results results;
  const std::vector<RunOutcome> outcomes =
      results.run(strip + xpbd + R"(, "accuracy": {"solver": )" + equilibrium +
                  R"(}, "sweep": {"/solver/substeps": [16, 64, 256]})");
  const double few = error(outcomes[0], "solver_rms"), more = error(outcomes[1], "solver_rms"),
               many = error(outcomes[2], "solver_rms");
  CHECK(few > more);
  // One iteration of Gauss-Seidel per substep damps like a step of backward Euler. The compliance differs
  // from the stated compliance by the square of the substep. So from 64 to 256 substeps the error falls by a
  // factor of about 16.
  const double order = std::log(more / many) / std::log(4.0);
  INFO("order " << order);
  CHECK(order > 1.5);
  CHECK(order < 2.5);
  CHECK(many < 0.005);
  CHECK(results.references().size() == 1);  // all three runs share it
}

TEST_CASE("accuracy: the error of the physical reference is smaller on a finer mesh") {
  const Results results;
  const std::vector<RunOutcome> outcomes = results.run(
      strip + R"(, "solver": {"method": "equilibrium"}, "accuracy": {"physical": ["/mesh/cells=36"],
      "physical_coarser": ["/mesh/cells=18"]}, "sweep": {"/mesh/cells": [6, 12, 18]})");
  const auto rms = [&](std::size_t i) { return error(outcomes[i], "physical_rms"); };
  CHECK(rms(0) > rms(1));
  CHECK(rms(1) > rms(2));
  // The coarser reference equals the third run.
  CHECK_THAT(error(outcomes[0], "physical_reference_gap"), WithinRel(rms(2), 1e-9));
  CHECK(error(outcomes[0], "physical_strain") > 0);  // of the run itself
  CHECK(results.references().size() == 2);
}

TEST_CASE(
    "accuracy: runs that share a reference compute it once, and a resumed campaign does not repeat it") {
  const Results results;
  const std::string settings = strip + xpbd + R"(, "accuracy": {"solver": ["/solver/substeps=200"]},
                                                  "sweep": {"/solver/substeps": [1, 2, 3, 4]})";
  const Experiment experiment = parse_experiment(R"({"name": "errors", "defaults": "paper",
          )" + settings + "}",
                                                 "test");
  std::vector<RunOutcome> outcomes(experiment.runs.size());
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      threads.emplace_back(
          [&, i] { outcomes[i] = execute_run(experiment, experiment.runs[i], results.folder); });
  }
  const auto made = results.references();
  REQUIRE(made.size() == 1);
  for (const RunOutcome& outcome : outcomes) CHECK(error(outcome, "solver_rms") > 0);

  const RunRecord reference =
      read_run(results.folder / "errors" / "references" / made.begin()->first / "run.vtkhdf");
  CHECK(reference.status == RunStatus::complete);

  fs::remove(outcomes[1].file);  // as if the campaign had been interrupted there
  const RunOutcome again = execute_run(experiment, experiment.runs[1], results.folder);
  CHECK_FALSE(again.reused);
  CHECK(again.summary == outcomes[1].summary);
  CHECK(results.references() == made);
  CHECK(execute_run(experiment, experiment.runs[0], results.folder).reused);
}

TEST_CASE("accuracy: a run that is stopped at its reference is not complete") {
  const Results results;
  const Experiment experiment =
      parse_experiment(R"({"name": "errors", "defaults": "paper", )" + strip +
                           R"(, "solver": {"dt": 3}, "accuracy": {"solver": ["/solver/dt=0.001"]}})",
                       "test");
  // The run takes only one step, so its last call of `progress` comes before the reference.
  std::atomic<bool> stop = false;
  const RunControl control{.stop = &stop, .progress = [&](double, double) { stop = true; }};
  const RunOutcome outcome = execute_run(experiment, experiment.runs[0], results.folder, control);
  CHECK(outcome.status == RunStatus::interrupted);
  CHECK_THAT(outcome.message, ContainsSubstring("references"));
  stop = false;
  CHECK(error(execute_run(experiment, experiment.runs[0], results.folder), "solver_rms") > 0);
}

TEST_CASE("accuracy: with start_from_end the reference is the equilibrium nearest to the end of the run") {
  // A round cloth on a round table hangs in folds, and the folds depend on the motion before.
  const std::string drape =
      R"("duration": 3, "mesh": {"generator": "disc", "radius": 0.15, "cells": 10},
      "pins": {"vertices": ["centre"], "ring": 6}, "initial": {"perturbation": 0.001},
      "bending": {"model": "discrete_shells", "stiffness": "physical", "flexural_rigidity": 1.05584e-05},
      "material": {"density": 0.1629, "strain": {"stiffness": "compliance", "compliance": 0.001}},
      "effects": [{"type": "gravity"}, {"type": "viscous_drag", "coefficient": 2}],
      "output": {"frames_per_second": 2},
      "solver": {"iterations": 1, "sweep": "symmetric", "precision": "double", "substeps": 64})";
  const Results results;
  const std::vector<RunOutcome> outcomes = results.run(
      drape + R"(, "accuracy": {"solver": ["/solver={\"method\": \"equilibrium\"}", "/duration=10"]},
                  "sweep": {"/accuracy/start_from_end": [true, false]})");
  const double own = error(outcomes[0], "solver_rms"), other = error(outcomes[1], "solver_rms");
  CHECK(own < 0.005);  // two ways to the same equilibrium
  CHECK(other > 2 * own);
  CHECK(results.references().size() == 2);
}

TEST_CASE("accuracy: an impossible reference is an error of the config or a message of the run") {
  const std::string k = R"("duration": 0.1, "mesh": {"cells": 4})";
  CHECK_THAT(config_error(k + R"(, "accuracy": {"solver": ["/mesh/cels=3"]})"),
             ContainsSubstring("/accuracy/solver") && ContainsSubstring("/mesh/cells"));
  CHECK_THAT(config_error(k + R"(, "accuracy": {"solver": )" + equilibrium + "}"),
             ContainsSubstring("k has no energy"));
  CHECK_THAT(config_error(k + R"(, "accuracy": {"physical_coarser": ["/mesh/cells=3"]})"),
             ContainsSubstring("/accuracy/physical_coarser") && ContainsSubstring("in /accuracy/physical"));
  CHECK_THAT(config_error(strip + R"(, "accuracy": {"over_time": true, "solver": )" + equilibrium + "}"),
             ContainsSubstring("no motion"));
  CHECK_THAT(
      config_error(
          k + R"(, "accuracy": {"over_time": true, "start_from_end": true, "solver": ["/solver/dt=0.01"]})"),
      ContainsSubstring("/accuracy/start_from_end"));

  for (const char* nothing : {R"("over_time": true)", R"("start_from_end": true)"})
    CHECK_THAT(config_error(k + R"(, "accuracy": {)" + nothing + "}"),
               ContainsSubstring("nothing to compare with"));
  CHECK_THAT(config_error(k + R"(, "accuracy": {"solver": ["/solver/substeps=1"]})"),
             ContainsSubstring("/accuracy/solver") && ContainsSubstring("changes nothing"));
  for (const std::string section : {"sweep", "expect", "accuracy"})
    CHECK_THAT(config_error(k + R"(, "accuracy": {"solver": ["/mesh/cells=3", "/)" + section + R"(={}"]})"),
               ContainsSubstring("/" + section) && ContainsSubstring("remove"));
  CHECK_THROWS_WITH(
      run_id(parse_experiment(R"({"name": "errors", "defaults": "paper", )" + k +
                                  R"(, "accuracy": {"physical": ["/mesh={\"file\": \"nothing.obj\"}"]}})",
                              "test")
                 .runs.front()),
      ContainsSubstring("/accuracy/physical") && ContainsSubstring("nothing.obj"));

  const Results results;
  // If the reference is possible for a part of the sweep, the other runs state the reason why not.
  const std::vector<RunOutcome> mixed =
      results.run(strip + xpbd + R"(, "accuracy": {"solver": )" + equilibrium +
                  R"(}, "sweep": {"/bending": [
                     {"model": "dihedral", "stiffness": "k"},
                     {"model": "dihedral", "stiffness": "physical", "flexural_rigidity": 0.0015696}]})");
  CHECK_THAT(mixed[0].message, ContainsSubstring("/accuracy/solver") && ContainsSubstring("k has no energy"));
  CHECK(is_whole(mixed[0].status));
  CHECK_FALSE(mixed[0].summary.contains("error_solver_rms"));
  CHECK(error(mixed[1], "solver_rms") > 0);

  const auto message_with = [&](const std::string& accuracy) {
    const RunOutcome outcome = results.run_one(k + R"(, "accuracy": {)" + accuracy + "}");
    CHECK(outcome.status == RunStatus::complete);
    CHECK_FALSE(outcome.summary.contains("error_physical_rms"));
    return outcome.message;
  };
  CHECK_THAT(message_with(R"("physical": ["/mesh/width=0.4"])"),
             ContainsSubstring("/accuracy/physical: ") && ContainsSubstring("outside"));
  CHECK_THAT(message_with(R"("physical": ["/mesh/width=3", "/mesh/cells=30"])"),
             ContainsSubstring("different outlines"));
  CHECK_THAT(message_with(R"("physical": ["/pins/indices=[99]"])"), ContainsSubstring("vertex 99"));
  {
    const WithoutTraps infinite;  // on purpose
    CHECK_THAT(message_with(R"("physical": ["/initial/velocity=[0, 0, 1e30]"])"),
               ContainsSubstring("the reference diverged"));
  }
  const std::string over =
      R"("over_time": true, "physical": ["/output/frames_per_second=0.1", "/duration=0.05"])";
  CHECK_THAT(message_with(over), ContainsSubstring("no recorded frame"));

  // The reference has too few steps for Newton's method. The run is compared with it nevertheless, and
  // reports this.
  const RunOutcome unbalanced = results.run_one(strip + R"(, "solver": {"method": "equilibrium"},
      "accuracy": {"solver": ["/solver={\"method\": \"equilibrium\"}", "/duration=0.05"]})");
  CHECK_THAT(unbalanced.message,
             ContainsSubstring("/accuracy/solver: ") && ContainsSubstring("unbalanced forces"));
  CHECK(error(unbalanced, "solver_unbalanced") > 1e-7);
  CHECK(error(unbalanced, "solver_rms") > 0);
}

TEST_CASE("accuracy: a run that diverged has no errors") {
  const WithoutTraps infinite;  // on purpose
  const Results results;
  const RunOutcome outcome = results.run_one(
      R"("duration": 0.1, "mesh": {"cells": 4}, "initial": {"velocity": [0, 0, 1e30]},
         "accuracy": {"physical": ["/initial/velocity=[0, 0, 0]"]})");
  CHECK(outcome.status == RunStatus::diverged);
  for (const auto& [name, value] : outcome.summary) CHECK_FALSE(name.starts_with("error_"));
  CHECK(results.references().empty());
}

TEST_CASE("accuracy: motion and its energy are compared at common times") {
  // A free sheet without gravity keeps its velocity. The reference starts twice as fast, so the two are v t
  // apart, at 0.1, 0.2 and 0.3 s.
  const Results results;
  const RunOutcome outcome = results.run_one(
      R"("duration": 0.3, "mesh": {"cells": 4}, "pins": {"vertices": []}, "effects": [],
         "material": {"density": 2}, "initial": {"velocity": [0, 0, 0.1]},
         "output": {"frames_per_second": 10}, "solver": {"dt": 0.01, "precision": "double"},
         "accuracy": {"over_time": true, "solver": ["/initial/velocity=[0, 0, 0.2]", "/solver/dt=0.005"],
                      "solver_coarser": ["/initial/velocity=[0, 0, 0.25]"]})");
  const double size = std::numbers::sqrt2;
  CHECK(error(outcome, "solver_frames") == 3);
  const double drift = 1e-9;  // of positions after 60 steps, by rounding
  CHECK_THAT(error(outcome, "solver_rms"), WithinAbs(0.1 * 0.2 / size, drift));
  CHECK_THAT(error(outcome, "solver_rms_worst"), WithinAbs(0.1 * 0.3 / size, drift));
  CHECK_THAT(error(outcome, "solver_reference_gap"), WithinAbs(0.05 * 0.2 / size, drift));
  CHECK_THAT(error(outcome, "solver_energy"), WithinAbs(0, drift));  // both keep their energy
}

TEST_CASE("accuracy: with alignment, a sheet turned about its pin has no error") {
  // The sheet spins about its pinned centre to the left or to the right. Both poses are equal, except for a
  // turn about the vertical.
  const std::string sheet =
      R"("duration": 0.2, "mesh": {"cells": 4}, "pins": {"vertices": ["centre"], "ring": 0},
      "effects": [], "solver": {"precision": "double"}, "initial": {"spin": [0, 0, 2]})";
  const Results results;
  const auto rms = [&](const std::string& align) {
    return error(results.run_one(sheet + R"(, "accuracy": {"align": ")" + align +
                                 R"(", "solver": ["/initial/spin=[0, 0, -2]"]})"),
                 "solver_rms");
  };
  CHECK(rms("none") > 0.05);
  CHECK_THAT(rms("vertical"), WithinAbs(0, 1e-3));  // left and right differ slightly because of the diagonals
  CHECK_THAT(rms("rigid"), WithinAbs(0, 1e-3));
}

TEST_CASE("accuracy: the id of a run depends on its references, and on alignment only if it has references") {
  const auto id = [](const std::string& accuracy) {
    return run_id(parse_experiment(R"({"name": "id", "defaults": "paper",
          "mesh": {"cells": 4}, "accuracy": {)" +
                                       accuracy + "}}",
                                   "test")
                      .runs.front());
  };
  CHECK(id("") == id(R"("align": "rigid", "solver": [])"));
  CHECK(id("") != id(R"("solver": ["/solver/dt=0.01"])"));
  CHECK(id(R"("solver": ["/solver/dt=0.01"])") != id(R"("solver": ["/solver/dt=0.02"])"));
  CHECK(id(R"("solver": ["/solver/dt=0.01"])") != id(R"("physical": ["/solver/dt=0.01"])"));
  CHECK(id(R"("solver": ["/solver/dt=0.01"])") != id(R"("solver": ["/solver/dt=0.01"], "align": "rigid")"));
}

TEST_CASE("accuracy: the memory of the solver is counted") {
  // By hand: a sheet of 3 × 3 vertices and 8 triangles without pins. In single precision a point has 4
  // floats. There are at least three arrays of points, three arrays of the parts that floats cannot hold
  // (four if moves are stored apart, as with 64 substeps), the rest shape, and masses in double precision.
  const auto bytes = [](const std::string& settings) {
    const std::string config = R"({"name": "memory", "defaults": "paper",
          "bending": {"model": "crossover"}, )" +
                               settings + "}";
    const BuiltScene scene = build_scene(parse_experiment(config, "test").runs.front().scene());
    return static_cast<double>(simulation_of(scene)->memory_bytes());
  };
  CHECK(bytes(R"("mesh": {"cells": 2})") > 9 * (7 * 16 + 8));
  CHECK(bytes(R"("mesh": {"cells": 2}, "solver": {"substeps": 64})") > 9 * (8 * 16 + 8));
  // Without the effect of padding, four times as many vertices take four times as much memory. By hand, bytes
  // per vertex in single and in double precision: points 112 and 128 (seven arrays of floats, eight if moves
  // are stored apart, or four arrays of doubles) and a mass of 8; two triangles of 3 indices and 4 numbers,
  // 56 and 88; three springs with 1¼ indices and a length, 27 and 39; the order, 20. The sums are 223 or 239,
  // and 283.
  const double small = bytes(R"("mesh": {"cells": 40})"), large = bytes(R"("mesh": {"cells": 80})");
  CHECK_THAT(large / small, WithinRel(4, 0.15));
  const double in_double = bytes(R"("mesh": {"cells": 80}, "solver": {"precision": "double"})");
  CHECK_THAT(in_double / large, WithinRel(283.0 / 223, 0.03));  // except for padding
  const double apart = bytes(R"("mesh": {"cells": 80}, "solver": {"substeps": 64})");
  CHECK_THAT(in_double / apart, WithinRel(283.0 / 239, 0.03));
}

}  // namespace bendlab::accuracy_test
