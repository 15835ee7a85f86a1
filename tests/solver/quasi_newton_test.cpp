// Parts of quasi_newton: the direction from pairs of L-BFGS, and the softened membrane.
#include <algorithm>
#include <random>

#include "bendlab/solver/elastic_metric.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/pair_history.hpp"
#include "bendlab/solver/soft_membrane.hpp"
#include "tests/catch.hpp"
#include "tests/solver/implicit_scenes.hpp"

namespace bendlab::quasi_newton_test {
namespace {

using Catch::Matchers::WithinRel;
using test::compliant;

using Vector = Eigen::VectorXd;

Points<double> points_of(const Vector& numbers) {
  Points<double> points(static_cast<std::size_t>(numbers.size() / 3));
  for (std::size_t v = 0; v < points.size(); ++v)
    points[v].set(numbers.segment<3>(3 * static_cast<Eigen::Index>(v)));
  return points;
}

// The two loops of L-BFGS as Nocedal published them. They start with the newest pair.
Vector two_loops(Vector q, const std::vector<Vector>& s, const std::vector<Vector>& y, const Vector& metric) {
  std::vector<double> alpha(s.size());
  for (std::size_t i = s.size(); i-- > 0;) {
    alpha[i] = s[i].dot(q) / s[i].dot(y[i]);
    q -= alpha[i] * y[i];
  }
  q = q.cwiseQuotient(metric);
  for (std::size_t i = 0; i < s.size(); ++i) q += (alpha[i] - y[i].dot(q) / s[i].dot(y[i])) * s[i];
  return q;
}

}  // namespace

TEST_CASE("the pair history gives the direction of the two loops of L-BFGS", "[solver]") {
  constexpr int points = 300, most = 4,
                places = 9;  // several parts of points, and more pairs than are kept
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto numbers = [&] { return Vector::NullaryExpr(3 * points, [&] { return normal(random); }).eval(); };
  const Vector metric = numbers().cwiseAbs().array() + 0.5, hessian = numbers().cwiseAbs().array() + 0.5;
  PairHistory<double> pairs(points, most);
  const std::vector<double> no_inertia(points, 0);
  std::vector<Vector> s, y;
  Vector last_x, last_gradient;
  for (int place = 0; place < places; ++place) {
    const Vector x = numbers(), gradient = hessian.cwiseProduct(x).array() + x.array().cube();
    const Points<double> at = points_of(x), g = points_of(gradient),
                         p = points_of(gradient.cwiseQuotient(metric));
    const auto along = pairs.add({at, g, p}, no_inertia);
    REQUIRE(along.has_value() == (place > 0));
    if (place > 0) {
      s.push_back(x - last_x), y.push_back(gradient - last_gradient);
      if (s.size() > most) s.erase(s.begin()), y.erase(y.begin());
      // The slopes along the move, before and after it.
      CHECK_THAT(along->before, WithinRel(s.back().dot(last_gradient), 1e-10));
      CHECK_THAT(along->after, WithinRel(s.back().dot(gradient), 1e-10));
    }
    last_x = x, last_gradient = gradient;
    Points<double> direction(points);
    pairs.direct(p, direction);
    const Points<double> expected = points_of(two_loops(gradient, s, y, metric));
    double error = 0, size = 0;
    for (std::size_t v = 0; v < points; ++v) {
      error = std::max(error, (direction[v].vector() - expected[v].vector()).norm());
      size = std::max(size, expected[v].vector().norm());
    }
    CHECK(error <= 1e-9 * size);  // rounding of sums of 900 numbers, over nine pairs
  }
}

TEST_CASE("the pair history takes account of a stated change of the function", "[solver]") {
  // The gradient is H x before the change and H x - b after it. With b stated, the pair belongs to H alone.
  constexpr int points = 5;
  const Vector ones = Vector::Ones(3 * points), x0 = ones, x1 = 3 * ones, b = 0.5 * ones;
  PairHistory<double> pairs(points, 3);
  const std::vector<double> no_inertia(points, 0);
  const Points<double> at0 = points_of(x0), g0 = points_of(2 * x0), p0 = points_of(x0), at1 = points_of(x1),
                       g1 = points_of(2 * x1 - b), p1 = points_of(x1 - 0.5 * b), change = points_of(-b),
                       applied_change = points_of(-0.5 * b);
  pairs.add({at0, g0, p0}, no_inertia);
  const auto along = pairs.add({at1, g1, p1, &change, &applied_change}, no_inertia);
  REQUIRE(along);
  const Vector s = x1 - x0;
  CHECK_THAT(along->after - along->before, WithinRel(s.dot(2 * s), 1e-12));  // s·H s
}

// In a flat sheet bending resists moves along the normal and turns of the directors, and nothing else. The
// matrix leaves out that directors and vertices are coupled.
TEST_CASE("the matrix of quasi_newton is the Hessian of a flat sheet at rest", "[solver]") {
  const RestMesh rest(delaunay(1, 1, 5, 2));
  for (const std::string_view model : {"dihedral", "isometric", "bridson", "mid_edge"}) {
    INFO(model);
    SimulationInput input =
        compliant(test::sheet(rest, make_pins(rest, {0, 1}, 0), model), "quasi_newton", 1e-3, 1);
    const ElasticMetric metric(input);
    ElasticSystem system(input);
    const Positions points = input.points();
    const Eigen::MatrixXd hessian =
        Eigen::MatrixXd(system.hessian(points, system.multipliers(points))).selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd matrix = Eigen::MatrixXd(metric.bending()).selfadjointView<Eigen::Lower>();
    Eigen::MatrixXd expected(matrix.rows(), matrix.cols());
    const auto point_of = [&](Eigen::Index i) {
      return static_cast<std::size_t>(metric.vertices()[static_cast<std::size_t>(i)]);
    };
    const auto is_vertex = [&](Eigen::Index i) { return point_of(i) < input.mass.size(); };
    const auto unknown = [&](Eigen::Index i) {
      return 3 * system.free_index()[point_of(i)] + (is_vertex(i) ? 2 : 0);
    };
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        expected(i, j) = is_vertex(i) == is_vertex(j) ? hessian(unknown(i), unknown(j)) : 0;
    CHECK((matrix - expected).norm() <= 1e-9 * expected.norm());  // central differences have ten digits
  }
}

TEST_CASE("a membrane is as stiff as stated at a pin, and softer with the distance from it", "[solver]") {
  // A row of 10 cells of 0.1 m is pinned at its left end, so distances along edges are known.
  const RestMesh rest(grid(1, 0.1, 10, 1));
  constexpr double compliance = 1e-6, error = 2e-3, force = 1;
  const Pins pins = make_pins(rest, {0, 11}, 0);
  const SimulationInput input = compliant(test::sheet(rest, pins, "none"), "quasi_newton", compliance, 1);
  const std::vector<double> softness = SoftMembrane(input).softness(error, force);
  const double most = input.size * error / (5 * force * compliance), graded = 10 * error * input.size;
  for (std::size_t t = 0; t < softness.size(); ++t) {
    double x = 0;
    for (const int v : rest.triangles().row(static_cast<Eigen::Index>(t)))
      x += rest.position(v).x() - rest.position(0).x();
    CHECK_THAT(softness[t], WithinRel(std::max(1.0, most * std::min(1.0, x / 3 / graded)), 1e-12));
  }
  for (const double s : SoftMembrane(input).softness(error, 1e9)) CHECK(s == 1);  // as stiff as stated
  for (const double s : SoftMembrane(input).softness(error, 0)) CHECK(s == 1);    // no known load
}

}  // namespace bendlab::quasi_newton_test
