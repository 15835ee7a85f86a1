// The energy of springs in a bent sheet, compared with geometry. For our model sparse_lod: few springs per
// vertex at any LOD level.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::spring_models_test {
namespace {

using Catch::Matchers::WithinRel;

constexpr double pi = std::numbers::pi;

// A lattice with rows along x, folded by the same angle at every row. Strips between rows stay flat, and
// edges keep their length.
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

// The springs whose midpoint is within `reach` of the sheet's centre along both axes.
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

// Largest minus smallest energy over the directions of bending, relative to the mean.
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

TEST_CASE("the energy of ring springs follows from their shortening in a folded lattice", "[bending]") {
  // W = C κ⁴ / 4 with C = c k a⁴. A spring of rest length l over n rows of height h shortens by n² (n² - 1)
  // h⁴ κ² / (24 l). A separate computation in integer coordinates of the lattice summed this over the 3 t
  // springs per vertex; the same sum follows below.
  const double h = std::numbers::sqrt3 / 2;
  const std::map<int, double> computed_apart = {{2, 0.15223}, {3, 3.3926}, {4, 27.507}, {5, 135.77}};
  const RestMesh rest(equilateral(1, 1, 64));
  const double a = rest.mean_edge_length(), curvature = 0.02 / a;
  for (const auto& [t, coefficient] : computed_apart) {
    // By hand: the vertices of the ring above the centre. Half of the vertices level with the centre count,
    // too, but their springs do not shorten.
    double sum = 0;
    for (int n = 1; n <= t; ++n)
      for (int place = 0; place <= (n == t ? t : 1); ++place) {
        // Row n < t meets the ring at two vertices. Row t is a whole side of the ring.
        const double x = n == t ? place - 0.5 * t : (place == 0 ? -1 : 1) * (t - 0.5 * n);
        const double length = std::hypot(x, n * h);
        sum += std::pow(n * n * (n * n - 1) * std::pow(h, 4) / (24 * length), 2);
      }
    // ½ k δ² per spring and one vertex per area h give C / 4.
    CHECK_THAT(2 * sum / h, WithinRel(coefficient, 1e-3));

    const DistanceConstraints springs =
        test::built("k_ring", rest, {{"k", std::int64_t{t}}, {"rings", std::string("last")}}).distance;
    // A spring belongs to its lower end. Only springs whose lower end is in the middle count.
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
    // κ a = 0.02, so the next term of the chord is of order (t κ a)² / 20.
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
  // The setting `springs`, except for a few springs in the pinned corner.
  CHECK_THAT(per_vertex.front(), WithinRel(4.0, 0.01));
  for (const double count : per_vertex) CHECK_THAT(count, WithinRel(per_vertex.front(), 0.02));
}

TEST_CASE("sparse_lod chooses springs at a vertex whose triangles have no area", "[bending]") {
  // The corner lies on the opposite corner of its cell, exactly or almost. Both cases give the same springs.
  const auto springs = [](double away) {
    TriangleMesh mesh = grid(1, 1, 8, 8);
    // A row has 9 vertices, so vertex 10 lies one row up and one vertex on.
    const double x = mesh.positions(10, 0), y = mesh.positions(10, 1);
    mesh.positions.row(0) << x - away, y - 1.1 * away, 0;
    auto pairs = test::plain(sparse_springs(RestMesh(std::move(mesh)), 3).vertices);
    std::ranges::sort(pairs);
    return pairs;
  };
  CHECK(springs(0) == springs(1e-9));
}

TEST_CASE("sparse_lod is equally stiff in all directions", "[bending]") {
  // Springs are spread evenly and weighted by length. Directions differ by at most 5 % on structured,
  // equilateral and irregular meshes, while those of the whole ring differ by up to ± 23 % (Σ cos⁸ over three
  // directions).
  const std::array meshes = {RestMesh(grid(1, 1, 64, 64)),
                             RestMesh(grid(1, 1, 64, 64, Diagonal::alternating)),
                             RestMesh(equilateral(1, 1, 64)), RestMesh(delaunay(1, 1, 64, 3))};
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh)
    for (const std::int64_t t : {2, 3, 5, 8}) {
      if (mesh == 0 && t == 2) continue;  // its ring 2 has gaps of 45°: 12 %
      INFO("mesh " << mesh << ", t = " << t);
      CHECK(anisotropy(sparse_springs(meshes[mesh], t), meshes[mesh]) <= 0.05);
    }
}

TEST_CASE("the softness of sparse_lod springs gives all of them the same energy", "[bending]") {
  const RestMesh rest(grid(1, 1, 32, 32));
  const DistanceConstraints springs = sparse_springs(rest, 4);
  REQUIRE(springs.softness.size() == springs.size());
  const double radius = 4 * rest.mean_edge_length();
  // The chord of an arc of length l at curvature κ is shorter by l³ κ² / 24. The square of this over the
  // softness is the same for all springs.
  for (std::size_t s = 0; s < springs.size(); ++s)
    CHECK_THAT(std::pow(springs.rest(s), 6) / springs.softness[s], WithinRel(std::pow(radius, 6), 1e-12));
}

}  // namespace bendlab::spring_models_test
