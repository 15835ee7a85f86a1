// Fits find the rigidities of shapes that another mesh and another model made, and refuse what a shape cannot
// tell.
#include "experiments/fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bendlab/scene/simulate.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::fit_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

// A strip that hangs from a clamp. `warp_along`: 1 if the strip is cut along the warp, 0 along the weft.
std::string strip(const std::string& mesh, const std::string& bending, int warp_along) {
  return R"({"name": "strip", "duration": 60, "mesh": {"width": 0.058, "height": 0.008, )" + mesh +
         R"(}, "pins": {"vertices": ["left"], "distance": 0.0081}, )" +
         R"("material": {"density": 0.15, "warp_direction": )" + (warp_along ? "[1, 0, 0]" : "[0, 1, 0]") +
         R"(}, "bending": )" + bending +
         R"(, "effects": [{"type": "gravity"}], "solver": {"method": "equilibrium"}})";
}

RunConfig run_of(const std::string& text) {
  return parse_experiment(text, "test").runs.front();
}

// Points along the middle of the strip at rest.
MeasuredShape shape_of(const std::string& text) {
  const RunConfig run = run_of(text);
  Cloth cloth = simulate(run.scene());
  cloth.run(run.scene().duration);
  const RestMesh& rest = cloth.scene().rest;
  std::vector<int> middle;
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (std::abs(rest.position(v).y() - rest.centre().y()) < 1e-6) middle.push_back(v);
  MeasuredShape shape{Positions(static_cast<Eigen::Index>(middle.size()), 3)};
  for (std::size_t i = 0; i < middle.size(); ++i)
    shape.points.row(static_cast<Eigen::Index>(i)) = cloth.positions().row(middle[i]);
  return shape;
}

const std::string fine = R"("cells": 58, "diagonal": "alternating")",
                  coarse = R"("cells": 29, "diagonal": "alternating")";
const std::string hidden = R"({"model": "dkt", "rigidity": {"warp": 2.4e-5, "weft": 0.9e-5}})",
                  guess = R"({"model": "mid_edge", "rigidity": {"warp": 1e-5, "weft": 1e-5}})";

}  // namespace

TEST_CASE("a fit finds warp and weft from strips of another mesh and model", "[fit][slow]") {
  FitProblem problem;
  for (const int along : {1, 0}) {
    problem.runs.push_back(run_of(strip(coarse, guess, along)));
    problem.shapes.push_back(shape_of(strip(fine, hidden, along)));
  }
  problem.pointers = {"/bending/rigidity/warp", "/bending/rigidity/weft"};
  const Fitted fitted = fit(problem);
  CHECK(fitted.is_known());
  CHECK_THAT(fitted.settings[0].value, WithinRel(2.4e-5, 0.01));
  CHECK_THAT(fitted.settings[1].value, WithinRel(0.9e-5, 0.01));
}

TEST_CASE("a fit refuses a setting that no shape depends on", "[fit]") {
  FitProblem problem;
  problem.runs.push_back(run_of(strip(coarse, guess, 1)));
  problem.shapes.push_back(shape_of(strip(coarse, guess, 1)));
  problem.pointers = {"/bending/rigidity/warp", "/bending/rigidity/weft"};
  problem.uncertainty = 2e-4;  // 0.2 mm
  const Fitted fitted = fit(problem);
  CHECK(fitted.settings[0].uncertainty < Fitted::known);
  CHECK(!(fitted.settings[1].uncertainty < Fitted::known));
  CHECK(!fitted.is_known());
  problem.pointers = {"bending/rigidity/warp"};
  CHECK_THROWS_WITH(fit(problem), ContainsSubstring("begins with a slash"));
  problem.pointers = {"/bending/rigidity/wrap"};
  CHECK_THROWS_WITH(fit(problem), ContainsSubstring("first guess"));
  problem.pointers = {"/bending/rigidity/warp"};
  problem.shapes.front().points.conservativeResize(1, 3);
  CHECK_THROWS_WITH(fit(problem), ContainsSubstring("measure more points"));
}

TEST_CASE("a fit refuses what the points cannot determine, also if they are exact", "[fit]") {
  const std::string exact = R"({"model": "discrete_shells", "flexural_rigidity": 2e-5})";
  FitProblem problem;
  problem.runs.push_back(run_of(strip(coarse, exact, 1)));
  problem.shapes.push_back(shape_of(strip(coarse, exact, 1)));
  // The shape of a strip depends on B over density alone.
  problem.pointers = {"/material/density", "/bending/flexural_rigidity"};
  const Fitted both = fit(problem);
  CHECK(!both.is_known());
  CHECK_THAT(both.correlation, WithinRel(1, 1e-3));  // only their ratio is known
  problem.pointers = {"/bending/flexural_rigidity"};
  problem.runs.front() =
      run_of(strip(coarse, R"({"model": "discrete_shells", "flexural_rigidity": 5e-8})", 1));
  CHECK_THROWS_WITH(fit(problem), ContainsSubstring("nearer first guess"));
  problem.runs.front() = run_of(strip(coarse, exact, 1));
  Positions& points = problem.shapes.front().points;
  points.col(0).array() += 0.02;  // as if the clamp were the origin
  CHECK_THROWS_WITH(fit(problem), ContainsSubstring("coordinates of the mesh"));
  points.col(0).array() -= 0.02;
  std::string falling = strip(coarse, exact, 1);
  falling.replace(falling.find("\"duration\": 60"), 14, "\"duration\": 0.1");
  falling.replace(falling.find("equilibrium"), 11, "quasi_newton");
  problem.runs.front() = run_of(falling);
  CHECK_THROWS_WITH(fit(problem), ContainsSubstring("still moves"));
}

TEST_CASE("a fit states what a wrong origin of the points would change, and finds a wrong origin", "[fit]") {
  FitProblem problem;
  problem.runs.push_back(
      run_of(strip(coarse, R"({"model": "discrete_shells", "flexural_rigidity": 5e-6})", 1)));
  problem.shapes.push_back(
      shape_of(strip(coarse, R"({"model": "discrete_shells", "flexural_rigidity": 6e-6})", 1)));
  problem.pointers = {"/bending/flexural_rigidity"};
  const Positions exact = problem.shapes.front().points;
  const auto fitted_at = [&](int axis, double move) {
    problem.shapes.front().points = exact;
    problem.shapes.front().points.col(axis).array() += move;
    return fit(problem);
  };
  const Fitted right = fitted_at(0, 0);
  CHECK(!right.misplaced());
  double squared = 0;
  for (const int axis : {0, 2}) {
    constexpr double step = 1e-4;
    const double change =
        std::log(fitted_at(axis, step).settings[0].value / fitted_at(axis, -step).settings[0].value) /
        (2 * step);
    squared += change * change;
  }
  // The tolerance is for the curvature of the change, and for distances to triangles instead of a curve.
  CHECK_THAT(right.settings[0].change_per_metre, WithinRel(std::sqrt(squared), 0.1));
  const Fitted wrong = fitted_at(0, 1e-3);
  INFO(wrong.rms << " " << wrong.rms_if_moved << " " << wrong.moves.front().transpose());
  CHECK(wrong.misplaced() == 0);
  CHECK_THAT(wrong.moves.front().x(), WithinRel(-1e-3, 0.2));  // linear
}

TEST_CASE("the uncertainty of a fit does not depend on a point beyond the border", "[fit]") {
  const std::string truth = R"({"model": "discrete_shells", "flexural_rigidity": 2e-5})",
                    start = R"({"model": "discrete_shells", "flexural_rigidity": 1.5e-5})";
  FitProblem problem;
  problem.runs.push_back(run_of(strip(coarse, start, 1)));
  problem.shapes.push_back(shape_of(strip(coarse, truth, 1)));
  problem.pointers = {"/bending/flexural_rigidity"};
  problem.uncertainty = 2e-3;  // far above the scatter, so that both fits have the same
  const double without = fit(problem).settings[0].uncertainty;
  // A point 0.5 mm beyond the tip, along the strip.
  Positions& points = problem.shapes.front().points;
  Eigen::Index tip = 0, before = 0;
  points.col(0).maxCoeff(&tip);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (i != tip && (points.row(i) - points.row(tip)).norm() < 0.003) before = i;
  const Eigen::RowVector3d beyond =
      points.row(tip) + 5e-4 * (points.row(tip) - points.row(before)).normalized();
  points.conservativeResize(points.rows() + 1, 3);
  points.row(points.rows() - 1) = beyond;
  const double with = fit(problem).settings[0].uncertainty;
  // A point adds information. Moves of a strip grow as s³ or less steeply, so a point at the tip has at most
  // 7 / n of the information of n points; here n > 14.
  CHECK(with <= without);
  CHECK(with >= without / std::sqrt(1.5));
}

TEST_CASE("the uncertainty of a fit is the scatter of the points over the change of the shape", "[fit]") {
  const auto strip_of = [](double rigidity) {
    return strip(coarse, fmt::format(R"({{"model": "discrete_shells", "flexural_rigidity": {}}})", rigidity),
                 1);
  };
  constexpr double truth = 2e-5, step = 0.01, scatter = 1e-3;  // scatter in m, far above the rms
  FitProblem problem;
  problem.runs.push_back(run_of(strip_of(truth)));
  problem.shapes.push_back(shape_of(strip_of(truth)));
  problem.pointers = {"/bending/flexural_rigidity"};
  problem.uncertainty = scatter;
  const Positions points = problem.shapes.front().points;
  const Positions change = (shape_of(strip_of(truth * std::exp(step))).points -
                            shape_of(strip_of(truth * std::exp(-step))).points) /
                           (2 * step);
  // The distance of a point to the strip changes by the part of the change that is normal to the strip.
  double information = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Index before = std::max<Eigen::Index>(i - 1, 0),
                       after = std::min<Eigen::Index>(i + 1, points.rows() - 1);
    const Eigen::RowVector3d along = (points.row(after) - points.row(before)).normalized();
    information += (change.row(i) - change.row(i).dot(along) * along).squaredNorm();
  }
  // The tolerance is for the slope at the tip, which is taken over half an edge, and for finite differences.
  CHECK_THAT(fit(problem).settings[0].uncertainty, WithinRel(scatter / std::sqrt(information), 0.05));
}

TEST_CASE("points of a shape are read from two or three columns", "[fit]") {
  const test::Workplace here;
  const auto read = [&](const std::string& text) {
    here.write("points.csv", text);
    return read_shape(here.folder / "points.csv", 0.25).points;
  };
  const Positions two = read("x (m);z (m)\n0,0\n\n0.01; -2e-3\r\n"), three = read("0 1 2\n3\t4\t5\n");
  REQUIRE(two.rows() == 2);
  CHECK(two.row(1) == Eigen::RowVector3d(0.01, 0.25, -2e-3));
  CHECK(three.row(1) == Eigen::RowVector3d(3, 4, 5));
  for (const auto& [text, cause] : {std::pair{"", "no points"},
                                    {"x z\n", "no points"},
                                    {"0 0\n1 2 3\n", "line 2"},
                                    {"0\n", "line 1"},
                                    {"0 0\n1 two\n", "line 2"},
                                    {"1 2 3 4\n", "line 1"}})
    CHECK_THROWS_WITH(read(text), ContainsSubstring(cause));
}

}  // namespace bendlab::fit_test
