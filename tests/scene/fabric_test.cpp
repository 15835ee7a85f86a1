// Fabrics in motion and at rest: directions, moments that are not linear, maps and keyframes, against closed
// forms.
#include "bendlab/scene/fabrics.hpp"

#include <png.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "bendlab/scene/energy.hpp"
#include "bendlab/scene/fabric_files.hpp"
#include "bendlab/scene/maps.hpp"
#include "bendlab/scene/scene_json.hpp"
#include "bendlab/scene/simulate.hpp"
#include "bendlab/settings/archive.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::fabric_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
namespace fs = std::filesystem;

constexpr double length = 0.1, width = 0.02, rigidity = 2e-5;

// A strip that is clamped at its left end and bent by a moment per width at its right end, without gravity.
// `cells`: along the free length; two more are clamped.
Scene bent_strip(double moment, int cells = 20) {
  Scene scene;
  scene.mesh = grid(length + 2 * length / cells, width, cells + 2, Diagonal::alternating);
  scene.pins.vertices = {Place::left}, scene.pins.distance = 2.001 * length / cells;
  scene.bending.model = MidEdge{};
  scene.bending.flexural_rigidity = rigidity;
  scene.effects = {EdgeMoment{.vertices = {Place::right}, .moment = moment * width}};
  scene.solver.method = Equilibrium{};
  scene.duration = 60;
  return scene;
}

// The curvature of the middle of the strip, from three points on its centre line a quarter of its length
// apart.
double curvature(const Cloth& cloth) {
  const RestMesh& rest = cloth.scene().rest;
  const Positions positions = cloth.positions();
  const auto at = [&](double along) {
    const double x = rest.box_max().x() - length * (1 - along), y = rest.centre().y();
    int nearest = 0;
    for (int v = 1; v < rest.vertex_count(); ++v)
      if ((rest.position(v) - Vector3(x, y, 0)).norm() < (rest.position(nearest) - Vector3(x, y, 0)).norm())
        nearest = v;
    return Vector3(positions.row(nearest).transpose());
  };
  const Vector3 a = at(0.3), b = at(0.5), c = at(0.7);
  // Menger's curvature: 4 area / (product of the sides).
  return 2 * (b - a).cross(c - a).norm() / ((b - a).norm() * (c - b).norm() * (a - c).norm());
}

// A folder that is removed when the tests end.
const fs::path& folder() {
  static const struct Folder {
    fs::path path = fs::temp_directory_path() / ("bendlab fabric test " + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
  } made;
  return made.path;
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

std::string refusal(Scene scene) {
  try {
    simulate(std::move(scene));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a strip that softens has the curvature of the closed form under an end moment", "[scene]") {
  // M = B κ / (1 + κ / κ½), so κ = M / (B - M / κ½).
  constexpr double half_at = 40, moment = 3e-4;
  const double expected = moment / (rigidity - moment / half_at), linear = moment / rigidity;
  Scene scene = bent_strip(moment);
  Cloth straight = simulate(scene);
  straight.run(60);
  // The long sides of a strip of 4 cells bend a little less than its middle, as in the linear strip.
  CHECK_THAT(curvature(straight) / linear, WithinAbs(1, 0.02));
  scene.bending.softening.half_at = half_at;
  Cloth soft = simulate(scene);
  soft.run(60);
  CHECK_THAT(curvature(soft) / expected, WithinAbs(1, 0.03));
  // A table with many points of the same law.
  scene.bending.softening = {};
  for (int k = 1; k <= 40; ++k) {
    const double at = k;
    scene.bending.softening.curvatures.push_back(at);
    scene.bending.softening.moments.push_back(rigidity * at / (1 + at / half_at));
  }
  scene.bending.flexural_rigidity = scene.bending.softening.moments.front();
  Cloth by_table = simulate(scene);
  by_table.run(60);
  CHECK_THAT(curvature(by_table) / curvature(soft), WithinAbs(1, 0.01));
}

TEST_CASE("every method that takes elements comes to the same softened rest", "[scene]") {
  Scene scene = bent_strip(2e-4, 10);
  scene.bending.softening.half_at = 40;
  Cloth equilibrium = simulate(scene);
  equilibrium.run(60);
  const double expected = curvature(equilibrium);
  // The slowest mode has ω = 3.5 /s; a drag of 2 ρ ω damps it critically.
  scene.effects.push_back(ViscousDrag{.coefficient = 1});
  for (const Method& method : {Method(Newton{}), Method(QuasiNewton{})}) {
    INFO(method.name());
    Scene dynamic = scene;
    dynamic.solver.method = method, dynamic.solver.substeps = {}, dynamic.solver.iterations = {};
    dynamic.duration = 3;
    Cloth cloth = simulate(dynamic);
    cloth.run(3);
    CHECK_THAT(curvature(cloth) / expected, WithinAbs(1, 0.05));
  }
}

TEST_CASE("a strip with internal friction keeps at most HB/B when it is let go", "[scene]") {
  // Bent to M = B κ + HB and let go slowly: B κ_left + friction = 0. Friction reverses by 2 HB at most.
  constexpr double friction = 1e-4, slip = 1, most = 4e-4;  // HB / B is 5 /m
  Scene scene = bent_strip(most, 10);
  EdgeMoment load{.vertices = {Place::right}, .moment = most * width};
  load.times = {0, 1, 2, 4}, load.factors = {0, 1, 0, 0};
  // The strip is so light that its slowest mode (ω = 110 /s) follows the moment. The drag damps this mode
  // critically. Nothing stretches the membrane; it is soft, so that quasi_newton converges.
  scene.material.density = 2e-4;
  scene.material.strain.stiffness = Stiffness::physical, scene.material.strain.membrane_stiffness = 20;
  scene.effects = {load, ViscousDrag{.coefficient = 0.04}};
  scene.bending.hysteresis = {.hb = friction, .slip = slip};
  scene.duration = 4;
  scene.solver.dt = 1.0 / 60, scene.solver.substeps = 1;
  // In quasi_newton (and pbd) batches of elements yield, in single precision; in newton (and vbd) lists.
  for (const auto& [method, iterations] : {std::pair<Method, int>{Newton{}, 20},
                                           {QuasiNewton{.membrane = QuasiNewton::Membrane::stated}, 200}}) {
    INFO(method.name());
    scene.solver.method = method, scene.solver.iterations = iterations;
    Cloth cloth = simulate(scene);
    cloth.run(1);
    // Bent for the first time: M = B κ + HB beyond the slip.
    CHECK_THAT(curvature(cloth), WithinRel((most - friction) / rigidity, 0.05));
    cloth.run(3);
    // Unbending from κ1, friction falls along the slope HB/slip from +HB; at M = 0 it is -B κ. The elastic
    // part is larger than HB here, so friction has reversed fully: B κ = HB.
    CHECK_THAT(curvature(cloth), WithinRel(friction / rigidity, 0.05));
  }
}

TEST_CASE("a checkpoint keeps folds, friction and the factor over time", "[scene]") {
  struct Law {
    const char* name;
    void (*add)(Scene& scene);
    void (*remove)(Scene& scene);
  };
  const std::array laws = {
      Law{"plasticity", [](Scene& s) { s.bending.plasticity = {.yield_at = 5, .hardening = 0.2}; },
          [](Scene& s) { s.bending.plasticity = {}; }},
      Law{"hysteresis", [](Scene& s) { s.bending.hysteresis = {.hb = 1e-4, .slip = 1}; },
          [](Scene& s) { s.bending.hysteresis = {}; }},
      Law{"over_time",
          [](Scene& s) {
            s.bending.over_time = {.times = {0.1, 0.3}, .factors = {1, 4}};
          },
          [](Scene& s) { s.bending.over_time = {}; }}};
  const std::array models = {BendingModel(MidEdge{}), BendingModel(DiscreteShells{})};
  const std::array methods = {Method(Newton{}), Method(QuasiNewton{}), Method(Pbd{}), Method(Vbd{})};
  for (std::size_t l = 0; l < laws.size(); ++l)
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Law& law = laws[l];
      const Method& method = methods[m];
      const BendingModel& model = models[(l + m) % 2];  // every pair of law, method and model occurs
      INFO(law.name << " " << model.name() << " " << method.name());
      Scene scene = bent_strip(4e-4, 6);
      scene.effects.push_back(ViscousDrag{.coefficient = 5});
      scene.bending.model = model;
      law.add(scene);
      scene.solver.method = method, scene.solver.substeps = {}, scene.solver.iterations = {};
      scene.duration = 0.3;
      Cloth whole = simulate(scene), first = simulate(scene), second = simulate(scene);
      whole.run(0.3);
      first.run(0.2);
      Scene elastic = scene;
      law.remove(elastic);
      Cloth without = simulate(elastic);
      without.run(0.2);
      CHECK(first.positions() != without.positions());  // the law has acted before the stop
      Archive written;
      first.simulation().archive(written);
      Archive read(written.bytes());
      second.simulation().archive(read);
      second.run(0.1);
      CHECK(whole.positions() == second.positions());
    }
}

TEST_CASE("settings that state the rigidity twice, or lack a part, are refused", "[scene]") {
  const auto with = [](const auto& change) {
    Scene scene = bent_strip(1e-4);
    scene.solver.method = QuasiNewton{};
    change(scene);
    return refusal(scene);
  };
  CHECK_THAT(with([](Scene& s) {
               s.bending.softening = {.half_at = {}, .curvatures = {10, 20}, .moments = {1e-4, 2e-4}};
               s.bending.rigidity = {.warp = 1e-5, .weft = 1e-5, .bias = {}};
             }),
             ContainsSubstring("/bending/softening/curvatures"));
  CHECK_THAT(with([](Scene& s) { s.bending.plasticity.hardening = 0.5; }),
             ContainsSubstring("/bending/plasticity/yield_at"));
  CHECK_THAT(with([](Scene& s) { s.bending.map.property = "stiff"; }),
             ContainsSubstring("/bending/map/file"));
}

TEST_CASE("a warp that is perpendicular to the sheet is refused if the stiffness depends on it", "[scene]") {
  Scene scene = bent_strip(1e-4);
  scene.material.warp_direction = {0, 0, 1};
  CHECK_NOTHROW(simulate(scene));
  scene.bending.rigidity = {.warp = 2e-5, .weft = 1e-5, .bias = {}}, scene.bending.flexural_rigidity.reset();
  CHECK_THAT(refusal(scene), ContainsSubstring("/material/warp_direction"));
  scene.material.warp_direction = {0, 1, 1};
  CHECK_NOTHROW(simulate(scene));
}

TEST_CASE("directors have the least energy in a fold, also with a moment that softens", "[scene]") {
  for (const bool softens : {false, true}) {
    INFO(softens);
    Scene scene;
    scene.mesh = grid(1, 1, 16, Diagonal::same);
    scene.pins.vertices = {Place::upper_left, Place::upper_right};
    scene.bending.model = MidEdge{}, scene.bending.flexural_rigidity = 1e-5;
    if (softens) scene.bending.softening.half_at = 30;
    scene.effects = {Gravity{}};
    Cloth cloth = simulate(scene);
    cloth.run(0.8);
    const SimulationInput& input = cloth.scene().input;
    const Points<double> forces = ElasticSystem(input).forces(input.points_at(cloth.positions()));
    const auto vertices = static_cast<std::size_t>(input.positions.rows());
    REQUIRE(forces.size() > vertices);
    double squared = 0;
    for (std::size_t d = vertices; d < forces.size(); ++d) squared += forces[d].vector().squaredNorm();
    // An energy E = 3e-4 J is known up to δ = 1e-16 E. With the stiffness k = 3e-3 N/m of a director, B over
    // the square of an edge, the force is then known up to √(2 k δ) = 1e-11 N.
    CHECK(std::sqrt(squared) < 1e-10);
  }
}

// Sheets that hang by their left side: the default method may soften a stiff membrane, but not a direction, a
// place or a time at which the membrane is soft anyway.
TEST_CASE("laws that change nothing leave all bits as they are", "[scene]") {
  const fs::path file = folder() / "ones.ply";
  write(file,
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
        "property double one\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "-1 -1 0 1\n1 -1 0 1\n1 1 0 1\n-1 1 0 1\n3 0 1 2\n3 0 2 3\n");
  for (const Method& method : {Method(Newton{}), Method(QuasiNewton{}), Method(Pbd{}), Method(Vbd{})})
    for (const BendingModel& model : {BendingModel(MidEdge{}), BendingModel(DiscreteShells{})}) {
      INFO(method.name() << " " << model.name());
      Scene plain = bent_strip(4e-4, 6);
      plain.solver.method = method, plain.bending.model = model, plain.duration = 0.1;
      Scene factor = plain, map = plain;
      factor.bending.over_time = {.times = {0}, .factors = {1}};
      map.bending.map = {.file = file.string(), .property = "one"};
      Cloth none = simulate(plain), with_factor = simulate(factor), with_map = simulate(map);
      none.run(0.1), with_factor.run(0.1), with_map.run(0.1);
      CHECK(none.positions() == with_factor.positions());
      CHECK(none.positions() == with_map.positions());
    }
}

TEST_CASE("a fabric softens along its warp at the measured curvature", "[scene]") {
  const Fabric& fabric = *find_fabric("feng_12");
  ConfigProblems problems;
  Scene scene = read_scene(
      Json::parse(R"({"material": {"fabric": "feng_12"}, "bending": {"model": "mid_edge"}})"), {}, problems);
  REQUIRE(problems.empty());
  scene.mesh = grid(0.02, 0.02, 24, Diagonal::alternating);
  scene.pins.vertices.clear();
  Scene linear = scene;
  linear.bending.softening = {};
  const BuiltScene soft = build_scene(scene), stiff = build_scene(linear);
  const auto moment = [&](const BuiltScene& built) {
    const auto energy = [&](double curvature) {
      return bending_energy(built.input, test::bent(built.rest, curvature, -std::numbers::pi / 2));
    };
    const double step = 1e-3 * fabric.half_at;
    return (energy(fabric.half_at + step) - energy(fabric.half_at - step)) / (2 * step);
  };
  // The border of 24 cells, a twelfth of the sheet, sees less curvature and softens less.
  CHECK_THAT(moment(soft) / moment(stiff), WithinAbs(0.5, 0.03));
}

TEST_CASE("a membrane that is soft in a direction or at a time is not softened further", "[scene]") {
  const auto stretch = [](const Method& method, const auto& change) {
    Scene scene;
    scene.mesh = grid(0.5, 0.1, 12, Diagonal::alternating);
    scene.pins.vertices = {Place::left};
    scene.bending.model = DiscreteShells{}, scene.bending.flexural_rigidity = 1e-5;
    scene.bending.stiffness = Stiffness::physical;
    scene.effects = {Gravity{.acceleration = {9.81, 0, 0}}, ViscousDrag{.coefficient = 1}};
    scene.material.strain.stiffness = Stiffness::physical;
    scene.solver.method = method, scene.duration = 3;
    change(scene);
    Cloth cloth = simulate(scene);
    cloth.run(3);
    return (cloth.positions().col(0).maxCoeff() - cloth.positions().col(0).minCoeff()) / 0.5;
  };
  const auto along = [](Scene& s) { s.material.strain.membrane = {.warp = 20, .weft = 1e4, .shear = 20}; };
  const auto over_time = [](Scene& s) {
    s.material.strain.membrane_stiffness = 1000;
    s.material.strain.over_time = {.times = {0, 1}, .factors = {1, 0.01}};
  };
  // W = ρ g a strain of about W L / 2 Y at the rest: 1.962 N/m² times 0.25 m over 20 or 10 N/m.
  CHECK_THAT(stretch(QuasiNewton{}, along), WithinAbs(1 + 1.962 * 0.25 / 20, 0.005));
  CHECK_THAT(stretch(Pbd{}, along), WithinAbs(1 + 1.962 * 0.25 / 20, 0.005));
  CHECK_THAT(stretch(QuasiNewton{}, over_time), WithinAbs(1 + 1.962 * 0.25 / 10, 0.005));
}

TEST_CASE("an equilibrium has no internal friction and no plastic folds", "[scene]") {
  Scene scene = bent_strip(1e-4);
  scene.bending.hysteresis = {.hb = 1e-4};
  CHECK_THAT(refusal(scene), ContainsSubstring("/bending/hysteresis") && ContainsSubstring("quasi_newton"));
  scene.bending.hysteresis = {}, scene.bending.plasticity = {.yield_at = 10};
  CHECK_THAT(refusal(scene), ContainsSubstring("/bending/plasticity") && ContainsSubstring("quasi_newton"));
}

TEST_CASE("a map of the rigidity bends a strip in steps", "[scene]") {
  // The half at the clamp has 3 B: under an end moment its curvature is a third.
  const fs::path file = folder() / "step.ply";
  write(file,
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty double stiff\nend_header\n"
        "-1 -1 0\n0 -1 0\n1 -1 0\n-1 1 0\n0 1 0\n1 1 0\n4 0 1 4 3 3\n4 1 2 5 4 1\n");
  constexpr double moment = 2e-4;
  constexpr int cells = 20;
  Scene scene = bent_strip(moment);
  scene.mesh = grid(length, width, cells, Diagonal::alternating);
  scene.pins.distance = 2.001 * length / cells;
  scene.bending.map = {.file = file.string(), .property = "stiff"};
  Cloth cloth = simulate(scene);
  cloth.run(60);
  const Positions p = cloth.positions();
  const auto turn = [&](double from, double to) {  // of the centre line between two places, rad
    const auto tangent = [&](double x) {
      std::vector<int> near;
      for (const double at : {x - length / cells, x + length / cells})
        for (int v = 0; v < cloth.scene().rest.vertex_count(); ++v)
          if ((cloth.scene().rest.position(v) - Vector3(at, 0, 0)).norm() < 1e-6) near.push_back(v);
      REQUIRE(near.size() == 2);
      const Vector3 along = (p.row(near[1]) - p.row(near[0])).transpose();
      return std::atan2(along.z(), along.x());
    };
    return std::abs(tangent(to) - tangent(from)) / std::abs(to - from);
  };
  const double cell = length / cells;
  CHECK_THAT(turn(2 * cell, 8 * cell), WithinRel(moment / rigidity, 0.03));
  CHECK_THAT(turn(-6 * cell, -2 * cell), WithinRel(moment / (3 * rigidity), 0.05));
}

TEST_CASE("maps that do not fit say what to do", "[scene]") {
  const fs::path file = folder() / "other.ply";
  write(file,
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "property float paint\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "5 5 0 1\n6 5 0 1\n5 6 0 0\n3 0 1 2\n");
  Scene scene = bent_strip(1e-4);
  scene.bending.map = {.file = file.string(), .property = "paint"};
  CHECK_THAT(refusal(scene), ContainsSubstring("belongs to another mesh"));
  scene.bending.map.property = "paints";
  CHECK_THAT(refusal(scene), ContainsSubstring("paint (vertex)"));
  scene.bending.map.property = "";
  CHECK_THAT(refusal(scene), ContainsSubstring("name the property"));
  scene.bending.map = {.file = (folder() / "missing.ply").string(), .property = "paint"};
  CHECK_THAT(refusal(scene), ContainsSubstring("missing.ply"));
  const fs::path text = folder() / "text.png";
  write(text, "no image");
  scene.bending.map = {.file = text.string()};
  CHECK_THAT(refusal(scene), ContainsSubstring("not a PNG"));
  scene.bending.map.property = "paint";
  CHECK_THAT(refusal(scene), ContainsSubstring("PNG image"));
  scene.bending.map = {.file = (folder() / "map.jpg").string()};
  CHECK_THAT(refusal(scene), ContainsSubstring("PLY"));
}

TEST_CASE("an image lies on a sheet with its first row at the top", "[scene]") {
  // Two by two pixels: black above, white below.
  const fs::path file = folder() / "halves.png";
  png_image image{};
  image.version = PNG_IMAGE_VERSION, image.width = 2, image.height = 2, image.format = PNG_FORMAT_GRAY;
  const std::array<unsigned char, 4> pixels = {0, 0, 255, 255};
  REQUIRE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr) != 0);
  Scene scene;
  scene.mesh = grid(1, 1, 16);
  scene.pins.vertices = {};
  scene.material.density_map = {.file = file.string(), .property = "", .low = 0.5, .high = 1.5};
  const BuiltScene built = simulate(scene).scene();
  double below = 0, above = 0;
  for (int v = 0; v < built.rest.vertex_count(); ++v)
    (built.rest.position(v).y() < built.rest.centre().y() ? below : above) +=
        built.input.mass[static_cast<std::size_t>(v)];
  // Halves of 0.625 and 0.375; the row of vertices in the middle counts as above.
  CHECK_THAT(below / above, WithinAbs(1.45, 0.05));
  // The grey is linear between the pixels' centres and repeats at the border, so its mean is a half.
  CHECK_THAT(below + above, WithinRel(scene.material.density, 1e-3));
}

TEST_CASE("maps belong to the mesh file, also if the scene scales and moves it", "[scene]") {
  // A square of 100 mm. The property grows from 1 to 3 along x, the image along its texture's v axis. Both
  // are linear, so a triangle's mean is the value at its centre.
  const fs::path painted = folder() / "painted.ply", mesh = folder() / "square.obj",
                 image_file = folder() / "ramp.png";
  write(painted,
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
        "property double paint\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 1\n100 0 0 3\n100 100 0 3\n0 100 0 1\n3 0 1 2\n3 0 2 3\n");
  // The texture is turned: its v axis lies along -x, inside the first and last centre of a pixel.
  write(mesh,
        "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nvt 0.5 0.75\nvt 0.5 0.25\n"
        "f 1/1 2/2 3/2\nf 1/1 3/2 4/1\n");
  png_image image{};
  image.version = PNG_IMAGE_VERSION, image.width = 2, image.height = 2, image.format = PNG_FORMAT_GRAY;
  const std::array<unsigned char, 4> pixels = {255, 255, 0, 0};  // v = 0.75 is white, v = 0.25 is black
  REQUIRE(png_image_write_to_file(&image, image_file.c_str(), 0, pixels.data(), 0, nullptr) != 0);
  Scene scene;
  scene.mesh.file = mesh.string(), scene.mesh.refine = 3;
  scene.mesh.scale = 1e-3, scene.mesh.offset = {5, -2, 1};
  const AcceptedMesh accepted = rest_mesh_of(scene.mesh, {});
  const RestMesh rest(accepted.mesh, accepted.named);
  const auto centre = [&](int t) {  // along x, over the square's side
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += rest.named_positions()(rest.triangles()(t, c), 0) - 5;
    return sum / 3 / 0.1;
  };
  const std::vector<double> by_paint = factors_of(
                                {.file = painted.string(), .property = "paint", .low = 0.0, .high = 1.0},
                                scene.mesh, rest, {}, "/bending/map"),
                            by_image =
                                factors_of({.file = image_file.string(), .property = "", .low = 2, .high = 4},
                                           scene.mesh, rest, {}, "/bending/map");
  REQUIRE(by_paint.size() == static_cast<std::size_t>(rest.triangle_count()));
  REQUIRE(by_image.size() == by_paint.size());
  for (int t = 0; t < rest.triangle_count(); ++t) {
    CHECK_THAT(by_paint[static_cast<std::size_t>(t)], WithinAbs(1 + 2 * centre(t), 1e-9));
    // A pixel has 8 bits, and the image is kept in single precision.
    CHECK_THAT(by_image[static_cast<std::size_t>(t)], WithinAbs(4 - 2 * centre(t), 1e-5));
  }
}

TEST_CASE("a stiffness that changes over time ends at the rest of its last value", "[scene]") {
  Scene scene = bent_strip(2e-4, 10);
  scene.effects.push_back(ViscousDrag{.coefficient = 1.5});
  scene.bending.over_time = {.times = {0.2, 0.8}, .factors = {1, 2.5}};
  scene.duration = 3;
  const double expected = 2e-4 / (2.5 * rigidity);
  for (const Method& method : {Method(Newton{}), Method(QuasiNewton{}), Method(Equilibrium{})}) {
    INFO(method.name());
    scene.solver.method = method, scene.solver.substeps = {}, scene.solver.iterations = {};
    Cloth cloth = simulate(scene);
    cloth.run(method.name() == "equilibrium" ? 60 : 3);
    CHECK_THAT(curvature(cloth), WithinRel(expected, 0.05));
  }
  // A constant factor is a stiffness: the same motion as with this stiffness.
  scene.solver.method = Newton{}, scene.duration = 0.3;
  scene.bending.over_time = {.times = {0}, .factors = {2}};
  Cloth scaled = simulate(scene);
  scaled.run(0.3);
  scene.bending.over_time = {};
  scene.bending.flexural_rigidity = 2 * rigidity;
  Cloth stated = simulate(scene);
  stated.run(0.3);
  CHECK((scaled.positions() - stated.positions()).cwiseAbs().maxCoeff() < 1e-7);  // Newton's tolerance
}

TEST_CASE("a square of woven cloth that lies on its centre has the two-fold symmetry of its rigidity",
          "[scene]") {
  // A mesh with four-fold symmetry. The load is so small that the sheet sags by a micrometre: a sheet that
  // sags by more than its thickness bends in one direction only.
  Scene scene;
  scene.mesh = grid(0.1, 0.1, 8, Diagonal::both);
  scene.pins.vertices = {Place::centre}, scene.pins.ring = 1;
  scene.effects = {Gravity{.acceleration = {0, 0, -1e-4}}};
  scene.bending.model = MidEdge{};
  scene.bending.rigidity = {.warp = 4e-5, .weft = 1e-5, .bias = 1.5e-5};
  scene.solver.method = Equilibrium{};
  scene.duration = 20;
  Cloth cloth = simulate(scene);
  cloth.run(20);
  std::swap(scene.bending.rigidity.warp, scene.bending.rigidity.weft);
  Cloth turned = simulate(scene);
  turned.run(20);
  const RestMesh& rest = cloth.scene().rest;
  const Vector3 centre = rest.centre();
  const auto depth = [&](const Cloth& of, double x, double y) {
    for (int v = 0; v < rest.vertex_count(); ++v)
      if ((rest.position(v) - centre - Vector3(x, y, 0)).norm() < 1e-9) return -of.positions()(v, 2);
    throw std::logic_error("no such vertex");
  };
  const double most = depth(cloth, 0, 0.05);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const Vector3 at = rest.position(v) - centre;
    const double here = depth(cloth, at.x(), at.y());
    CHECK_THAT(depth(cloth, -at.x(), -at.y()), WithinAbs(here, 1e-4 * most));  // the equilibrium's tolerance
    CHECK_THAT(depth(cloth, -at.x(), at.y()), WithinAbs(here, 1e-4 * most));
    CHECK_THAT(depth(turned, at.y(), at.x()), WithinAbs(here, 1e-4 * most));
  }
  CHECK(depth(cloth, 0.05, 0) < 0.5 * most);  // the warp is four times as stiff
}

TEST_CASE("a membrane by direction stretches by its own stiffness", "[scene]") {
  // Pulled along x by F per width, the strain is F/Y of the thread that lies along x.
  constexpr double force = 5;
  for (const bool along_warp : {true, false}) {
    Scene scene;
    scene.mesh = grid(0.1, 0.1, 8, Diagonal::alternating);
    scene.pins.vertices = {}, scene.pins.hold_x = {Place::left},
    scene.pins.hold_z = {Place::left, Place::right};
    scene.pins.hold_y = {Place::lower_left};
    scene.effects = {
        Load{.vertices = {Place::right}, .force = {force * 0.1, 0, 0}, .spread = Load::Spread::length}};
    scene.material.warp_direction = along_warp ? Vector3(1, 0, 0) : Vector3(0, 1, 0);
    scene.material.strain.membrane = {.warp = 1000, .weft = 250, .shear = 100};
    scene.solver.method = Equilibrium{};
    scene.duration = 60;
    Cloth cloth = simulate(scene);
    cloth.run(60);
    const double extent = cloth.positions().col(0).maxCoeff() - cloth.positions().col(0).minCoeff();
    CHECK_THAT(extent / 0.1 - 1, WithinRel(force / (along_warp ? 1000 : 250), 0.02));
  }
}

TEST_CASE("a fabric by name sets its numbers, and stated numbers replace them", "[scene]") {
  const auto read = [](const std::string& text) {
    ConfigProblems problems;
    const Scene scene = read_scene(Json::parse(text), {}, problems);
    for (const auto& problem : problems) UNSCOPED_INFO(problem.pointer << " " << problem.message);
    CHECK(problems.empty());
    return scene;
  };
  // Matsudaira and others 2015: 0.118 gf cm²/cm, 2HB 0.124 gf cm/cm, 12.38 mg/cm².
  const Scene broad = read(R"({"material": {"fabric": "cotton_broad"}})");
  CHECK_THAT(broad.material.density, WithinRel(0.1238, 1e-12));
  CHECK_THAT(*broad.bending.rigidity.warp, WithinRel(1.1572e-5, 1e-4));
  CHECK_THAT(*broad.bending.hysteresis.hb, WithinRel(6.080e-4, 1e-3));
  // HB/B is 52.5 /m.
  CHECK_THAT(*broad.bending.hysteresis.hb / *broad.bending.rigidity.warp, WithinRel(52.5, 2e-3));
  const Scene heavy = read(R"({"material": {"fabric": "cotton_broad", "density": 0.2}})");
  CHECK(heavy.material.density == 0.2);
  const Scene springs =
      read(R"({"material": {"fabric": "cotton_broad"}, "bending": {"model": "prestressed"}})");
  CHECK(!springs.bending.hysteresis.is_given());
  const Scene still =
      read(R"({"material": {"fabric": "cotton_broad"}, "solver": {"method": "equilibrium"}})");
  CHECK(!still.bending.hysteresis.is_given());
  const Scene folds =
      read(R"({"material": {"fabric": "feng_1"}, "bending": {"plasticity": {"yield_at": 50}}})");
  CHECK(!folds.bending.softening.is_given());
  const Scene curve = read(R"({"material": {"fabric": "feng_1"},
      "bending": {"softening": {"curvatures": [10, 100], "moments": [1e-4, 4e-4]}}})");
  CHECK((!curve.bending.softening.half_at && !curve.bending.rigidity.is_given()));
  const Scene shell = read(R"({"material": {"fabric": "feng_1", "youngs_modulus": 1e6, "thickness": 5e-4}})");
  CHECK(!shell.bending.rigidity.is_given());
  CHECK(read(R"({"material": {"fabric": "cotton_broad"},
      "bending": {"model": "mid_edge", "discrete_shells": {"measure": "tan"}}})")
            .bending.hysteresis.is_given());
  for (const Fabric& fabric : fabrics()) {
    INFO(fabric.name);
    CHECK(!fabric.source.empty());
    CHECK_NOTHROW(orthotropic_rigidity(fabric.warp, fabric.weft, fabric.bias, 0));
    // Between silk and denim (0.02 to 0.6 kg/m²), and between 0.1 and 1000 µN m.
    CHECK((fabric.density > 0.02 && fabric.density < 0.6));
    CHECK((fabric.warp > 1e-7 && fabric.warp < 1e-3));
    CHECK_NOTHROW(
        read(R"({"mesh": {"cells": 4}, "material": {"fabric": ")" + std::string(fabric.name) + "\"}}"));
  }
}

TEST_CASE("laboratory files become rigidities in SI", "[scene]") {
  // The four branches have different slopes, with the mean B = 0.1 gf cm²/cm. At 1 /cm, HB is 0.03 gf cm/cm
  // on the face and 0.01 on the back.
  std::string loop = "K (1/cm), M (gf cm/cm)\n";
  const auto add = [&](double from, double to, double slope, double friction) {
    const double side = from + to > 0 ? 1 : -1;
    for (int k = 0; k <= 100; ++k) {
      const double at = from + (to - from) * k / 100;
      loop += std::to_string(at) + ", " + std::to_string(side * 0.1 + slope * (at - side) + friction) + "\n";
    }
  };
  add(0, 2.5, 0.14, 0.03), add(2.5, 0, 0.06, -0.03), add(0, -2.5, 0.11, -0.01), add(-2.5, 0, 0.09, 0.01);
  const fs::path kes = folder() / "kes.csv", astm = folder() / "astm.csv", arcsim = folder() / "arcsim.json";
  write(kes, loop);
  const BendingMeasurement measured = kes_bending(kes);
  CHECK_THAT(measured.rigidity, WithinRel(0.1 * 9.80665e-5, 1e-3));  // six digits in the file
  CHECK_THAT(measured.friction, WithinRel(0.02 * 9.80665e-3, 1e-3));
  write(kes, "0.1 0.2\n0.2 0.3\n");
  CHECK_THROWS_WITH(kes_bending(kes), ContainsSubstring("needs 3"));
  write(astm, "direction,overhang\nwarp 50\nwarp 52\nweft 40\n");
  const std::vector<BendingLengths> lengths = astm_bending_lengths(astm);
  REQUIRE(lengths.size() == 2);
  CHECK_THAT(lengths[0].length, WithinRel(0.0255, 1e-12));
  CHECK_THAT(lengths[0].uncertainty, WithinRel(0.0005, 1e-9));  // two values 25 and 26 mm: s/√2
  for (const auto& [text, cause] : {std::pair{"", "no numbers"},
                                    {"1/cm gf\n0.5 0.06\n0,7;0,08\n", "line 3"},
                                    {"0 0\n50 0.1\n100 0.2\n", "in 1/m"},
                                    {"0.5 0.06\n1 0.1\n1.5 0.15\n2 0.2\n", "whole loop"}}) {
    write(kes, text);
    CHECK_THROWS_WITH(kes_bending(kes), ContainsSubstring(cause));
  }
  write(astm, "warp;45,5\nweft;40,2\n");
  CHECK_THROWS_WITH(astm_bending_lengths(astm), ContainsSubstring("decimal point"));
  write(astm, "warp -3\n");
  CHECK_THROWS_WITH(astm_bending_lengths(astm), ContainsSubstring("line 1"));
  write(arcsim,
        R"({"density": 0.2, "bending": [[4e-6, 1, 1, 1, 1], [8e-6, 1, 1, 1, 1], [12e-6, 1, 1, 1, 1]]})");
  const Json settings = arcsim_settings(arcsim);
  CHECK(settings["bending"]["rigidity"]["weft"] == 1e-6);
  CHECK(settings["bending"]["rigidity"]["warp"] == 3e-6);
  write(arcsim, "{}");
  CHECK_THROWS_WITH(arcsim_settings(arcsim), ContainsSubstring("density"));
}

}  // namespace bendlab::fabric_test
