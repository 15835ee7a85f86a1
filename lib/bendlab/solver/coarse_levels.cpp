#include "bendlab/solver/coarse_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/quad.hpp"
#include "bendlab/mesh/geodesics.hpp"
#include "bendlab/solver/colouring.hpp"
#include "bendlab/solver/memory.hpp"

namespace bendlab {
namespace {

// The least distance between points of the finest coarse level, in mean edges of the mesh. Each coarser level
// doubles the distance. On a mesh of squares 1.7 mean edges are just below two sides, because a mean edge is
// longer than a side: diagonals are edges, too.
constexpr double level_edges = 1.7;
constexpr double longest_span = 1.6;  // in least distances between points: joins diagonals of squares
constexpr int fewest_points = 6;
constexpr int coarsest_sweeps = 8;  // a sweep over the coarsest level costs next to nothing
// The compliance of a span as a multiple of the membrane's largest compliance. Spans add to the stiffness of
// the triangles; soft spans add little where the projections of the triangles converge.
constexpr double span_softness = 64;
constexpr std::size_t worthwhile_lanes = 2048, worthwhile_points = 16384;  // about 10 µs of one thread

// Spans resist stretch in every direction, so the membrane has to resist stretch in every direction, too.
void expect_all_directions(const StrainStiffness& strain) {
  if (strain.warp > 0 && strain.weft > 0 && strain.shear > 0) return;
  throw std::invalid_argument(
      "/solver/levels needs a membrane that resists warp, weft and shear, because coarse levels resist "
      "stretch in every direction. Set /solver/levels to 0, or warp, weft and shear in /material/strain "
      "above 0");
}

}  // namespace

template <class Real>
struct CoarseLevels<Real>::Builder {
  const SimulationInput& input;
  RestMesh rest;
  GeodesicDiscs discs;
  std::vector<int> finer;  // vertices of the next finer level's points; of the cloth at first
  std::vector<double> finer_mass;

  explicit Builder(const SimulationInput& of)
      : input(of), rest(mesh_of(of)), discs(rest), finer(of.mass.size()), finer_mass(of.mass) {
    std::iota(finer.begin(), finer.end(), 0);
  }

  static TriangleMesh mesh_of(const SimulationInput& input) {
    TriangleMesh mesh;
    mesh.positions = input.rest.rows() > 0 ? input.rest : input.positions;
    mesh.triangles.resize(static_cast<Eigen::Index>(input.strain.size()), 3);
    for (std::size_t t = 0; t < input.strain.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c)
        mesh.triangles(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(c)) =
            input.strain.vertices[t][c];
    return mesh;
  }

  bool is_free(int v) const {
    const auto at = static_cast<std::size_t>(v);
    return !input.is_pinned[at] && input.mass[at] > 0;
  }
  int slot(int v) const {
    return input.permutation.empty() ? v : input.permutation[static_cast<std::size_t>(v)];
  }

  // Points that are at least `apart` (m) from each other. Every vertex has a point within this distance.
  // Pinned vertices are chosen first, because the cloth that hangs from a pin needs the pin's position. `at`:
  // for each vertex, the index of the point at the vertex, or -1.
  struct Sample {
    std::vector<int> points, at;
    DistanceConstraints spans;
    std::vector<std::vector<Hat>> hats;  // by vertex
    int free_count = 0;
  };
  Sample sample(double apart) {
    const auto count = static_cast<std::size_t>(rest.vertex_count());
    Sample sample;
    sample.at.assign(count, -1), sample.hats.resize(count);
    for (const bool pinned_now : {true, false})
      for (int v = 0; v < rest.vertex_count(); ++v)
        if (is_free(v) != pinned_now && sample.hats[static_cast<std::size_t>(v)].empty())
          add(sample, v, apart);
    for (std::vector<Hat>& hats : sample.hats) {
      Real sum = 0;
      for (const Hat& hat : hats) sum += hat.share;
      for (Hat& hat : hats) hat.share /= sum;
    }
    return sample;
  }

  void add(Sample& sample, int v, double apart) {
    const auto point = static_cast<int>(sample.points.size());
    for (const GeodesicDiscs::Member& near : discs.around(v, longest_span * apart)) {
      const auto at = static_cast<std::size_t>(near.vertex);
      const int other = sample.at[at];
      if (other >= 0 && (is_free(v) || is_free(near.vertex))) {
        sample.spans.vertices.push_back({other, point});
        sample.spans.rest_length.push_back(near.distance);
      }
      if (near.distance < apart)
        sample.hats[at].push_back({point, static_cast<Real>(1 - near.distance / apart)});
    }
    sample.at[static_cast<std::size_t>(v)] = point;
    sample.points.push_back(v);
    sample.free_count += is_free(v);
  }

  Level level(const Sample& sample, bool finer_is_cloth) {
    Level level;
    const auto count = sample.points.size();
    level.base.resize(count + dummy_points), level.moved = level.taken = level.base;
    // Hats spread masses with the same shares as moves, so that moves keep momentum.
    std::vector<double> mass(count);
    for (std::size_t p = 0; p < finer.size(); ++p)
      if (is_free(finer[p]))
        for (const Hat& hat : sample.hats[static_cast<std::size_t>(finer[p])])
          mass[static_cast<std::size_t>(hat.point)] += static_cast<double>(hat.share) * finer_mass[p];
    for (std::size_t p = 0; p < count; ++p) {
      level.slot.push_back(slot(sample.points[p]));
      if (is_free(sample.points[p])) level.base[p].w = static_cast<Real>(1 / mass[p]);
    }
    place_dummies(level.base, count);
    level.hats.first.push_back(0);
    std::vector<int> vertex_of(finer);
    if (finer_is_cloth)
      for (const int v : finer) vertex_of[static_cast<std::size_t>(slot(v))] = v;
    for (const int v : vertex_of) {
      if (is_free(v)) {
        const std::vector<Hat>& hats = sample.hats[static_cast<std::size_t>(v)];
        level.hats.all.insert(level.hats.all.end(), hats.begin(), hats.end());
      }
      level.hats.first.push_back(level.hats.all.size());
    }
    level.spans = make_distance_batch<Real>(
        sample.spans, star_order(sample.spans.vertices, static_cast<int>(count)), static_cast<int>(count));
    level.spans.only_pulls = true;
    const StrainStiffness& strain = input.strain_stiffness;
    level.spans.kind = strain.kind;
    level.spans.compliance = static_cast<Real>(span_softness * input.softest_membrane());
    level.spans.k = static_cast<Real>(k_of_projection(
        strain.kind, std::max({strain.warp, strain.weft, strain.shear}), input.settings.iterations));
    if (strain.kind == StiffnessKind::compliance) level.spans.multiplier.assign(level.spans.b.size(), 0);
    finer = sample.points, finer_mass = std::move(mass);
    return level;
  }
};

template <class Real>
CoarseLevels<Real>::CoarseLevels(const SimulationInput& input, int most_levels) {
  if (most_levels == 0 || input.strain.size() == 0) return;
  expect_all_directions(input.strain_stiffness);
  compliance_ = span_softness * input.softest_membrane();
  Builder builder(input);
  double apart = level_edges * builder.rest.mean_edge_length();
  for (int l = 0; l < most_levels; ++l, apart *= 2) {
    const typename Builder::Sample sample = builder.sample(apart);
    if (sample.free_count < fewest_points || sample.points.size() >= builder.finer.size()) return;
    levels_.push_back(builder.level(sample, l == 0));
  }
}

bool levels_are_worthwhile(const SimulationInput& input) {
  const Positions& rest = input.rest.rows() > 0 ? input.rest : input.positions;
  double length = 0;
  for (const auto& [a, b, c] : input.strain.vertices)
    length += ((rest.row(a) - rest.row(b)).norm() + (rest.row(b) - rest.row(c)).norm() +
               (rest.row(c) - rest.row(a)).norm()) /
              3;
  const double mean_edge = length / static_cast<double>(input.strain.size());
  return input.strain.size() > 0 && input.settings.substeps * mean_edge < input.size;
}

template <class Real>
void CoarseLevels<Real>::begin_substep() {
  for (Level& level : levels_)
    std::fill(level.spans.multiplier.begin(), level.spans.multiplier.end(), Real(0));
}

template <class Real>
void CoarseLevels<Real>::take_over(Level& level, const Places<Real>& cloth) const {
  for (std::size_t p = 0; p < level.slot.size(); ++p) {
    const auto slot = static_cast<std::size_t>(level.slot[p]);
    level.taken[p] = level.moved[p] = cloth.moved[slot];
    if (cloth.base != nullptr)
      level.base[p].set(cloth.base[slot].vector()), level.moved[p].w = 0;
    else
      level.moved[p].w = level.base[p].w;
  }
}

template <class Real>
void CoarseLevels<Real>::shorten(Level& level, bool is_split, Real h, int sweeps, Workers& workers) const {
  const Places<Real> places =
      is_split ? Places<Real>(level.base.data(), level.moved.data()) : Places<Real>(level.moved.data());
  const std::vector<std::size_t>&colours = level.spans.order.colours, &stacks = level.spans.order.stacks;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t step = 0; step + 1 < colours.size(); ++step) {
      const bool backwards = sweep % 2 == 1;
      const std::size_t colour = backwards ? colours.size() - 2 - step : step;
      const std::size_t first = colours[colour], last = colours[colour + 1];
      workers.for_range(
          first, last, stacks[last] - stacks[first] >= worthwhile_lanes,
          [&](std::size_t from, std::size_t to) { project(places, level.spans, from, to, h, backwards); });
    }
}

template <class Real>
void CoarseLevels<Real>::correct(const Places<Real>& cloth, Real h, Workers& workers) {
  using Quad = typename detail::QuadType<Real>::type;
  for (Level& level : levels_) take_over(level, cloth);
  for (std::size_t l = levels_.size(); l-- > 0;) {
    Level& level = levels_[l];
    shorten(level, cloth.base != nullptr, h, l + 1 == levels_.size() ? coarsest_sweeps : 1, workers);
    Point<Real>* const finer = l > 0 ? levels_[l - 1].moved.data() : cloth.moved;
    const std::size_t finer_count = level.hats.first.size() - 1;
    workers.for_range(
        0, finer_count, finer_count >= worthwhile_points, [&](std::size_t first, std::size_t last) {
          for (std::size_t p = first; p < last; ++p) {
            Quad move{};
            for (std::size_t i = level.hats.first[p]; i < level.hats.first[p + 1]; ++i) {
              const Hat& hat = level.hats.all[i];
              const auto at = static_cast<std::size_t>(hat.point);
              move += hat.share * (detail::load_point(level.moved[at]) - detail::load_point(level.taken[at]));
            }
            move[3] = 0;  // the inverse mass stays
            detail::store_point<Real>(finer[p], detail::load_point(finer[p]) + move);
          }
        });
  }
}

template <class Real>
std::size_t CoarseLevels<Real>::span_count() const {
  std::size_t count = 0;
  for (const Level& level : levels_) count += level.spans.count;
  return count;
}

template <class Real>
std::size_t CoarseLevels<Real>::memory_bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels_)
    sum += bytes_of(level.slot) + bytes_of(level.base) + bytes_of(level.moved) + bytes_of(level.taken) +
           bytes_of(level.spans) + bytes_of(level.hats.first) + bytes_of(level.hats.all);
  return sum;
}

template class CoarseLevels<float>;
template class CoarseLevels<double>;

}  // namespace bendlab
