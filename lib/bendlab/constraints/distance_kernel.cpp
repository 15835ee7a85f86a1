// A lane (an entry of a vector register) holds a star: the springs of one centre a. Each group of the stack
// holds one spring of the star. The centres stay in registers. A pack is a vector register; it takes
// lanes<Real> of the max_lanes = 16 lanes of a group at a time.
//
//   lane           0      1      2    …
//   centre a       a0     a1     a2         batch.a[16 stack + lane]
//   group 0  b     b0     b1     b2         batch.b, rest_length, softness, multiplier at
//   group 1  b     b16    b17    b18        stacks[stack] + 16 group + lane
//
// The oracle (scalar code): distance_constraint() and project_by_oracle() in oracle.hpp.
#include <limits>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/pack.hpp"

namespace bendlab {
namespace {

// While a lane is computed, the data that is `ahead` lanes farther is fetched. The processor itself does not
// know which data follow when a tile begins in the middle of a colour. With a million vertices, fetching
// saves 8 % of the measured time per spring.
constexpr std::size_t ahead = 512;

// The ends of a pack's springs in the rest shape.
template <class Real>
struct RestEnds {
  const Point<Real>* points;  // null: there is no rest shape
  const int *a, *b;           // offsets, one per lane

  // In `collapsed` lanes, sets d to the spring's direction in the rest shape, with the length `length`.
  // Padded lanes are left out: their rest length is the largest number, so `length` would overflow if the
  // centre lies next to the dummy point.
  BENDLAB_INLINE void open(PackVector<Real>& d, const PackMask<Real>& collapsed,
                           const Pack<Real>& length) const {
    if (points == nullptr) return;
    const PackVector<Real> along = gather(points, a).position - gather(points, b).position;
    const Pack<Real> squared = dot(along, along), one = broadcast<Real>(1);
    const Pack<Real> largest = broadcast(std::numeric_limits<Real>::max());
    const auto opens = collapsed & (squared > Pack<Real>{}) & (length * length < largest);
    const Pack<Real> scale = (opens ? length : one) * inverse_square_root(opens ? squared : one);
    d = select(opens, scaled<Real>(scale, along), d);
  }
};

//   a o-------------o b      C = |p_a - p_b| - rest_length,   ∇_a C = n,   ∇_b C = -n,
//                            n = d / |d|,   d = p_a - p_b
//
// For a collapsed spring d has the direction in the rest shape and a length just above the limit. No move
// needs a bound, because no correction is longer than C, and |∇C| is 1. Moves a, and returns the move of b.
template <class Real, bool compliant, bool only_pulls>
BENDLAB_INLINE PackVector<Real> project_pack(PackPoints<Real>& a, const PackPoints<Real>& b,
                                             const Pack<Real>& rest, Real k, const Pack<Real>& alpha,
                                             Real* multipliers, const RestEnds<Real>& at_rest) {
  using P = Pack<Real>;
  const P zero{}, one = broadcast<Real>(1), shortest = collapsed_ratio<Real> * rest, weight = a.w + b.w;
  PackVector<Real> d = a.position - b.position;
  P squared = dot(d, d);
  const P sum = compliant ? weight + alpha : weight;
  auto acts = (squared > shortest * shortest) & (sum > zero);
  if (any(~acts & (weight > zero))) [[unlikely]] {
    at_rest.open(d, ~acts & (weight > zero), 2 * shortest);
    squared = dot(d, d);
    acts = (squared > shortest * shortest) & (sum > zero);
  }
  const P inverse_length = inverse_square_root(acts ? squared : one), inverse_sum = one / (acts ? sum : one);
  P step;  // the move along d, per inverse mass
  if constexpr (compliant) {
    const P multiplier = load(multipliers);
    P change = acts ? (rest - squared * inverse_length - alpha * multiplier) * inverse_sum : zero;
    if constexpr (only_pulls) change = change > -multiplier ? -multiplier : change;  // keeps λ ≤ 0
    store(multipliers, multiplier + change);
    step = change * inverse_length;
  } else {
    step = acts ? k * inverse_sum * (rest * inverse_length - one) : zero;
    if constexpr (only_pulls) step = step > zero ? zero : step;
  }
  a.position = a.position + scaled<Real>(step * a.w, d);
  return scaled<Real>(-step * b.w, d);
}

enum class Alpha { none, common, own };  // PBD; XPBD with one α for all springs; XPBD with an α per spring

template <class Real, Alpha kind, bool split, bool only_pulls>
void project_stacks(const Places<Real>& places, DistanceBatch<Real>& batch, std::size_t first,
                    std::size_t last, Real compliance_over_h2, bool backwards) {
  constexpr bool compliant = kind != Alpha::none;
  Pack<Real> alpha = broadcast(compliance_over_h2);
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  for (std::size_t stack = first; stack < last; ++stack)
    for (std::size_t part = 0; part < width; part += static_cast<std::size_t>(lanes<Real>)) {
      const std::size_t begin = batch.order.stacks[stack] + part,
                        groups = (batch.order.stacks[stack + 1] - begin + part) / width;
      const int* const centres = &batch.a[stack * width + part];
      PackPoints<Real> a;
      [[maybe_unused]] detail::BaseRows<Real> base;
      if constexpr (split)
        base = detail::base_rows(places, centres, detail::moved_rows(places, centres), a);
      else
        a = gather(places.moved, centres);
      for (std::size_t group = 0; group < groups; ++group) {
        const std::size_t lane = begin + (backwards ? groups - 1 - group : group) * width;
        prefetch(batch.b, lane + ahead);
        prefetch(batch.rest_length, lane + ahead);
        PackPoints<Real> b;
        [[maybe_unused]] detail::MovedRows<Real> moved;
        if constexpr (split) {
          moved = detail::moved_rows(places, &batch.b[lane]);
          b = base.relative(places, &batch.b[lane], moved);
        } else {
          b = gather(places.moved, &batch.b[lane]);
        }
        if constexpr (kind == Alpha::own) alpha = compliance_over_h2 * load(&batch.softness[lane]);
        const PackVector<Real> move = project_pack<Real, compliant, only_pulls>(
            a, b, load(&batch.rest_length[lane]), batch.k, alpha,
            compliant ? &batch.multiplier[lane] : nullptr, {batch.rest_points, centres, &batch.b[lane]});
        if constexpr (split) {
          detail::scatter_moved(places, &batch.b[lane], moved, move);
        } else {
          b.position = b.position + move;
          scatter(places.moved, &batch.b[lane], b);
        }
      }
      if constexpr (split) a.w = Pack<Real>{};
      scatter(places.moved, centres, a);
    }
}

}  // namespace

template <class Real>
void project(const PlacesOf<Real>& places, DistanceBatch<Real>& batch, std::size_t first, std::size_t last,
             Real substep, bool backwards) {
  const Real compliance = batch.compliance / (substep * substep);
  const auto project_all = [&]<bool split, bool pulls>(std::bool_constant<split>, std::bool_constant<pulls>) {
    if (batch.kind != StiffnessKind::compliance)
      project_stacks<Real, Alpha::none, split, pulls>(places, batch, first, last, 0, backwards);
    else if (batch.softness.empty())
      project_stacks<Real, Alpha::common, split, pulls>(places, batch, first, last, compliance, backwards);
    else
      project_stacks<Real, Alpha::own, split, pulls>(places, batch, first, last, compliance, backwards);
  };
  with_split(places, [&](auto split) {
    batch.only_pulls ? project_all(split, std::true_type{}) : project_all(split, std::false_type{});
  });
}

template <class Real>
void damp(const Point<Real>* points, Point<Real>* velocities, const DistanceBatch<Real>& batch, Real k) {
  using P = Pack<Real>;
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  const P zero{}, one = broadcast<Real>(1);
  for (std::size_t stack = 0; stack < batch.order.stack_count(); ++stack)
    for (std::size_t lane = batch.order.stacks[stack]; lane < batch.order.stacks[stack + 1];
         lane += static_cast<std::size_t>(lanes<Real>)) {
      const int* const centres = &batch.a[stack * width + lane % width];
      const PackPoints<Real> a = gather(points, centres), b = gather(points, &batch.b[lane]);
      PackPoints<Real> va = gather(velocities, centres), vb = gather(velocities, &batch.b[lane]);
      const PackVector<Real> d = a.position - b.position;
      const P squared = dot(d, d), sum = a.w + b.w,
              shortest = collapsed_ratio<Real> * load(&batch.rest_length[lane]);
      const auto acts = (squared > shortest * shortest) & (sum > zero);
      const P rate = dot(d, va.position - vb.position);  // Ċ times the length
      const P step = acts ? -k * rate / (acts ? squared * sum : one) : zero;
      va.position = va.position + scaled<Real>(step * a.w, d);
      vb.position = vb.position - scaled<Real>(step * b.w, d);
      scatter(velocities, centres, va);
      scatter(velocities, &batch.b[lane], vb);
    }
}

template <class Real>
void add_forces(const Point<Real>* points, Point<Real>* forces, const DistanceBatch<Real>& batch,
                std::size_t first, std::size_t last) {
  using P = Pack<Real>;
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  const P zero{}, one = broadcast<Real>(1);
  for (std::size_t stack = first; stack < last; ++stack)
    for (std::size_t part = 0; part < width; part += static_cast<std::size_t>(lanes<Real>)) {
      const int* const centres = &batch.a[stack * width + part];
      const PackPoints<Real> a = gather(points, centres);
      PackPoints<Real> force = gather(forces, centres);
      for (std::size_t lane = batch.order.stacks[stack] + part; lane < batch.order.stacks[stack + 1];
           lane += width) {
        const int* const ends = &batch.b[lane];
        PackPoints<Real> other = gather(forces, ends);
        const PackVector<Real> d = a.position - gather(points, ends).position;
        const P rest = load(&batch.rest_length[lane]), squared = dot(d, d),
                shortest = collapsed_ratio<Real> * rest;
        const P alpha = batch.softness.empty() ? broadcast(batch.compliance)
                                               : batch.compliance * load(&batch.softness[lane]);
        const auto acts = (squared > shortest * shortest) & (alpha > zero);
        const P per_length = inverse_square_root(acts ? squared : one);
        const P pull = acts ? (one - rest * per_length) / (acts ? alpha : one) : zero;
        force.position = force.position - scaled<Real>(pull, d);
        other.position = other.position + scaled<Real>(pull, d);
        scatter(forces, ends, other);
      }
      scatter(forces, centres, force);
    }
}

template void add_forces(const Point<float>*, Point<float>*, const DistanceBatch<float>&, std::size_t,
                         std::size_t);
template void add_forces(const Point<double>*, Point<double>*, const DistanceBatch<double>&, std::size_t,
                         std::size_t);
template void project(const Places<float>&, DistanceBatch<float>&, std::size_t, std::size_t, float, bool);
template void project(const Places<double>&, DistanceBatch<double>&, std::size_t, std::size_t, double, bool);
template void damp(const Point<float>*, Point<float>*, const DistanceBatch<float>&, float);
template void damp(const Point<double>*, Point<double>*, const DistanceBatch<double>&, double);

}  // namespace bendlab
