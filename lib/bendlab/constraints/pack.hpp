// Packs: vector registers, for arithmetic on several constraints at once. A lane is an entry of a pack and
// holds one constraint. Packs are vector types of the compiler (GCC, Clang), so that one source compiles for
// 128, 256 and 512 bits. Each point is loaded in one piece, and then points are transposed. Measurements show
// that this way is faster than loads of single numbers and than gather instructions:
//
//   point of lane 0:  x y z w | of lane 4: …               x x x x | …   lanes 0, 1, 2, 3 | 4, 5, 6, 7 | …
//            lane 1:  x y z w | of lane 5: …   transposed  y y y y | …
//            lane 2:  x y z w | …                          z z z z | …
//            lane 3:  x y z w | …                          w w w w | …
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#include "bendlab/constraints/quad.hpp"

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

/// Number of lanes of a pack: 16, 8 or 4 floats, 8 or 4 doubles. Four points are transposed at a time.
template <class Real>
inline constexpr int lanes = pack_bytes / static_cast<int>(sizeof(Real)) < 4
                                 ? 4
                                 : pack_bytes / static_cast<int>(sizeof(Real));

template <class Real>
struct PackType {
  typedef Real type __attribute__((vector_size(sizeof(Real) * static_cast<std::size_t>(lanes<Real>))));
};
template <class Real>
using Pack = typename PackType<Real>::type;

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

// With a mask, because without a mask GCC 12 warns of an uninitialised register in its own header.
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

/// 1 / √x of positive, normal x, within two units in the last place. The first guess has 14 correct bits, and
/// each Newton step doubles this number. The guess and the steps take a fraction of the time of a square root
/// and a division. Multiplying x by a power of 4 changes only the exponent of the result.
BENDLAB_INLINE Pack<float> inverse_square_root(const Pack<float>& x) {
#if defined(__AVX512F__)
  const Pack<float> guess = (Pack<float>)_mm512_maskz_rsqrt14_ps(0xffff, (__m512)x);
  return guess + guess * (0.5f - 0.5f * x * guess * guess);
#else
  return 1.0f / square_root(x);
#endif
}

BENDLAB_INLINE Pack<double> inverse_square_root(const Pack<double>& x) {
#if defined(__AVX512F__)
  const Pack<double> guess = (Pack<double>)_mm512_maskz_rsqrt14_pd(0xff, (__m512d)x);
  const Pack<double> better = guess + guess * (0.5 - 0.5 * x * guess * guess);
  return better + better * (0.5 - 0.5 * x * better * better);
#else
  return 1.0 / square_root(x);
#endif
}

template <class Real>
using PackMask = decltype(Pack<Real>{} < Pack<Real>{});

/// Whether any lane of a comparison is true.
template <class Mask>
BENDLAB_INLINE bool any(const Mask& mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
#else
  std::array<unsigned long long, sizeof(Mask) / sizeof(unsigned long long)> words;
  std::memcpy(words.data(), &mask, sizeof(mask));
  unsigned long long all = 0;
  for (const unsigned long long word : words) all |= word;
  return all != 0;
#endif
}

/// In each lane the larger of x and y.
template <class Real>
BENDLAB_INLINE Pack<Real> larger(const Pack<Real>& x, const Pack<Real>& y) {
  return x > y ? x : y;
}

template <class Real>
struct PackVector {
  Pack<Real> x, y, z;
};

/// In each lane `a` if the mask is true, else `b`.
template <class Real, class Mask>
BENDLAB_INLINE PackVector<Real> select(const Mask& mask, const PackVector<Real>& a,
                                       const PackVector<Real>& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

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

// Lane l of each block of four lanes becomes first[i_l] if i_l < 4, and second[i_l - 4] otherwise.
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

// Transposes each block of 4 × 4 numbers.
template <class Real>
BENDLAB_INLINE void transpose(Pack<Real>& a, Pack<Real>& b, Pack<Real>& c, Pack<Real>& d) {
  const Pack<Real> ab_low = blend<0, 4, 1, 5, Real>(a, b), ab_high = blend<2, 6, 3, 7, Real>(a, b);
  const Pack<Real> cd_low = blend<0, 4, 1, 5, Real>(c, d), cd_high = blend<2, 6, 3, 7, Real>(c, d);
  a = blend<0, 1, 4, 5, Real>(ab_low, cd_low);
  b = blend<2, 3, 6, 7, Real>(ab_low, cd_low);
  c = blend<0, 1, 4, 5, Real>(ab_high, cd_high);
  d = blend<2, 3, 6, 7, Real>(ab_high, cd_high);
}

template <int first, class Vector, int... lane>
BENDLAB_INLINE auto part_of(const Vector& vector, std::integer_sequence<int, lane...>) {
  return __builtin_shufflevector(vector, vector, (first + lane)...);
}

template <class First, class Second, int... lane>
BENDLAB_INLINE auto concatenated(const First& first, const Second& second,
                                 std::integer_sequence<int, lane...>) {
  return __builtin_shufflevector(first, second, lane...);
}

// Points at offsets[0], offsets[4], offsets[8], … side by side in one pack. The points are joined in
// registers, because a pack joined in memory could be loaded only after all stores of its points. To insert a
// point from memory is a blend, for which the processor has two vector ports. GCC compiles a concatenation to
// shuffles, for which the processor has only one port, and this port limits the speed of the kernels.
template <class Real>
BENDLAB_INLINE Pack<Real> rows_by_fours(const Point<Real>* points, const int* offsets) {
  if constexpr (lanes<Real> == 4) {
    return load_point(point_at(points, offsets[0]));
  } else if constexpr (lanes<Real> == 8) {
#if defined(__AVX512F__)
    const __m512d low = _mm512_castpd256_pd512((__m256d)load_point(point_at(points, offsets[0])));
    const __m256d high = (__m256d)load_point(point_at(points, offsets[4]));
    return (Pack<Real>)_mm512_maskz_insertf64x4(0xff, low, high, 1);
#else
    return concatenated(load_point(point_at(points, offsets[0])), load_point(point_at(points, offsets[4])),
                        std::make_integer_sequence<int, 8>{});
#endif
  } else {
#if defined(__AVX512F__)
    __m512 row = _mm512_castps128_ps512((__m128)load_point(point_at(points, offsets[0])));
    row = _mm512_insertf32x4(row, (__m128)load_point(point_at(points, offsets[4])), 1);
    row = _mm512_insertf32x4(row, (__m128)load_point(point_at(points, offsets[8])), 2);
    return (Pack<Real>)_mm512_insertf32x4(row, (__m128)load_point(point_at(points, offsets[12])), 3);
#endif
  }
}

// The inverse of rows_by_fours(). To store a quarter of a 512-bit register takes a shuffle; to store half of
// a 256-bit register takes no shuffle. So the upper half is copied to a 256-bit register first. The asm
// prevents GCC from merging this copy with the extraction of quarters.
template <class Real>
BENDLAB_INLINE void store_rows_by_fours(Point<Real>* points, const int* offsets, const Pack<Real>& row) {
  constexpr std::make_integer_sequence<int, 4> quad{};
  if constexpr (lanes<Real> == 16) {
#if defined(__AVX512F__)
    const __m256 low = _mm256_castpd_ps(_mm512_maskz_extractf64x4_pd(0xf, (__m512d)row, 0));
    __m256 high = _mm256_castpd_ps(_mm512_maskz_extractf64x4_pd(0xf, (__m512d)row, 1));
    asm("" : "+x"(high));
    _mm_store_ps(&point_at(points, offsets[0]).x, _mm256_castps256_ps128(low));
    _mm_store_ps(&point_at(points, offsets[4]).x, _mm256_extractf128_ps(low, 1));
    _mm_store_ps(&point_at(points, offsets[8]).x, _mm256_castps256_ps128(high));
    _mm_store_ps(&point_at(points, offsets[12]).x, _mm256_extractf128_ps(high, 1));
#endif
  } else {
    store_point(point_at(points, offsets[0]), part_of<0>(row, quad));
    if constexpr (lanes<Real> == 8) store_point(point_at(points, offsets[4]), part_of<4>(row, quad));
  }
}

}  // namespace detail

/// Points at `offsets[0 .. lanes)` as packs.
template <class Real>
BENDLAB_INLINE PackPoints<Real> gather(const Point<Real>* points, const int* offsets) {
  Pack<Real> row[4];
  for (int r = 0; r < 4; ++r) row[r] = detail::rows_by_fours(points, offsets + r);
  detail::transpose<Real>(row[0], row[1], row[2], row[3]);
  return {{row[0], row[1], row[2]}, row[3]};
}

/// Writes packs to the points at `offsets[0 .. lanes)`. All offsets must differ.
template <class Real>
BENDLAB_INLINE void scatter(Point<Real>* points, const int* offsets, const PackPoints<Real>& packs) {
  Pack<Real> row[4] = {packs.position.x, packs.position.y, packs.position.z, packs.w};
  detail::transpose<Real>(row[0], row[1], row[2], row[3]);
  for (int r = 0; r < 4; ++r) detail::store_rows_by_fours(points, offsets + r, row[r]);
}

namespace detail {

// The lanes that hold an inverse mass before points are transposed: every fourth lane.
template <class Real>
BENDLAB_INLINE PackMask<Real> inverse_mass_lanes() {
  PackMask<Real> mask{};
  for (int l = 3; l < lanes<Real>; l += 4) mask[l] = -1;
  return mask;
}

// The moves of points if places are split, in rows that are not transposed yet.
template <class Real>
struct MovedRows {
  Pack<Real> row[4];
};

template <class Real>
BENDLAB_INLINE MovedRows<Real> moved_rows(const Places<Real>& places, const int* offsets) {
  MovedRows<Real> moved;
  for (int r = 0; r < 4; ++r) moved.row[r] = rows_by_fours<Real>(places.moved, offsets + r);
  return moved;
}

// The base of one point per lane, from which the positions of other points are measured.
template <class Real>
struct BaseRows {
  Pack<Real> row[4];  // positions, 0 in the lanes of inverse masses

  // base + moved - row. The difference base - row is computed first, because it is exact.
  BENDLAB_INLINE PackPoints<Real> relative(const Places<Real>& places, const int* offsets,
                                           const MovedRows<Real>& moved) const {
    Pack<Real> sum[4];
    for (int r = 0; r < 4; ++r) sum[r] = (rows_by_fours(places.base, offsets + r) - row[r]) + moved.row[r];
    transpose<Real>(sum[0], sum[1], sum[2], sum[3]);
    return {{sum[0], sum[1], sum[2]}, sum[3]};
  }
  // base - row.
  BENDLAB_INLINE PackPoints<Real> relative_base(const Places<Real>& places, const int* offsets) const {
    Pack<Real> difference[4];
    for (int r = 0; r < 4; ++r) difference[r] = rows_by_fours(places.base, offsets + r) - row[r];
    transpose<Real>(difference[0], difference[1], difference[2], difference[3]);
    return {{difference[0], difference[1], difference[2]}, difference[3]};
  }
};

// base + moved.
template <class Real>
BENDLAB_INLINE PackPoints<Real> whole_points(const Places<Real>& places, const int* offsets,
                                             const MovedRows<Real>& moved) {
  Pack<Real> sum[4];
  for (int r = 0; r < 4; ++r) sum[r] = rows_by_fours(places.base, offsets + r) + moved.row[r];
  transpose<Real>(sum[0], sum[1], sum[2], sum[3]);
  return {{sum[0], sum[1], sum[2]}, sum[3]};
}

// The bases at `offsets`. Sets `relative` to the moves and inverse masses of the points at `offsets`.
template <class Real>
BENDLAB_INLINE BaseRows<Real> base_rows(const Places<Real>& places, const int* offsets,
                                        const MovedRows<Real>& moved, PackPoints<Real>& relative) {
  const PackMask<Real> masses = inverse_mass_lanes<Real>();
  BaseRows<Real> base;
  Pack<Real> sum[4];
  for (int r = 0; r < 4; ++r) {
    const Pack<Real> whole = rows_by_fours(places.base, offsets + r), zero{};
    base.row[r] = masses ? zero : whole;
    sum[r] = masses ? whole : moved.row[r];
  }
  transpose<Real>(sum[0], sum[1], sum[2], sum[3]);
  relative = {{sum[0], sum[1], sum[2]}, sum[3]};
  return base;
}

// Writes `moved` plus `change` for each point. All offsets must differ.
template <class Real>
BENDLAB_INLINE void scatter_moved(const Places<Real>& places, const int* offsets,
                                  const MovedRows<Real>& moved, const PackVector<Real>& change) {
  Pack<Real> row[4] = {change.x, change.y, change.z, Pack<Real>{}};
  transpose<Real>(row[0], row[1], row[2], row[3]);
  for (int r = 0; r < 4; ++r) store_rows_by_fours(places.moved, offsets + r, moved.row[r] + row[r]);
}

}  // namespace detail

}  // namespace bendlab
