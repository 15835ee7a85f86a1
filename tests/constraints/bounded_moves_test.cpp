// Rounding causes no wild corrections. For any pose and any pinned corners, a projection is finite, moves no
// corner farther than its bound, keeps momentum, and does not increase the error that it should reduce.
#include <functional>
#include <tuple>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "bendlab/io/without_traps.hpp"
#include "bendlab/solver/colouring.hpp"
#include "tests/catch.hpp"
#include "tests/poses.hpp"

namespace bendlab::constraints_bounded_moves_test {
namespace {

using test::Poses, test::poses, test::size_of_pose;

enum class Road { kernel, split, oracle };

// How far each corner moves in one projection of every constraint, m.
template <class Real, std::size_t N, class Batch>
std::vector<std::array<Vector3, N>> moves(const Poses<N>& poses, Batch batch, Road road) {
  const std::size_t vertices = poses.size() * N;
  Points<Real> points(vertices + dummy_points), rest(vertices + dummy_points), moved(vertices + dummy_points);
  for (std::size_t c = 0; c < poses.size(); ++c)
    for (std::size_t i = 0; i < N; ++i) {
      Point<Real>& point = points[c * N + i];
      point.set(poses.now[c][i].template cast<Real>());
      point.w = poses.mass[c][i] > 0 ? static_cast<Real>(1 / poses.mass[c][i]) : Real(0);
      rest[c * N + i].set(poses.rest[c][i].template cast<Real>());
    }
  for (int corner = 1; corner < 4; ++corner)
    for (std::size_t lane = 0; lane < max_lanes; ++lane)
      points[vertices + static_cast<std::size_t>(corner) * max_lanes + lane].set(
          Vector3Of<Real>::Unit(corner - 1));
  batch.rest_points = rest.data();
  const Points<Real> before = points;
  const Places<Real> places =
      road == Road::split ? Places<Real>(before.data(), moved.data()) : Places<Real>(points.data());
  if (road == Road::oracle)
    project_by_oracle(places, batch, Real(1e-3));
  else
    for (std::size_t c = 0; c + 1 < batch.order.colours.size(); ++c)
      project(places, batch, batch.order.colours[c], batch.order.colours[c + 1], Real(1e-3));
  std::vector<std::array<Vector3, N>> result(poses.size());
  for (std::size_t c = 0; c < poses.size(); ++c)
    for (std::size_t i = 0; i < N; ++i) {
      const std::size_t v = c * N + i;
      result[c][i] = (road == Road::split ? moved : points)[v].vector().template cast<double>();
      if (road != Road::split) result[c][i] -= before[v].vector().template cast<double>();
    }
  return result;
}

template <std::size_t N>
std::array<Vector3, N> after(const std::array<Vector3, N>& now, const std::array<Vector3, N>& way) {
  std::array<Vector3, N> p;
  for (std::size_t i = 0; i < N; ++i) p[i] = now[i] + way[i];
  return p;
}

// `bound`: how far a corner may move, in sizes of the pose. `error(c, p)`: |C| of the constraint c at p, or
// nothing if it is not checked.
template <class Real, std::size_t N>
void check_moves(
    const Poses<N>& poses, const std::vector<std::array<Vector3, N>>& all, double bound, Road road,
    const std::function<std::optional<double>(std::size_t, const std::array<Vector3, N>&)>& error) {
  constexpr double epsilon = std::numeric_limits<Real>::epsilon();
  for (std::size_t c = 0; c < poses.size(); ++c) {
    double farthest = 0, momentum_scale = 0, position = 0;
    bool finite = true, pinned = false;
    Vector3 momentum = Vector3::Zero();
    for (std::size_t i = 0; i < N; ++i) {
      finite = finite && all[c][i].allFinite();
      farthest = std::max(farthest, all[c][i].norm());
      position = std::max(position, poses.now[c][i].norm());
      pinned = pinned || poses.mass[c][i] == 0;
      momentum += poses.mass[c][i] * all[c][i];
      momentum_scale += poses.mass[c][i] * all[c][i].norm();
    }
    const double size = size_of_pose(poses.now[c], poses.rest[c]);
    CAPTURE(c, static_cast<int>(road), size, farthest);
    REQUIRE(finite);
    // With whole positions, a move is the difference of two positions that are both rounded.
    const double rounding = (road == Road::split ? 0 : 2 * position * epsilon) + 1e-3 * size;
    REQUIRE(farthest <= bound * size + rounding);
    if (!pinned) {
      // The move of each corner is rounded separately.
      double masses = 0;
      for (const double mass : poses.mass[c]) masses += mass;
      REQUIRE(momentum.norm() <=
              1e2 * epsilon * (momentum_scale + masses * (road == Road::split ? size : position)));
    }
    const std::optional<double> start = error(c, poses.now[c]),
                                end = error(c, after<N>(poses.now[c], all[c]));
    if (start && end) {
      CAPTURE(*start, *end);
      CHECK(*end <= *start + 1e2 * epsilon * (1 + position / size));
    }
  }
}

template <class Real, std::size_t N, class Batch, class Error>
void check_all_roads(const Poses<N>& poses, const Batch& batch, double bound, const Error& error) {
  for (const Road road : {Road::kernel, Road::split, Road::oracle}) {
    if (road == Road::split && sizeof(Real) == sizeof(double)) continue;
    check_moves<Real, N>(poses, moves<Real, N>(poses, batch, road), bound, road, error);
  }
}

template <std::size_t N>
std::vector<std::array<int, N>> vertices_of(const Poses<N>& poses) {
  std::vector<std::array<int, N>> list(poses.size());
  for (std::size_t c = 0; c < list.size(); ++c)
    for (std::size_t i = 0; i < N; ++i) list[c][i] = static_cast<int>(c * N + i);
  return list;
}

template <class Batch>
void set_stiffness(Batch& batch, bool compliant, std::size_t multipliers) {
  batch.kind = compliant ? StiffnessKind::compliance : StiffnessKind::k;
  if (compliant) batch.multiplier.assign(multipliers, 0);
}

}  // namespace

TEMPLATE_TEST_CASE("a spring's projection is bounded by the spring", "[constraints]", float, double) {
  for (const double unit : {1.0, 1e-3, 1e3}) {
    const Poses<2> all = poses<2>(1, unit);
    DistanceConstraints list;
    list.vertices = PairList(vertices_of(all));
    for (const auto& rest : all.rest) list.rest_length.push_back((rest[1] - rest[0]).norm());
    const auto error = [&](std::size_t c, const std::array<Vector3, 2>& p) -> std::optional<double> {
      return std::abs((p[1] - p[0]).norm() / list.rest_length[c] - 1);
    };
    for (const bool compliant : {false, true}) {
      auto batch =
          make_distance_batch<TestType>(list, star_order(list.vertices, static_cast<int>(2 * all.size())),
                                        static_cast<int>(2 * all.size()));
      batch.compliance = TestType(1e-6);
      set_stiffness(batch, compliant, batch.b.size());
      check_all_roads<TestType>(all, batch, 1, error);
    }
  }
}

TEMPLATE_TEST_CASE("a triangle's projections are bounded", "[constraints]", float, double) {
  const WithoutTraps overflow;  // points far apart overflow in single precision
  for (const double unit : {1.0, 1e-3, 1e3}) {
    const Poses<3> all = poses<3>(2, unit);
    StrainConstraints list;
    list.vertices = vertices_of(all);
    for (const auto& rest : all.rest) {
      Eigen::Matrix2d q;
      q << rest[1].x() - rest[0].x(), rest[2].x() - rest[0].x(), rest[1].y() - rest[0].y(),
          rest[2].y() - rest[0].y();
      const Eigen::Matrix2d inverse = q.inverse();
      list.inverse_rest.push_back({inverse(0, 0), inverse(0, 1), inverse(1, 0), inverse(1, 1)});
    }
    for (const bool compliant : {false, true})
      for (const StrainForm form : {StrainForm::normalised, StrainForm::green, StrainForm::angle})
        for (int term = 0; term < 4; ++term) {
          auto batch =
              make_strain_batch<TestType>(list, colour_order(list.vertices, static_cast<int>(3 * all.size())),
                                          static_cast<int>(3 * all.size()));
          batch.form = form, batch.compliance = TestType(1e-6);
          batch.warp = term == 0, batch.weft = term == 1, batch.shear = term == 2, batch.area = term == 3;
          set_stiffness(batch, compliant, 4 * batch.a.size());
          const bool published_shear = term == 2 && form == StrainForm::normalised;
          CAPTURE(unit, compliant, static_cast<int>(form), term);
          // Stretch along a direction is linear in the corners, except for the length of f. Other terms are
          // not linear and may overshoot.
          const auto error = [&](std::size_t c, const std::array<Vector3, 3>& p) -> std::optional<double> {
            if (term > 1 || form == StrainForm::green) return std::nullopt;
            const auto s = stretch_constraint<double>(p, list.inverse_rest[c], term, StrainForm::normalised);
            return s.defined ? std::optional(std::abs(s.value)) : std::nullopt;
          };
          check_all_roads<TestType>(all, batch, published_shear ? largest_published_move : largest_move,
                                    error);
        }
  }
}

TEMPLATE_TEST_CASE("a hinge's projection is bounded", "[constraints]", float, double) {
  for (const double unit : {1.0, 1e-3, 1e3}) {
    const Poses<4> all = poses<4>(3, unit);
    for (const bool compliant : {false, true}) {
      for (const auto law : {HingeAngle::Law::angle, HingeAngle::Law::half_sine}) {
        ElementList<HingeAngle> list;
        list.law = law, list.vertices = vertices_of(all);
        for (const auto& rest : all.rest) {
          list.rest.push_back({0, 1 / (rest[1] - rest[0]).norm(), 0, 1});
          list.softness.push_back(1);
        }
        auto batch =
            make_element_batch<TestType>(list, colour_order(list.vertices, static_cast<int>(4 * all.size())),
                                         static_cast<int>(4 * all.size()));
        batch.compliance = TestType(1e-6);
        set_stiffness(batch, compliant, batch.order.lane_count());
        check_all_roads<TestType>(
            all, batch, largest_move,
            [](std::size_t, const auto&) -> std::optional<double> { return std::nullopt; });
      }
      for (const auto law : {QuadraticBend::Law::norm, QuadraticBend::Law::energy}) {
        ElementList<QuadraticBend> list;
        list.law = law, list.vertices = vertices_of(all);
        for (const auto& rest : all.rest) {
          const double edge = (rest[1] - rest[0]).norm();
          list.rest.push_back({1 / edge, 1 / edge, -1 / edge, -1 / edge, 0, edge});
          list.softness.push_back(1);
        }
        auto batch =
            make_element_batch<TestType>(list, colour_order(list.vertices, static_cast<int>(4 * all.size())),
                                         static_cast<int>(4 * all.size()));
        batch.compliance = TestType(1e-6);
        set_stiffness(batch, compliant, batch.order.lane_count());
        // Kx, in units of the pose's size, is linear in the corners.
        const auto error = [&](std::size_t c, const std::array<Vector3, 4>& p) -> std::optional<double> {
          const auto value = QuadraticBend::value<double>(p, list.rest[c], QuadraticBend::Law::norm);
          return std::abs(value.value);
        };
        check_all_roads<TestType>(all, batch, largest_move, error);
      }
    }
  }
}

TEMPLATE_TEST_CASE("an arc's projection is bounded", "[constraints]", float, double) {
  for (const double unit : {1.0, 1e-3, 1e3})
    for (const bool compliant : {false, true})
      for (const auto law : {ArcSpring::Law::exact, ArcSpring::Law::polynomial}) {
        const Poses<2> all = poses<2>(4, unit);
        ElementList<ArcSpring> list;
        list.law = law, list.vertices = vertices_of(all);
        for (const auto& rest : all.rest) {
          list.rest.push_back({(rest[1] - rest[0]).norm()});
          list.softness.push_back(1);
        }
        auto batch =
            make_element_batch<TestType>(list, colour_order(list.vertices, static_cast<int>(2 * all.size())),
                                         static_cast<int>(2 * all.size()));
        batch.compliance = TestType(1e-6);
        set_stiffness(batch, compliant, batch.order.lane_count());
        check_all_roads<TestType>(
            all, batch, largest_move,
            [](std::size_t, const auto&) -> std::optional<double> { return std::nullopt; });
      }
}

}  // namespace bendlab::constraints_bounded_moves_test
