// Random numbers that are the same on every platform, unlike std::uniform_real_distribution.
#pragma once

#include <cstdint>
#include <random>

namespace bendlab {

/// A uniform number in [0, 1), from the upper 53 of 64 random bits.
inline double unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// A uniform number in [0, 1), from the next number of `random`.
inline double uniform(std::mt19937_64& random) {
  return unit_interval(random());
}

/// The n-th number of the SplitMix64 generator (Steele, Lea and Flood 2014) with that seed.
inline std::uint64_t split_mix(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + (n + 1) * std::uint64_t{0x9e3779b97f4a7c15};
  z = (z ^ (z >> 30)) * std::uint64_t{0xbf58476d1ce4e5b9};
  z = (z ^ (z >> 27)) * std::uint64_t{0x94d049bb133111eb};
  return z ^ (z >> 31);
}

}  // namespace bendlab
