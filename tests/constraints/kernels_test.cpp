// The lane kernels agree with the oracle, which projects one constraint at a time. Every projection keeps
// momentum.
#include "bendlab/constraints/kernels.hpp"

#include "bendlab/constraints/oracle.hpp"
#include "bendlab/constraints/sine_projection.hpp"
#include "bendlab/solver/colouring.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::kernels_test {
namespace {

// A crumpled sheet with random masses, some pinned vertices, and directors at random.
template <class Real>
struct Crumpled {
  RestMesh rest;
  Points<Real> points, rest_points;

  /// Vertices, and directors for more edges than the mesh has.
  int point_count() const { return 5 * rest.vertex_count(); }

  explicit Crumpled(unsigned seed, bool with_pins = true)
      : rest(delaunay(1, 1, 9, seed)),
        points(static_cast<std::size_t>(point_count()) + dummy_points),
        rest_points(points.size()) {
    std::mt19937_64 random(seed);
    for (int v = 0; v < rest.vertex_count(); ++v) {
      Point<Real>& point = points[static_cast<std::size_t>(v)];
      point.set((rest.position(v) + test::random_vector(random, 0.03)).template cast<Real>());
      rest_points[static_cast<std::size_t>(v)].set(rest.position(v).template cast<Real>());
      point.w = with_pins && v % 7 == 0 ? Real(0) : static_cast<Real>(test::uniform(random, 10, 500));
    }
    for (int d = rest.vertex_count(); d < point_count(); ++d) {
      Point<Real>& director = points[static_cast<std::size_t>(d)];
      director.x = static_cast<Real>(test::uniform(random, -0.02, 0.02));
      director.w = static_cast<Real>(test::uniform(random, 10, 500));
    }
  }

  StrainBatch<Real> strain(StiffnessKind kind, StrainForm form) const {
    const StrainConstraints list = strain_constraints(rest, make_pins(rest, {}, 0),
                                                      inverse_rest_from_warp(rest.mesh(), Vector3::UnitX()));
    StrainBatch<Real> batch =
        make_strain_batch<Real>(list, colour_order(list.vertices, rest.vertex_count()), point_count());
    batch.kind = kind, batch.form = form;
    batch.warp = Real(0.9), batch.weft = Real(0.7), batch.shear = Real(0.4), batch.area = Real(0.2);
    batch.compliance = Real(1e-4);
    if (kind == StiffnessKind::compliance) batch.multiplier.assign(4 * batch.a.size(), 0);
    return batch;
  }

  DistanceBatch<Real> pulling(StiffnessKind kind) const {
    DistanceBatch<Real> batch = distance(kind);
    batch.only_pulls = true;
    return batch;
  }

  DistanceBatch<Real> distance(StiffnessKind kind, bool stars = true) const {
    const DistanceConstraints list = test::sheet(rest, make_pins(rest, {}, 0), "k_ring").distance;
    DistanceBatch<Real> batch =
        make_distance_batch<Real>(list,
                                  stars ? star_order(list.vertices, rest.vertex_count())
                                        : colour_order(test::plain(list.vertices), rest.vertex_count()),
                                  point_count());
    batch.kind = kind, batch.k = Real(0.6), batch.compliance = Real(1e-5);
    if (kind == StiffnessKind::compliance) batch.multiplier.assign(batch.b.size(), 0);
    return batch;
  }

  template <class Kind>
  ElementBatch<Real, Kind> elements(std::string_view model, StiffnessKind kind,
                                    typename Kind::Law law) const {
    const Pins none = make_pins(rest, {}, 0);
    auto list = std::get<ElementList<Kind>>(
        constraints_of(BendingModel(*find_bending_model(model)), {rest, none}).elements);
    for (std::size_t c = 0; c < list.size(); ++c) bend_at_rest(list.rest[c], c);
    list.law = law;
    if constexpr (std::is_same_v<Kind, HingeAngle>)
      if (law == HingeAngle::Law::sine) open_hinges(list);
    ElementBatch<Real, Kind> batch =
        make_element_batch<Real>(list, colour_order(list.vertices, point_count()), point_count());
    // The compliance of one-sided kinds is large, so that some of their elements yield to their load.
    batch.kind = kind, batch.k = Real(0.3), batch.compliance = Real(OneSided<Kind> ? 1e3 : 1e-2);
    // Compliant projections of a sine, too, turn a hinge by at most 2 tan φ, if they are soft enough.
    if constexpr (std::is_same_v<Kind, HingeAngle>)
      if (law == HingeAngle::Law::sine) batch.compliance = 10;
    if (kind == StiffnessKind::compliance) batch.multiplier.assign(batch.order.lane_count(), 0);
    return batch;
  }

  // Leaves out hinges that are nearly closed, and makes rest angles small. Where a hinge is nearly closed,
  // sin(θ/2) does not depend on the angle, so that rounding decides how far a projection moves the corners.
  void open_hinges(ElementList<HingeAngle>& list) const {
    constexpr double widest = 0.8, share = 0.4;  // rad; of the rest angles
    ElementList<HingeAngle> open{.vertices = {}, .rest = {}, .softness = {}, .law = list.law};
    for (std::size_t c = 0; c < list.size(); ++c) {
      std::array<Vector3, 4> p;
      for (std::size_t i = 0; i < 4; ++i)
        p[i] = points[static_cast<std::size_t>(list.vertices[c][i])].vector().template cast<double>();
      if (!(std::abs(hinge_angle(p, list.rest[c][1]).value) < widest)) continue;
      open.vertices.push_back(list.vertices[c]);
      open.rest.push_back(list.rest[c]), open.softness.push_back(list.softness[c]);
      bend(open.rest.back(), share * list.rest[c][0]);
    }
    list = open;
  }

  // Rest angles of every sign and size, including tiny angles and zero.
  static void bend_at_rest(std::array<double, 4>& hinge, std::size_t c) {
    bend(hinge, c % 5 == 0 ? 0 : std::sin(static_cast<double>(c)) * 2.5);
  }
  static void bend(std::array<double, 4>& hinge, double angle) {
    hinge = {angle, hinge[1], std::sin(angle / 2), std::cos(angle / 2)};
  }
  static void bend_at_rest(std::array<double, 6>& quadratic, std::size_t c) {
    quadratic[4] = c % 5 == 0 ? 0 : 0.01 * static_cast<double>(c % 7);
  }
  static void bend_at_rest(std::array<double, LaplacianBend::rest_values>& sum, std::size_t c) {
    sum[LaplacianBend::arity] = c % 5 == 0 ? 0 : 0.01 * static_cast<double>(c % 7);
  }
  static void bend_at_rest(std::array<double, FoldBend::rest_values>& face, std::size_t c) {
    for (std::size_t i = 3; i < 6; ++i)
      face[i] = c % 5 == 0 ? 0 : 0.02 * std::sin(static_cast<double>(3 * c + i));
  }
  static void bend_at_rest(std::array<double, MidEdgeBend::rest_values>& face, std::size_t c) {
    for (std::size_t i = 3; i < 6; ++i)
      face[i] = c % 5 == 0 ? 0 : 0.02 * std::sin(static_cast<double>(3 * c + i));
  }
  // From 1.5 to 0.5 times the length of the pair.
  static void bend_at_rest(std::array<double, 1>& arc, std::size_t c) {
    arc[0] *= 1 + 0.5 * std::sin(static_cast<double>(c));
  }
};

// The batch with moments that soften, or with elements that have yielded.
template <class Batch>
Batch softened(Batch batch) {
  batch.softening.half_at = 3;
  batch.length.assign(batch.order.lane_count(), typename decltype(batch.softness)::value_type(0.05));
  batch.yield.assign(batch.length.size(),
                     std::numeric_limits<typename decltype(batch.softness)::value_type>::infinity());
  batch.hardening.assign(batch.length.size(), 0);
  return batch;
}
template <class Batch>
Batch yielding(Batch batch) {
  batch.length.assign(batch.order.lane_count(), 0), batch.yield.assign(batch.length.size(), 0);
  batch.hardening.assign(batch.length.size(), 0);
  for (std::size_t lane = 0; lane < batch.yield.size(); ++lane) {
    using Real = typename decltype(batch.yield)::value_type;
    batch.yield[lane] = static_cast<Real>(0.01 * static_cast<double>(1 + lane % 9));
    batch.hardening[lane] = static_cast<Real>(0.1 * static_cast<double>(lane % 4));
  }
  return batch;
}

// Calls check(batch) for the elements of every kind, law and stiffness.
template <class Real, class Check>
void for_elements(const Crumpled<Real>& cloth, const Check& check) {
  for (const StiffnessKind kind : {StiffnessKind::k, StiffnessKind::compliance}) {
    for (const auto law : {HingeAngle::Law::angle, HingeAngle::Law::half_sine, HingeAngle::Law::tangent,
                           HingeAngle::Law::sine})
      check(cloth.template elements<HingeAngle>("dihedral", kind, law));
    for (const auto law : {QuadraticBend::Law::norm, QuadraticBend::Law::energy})
      check(cloth.template elements<QuadraticBend>("isometric", kind, law));
    for (const auto law : {ArcSpring::Law::exact, ArcSpring::Law::polynomial})
      check(cloth.template elements<ArcSpring>("choi_ko", kind, law));
    for (const auto law : {FoldBend::Law::sine, FoldBend::Law::height})
      check(cloth.template elements<FoldBend>("mid_edge_average", kind, law));
    for (const auto law : {MidEdgeBend::Law::tangent, MidEdgeBend::Law::sine, MidEdgeBend::Law::angle})
      check(cloth.template elements<MidEdgeBend>("mid_edge", kind, law));
    check(cloth.template elements<LaplacianBend>("laplacian", kind, LaplacianBend::Law::norm));
    if (kind == StiffnessKind::k) continue;
    const auto hinges = cloth.template elements<HingeAngle>("dihedral", kind, HingeAngle::Law::angle);
    const auto faces = cloth.template elements<MidEdgeBend>("mid_edge", kind, MidEdgeBend::Law::tangent);
    check(softened(hinges)), check(yielding(hinges)), check(softened(faces)), check(yielding(faces));
  }
}

template <class Real, class Batch>
void project_all(Points<Real>& points, Batch& batch, bool backwards = false) {
  const std::vector<std::size_t>& colours = batch.order.colours;
  for (std::size_t step = 0; step + 1 < colours.size(); ++step) {
    const std::size_t c = backwards ? colours.size() - 2 - step : step;
    project(points.data(), batch, colours[c], colours[c + 1], Real(1e-2), backwards);
  }
}

template <class Real>
double largest_difference(const Points<Real>& a, const Points<Real>& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    largest = std::max(largest, static_cast<double>((a[v].vector() - b[v].vector()).norm()));
    REQUIRE(a[v].w == b[v].w);
  }
  return largest;
}

// Two sweeps over a few thousand constraints. Each constraint has a rounding of a few ε, and shear near
// collapse amplifies this error.
template <class Real>
constexpr double agreement = 2e3 * static_cast<double>(std::numeric_limits<Real>::epsilon());

// How much more a tangent depends on its angle φ than the angle itself: 2 (1 + tan² φ) at the steepest turn.
// A projection of a sine by k turns a hinge by 2 tan φ, φ up to 66 degrees (sine_projection.hpp).
template <class Batch>
double amplification(const Batch& batch) {
  const auto of = [](double steep) { return 2 * (1 + std::tan(steep) * std::tan(steep)); };
  if constexpr (requires { batch.law == decltype(batch.law)::tangent; })
    return batch.law == decltype(batch.law)::tangent ? of(1.4)
           : batch.law == decltype(batch.law)::sine  ? of(std::asin(largest_sine / 2))
                                                     : 1;
  else
    return 1;
}

// The kind and the law of a batch, for messages.
template <class Real, class Kind>
std::string name_of(const ElementBatch<Real, Kind>& batch) {
  return std::string(Kind::name) + " " + std::string(Kind::law_names[static_cast<std::size_t>(batch.law)]);
}
template <class Batch>
std::string name_of(const Batch&) {
  return "springs or strain";
}

template <class Real, class Batch>
void check_kernel(const Crumpled<Real>& cloth, const Batch& batch) {
  Points<Real> by_kernel = cloth.points, by_oracle = cloth.points;
  Batch kernel_batch = batch, oracle_batch = batch;
  for (const bool backwards : {false, true}) {
    project_all(by_kernel, kernel_batch, backwards);
    project_by_oracle(by_oracle.data(), oracle_batch, Real(1e-2), backwards);
  }
  INFO(name_of(batch));
  CHECK(largest_difference(by_kernel, cloth.points) > 1e-3);  // the projections moved something
  CHECK(largest_difference(by_kernel, by_oracle) <= agreement<Real> * amplification(batch));
}

}  // namespace

TEMPLATE_TEST_CASE("kernels agree with the oracle to rounding", "[constraints]", float, double) {
  const Crumpled<TestType> cloth(5);
  for (const StiffnessKind kind : {StiffnessKind::k, StiffnessKind::compliance}) {
    check_kernel(cloth, cloth.distance(kind));
    check_kernel(cloth, cloth.pulling(kind));
    for (const StrainForm form :
         {StrainForm::normalised, StrainForm::green, StrainForm::angle, StrainForm::stvk})
      check_kernel(cloth, cloth.strain(kind, form));
  }
  for_elements(cloth, [&](const auto& batch) { check_kernel(cloth, batch); });
}

namespace {

// Calls check(batch) for every kind of batch of a scene. Each batch has the rest shape, which tells collapsed
// elements how to open.
template <class Real, class Check>
void for_batches(const Crumpled<Real>& cloth, const Check& check) {
  const auto with_rest = [&](auto batch) {
    batch.rest_points = cloth.rest_points.data();
    check(batch);
  };
  for (const StiffnessKind kind : {StiffnessKind::k, StiffnessKind::compliance}) {
    with_rest(cloth.distance(kind));
    with_rest(cloth.pulling(kind));
    for (const StrainForm form :
         {StrainForm::normalised, StrainForm::green, StrainForm::angle, StrainForm::stvk})
      with_rest(cloth.strain(kind, form));
  }
  for_elements(cloth, with_rest);
}

// Four cloths: collapsed to a point, onto two different lines, and a cloth in which every seventh vertex lies
// on a neighbour.
template <class Real>
std::vector<Crumpled<Real>> collapsed_cloths() {
  std::vector<Crumpled<Real>> cloths(4, Crumpled<Real>(9));
  const int count = cloths[0].rest.vertex_count();
  for (int v = 0; v < count; ++v) {
    const auto at = static_cast<std::size_t>(v);
    const Vector3 rest = cloths[0].rest.position(v);
    cloths[0].points[at].set({Real(0.25), Real(-0.5), Real(0.125)});
    // Lines along neither warp nor weft: else the other direction would consist of rounding.
    cloths[1].points[at].set(Vector3(rest.x() + 0.5 * rest.y(), 0, 0).cast<Real>());
    cloths[2].points[at].set(((rest.x() - rest.y()) * Vector3(0.5, 0.25, -1)).cast<Real>());
    // The vertex moves to a neighbour, never to the opposite vertex of a hinge. That would fold the hinge by
    // ±π, with a sign that depends on rounding.
    if (v % 7 == 3)
      cloths[3].points[at].set(
          cloths[3].points[static_cast<std::size_t>(cloths[3].rest.one_ring()[v].front())].vector());
  }
  return cloths;
}

}  // namespace

TEMPLATE_TEST_CASE("kernels agree with the oracle on collapsed elements", "[constraints]", float, double) {
  for (const Crumpled<TestType>& cloth : collapsed_cloths<TestType>())
    for_batches(cloth, [&](const auto& batch) {
      Points<TestType> by_kernel = cloth.points, by_oracle = cloth.points;
      auto kernel_batch = batch, oracle_batch = batch;
      // Only the first colour: later colours would meet nearly collapsed elements, where rounding decides the
      // result.
      project(by_kernel.data(), kernel_batch, batch.order.colours[0], batch.order.colours[1], TestType(1e-2));
      auto& order = oracle_batch.order;
      const auto first_lane = static_cast<std::ptrdiff_t>(max_lanes * order.colours[1]);
      std::fill(order.first.begin() + first_lane, order.first.end(), -1);
      if (!order.length.empty()) std::fill(order.length.begin() + first_lane, order.length.end(), 0);
      project_by_oracle(by_oracle.data(), oracle_batch, TestType(1e-2));
      INFO(name_of(batch));
      double size = 1;  // arcs of XPBD have no bound on their push
      for (const auto& point : by_oracle) size = std::max<double>(size, point.vector().norm());
      CHECK(largest_difference(by_kernel, by_oracle) <= agreement<TestType> * size * amplification(batch));
    });
}

TEMPLATE_TEST_CASE("no finite state makes a NaN", "[constraints]", float, double) {
  const WithoutTraps overflows;
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    Crumpled<TestType> cloth(static_cast<unsigned>(trial) + 1);
    const auto count = static_cast<std::size_t>(cloth.rest.vertex_count());
    for (std::size_t v = 0; v < count; ++v) {
      const double choice = test::uniform(random, 0, 1);
      const double size = choice < 0.1 ? 1e18 : choice < 0.2 ? 1e-30 : choice < 0.3 ? 1e6 : 1;
      if (trial % 4 != 0) cloth.points[v].set(test::random_vector(random, size).template cast<TestType>());
      if (choice > 0.7) cloth.points[v].set(cloth.points[(7 * v + 3) % count].vector());
    }
    const auto finite = [&](const Points<TestType>& points) {
      return std::ranges::all_of(points, [](const auto& p) { return p.vector().allFinite(); });
    };
    for_batches(cloth, [&](const auto& batch) {
      auto kernel_batch = batch, oracle_batch = batch;
      Points<TestType> by_kernel = cloth.points, by_oracle = cloth.points, velocity = cloth.points;
      project_all(by_kernel, kernel_batch);
      project_by_oracle(by_oracle.data(), oracle_batch, TestType(1e-2));
      CHECK(finite(by_kernel));
      CHECK(finite(by_oracle));
      for (auto& v : velocity) v = {1, -2, 3, 0};
      damp(cloth.points.data(), velocity.data(), batch, TestType(0.5));
      CHECK(finite(velocity));
    });
  }
}

TEMPLATE_TEST_CASE("a collapsed spring opens along its rest direction", "[constraints]", float, double) {
  using Real = TestType;
  const DistanceConstraints list{.vertices = {{0, 1}}, .rest_length = {0.5}, .softness = {}};
  DistanceBatch<Real> batch = make_distance_batch<Real>(list, star_order(list.vertices, 2), 2);
  Points<Real> rest(2 + dummy_points), points(2 + dummy_points);
  rest[1].set({0, Real(0.3), Real(0.4)});
  batch.rest_points = rest.data();
  points[0] = {1, 2, 3, 1}, points[1] = {1, 2, 3, 3};
  project(points.data(), batch, 0, 1, Real(1));
  // The points move apart by 0.5 along (0, 0.6, 0.8). Their inverse masses give them a quarter and three
  // quarters of it. The tolerance covers rounding of coordinates up to 3, and the kernel's 32 ε of the
  // length.
  const double tolerance = 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  CHECK((points[0].vector().template cast<double>() - Vector3(1, 2 - 0.075, 3 - 0.1)).norm() <= tolerance);
  CHECK((points[1].vector().template cast<double>() - Vector3(1, 2 + 0.225, 3 + 0.3)).norm() <= tolerance);
}

TEMPLATE_TEST_CASE("a triangle collapsed to a point opens to its rest shape", "[constraints]", float,
                   double) {
  using Real = TestType;
  TriangleMesh mesh;
  mesh.positions.resize(3, 3);
  mesh.positions << 0, 0, 0, 0.3, 0.1, 0, 0.1, 0.4, 0;
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  const RestMesh shape(mesh);
  const StrainConstraints list =
      strain_constraints(shape, make_pins(shape, {}, 0), inverse_rest_from_warp(mesh, Vector3::UnitX()));
  for (const StrainForm form : {StrainForm::normalised, StrainForm::angle, StrainForm::green}) {
    StrainBatch<Real> batch = make_strain_batch<Real>(list, colour_order(list.vertices, 3), 3);
    batch.form = form;
    Points<Real> rest(3 + dummy_points), points(3 + dummy_points);
    for (int v = 0; v < 3; ++v) {
      rest[static_cast<std::size_t>(v)].set(shape.position(v).cast<Real>());
      points[static_cast<std::size_t>(v)] = {Real(0.5), Real(0.25), Real(1), 1};
    }
    batch.rest_points = rest.data();
    // The first projection opens the triangle along warp and weft at rest. Both disturb each other; the later
    // projections correct this.
    for (int i = 0; i < 40; ++i) project(points.data(), batch, 0, 1, Real(1));
    for (const auto& [a, b] : {std::pair{0u, 1u}, {1u, 2u}, {2u, 0u}})
      CHECK_THAT((points[a].vector() - points[b].vector()).norm(),
                 Catch::Matchers::WithinAbs(
                     static_cast<double>((rest[a].vector() - rest[b].vector()).norm()),
                     64 * static_cast<double>(std::numeric_limits<Real>::epsilon())));  // coordinates up to 1
  }
}

TEMPLATE_TEST_CASE("damping kernels agree with the oracle to rounding", "[constraints]", float, double) {
  const Crumpled<TestType> cloth(6);
  std::mt19937_64 random(6);
  Points<TestType> start(cloth.points.size());
  for (int v = 0; v < cloth.rest.vertex_count(); ++v)
    if (cloth.points[static_cast<std::size_t>(v)].w > 0)
      start[static_cast<std::size_t>(v)].set(test::random_vector(random).cast<TestType>());
  const auto check = [&](const auto& batch) {
    Points<TestType> by_kernel = start, by_oracle = start;
    damp(cloth.points.data(), by_kernel.data(), batch, TestType(0.5));
    damp_by_oracle(cloth.points.data(), by_oracle.data(), batch, TestType(0.5));
    CHECK(largest_difference(by_kernel, start) > 1e-2);
    CHECK(largest_difference(by_kernel, by_oracle) <= agreement<TestType> * amplification(batch));
  };
  check(cloth.distance(StiffnessKind::k));
  check(cloth.strain(StiffnessKind::k, StrainForm::normalised));
  for_elements(cloth, check);
}

TEST_CASE("every projection keeps linear and angular momentum", "[constraints]") {
  const Crumpled<double> cloth(7, false);
  // Checked colour by colour, with single springs instead of stars: within a colour, every vertex moves only
  // once, from the position at which its constraint took the gradient.
  const auto check = [&](auto batch) {
    Points<double> points = cloth.points;
    for (std::size_t c = 0; c + 1 < batch.order.colours.size(); ++c) {
      const Points<double> before = points;
      project(points.data(), batch, batch.order.colours[c], batch.order.colours[c + 1], 1e-2);
      Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
      double scale = 0;
      for (std::size_t v = 0; v < static_cast<std::size_t>(cloth.rest.vertex_count()); ++v) {
        if (!(points[v].w > 0)) continue;
        const Vector3 momentum = (points[v].vector() - before[v].vector()) / points[v].w;
        linear += momentum, angular += before[v].vector().cross(momentum), scale += momentum.norm();
      }
      CHECK(scale > 0);
      // Differences of coordinates of size 1 have an absolute error of 1e-16, and displacements are about
      // 1e-3.
      CHECK(linear.norm() <= 1e-12 * scale);
      CHECK(angular.norm() <= 1e-12 * scale);
    }
  };
  check(cloth.distance(StiffnessKind::k, false));
  check(cloth.distance(StiffnessKind::compliance, false));
  for_elements(cloth, check);
  // The terms of a triangle follow one another, each with its own gradient, so they are checked one at a
  // time.
  for (const StrainForm form :
       {StrainForm::normalised, StrainForm::green, StrainForm::angle, StrainForm::stvk})
    for (int term = 0; term < 4; ++term) {
      StrainBatch<double> batch = cloth.strain(StiffnessKind::k, form);
      batch.warp = term == 0, batch.weft = term == 1, batch.shear = term == 2, batch.area = term == 3;
      check(batch);
    }
}

TEMPLATE_TEST_CASE("collapsed elements without a rest shape and padding lanes do not move", "[constraints]",
                   float, double) {
  Crumpled<TestType> cloth(8);
  for (int v = 0; v < cloth.rest.vertex_count(); ++v)
    cloth.points[static_cast<std::size_t>(v)].set({1, 2, 3});
  const Points<TestType> start = cloth.points;
  const auto check = [&](auto batch) {
    project_all(cloth.points, batch);
    CHECK(largest_difference(cloth.points, start) == 0);
  };
  check(cloth.distance(StiffnessKind::k));
  check(cloth.distance(StiffnessKind::compliance));
  check(cloth.strain(StiffnessKind::k, StrainForm::normalised));
  check(cloth.strain(StiffnessKind::compliance, StrainForm::green));
  for_elements(cloth, check);
}

TEST_CASE("k' leaves 1 - k of the error of an isolated constraint after n projections", "[constraints]") {
  for (const int n : {1, 2, 10, 50}) {
    std::array<Point<double>, 2> points = {Point<double>{0, 0, 0, 1}, Point<double>{2, 0, 0, 3}};
    const Places<double> places(points.data());
    const double k = k_of_projection(StiffnessKind::k_per_step, 0.3, n);
    for (int i = 0; i < n; ++i)
      project_by_oracle<double>(corners_at(places, offset_of(0), offset_of(1)),
                                distance_constraint<double>({points[0].vector(), points[1].vector()}, 1), k,
                                nullptr, 0.0);
    // The violation falls from 1 to 0.7, up to the rounding of at most 50 multiplications.
    CHECK_THAT((points[1].vector() - points[0].vector()).norm() - 1, Catch::Matchers::WithinAbs(0.7, 1e-14));
  }
}

}  // namespace bendlab::kernels_test
