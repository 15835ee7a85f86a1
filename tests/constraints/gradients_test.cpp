// The gradient of every constraint agrees with central differences, and has the invariances of the
// constraint.
#include <functional>
#include <numbers>

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::gradients_test {
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

/// The last `directors` corners do not move with the cloth.
template <std::size_t N>
void check_gradient(const Constraint<N>& constraint, const Corners<N>& p, std::size_t directors = 0) {
  const ConstraintValue<double, N> c = constraint(p);
  REQUIRE(c.defined);
  const Corners<N> expected = difference_gradient(constraint, p);
  double largest = 0, error = 0;
  Vector3 sum = Vector3::Zero(), moment = Vector3::Zero();
  for (std::size_t i = 0; i < N; ++i) {
    largest = std::max(largest, expected[i].norm());
    error = std::max(error, (c.gradient[i] - expected[i]).norm());
    if (i >= N - directors) continue;
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
    for (const StrainForm form :
         {StrainForm::normalised, StrainForm::green, StrainForm::angle, StrainForm::stvk}) {
      for (const int axis : {0, 1})
        check_gradient<3>([&](const Corners<3>& x) { return stretch_constraint(x, q, axis, form); }, p);
      check_gradient<3>([&](const Corners<3>& x) { return shear_constraint(x, q, form); }, p);
    }
    check_gradient<3>([&](const Corners<3>& x) { return area_constraint(x, q); }, p);
    check_gradient<3>([&](const Corners<3>& x) { return trace_constraint(x, q); }, p);
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
      for (const auto law : {HingeAngle::Law::angle, HingeAngle::Law::half_sine, HingeAngle::Law::tangent,
                             HingeAngle::Law::sine}) {
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

namespace {

// A triangle with three neighbours, whose folds and heights are far from the limits, and its directors.
template <class Kind>
Corners<Kind::arity> random_face(std::mt19937_64& random) {
  const double h = std::numbers::sqrt3 / 2;
  const std::array<Vector3, 6> flat = {Vector3(1.5, h, 0), Vector3(-0.5, h, 0), Vector3(0.5, -h, 0),
                                       Vector3(0, 0, 0),   Vector3(1, 0, 0),    Vector3(0.5, h, 0)};
  Corners<Kind::arity> p;
  const Vector3 shift = test::random_vector(random);
  for (std::size_t i = 0; i < 6; ++i) p[i] = flat[i] + shift + test::random_vector(random, 0.25);
  for (std::size_t i = 6; i < Kind::arity; ++i) p[i] = {test::uniform(random, -0.3, 0.3), 0, 0};
  return p;
}

template <class Kind>
std::array<double, Kind::rest_values> random_rest(std::mt19937_64& random, std::size_t border) {
  std::array<double, Kind::rest_values> rest;
  for (double& value : rest) value = test::uniform(random, 0.2, 1);
  for (std::size_t i = 0; i < 3; ++i) rest[i] = i == border ? 0 : 0.5;
  return rest;
}

template <class Kind>
void check_faces(std::initializer_list<typename Kind::Law> laws) {
  std::mt19937_64 random(21);
  for (int trial = 0; trial < 60; ++trial)
    for (const auto law : laws) {
      const auto p = random_face<Kind>(random);
      const auto rest = random_rest<Kind>(random, static_cast<std::size_t>(trial % 5));
      for (std::size_t k = 0; k < Kind::components; ++k)
        check_gradient<Kind::arity>(
            [&](const Corners<Kind::arity>& x) { return Kind::template component<double>(x, rest, law, k); },
            p, directors_of<Kind>);
      check_gradient<Kind::arity>(
          [&](const Corners<Kind::arity>& x) { return Kind::template value<double>(x, rest, law); }, p,
          directors_of<Kind>);
      double squares = 0;
      for (std::size_t k = 0; k < Kind::components; ++k)
        squares += std::pow(Kind::template component<double>(p, rest, law, k).value, 2);
      CHECK_THAT(Kind::template value<double>(p, rest, law).value,
                 Catch::Matchers::WithinRel(std::sqrt(squares), 1e-12));  // rounding of three squares
    }
}

}  // namespace

TEST_CASE("gradients of bent triangles agree with differences", "[constraints]") {
  check_faces<FoldBend>({FoldBend::Law::sine, FoldBend::Law::height});
  check_faces<MidEdgeBend>({MidEdgeBend::Law::tangent, MidEdgeBend::Law::sine, MidEdgeBend::Law::angle});
}

TEST_CASE("measures of a turn agree for small angles, and go on beyond their limits", "[constraints]") {
  for (const Turn measure : {Turn::tangent, Turn::sine, Turn::angle}) {
    CHECK_THAT(turn_of(measure, 1e-4).value, Catch::Matchers::WithinRel(1e-4, 1e-8));  // of third order
    for (const double angle : {-3.0, -1.5, -0.7, 0.2, 1.3, 1.5, 2.5}) {
      constexpr double step = 1e-6;
      const double slope =
          (turn_of(measure, angle + step).value - turn_of(measure, angle - step).value) / (2 * step);
      CHECK_THAT(turn_of(measure, angle).slope, Catch::Matchers::WithinAbs(slope, 1e-7));
    }
  }
  CHECK(turn_of(Turn::sine, 2.0).value == 1);
  CHECK_THAT(turn_of(Turn::tangent, 1.0).value, Catch::Matchers::WithinRel(std::tan(1.0), 1e-15));
}

TEST_CASE("strain constraints vanish at rest and under rigid motion", "[constraints]") {
  std::mt19937_64 random(3);
  const std::array<double, 4> q = {1, -0.5, 0, 2};  // Q = [1 0.25; 0 0.5]
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized().toRotationMatrix();
  const Vector3 shift = test::random_vector(random);
  const Corners<3> p = {shift, shift + rotation * Vector3(1, 0, 0), shift + rotation * Vector3(0.25, 0.5, 0)};
  for (const StrainForm form :
       {StrainForm::normalised, StrainForm::green, StrainForm::angle, StrainForm::stvk}) {
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

}  // namespace bendlab::gradients_test
