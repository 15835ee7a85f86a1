// The gradient of every constraint agrees with central differences, and has the invariances of the
// constraint.
#include <functional>

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab {
namespace {

template <std::size_t N>
using Corners = std::array<Vector3, N>;
template <std::size_t N>
using Constraint = std::function<ConstraintValue<double, N>(const Corners<N>&)>;

// Central differences. Their error is about step² for a smooth C of unit size. With rounding, a step of 1e-6
// leaves a relative error of about 1e-8.
template <std::size_t N>
Corners<N> difference_gradient(const Constraint<N>& constraint, const Corners<N>& p) {
  constexpr double step = 1e-6;
  Corners<N> gradient;
  for (std::size_t i = 0; i < N; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      Corners<N> forward = p, backward = p;
      forward[i](axis) += step, backward[i](axis) -= step;
      gradient[i](axis) = (constraint(forward).value - constraint(backward).value) / (2 * step);
    }
  return gradient;
}

template <std::size_t N>
void check_gradient(const Constraint<N>& constraint, const Corners<N>& p) {
  const ConstraintValue<double, N> c = constraint(p);
  REQUIRE(c.defined);
  const Corners<N> expected = difference_gradient(constraint, p);
  double largest = 0, error = 0;
  Vector3 sum = Vector3::Zero(), moment = Vector3::Zero();
  for (std::size_t i = 0; i < N; ++i) {
    largest = std::max(largest, expected[i].norm());
    error = std::max(error, (c.gradient[i] - expected[i]).norm());
    sum += c.gradient[i];
    moment += p[i].cross(c.gradient[i]);
  }
  CHECK(error <= 1e-6 * largest);
  // Rounding of a few products of numbers of the gradient's size.
  CHECK(sum.norm() <= 1e-13 * largest);
  CHECK(moment.norm() <= 1e-13 * largest);
}

// A random triangle whose deformation is far from collapsed, and its random rest shape.
struct RandomTriangle {
  Corners<3> p;
  std::array<double, 4> q;
};

RandomTriangle random_triangle(std::mt19937_64& random) {
  for (;;) {
    Eigen::Matrix2d rest;
    for (int i = 0; i < 4; ++i) rest(i) = test::uniform(random, -1, 1);
    RandomTriangle t;
    for (Vector3& corner : t.p) corner = test::random_vector(random);
    if (std::abs(rest.determinant()) < 0.2 || (t.p[1] - t.p[0]).cross(t.p[2] - t.p[0]).norm() < 0.2) continue;
    const Eigen::Matrix2d inverse = rest.inverse();
    t.q = {inverse(0, 0), inverse(0, 1), inverse(1, 0), inverse(1, 1)};
    return t;
  }
}

}  // namespace

TEST_CASE("distance gradient agrees with differences", "[constraints]") {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 100; ++trial)
    check_gradient<2>([](const Corners<2>& p) { return distance_constraint(p, 0.7); },
                      {test::random_vector(random), test::random_vector(random)});
}

TEST_CASE("arc spring gradient agrees with differences", "[constraints]") {
  std::mt19937_64 random(13);
  for (int trial = 0; trial < 100; ++trial)
    check_gradient<2>(
        [](const Corners<2>& p) { return ArcSpring::value<double>(p, {0.7}, ArcSpring::Law::exact); },
        {test::random_vector(random), test::random_vector(random)});
}

TEST_CASE("strain gradients agree with differences", "[constraints]") {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const auto [p, q] = random_triangle(random);
    for (const StrainForm form : {StrainForm::normalised, StrainForm::green, StrainForm::angle}) {
      for (const int axis : {0, 1})
        check_gradient<3>([&](const Corners<3>& x) { return stretch_constraint(x, q, axis, form); }, p);
      check_gradient<3>([&](const Corners<3>& x) { return shear_constraint(x, q, form); }, p);
    }
    check_gradient<3>([&](const Corners<3>& x) { return area_constraint(x, q); }, p);
  }
}

// Two triangles that share an edge, with a random fold. They are far from collapsed, and from the jump at ±π.
Corners<4> random_hinge(std::mt19937_64& random) {
  for (;;) {
    Corners<4> p;
    for (Vector3& corner : p) corner = test::random_vector(random);
    const ConstraintValue<double, 4> angle = hinge_angle(p, 1.0);
    const auto height = [&](std::size_t i) {
      return (p[i] - p[0]).cross(p[i] - p[1]).norm() / (p[1] - p[0]).norm();
    };
    if ((p[1] - p[0]).norm() > 0.3 && height(2) > 0.3 && height(3) > 0.3 && std::abs(angle.value) < 2.8)
      return p;
  }
}

TEST_CASE("hinge gradients agree with differences", "[constraints]") {
  std::mt19937_64 random(12);
  for (int trial = 0; trial < 100; ++trial) {
    const Corners<4> p = random_hinge(random);
    check_gradient<4>([](const Corners<4>& x) { return hinge_angle(x, 0.7); }, p);
    for (const double rest : {0.0, 0.9, -2.0})
      for (const auto law : {HingeAngle::Law::angle, HingeAngle::Law::half_sine}) {
        const std::array<double, 4> values = {rest, 0.7, std::sin(rest / 2), std::cos(rest / 2)};
        if (std::abs(hinge_angle(p, 0.7).value - rest) <
            3.0)  // else it may jump by 2π between the two differences
          check_gradient<4>([&](const Corners<4>& x) { return HingeAngle::value(x, values, law); }, p);
      }
    const double a = test::uniform(random, 0.2, 2), b = test::uniform(random, 0.2, 2);
    const std::array<double, 6> k = {a, b, -0.6 * (a + b), -0.4 * (a + b), 0.3, 1};  // sum 0
    for (const auto law : {QuadraticBend::Law::norm, QuadraticBend::Law::energy}) {
      // K annihilates translations. Moments vanish only if K x0 = 0, as for the cotangents of a flat hinge.
      const Constraint<4> constraint = [&](const Corners<4>& x) { return QuadraticBend::value(x, k, law); };
      const Corners<4> expected = difference_gradient(constraint, p);
      const ConstraintValue<double, 4> c = constraint(p);
      for (std::size_t i = 0; i < 4; ++i)
        CHECK((c.gradient[i] - expected[i]).norm() <= 1e-6 * expected[0].norm());
    }
  }
}

TEST_CASE("strain constraints vanish at rest and under rigid motion", "[constraints]") {
  std::mt19937_64 random(3);
  const std::array<double, 4> q = {1, -0.5, 0, 2};  // Q = [1 0.25; 0 0.5]
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized().toRotationMatrix();
  const Vector3 shift = test::random_vector(random);
  const Corners<3> p = {shift, shift + rotation * Vector3(1, 0, 0), shift + rotation * Vector3(0.25, 0.5, 0)};
  for (const StrainForm form : {StrainForm::normalised, StrainForm::green, StrainForm::angle}) {
    // Rounding of rotated unit coordinates.
    CHECK_THAT(stretch_constraint(p, q, 0, form).value, Catch::Matchers::WithinAbs(0, 1e-14));
    CHECK_THAT(stretch_constraint(p, q, 1, form).value, Catch::Matchers::WithinAbs(0, 1e-14));
    CHECK_THAT(shear_constraint(p, q, form).value, Catch::Matchers::WithinAbs(0, 1e-14));
  }
  CHECK_THAT(area_constraint(p, q).value, Catch::Matchers::WithinAbs(0, 1e-14));
}

namespace {

void project_once(std::array<Point<double>, 3>& points, const ConstraintValue<double, 3>& c) {
  const Places<double> places(points.data());
  project_by_oracle<double>(corners_at(places, offset_of(0), offset_of(1), offset_of(2)), c, 1.0, nullptr,
                            0.0);
}

}  // namespace

TEST_CASE("one projection solves the square-root stretch exactly for any masses", "[constraints]") {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    auto [p, q] = random_triangle(random);
    std::array<Point<double>, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      points[i].set(p[i]);
      points[i].w = i == 0 && trial % 3 == 0 ? 0 : test::uniform(random, 0.01, 10);
    }
    const auto constraint = [&] {
      return stretch_constraint<double>({points[0].vector(), points[1].vector(), points[2].vector()}, q,
                                        trial % 2, StrainForm::normalised);
    };
    project_once(points, constraint());
    CHECK_THAT(constraint().value, Catch::Matchers::WithinAbs(0, 1e-13));
  }
}

TEST_CASE("one projection of the Green form overshoots as Newton's method does", "[constraints]") {
  // A unit right triangle of unit masses is stretched to λ along the warp. The step divides λ² - 1 by 2λ, so
  // λ' = λ - (λ² - 1) / (2λ).
  const std::array<double, 4> q = {1, 0, 0, 1};
  for (const double stretch : {2.0, 3.0, 0.5}) {
    std::array<Point<double>, 3> points = {Point<double>{0, 0, 0, 1}, Point<double>{stretch, 0, 0, 1},
                                           Point<double>{0, 1, 0, 1}};
    const auto constraint = [&] {
      return stretch_constraint<double>({points[0].vector(), points[1].vector(), points[2].vector()}, q, 0,
                                        StrainForm::green);
    };
    project_once(points, constraint());
    const double expected = stretch - (stretch * stretch - 1) / (2 * stretch);  // 1.25, 1.67, 1.25
    CHECK_THAT(std::sqrt(constraint().value + 1), Catch::Matchers::WithinAbs(expected, 1e-14));
  }
}

}  // namespace bendlab
