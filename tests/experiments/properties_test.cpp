// Properties of every valid config, of every accepted mesh, and of every step after which a run is stopped.
// RapidCheck tries each property with a hundred random cases. It shrinks a failing case and prints it with
// the RC_PARAMS="seed=…" that repeats it. Without RC_PARAMS the cases are always the same.
#include <fmt/format.h>
#include <rapidcheck.h>
#include <stdlib.h>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "bendlab/io/without_traps.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/files.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "experiments/run/run_id.hpp"
#include "tests/catch.hpp"
#include "tests/io/run_fixture.hpp"
#include "tests/random_settings.hpp"

namespace bendlab::properties_test {
using bendlab::test::Random;
using bendlab::test::TemporaryFolder;

namespace {

template <class Property>
bool holds(const std::string& what, const Property& property) {
  ::setenv("RC_PARAMS", "seed=1", 0);  // unless the user has set RC_PARAMS
  return rc::check(what, property);
}

// A valid config with random settings: changes that would make the config invalid are left out.
std::string valid_config(const Json& base, const std::vector<std::uint64_t>& seeds) {
  Json config = base;
  for (const std::uint64_t seed : seeds) {
    Random random(seed);
    Json next = config;
    for (auto& [pointer, value] : test::random_changes(random)) set_at(next, pointer, std::move(value));
    try {
      parse_experiment(next.dump(), "generated");
      config = std::move(next);
    } catch (const ConfigError&) {
    }
  }
  return config.dump();
}

// Random changes to a config. They come from a list of seeds, which can be shortened until a failing config
// is small.
rc::Gen<std::string> config_like(Json base) {
  return rc::gen::map(rc::gen::resize(6, rc::gen::arbitrary<std::vector<std::uint64_t>>()),
                      [base = std::move(base)](const std::vector<std::uint64_t>& seeds) {
                        return valid_config(base, seeds);
                      });
}

// The settings of a run that takes milliseconds.
Json small_run() {
  return {{"name", "small"}, {"duration", 0.1}, {"mesh", {{"cells", 3}}}, {"solver", {{"substeps", 2}}}};
}

RunConfig single_run(const std::string& text) {
  const Experiment experiment = parse_experiment(text, "generated");
  RC_ASSERT(experiment.runs.size() == 1u);
  return experiment.runs.front();
}

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

// Requires that all numbers of a run are finite, or that it has another verdict than complete and a reason.
void require_finite_or_reported(const RunOutcome& outcome) {
  if (outcome.status == RunStatus::complete) {
    for (const auto& [name, value] : outcome.summary)
      if (!std::isfinite(value)) RC_FAIL(fmt::format("{} is {}", name, value));
    RC_ASSERT(all_finite(read_positions(outcome.file, -1)));
  } else {
    RC_ASSERT(outcome.status == RunStatus::implausible || outcome.status == RunStatus::diverged);
    RC_ASSERT(!outcome.message.empty());
  }
}

}  // namespace

TEST_CASE("properties: a valid config is read back from its resolved text", "[properties]") {
  CHECK(holds("resolved settings are a config of the same run", [] {
    const RunConfig run = single_run(*config_like({{"name", "any"}}));
    Json settings = run.resolved();
    settings["name"] = "again";
    for (const int indent : {-1, 2}) {
      const RunConfig again = single_run(settings.dump(indent));
      RC_ASSERT(again.resolved() == run.resolved());
      RC_ASSERT(run_id(again) == run_id(run));
    }
  }));
}

TEST_CASE("properties: a run of a valid config has finite numbers, or reports a reason", "[properties]") {
  const WithoutTraps overflow;  // some diverge
  CHECK(holds("a run of a valid config", [] {
    const RunConfig run = single_run(*config_like(small_run()));
    const TemporaryFolder folder;
    Experiment experiment;
    experiment.name = "small";
    // A valid setting may not fit the mesh: a flat sheet has no rim.
    try {
      const RunOutcome outcome = execute_run(experiment, run, folder / "");
      RC_CLASSIFY(outcome.status == RunStatus::complete);
      require_finite_or_reported(outcome);
    } catch (const ConfigError& error) {
      RC_ASSERT(!error.problems().empty());
    } catch (const MeshError&) {
    }
  }));
}

namespace {

using Point = std::array<double, 3>;

// A sheet of cells² cells. Vertices are moved by up to `rough` cells, the sheet is scaled, and then damaged
// in a number of places.
struct Soup {
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;
};

Soup random_soup(Random& random) {
  Soup soup;
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  const int cells = 1 + static_cast<int>(random() % 4), row = cells + 1;
  const double rough = std::array{0.0, 0.2, 0.9}[random() % 3], scale = std::pow(10, 3 * unit());
  for (int i = 0; i < row * row; ++i)
    soup.points.push_back(
        {scale * (i % row + rough * unit()), scale * (i / row + rough * unit()), scale * rough * unit()});
  for (int i = 0; i < cells * cells; ++i) {
    const int corner = i / cells * row + i % cells;
    soup.triangles.push_back({corner, corner + 1, corner + row + 1});
    soup.triangles.push_back({corner, corner + row + 1, corner + row});
  }
  const auto vertex = [&] { return static_cast<int>(random() % soup.points.size()); };
  const auto triangle = [&]() -> std::array<int, 3>& {
    return soup.triangles[random() % soup.triangles.size()];
  };
  for (std::size_t damages = random() % 5; damages > 0; --damages) switch (random() % 7) {
      case 0:  // two vertices at the same place
        soup.points[static_cast<std::size_t>(vertex())] = soup.points[static_cast<std::size_t>(vertex())];
        break;
      case 1:  // a triangle of random vertices
        soup.triangles.push_back({vertex(), vertex(), vertex()});
        break;
      case 2:  // a triangle turned over
        std::swap(triangle()[0], triangle()[1]);
        break;
      case 3:  // a hole
        if (soup.triangles.size() > 1) soup.triangles.erase(soup.triangles.begin() + vertex() % 2);
        break;
      case 4:  // a coordinate that is not finite or huge
        soup.points[static_cast<std::size_t>(vertex())][random() % 3] =
            std::array{std::numeric_limits<double>::quiet_NaN(), 1e300, -1e30, 1e9}[random() % 4];
        break;
      case 5:  // an index without a vertex
        triangle()[random() % 3] = static_cast<int>(soup.points.size() + random() % 2);
        break;
      default:  // a duplicate triangle
        soup.triangles.push_back(triangle());
    }
  return soup;
}

std::string text_of(const Soup& soup, std::string_view extension) {
  std::string text =
      extension == ".off"   ? fmt::format("OFF\n{} {} 0\n", soup.points.size(), soup.triangles.size())
      : extension == ".ply" ? fmt::format(
                                  "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty "
                                  "double y\nproperty double z\nelement face {}\nproperty list uchar int "
                                  "vertex_indices\nend_header\n",
                                  soup.points.size(), soup.triangles.size())
                            : "";
  const bool obj = extension == ".obj";
  for (const auto& [x, y, z] : soup.points) text += fmt::format("{}{} {} {}\n", obj ? "v " : "", x, y, z);
  for (const auto& [a, b, c] : soup.triangles)
    text += obj ? fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1) : fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

}  // namespace

TEST_CASE("properties: a run of an accepted mesh has finite numbers, or reports a reason", "[properties]") {
  const WithoutTraps overflow;  // some diverge
  CHECK(holds("a run of a mesh from a file", [](std::uint64_t seed) {
    Random random(seed);
    const TemporaryFolder folder;
    const std::string extension = test::one_of(random, std::array{".obj", ".ply", ".off"});
    const std::string text = text_of(random_soup(random), extension);
    RC_LOG(text);
    std::ofstream(folder / ("mesh" + extension)) << text;
    const BendingKind& model = *test::one_of(random, bending_models());
    const Json config = {
        {"name", "mesh"},
        {"duration", 0.1},
        {"mesh",
         {{"file", (folder / ("mesh" + extension)).string()},
          {"bad_triangles", test::one_of(random, bad_triangles_names)}}},
        {"pins", {{"vertices", test::chance(random, 0.5) ? Json{"upper_right"} : Json::array()}}},
        {"bending", {{"model", model.needs_energy ? "none" : model.name}, {"stiffness", "k"}, {"k", 0.3}}}};
    RC_LOG(config.dump());
    Experiment experiment;
    experiment.name = "mesh";
    try {
      const RunOutcome outcome = execute_run(experiment, single_run(config.dump()), folder / "");
      RC_CLASSIFY(outcome.status == RunStatus::complete);
      require_finite_or_reported(outcome);
    } catch (const MeshError& error) {
      RC_ASSERT(std::string(error.what()).find("can't be simulated") != std::string::npos);
    }
  }));
}

TEST_CASE("properties: a run stopped after any step continues with the same bits", "[properties]") {
  const WithoutTraps overflow;  // some diverge
  CHECK(holds("a stopped run", [] {
    Json base = small_run();
    base["output"] = {{"frames_per_second", 1000}, {"measures", {"stability"}}};
    const RunConfig run = single_run(*config_like(base));
    const int stop_after = *rc::gen::inRange(1, 7);
    const TemporaryFolder whole, stopped;
    Experiment experiment;
    experiment.name = "stopped";
    RunOutcome uninterrupted;
    try {
      uninterrupted = execute_run(experiment, run, whole / "");
    } catch (const std::exception&) {  // the config does not run at all: see above
      return;
    }
    std::atomic<bool> stop = false;
    int frames = 0;
    RunControl control{.stop = &stop, .progress = [&](double, double) { stop = ++frames >= stop_after; }};
    RunOutcome outcome = execute_run(experiment, run, stopped / "", control);
    RC_CLASSIFY(outcome.status == RunStatus::interrupted);
    if (outcome.status == RunStatus::interrupted) outcome = execute_run(experiment, run, stopped / "");
    RC_ASSERT(outcome.status == uninterrupted.status);
    RC_ASSERT(differing_parts(uninterrupted.file, outcome.file) == std::vector<std::string>());
  }));
}

}  // namespace bendlab::properties_test
