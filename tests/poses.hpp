// Poses in which a constraint's gradient may consist of rounding only: right angles, lines, points, closed
// folds, and random poses. Each corner is pinned or free, in all combinations.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "tests/support.hpp"

namespace bendlab::test {

// Corners of many poses of one constraint. Each pose has its own vertices.
template <std::size_t N>
struct Poses {
  std::vector<std::array<Vector3, N>> rest, now;
  std::vector<std::array<double, N>> mass;  // kg; 0: pinned

  std::size_t size() const { return now.size(); }
};

// The four corners of a hinge: with right angles at the ends of its edge, equilateral, or random. Its first
// three corners serve as a triangle, its first two as a segment.
inline std::array<Vector3, 4> shape(std::mt19937_64& random, int kind) {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY();
  if (kind == 0) return {Vector3::Zero(), x, x + y, x - y};  // all right angles at one end of the edge
  if (kind == 1) return {Vector3::Zero(), x, y, x - y};      // right angles at both ends
  if (kind == 2) return {Vector3::Zero(), x, 0.5 * x + y, 0.5 * x - y};
  return {Vector3::Zero(), x * test::uniform(random, 0.5, 2),
          x * test::uniform(random, -1, 2) + y * test::uniform(random, 0.1, 2),
          x * test::uniform(random, -1, 2) - y * test::uniform(random, 0.1, 2)};
}

inline constexpr int deformations = 11;

inline Vector3 deformed(std::mt19937_64& random, int how, std::size_t corner, const Vector3& p,
                        const std::array<Vector3, 4>& all) {
  switch (how) {
    case 0:
      return p;  // at rest
    case 1:
      return p + test::random_vector(random, 1e-7);
    case 2:
      return p + test::random_vector(random, 1e-3);
    case 3:
      return p + test::random_vector(random, 0.5);
    case 4:
      return 1e3 * p + test::random_vector(random, 1);
    case 5:
      return 1e-3 * p;
    case 6:
      return {p.x(), 0, 0};  // on a line
    case 7:
      return Vector3::Zero();  // at a point
    case 8:
      return corner == 1 ? all[2] : p;  // two corners at the same place
    case 9:
      return {p.x(), std::abs(p.y()), 0};  // folded shut
    default:
      return {p.x(), std::abs(p.y()) * std::cos(3.0), p.y() * std::sin(3.0)};  // nearly shut
  }
}

template <std::size_t N>
Poses<N> poses(std::uint64_t seed, double unit) {
  std::mt19937_64 random(seed);
  Poses<N> all;
  for (int kind = 0; kind < 5; ++kind)
    for (int how = 0; how < deformations; ++how)
      for (unsigned pinned = 0; pinned + 1 < (1U << N); ++pinned) {
        const std::array<Vector3, 4> corners = shape(random, kind);
        const Eigen::Quaterniond turn =
            kind == 1 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond::UnitRandom();
        const Vector3 shift = test::random_vector(random);
        auto& rest = all.rest.emplace_back();
        auto& now = all.now.emplace_back();
        auto& mass = all.mass.emplace_back();
        for (std::size_t i = 0; i < N; ++i) {
          rest[i] = unit * corners[i];
          now[i] = unit * ((turn * deformed(random, how, i, corners[i], corners)) + shift);
          mass[i] = (pinned >> i) % 2 == 1 ? 0 : test::uniform(random, 1e-4, 1e-3);
        }
      }
  return all;
}

/// The longest distance between two corners, at rest or now, m.
template <std::size_t N>
double size_of_pose(const std::array<Vector3, N>& now, const std::array<Vector3, N>& rest) {
  double size = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < i; ++j)
      size = std::max({size, (now[i] - now[j]).norm(), (rest[i] - rest[j]).norm()});
  return size;
}

}  // namespace bendlab::test
