// A SIMD lane reads a vertex i, and then one spring of the vertex's row after another (spring_rows.hpp):
//
//   lane       0     1     2   …      step<Real> lanes of a slice at a time
//   vertex i   v0    v1    v2         own = offset_of() the vertices
//   spring 0   s0    s1    s0         other = offset_of() the far end j, rest_length, stiffness
//   spring 1   s3    s4    s2
#include "bendlab/solver/kang_cho_kernel.hpp"

#include <array>

#include "bendlab/constraints/pack.hpp"
#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {
namespace {

template <class Real>
constexpr auto step = static_cast<std::size_t>(lanes<Real>);

using Offsets = std::array<int, group_size>;

// offset_of() each vertex of a slice.
Offsets offsets_of(std::size_t slice) {
  Offsets offsets;
  for (std::size_t lane = 0; lane < group_size; ++lane)
    offsets[lane] = offset_of(static_cast<int>(slice * group_size + lane));
  return offsets;
}

//   i o-------------o j      d = x_j - x_i,   f_i = force d,   J = along d dᵀ + across 1
template <class Real>
struct SpringPack {
  PackVector<Real> d;
  Pack<Real> force, along, across;  // N/m, N/m³, N/m

  BENDLAB_INLINE SpringPack(const PackVector<Real>& from, const PackVector<Real>& to,
                            const SpringRows<Real>& springs, std::size_t lane, AcrossTangent<Real> rule)
      : d(to - from) {
    const Pack<Real> rest = load(&springs.rest_length[lane]), k = load(&springs.stiffness[lane]);
    const Pack<Real> zero{}, one = broadcast<Real>(1), shortest = collapsed_ratio<Real> * rest;
    const Pack<Real> squared = dot(d, d);
    const auto has_direction = squared > shortest * shortest;
    const Pack<Real> inverse_length = inverse_square_root(has_direction ? squared : one);
    const Pack<Real> stretch = has_direction ? one - rest * inverse_length : zero;
    const Pack<Real> taut = rule.slope * stretch, least = broadcast(rule.least);
    force = k * stretch;
    across = k * (taut > least ? taut : least);
    along = has_direction ? (k - across) * inverse_length * inverse_length : zero;
  }

  BENDLAB_INLINE PackVector<Real> tangent_times(const PackVector<Real>& u) const {
    return scaled<Real>(along * dot(d, u), d) + scaled<Real>(across, u);
  }
};

// The factors W = L D Lᵀ of a symmetric 3 × 3 matrix. Every pivot is at least m, because W is at least m
// times the identity. Rounding may make a pivot smaller, because m is tiny beside the entries of a stiff
// spring. Then the pivot is set to m, so that W stays positive definite.
template <class Real>
struct Factors {
  Pack<Real> l10, l20, l21, inverse0, inverse1, inverse2;

  BENDLAB_INLINE PackVector<Real> solve(const PackVector<Real>& b) const {
    const Pack<Real> y1 = b.y - l10 * b.x, y2 = b.z - l20 * b.x - l21 * y1;
    const Pack<Real> z = inverse2 * y2, y = inverse1 * y1 - l21 * z, x = inverse0 * b.x - l10 * y - l20 * z;
    return {x, y, z};
  }
};

template <class Real>
BENDLAB_INLINE Pack<Real> inverse_pivot(const Pack<Real>& pivot, const Pack<Real>& m) {
  return broadcast<Real>(1) / (pivot > m ? pivot : m);
}

template <class Real>
struct SymmetricPack {
  Pack<Real> xx, xy, xz, yy, yz, zz;

  BENDLAB_INLINE void add(const SpringPack<Real>& s, const Pack<Real>& factor) {
    const Pack<Real> across = factor * s.across;
    const PackVector<Real> column = scaled<Real>(factor * s.along, s.d);
    xx += column.x * s.d.x + across, xy += column.x * s.d.y, xz += column.x * s.d.z;
    yy += column.y * s.d.y + across, yz += column.y * s.d.z, zz += column.z * s.d.z + across;
  }

  BENDLAB_INLINE Factors<Real> factors(const Pack<Real>& m) const {
    Factors<Real> f;
    f.inverse0 = inverse_pivot<Real>(xx, m);
    f.l10 = xy * f.inverse0, f.l20 = xz * f.inverse0;
    f.inverse1 = inverse_pivot<Real>(yy - f.l10 * xy, m);
    const Pack<Real> left = yz - f.l20 * xy;
    f.l21 = left * f.inverse1;
    f.inverse2 = inverse_pivot<Real>(zz - f.l20 * xz - f.l21 * left, m);
    return f;
  }
};

// The data that assemble() stores for solve(), for a pack of vertices.
template <class Real>
struct Row {
  PackVector<Real> p;
  Factors<Real> w;
};
constexpr std::size_t numbers_per_vertex = 9;

template <class Real, class Numbers>
BENDLAB_INLINE auto* row_at(Numbers* numbers, std::size_t slice, std::size_t part) {
  return numbers + (slice * group_size + part) * numbers_per_vertex;
}

template <class Real>
BENDLAB_INLINE void store_row(Real* to, const Row<Real>& row) {
  static_assert(sizeof(row) == numbers_per_vertex * sizeof(Pack<Real>));
  std::memcpy(to, &row, sizeof(row));
}
template <class Real>
BENDLAB_INLINE Row<Real> load_row(const Real* from) {
  Row<Real> row;
  std::memcpy(&row, from, sizeof(row));
  return row;
}

template <class Real, class Mask>
BENDLAB_INLINE PackVector<Real> where(const Mask& mask, const PackVector<Real>& a) {
  const Pack<Real> zero{};
  return {mask ? a.x : zero, mask ? a.y : zero, mask ? a.z : zero};
}

template <class Real>
BENDLAB_INLINE void assemble_pack(ImplicitSystem<Real>& system, const State<Real>& state,
                                  const Point<Real>* external, const SpringRows<Real>& springs,
                                  AcrossTangent<Real> across, Real h, std::size_t slice, std::size_t part) {
  const Offsets slice_offsets = offsets_of(slice);
  const int* const own = &slice_offsets[part];
  const Point<Real>* const positions = state.position.data();
  const PackPoints<Real> x = gather(positions, own), v = gather(state.velocity.data(), own);
  const Pack<Real> zero{}, one = broadcast<Real>(1);
  const auto is_free = x.w > zero;
  const Pack<Real> m = one / (is_free ? x.w : one);
  PackVector<Real> p{zero, zero, zero};
  if (external) p = scaled<Real>(m, gather(external, own).position);
  SymmetricPack<Real> w{m, zero, zero, m, zero, m};
  for (std::size_t lane = springs.slices[slice] + part; lane < springs.slices[slice + 1];
       lane += group_size) {
    const int* const other = &springs.other[lane];
    const SpringPack<Real> s(x.position, gather(positions, other).position, springs, lane, across);
    const PackVector<Real> relative = gather(state.velocity.data(), other).position - v.position;
    p = p + scaled<Real>(h * s.force, s.d) + scaled<Real>(broadcast(h * h), s.tangent_times(relative));
    w.add(s, broadcast(h * h));
  }
  const Row<Real> row{p, w.factors(m)};
  store_row<Real>(row_at<Real>(system.rows.data(), slice, part), row);
  scatter(system.guess.data(), own, {where<Real>(is_free, row.w.solve(p)), zero});
}

template <class Real>
BENDLAB_INLINE void solve_pack(State<Real>& state, const ImplicitSystem<Real>& system,
                               const SpringRows<Real>& springs, AcrossTangent<Real> across, Real h,
                               std::size_t slice, std::size_t part) {
  const Offsets slice_offsets = offsets_of(slice);
  const int* const own = &slice_offsets[part];
  const Point<Real>* const positions = state.position.data();
  const PackPoints<Real> x = gather(positions, own);
  const Row<Real> row = load_row<Real>(row_at<Real>(system.rows.data(), slice, part));
  PackVector<Real> sum = row.p;
  for (std::size_t lane = springs.slices[slice] + part; lane < springs.slices[slice + 1];
       lane += group_size) {
    const int* const other = &springs.other[lane];
    const SpringPack<Real> s(x.position, gather(positions, other).position, springs, lane, across);
    const PackVector<Real> guess = gather(system.guess.data(), other).position;
    sum = sum + scaled<Real>(broadcast(h * h), s.tangent_times(guess));
  }
  PackPoints<Real> v = gather(state.velocity.data(), own);
  v.position = v.position + where<Real>(x.w > Pack<Real>{}, row.w.solve(sum));
  scatter(state.velocity.data(), own, v);
}

}  // namespace

template <class Real>
ImplicitSystem<Real>::ImplicitSystem(std::size_t slice_count, std::size_t point_count)
    : rows(slice_count * group_size * numbers_per_vertex), guess(point_count) {}

template <class Real>
void assemble(ImplicitSystem<Real>& system, const State<Real>& state, const Point<Real>* external,
              const SpringRows<Real>& springs, AcrossTangent<Real> across, Real substep, std::size_t first,
              std::size_t last) {
  for (std::size_t slice = first; slice < last; ++slice)
    for (std::size_t part = 0; part < group_size; part += step<Real>)
      assemble_pack(system, state, external, springs, across, substep, slice, part);
}

template <class Real>
void solve(State<Real>& state, const ImplicitSystem<Real>& system, const SpringRows<Real>& springs,
           AcrossTangent<Real> across, Real substep, std::size_t first, std::size_t last) {
  for (std::size_t slice = first; slice < last; ++slice)
    for (std::size_t part = 0; part < group_size; part += step<Real>)
      solve_pack(state, system, springs, across, substep, slice, part);
}

#define BENDLAB_INSTANTIATE(Real)                                                                       \
  template struct ImplicitSystem<Real>;                                                                 \
  template void assemble(ImplicitSystem<Real>&, const State<Real>&, const Point<Real>*,                 \
                         const SpringRows<Real>&, AcrossTangent<Real>, Real, std::size_t, std::size_t); \
  template void solve(State<Real>&, const ImplicitSystem<Real>&, const SpringRows<Real>&,               \
                      AcrossTangent<Real>, Real, std::size_t, std::size_t);
BENDLAB_INSTANTIATE(float)
BENDLAB_INSTANTIATE(double)
#undef BENDLAB_INSTANTIATE

}  // namespace bendlab
