// Lanes: arithmetic on as many constraints at once as the machine's registers hold. Compiler vectors (GCC,
// Clang), so that one source runs at 128, 256 and 512 bits. Points are loaded whole and transposed, which
// measured faster than element-wise loads and than hardware gathers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#include "bendlab/constraints/point.hpp"

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace bendlab {

#if defined(__AVX512F__)
inline constexpr int pack_bytes = 64;
#elif defined(__AVX__)
inline constexpr int pack_bytes = 32;
#else
inline constexpr int pack_bytes = 16;
#endif

/// Lanes of a pack: 16, 8 or 4 floats; 8 or 4 doubles (a multiple of 4, because points are transposed by
/// fours).
template <class Real>
inline constexpr int lanes = pack_bytes / static_cast<int>(sizeof(Real)) < 4
                                 ? 4
                                 : pack_bytes / static_cast<int>(sizeof(Real));
inline constexpr int max_lanes = 16;

template <class Real>
struct PackType {
  typedef Real type __attribute__((vector_size(sizeof(Real) * static_cast<std::size_t>(lanes<Real>))));
};
template <class Real>
using Pack = typename PackType<Real>::type;

#define BENDLAB_INLINE inline __attribute__((always_inline))

template <class Real>
BENDLAB_INLINE Pack<Real> broadcast(Real value) {
  return Pack<Real>{} + value;
}

template <class Real>
BENDLAB_INLINE Pack<Real> load(const Real* from) {
  Pack<Real> pack;
  std::memcpy(&pack, from, sizeof(pack));
  return pack;
}

template <class Real>
BENDLAB_INLINE void store(Real* to, const Pack<Real>& pack) {
  std::memcpy(to, &pack, sizeof(pack));
}

// The masked form: the plain one makes GCC 12 warn of an uninitialised register inside its own header.
BENDLAB_INLINE Pack<float> square_root(const Pack<float>& pack) {
#if defined(__AVX512F__)
  return (Pack<float>)_mm512_maskz_sqrt_ps(0xffff, (__m512)pack);
#else
  Pack<float> root;
  for (int l = 0; l < lanes<float>; ++l) root[l] = std::sqrt(pack[l]);
  return root;
#endif
}

BENDLAB_INLINE Pack<double> square_root(const Pack<double>& pack) {
#if defined(__AVX512F__)
  return (Pack<double>)_mm512_maskz_sqrt_pd(0xff, (__m512d)pack);
#else
  Pack<double> root;
  for (int l = 0; l < lanes<double>; ++l) root[l] = std::sqrt(pack[l]);
  return root;
#endif
}

template <class Real>
struct PackVector {
  Pack<Real> x, y, z;
};

template <class Real>
BENDLAB_INLINE PackVector<Real> operator-(const PackVector<Real>& a, const PackVector<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
BENDLAB_INLINE PackVector<Real> operator+(const PackVector<Real>& a, const PackVector<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
BENDLAB_INLINE PackVector<Real> scaled(const Pack<Real>& s, const PackVector<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
BENDLAB_INLINE Pack<Real> dot(const PackVector<Real>& a, const PackVector<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
BENDLAB_INLINE PackVector<Real> cross(const PackVector<Real>& a, const PackVector<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real>
struct PackPoints {
  PackVector<Real> position;
  Pack<Real> w;
};

namespace detail {

// Within each block of four lanes: first[from[0]], first[from[1]] or, from 4 on, second[from - 4].
template <int i0, int i1, int i2, int i3, class P, int... lane>
BENDLAB_INLINE P blend(const P& first, const P& second, std::integer_sequence<int, lane...>) {
  constexpr int width = static_cast<int>(sizeof...(lane));
  constexpr std::array<int, 4> from = {i0, i1, i2, i3};
  return __builtin_shufflevector(
      first, second,
      (from[lane % 4] < 4 ? lane / 4 * 4 + from[lane % 4] : width + lane / 4 * 4 + from[lane % 4] - 4)...);
}

template <int i0, int i1, int i2, int i3, class Real>
BENDLAB_INLINE Pack<Real> blend(const Pack<Real>& first, const Pack<Real>& second) {
  return blend<i0, i1, i2, i3>(first, second, std::make_integer_sequence<int, lanes<Real>>{});
}

// Transposes each block of 4 × 4; its own inverse.
template <class Real>
BENDLAB_INLINE void transpose(Pack<Real>& a, Pack<Real>& b, Pack<Real>& c, Pack<Real>& d) {
  const Pack<Real> ab_low = blend<0, 4, 1, 5, Real>(a, b), ab_high = blend<2, 6, 3, 7, Real>(a, b);
  const Pack<Real> cd_low = blend<0, 4, 1, 5, Real>(c, d), cd_high = blend<2, 6, 3, 7, Real>(c, d);
  a = blend<0, 1, 4, 5, Real>(ab_low, cd_low);
  b = blend<2, 3, 6, 7, Real>(ab_low, cd_low);
  c = blend<0, 1, 4, 5, Real>(ab_high, cd_high);
  d = blend<2, 3, 6, 7, Real>(ab_high, cd_high);
}

template <class Real>
struct QuadType {
  typedef Real type __attribute__((vector_size(4 * sizeof(Real))));
};

template <class Real>
BENDLAB_INLINE typename QuadType<Real>::type load_point(const Point<Real>& point) {
  typename QuadType<Real>::type quad;
  std::memcpy(&quad, &point, sizeof(quad));
  return quad;
}

template <class First, class Second, int... lane>
BENDLAB_INLINE auto concatenated(const First& first, const Second& second,
                                 std::integer_sequence<int, lane...>) {
  return __builtin_shufflevector(first, second, lane...);
}

// Points indices[0], indices[4], indices[8], … side by side in one pack, joined in registers: assembled in
// memory, the wide load would wait for the narrow stores before it.
template <class Real>
BENDLAB_INLINE Pack<Real> rows_by_fours(const Point<Real>* points, const int* indices) {
  constexpr std::make_integer_sequence<int, 8> eight{};
  if constexpr (lanes<Real> == 4) {
    return load_point(points[indices[0]]);
  } else if constexpr (lanes<Real> == 8) {
    return concatenated(load_point(points[indices[0]]), load_point(points[indices[4]]), eight);
  } else {
    const auto low = concatenated(load_point(points[indices[0]]), load_point(points[indices[4]]), eight);
    const auto high = concatenated(load_point(points[indices[8]]), load_point(points[indices[12]]), eight);
    return concatenated(low, high, std::make_integer_sequence<int, 16>{});
  }
}

}  // namespace detail

/// Points `indices[0 .. lanes)` as packs.
template <class Real>
BENDLAB_INLINE PackPoints<Real> gather(const Point<Real>* points, const int* indices) {
  Pack<Real> row[4];
  for (int r = 0; r < 4; ++r) row[r] = detail::rows_by_fours(points, indices + r);
  detail::transpose<Real>(row[0], row[1], row[2], row[3]);
  return {{row[0], row[1], row[2]}, row[3]};
}

/// Writes packs back to the points `indices[0 .. lanes)`; no index may stand twice.
template <class Real>
BENDLAB_INLINE void scatter(Point<Real>* points, const int* indices, const PackPoints<Real>& packs) {
  alignas(pack_bytes) Pack<Real> row[4] = {packs.position.x, packs.position.y, packs.position.z, packs.w};
  detail::transpose<Real>(row[0], row[1], row[2], row[3]);
  for (int block = 0; block < lanes<Real> / 4; ++block)
    for (int r = 0; r < 4; ++r)
      std::memcpy(static_cast<void*>(points + indices[4 * block + r]),
                  reinterpret_cast<const Real*>(&row[r]) + 4 * block, sizeof(Point<Real>));
}

}  // namespace bendlab
