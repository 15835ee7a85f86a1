// The springs' energy in a bent sheet against what geometry says, and ours: few springs, whatever the level.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab {
namespace {

using Catch::Matchers::WithinRel;

constexpr double pi = std::numbers::pi;

// A lattice with rows along x, folded by the same angle at every row: strips stay flat and edges keep their
// length.
Positions folded_at_rows(const RestMesh& rest, double curvature, double row_height) {
  Positions positions = rest.positions();
  const double lowest = positions.col(1).minCoeff(), turn = curvature * row_height;
  const int rows = static_cast<int>(std::lround((positions.col(1).maxCoeff() - lowest) / row_height));
  std::vector<std::array<double, 2>> profile{{0, 0}};
  for (int r = 0; r < rows; ++r)
    profile.push_back({profile.back()[0] + row_height * std::cos(r * turn),
                       profile.back()[1] + row_height * std::sin(r * turn)});
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const auto row = static_cast<std::size_t>(std::lround((positions(v, 1) - lowest) / row_height));
    positions(v, 1) = profile[row][0], positions(v, 2) = profile[row][1];
  }
  return positions;
}

// The springs whose middle lies in the middle of the sheet: within `reach` of its centre along both axes.
DistanceConstraints in_the_middle(const DistanceConstraints& springs, const RestMesh& rest, double reach) {
  DistanceConstraints middle;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [a, b] = springs.vertices[s];
    const Vector3 at = (rest.position(a) + rest.position(b)) / 2 - rest.centre();
    if (std::max(std::abs(at.x()), std::abs(at.y())) > reach) continue;
    middle.vertices.push_back({a, b});
    middle.rest_length.push_back(springs.rest(s));
    if (!springs.softness.empty()) middle.softness.push_back(springs.softness[s]);
  }
  return middle;
}

DistanceConstraints sparse_springs(const RestMesh& rest, std::int64_t t) {
  return test::built("sparse_lod", rest, {{"t", t}}).distance;
}

// Largest and smallest energy over directions of bending, by their mean.
double anisotropy(const DistanceConstraints& springs, const RestMesh& rest) {
  const DistanceConstraints middle = in_the_middle(springs, rest, 0.3);
  const double curvature = 0.02 / rest.mean_edge_length();
  double least = 1e300, most = 0, sum = 0;
  constexpr int directions = 18;
  for (int d = 0; d < directions; ++d) {
    const double energy = elastic_energy(middle, test::bent(rest, curvature, d * pi / directions));
    least = std::min(least, energy), most = std::max(most, energy), sum += energy;
  }
  return (most - least) / (sum / directions);
}

}  // namespace

TEST_CASE("ring springs have the energy that a folded lattice shortens them by", "[bending]") {
  // W = C κ⁴ / 4 with C = c k a⁴: springs of rest length l over n rows of height h shorten by n² (n² - 1) h⁴
  // κ² / (24 l); summed over the 3 t springs per vertex (a separate computation in arithmetic of the lattice;
  // the same sum below).
  const double h = std::numbers::sqrt3 / 2;
  const std::map<int, double> computed_apart = {{2, 0.15223}, {3, 3.3926}, {4, 27.507}, {5, 135.77}};
  const RestMesh rest(equilateral(1, 1, 64));
  const double a = rest.mean_edge_length(), curvature = 0.02 / a;
  for (const auto& [t, coefficient] : computed_apart) {
    // By hand: of the ring's 6 t vertices those above, and half of those level with, the centre (which do not
    // shorten).
    double sum = 0;
    for (int n = 1; n <= t; ++n)
      for (int place = 0; place <= (n == t ? t : 1); ++place) {
        // Row n crosses the ring at its two ends, the last row along its whole side.
        const double x = n == t ? place - 0.5 * t : (place == 0 ? -1 : 1) * (t - 0.5 * n);
        const double length = std::hypot(x, n * h);
        sum += std::pow(n * n * (n * n - 1) * std::pow(h, 4) / (24 * length), 2);
      }
    // ½ k δ² per spring, one vertex per area h: C / 4.
    CHECK_THAT(2 * sum / h, WithinRel(coefficient, 1e-3));

    const DistanceConstraints springs =
        test::built("k_ring", rest, {{"k", std::int64_t{t}}, {"rings", std::string("last")}}).distance;
    // A spring belongs to the row of its lower end; count vertices whose springs all lie inside.
    DistanceConstraints middle;
    std::vector<int> owners;
    for (std::size_t s = 0; s < springs.size(); ++s) {
      auto [low, high] = springs.vertices[s];
      if (rest.position(low).y() > rest.position(high).y() + 1e-9 ||
          (std::abs(rest.position(low).y() - rest.position(high).y()) < 1e-9 &&
           rest.position(low).x() > rest.position(high).x()))
        std::swap(low, high);
      if ((rest.position(low) - rest.centre()).cwiseAbs().maxCoeff() > 0.25) continue;
      middle.vertices.push_back({low, high});
      middle.rest_length.push_back(springs.rest(s));
      owners.push_back(low);
    }
    std::sort(owners.begin(), owners.end());
    const auto count = std::unique(owners.begin(), owners.end()) - owners.begin();
    CHECK(middle.size() == static_cast<std::size_t>(3 * t * count));
    const double area = static_cast<double>(count) * h * a * a;
    const double energy = elastic_energy(middle, folded_at_rows(rest, curvature, h * a));
    INFO(t);
    // κ a = 0.02: the next term of the chord is of order (t κ a)² / 20.
    CHECK_THAT(4 * energy / (std::pow(curvature, 4) * area * std::pow(a, 4)), WithinRel(coefficient, 0.01));
  }
}

TEST_CASE("sparse_lod has the same number of springs per vertex at any resolution", "[bending]") {
  std::vector<double> per_vertex;
  for (const int cells : {32, 64, 128, 256}) {
    const RestMesh rest(grid(1, 1, cells, cells));
    const Pins pins = make_pins(rest, select_vertices(rest, Place::upper_right), 1);
    const DistanceConstraints springs = test::built("sparse_lod", rest, pins).distance;
    per_vertex.push_back(static_cast<double>(springs.size()) / rest.vertex_count());
  }
  CHECK_THAT(per_vertex.front(), WithinRel(4.0, 0.01));  // `springs`, but for a few in the pinned corner
  for (const double count : per_vertex) CHECK_THAT(count, WithinRel(per_vertex.front(), 0.02));
}

TEST_CASE("sparse_lod finds directions where a vertex's triangles have no area", "[bending]") {
  // The corner lies on its cell's opposite corner, exactly or all but: the springs are the same.
  const auto springs = [](double away) {
    TriangleMesh mesh = grid(1, 1, 8, 8);
    const double x = mesh.positions(10, 0), y = mesh.positions(10, 1);  // 9 vertices a row: one up, one along
    mesh.positions.row(0) << x - away, y - 1.1 * away, 0;
    auto found = test::plain(sparse_springs(RestMesh(std::move(mesh)), 3).vertices);
    std::ranges::sort(found);
    return found;
  };
  CHECK(springs(0) == springs(1e-9));
}

TEST_CASE("sparse_lod bends alike in all directions", "[bending]") {
  // Springs spread evenly and weighed by length: 5 % between any two directions on structured, triangular and
  // irregular meshes, where the whole ring has up to ± 23 % (Σ cos⁸ over three directions).
  const std::array meshes = {RestMesh(grid(1, 1, 64, 64)),
                             RestMesh(grid(1, 1, 64, 64, Diagonal::alternating)),
                             RestMesh(equilateral(1, 1, 64)), RestMesh(delaunay(1, 1, 64, 3))};
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh)
    for (const std::int64_t t : {2, 3, 5, 8}) {
      if (mesh == 0 && t == 2) continue;  // the two-ring has gaps of 45°: 12 % there
      INFO("mesh " << mesh << ", t = " << t);
      CHECK(anisotropy(sparse_springs(meshes[mesh], t), meshes[mesh]) <= 0.05);
    }
}

TEST_CASE("sparse_lod springs are as soft as they shorten little", "[bending]") {
  const RestMesh rest(grid(1, 1, 32, 32));
  const DistanceConstraints springs = sparse_springs(rest, 4);
  REQUIRE(springs.softness.size() == springs.size());
  const double radius = 4 * rest.mean_edge_length();
  // An arc of length l at curvature κ has a chord shorter by l³ κ² / 24; squared and over the softness, the
  // same for all.
  for (std::size_t s = 0; s < springs.size(); ++s)
    CHECK_THAT(std::pow(springs.rest(s), 6) / springs.softness[s], WithinRel(std::pow(radius, 6), 1e-12));
}

}  // namespace bendlab
