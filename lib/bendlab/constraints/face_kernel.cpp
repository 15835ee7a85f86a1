// A lane (an entry of a vector register) holds one triangle. Symbols and order are as in the oracle (the
// scalar code), face_bend.hpp.
#include "bendlab/constraints/element_kernel.hpp"
#include "bendlab/constraints/face_bend.hpp"
#include "bendlab/constraints/pack_turn.hpp"

namespace bendlab {
namespace {

template <class Real>
struct PackEdgeTurn {
  Pack<Real> value, foot, foot_beyond, by_director;
  PackVector<Real> tilt, lift;
  PackMask<Real> defined;
};

// FaceBend::edge_turn() of the lanes.
template <class Real, class Kind, typename Kind::Law law>
BENDLAB_INLINE PackEdgeTurn<Real> edge_turn(const std::array<PackPoints<Real>, Kind::arity>& p,
                                            const std::array<Pack<Real>, Kind::rest_values>& rest,
                                            std::size_t i, const PackVector<Real>& normal,
                                            const Pack<Real>& twice_area) {
  using P = Pack<Real>;
  const P one = broadcast<Real>(1), least = collapsed_ratio<Real> * rest[12], least_area = least * rest[12],
          zero{};
  const PackVector<Real> start = p[3 + (i + 1) % 3].position, e = p[3 + (i + 2) % 3].position - start;
  PackEdgeTurn<Real> turn;
  const P squared = dot(e, e);
  turn.defined = squared > least * least;
  const P per_length = inverse_square_root(turn.defined ? squared : one);
  const PackVector<Real> inwards = scaled<Real>(per_length, cross(normal, e));
  const P height = twice_area * per_length, share = rest[i], per_squared = per_length * per_length;
  turn.foot = dot(p[3 + i].position - start, e) * per_squared;
  const PackVector<Real> offset = p[i].position - start, beyond = cross(offset, e);
  const PackMask<Real> has_neighbour = share > zero;
  const P square_beyond = dot(beyond, beyond);
  const PackMask<Real> large = (square_beyond > least_area * least_area) &
                               (dot(offset, offset) < overgrown_square<Real> * rest[12] * rest[12]);
  turn.defined = turn.defined & (large | ~has_neighbour);
  const PackMask<Real> folds = has_neighbour & large;
  const P per_area = inverse_square_root(folds ? square_beyond : one);
  const PackVector<Real> normal_beyond = scaled<Real>(folds ? per_area : zero, beyond);
  const P height_beyond = folds ? square_beyond * per_area * per_length : one;
  const P sine = dot(normal_beyond, inwards), cosine = folds ? dot(normal_beyond, normal) : one;
  turn.foot_beyond = folds ? dot(offset, e) * per_squared : zero;
  if constexpr (Kind::is_height(law)) {
    turn.value = share * height_beyond * sine;
    turn.tilt = scaled<Real>(share * height_beyond * cosine / height, normal);
    turn.lift = scaled<Real>(folds ? share : zero, normal);
    turn.by_director = zero;
  } else {
    P whole = share * arc_tangent<Real>(sine, cosine);
    if constexpr (Kind::directors > 0) whole = whole + rest[13 + i] * p[6 + i].position.x;
    const PackTurn<Real> f = pack_turn<Real, Kind::measure(law)>(whole);
    turn.value = height * f.value;
    turn.tilt = scaled<Real>(f.value, inwards) + scaled<Real>(share * f.slope, normal);
    turn.lift = scaled<Real>(share * height * f.slope / height_beyond, normal_beyond);
    if constexpr (Kind::directors > 0)
      turn.by_director = height * f.slope * rest[13 + i];
    else
      turn.by_director = zero;
  }
  return turn;
}

template <class Scalar, class Kind, typename Kind::Law law>
struct FaceKernel : ElasticKernel<Scalar, Kind> {
  using Real = Scalar;
  using P = Pack<Real>;
  using Corners = std::array<PackPoints<Real>, Kind::arity>;
  using Rest = std::array<P, Kind::rest_values>;

  BENDLAB_INLINE static PackMask<Real> exceeds_rest_size(const P& squared, const Rest& rest) {
    return squared > rest[12] * rest[12];
  }

  BENDLAB_INLINE static P rest_size_squared(const Rest& rest) { return rest[12] * rest[12]; }

  BENDLAB_INLINE static PackConstraint<Real, Kind::arity> evaluate(const Corners& p, const Rest& rest) {
    const P zero{}, one = broadcast<Real>(1), least_area = collapsed_ratio<Real> * rest[12] * rest[12],
                    most = overgrown_square<Real> * rest[12] * rest[12];
    const PackVector<Real> e1 = p[4].position - p[3].position, e2 = p[5].position - p[3].position,
                           n = cross(e1, e2);
    const P square = dot(n, n);
    PackConstraint<Real, Kind::arity> result;
    // A padded lane has the length 0. It counts as defined, so that its pack is projected only once.
    const PackMask<Real> padded = rest[12] == zero;
    const PackMask<Real> sound =
        (square > least_area * least_area) & (dot(e1, e1) < most) & (dot(e2, e2) < most);
    const P per_area = inverse_square_root(sound ? square : one);
    const PackVector<Real> normal = scaled<Real>(per_area, n);
    const P twice_area = (sound ? square : one) * per_area;
    std::array<PackEdgeTurn<Real>, 3> edge;
    PackMask<Real> defined = sound;
    for (std::size_t i = 0; i < 3; ++i) {
      edge[i] = edge_turn<Real, Kind, law>(p, rest, i, normal, twice_area);
      defined = defined & edge[i].defined;
    }
    const std::array<P, 3> u = {edge[0].value - rest[3], edge[1].value - rest[4], edge[2].value - rest[5]};
    const P c0 = rest[6] * u[0] + rest[7] * u[1] + rest[8] * u[2], c1 = rest[9] * u[1] + rest[10] * u[2],
            c2 = rest[11] * u[2], squared = c0 * c0 + c1 * c1 + c2 * c2;
    const PackMask<Real> bends = defined & (squared > collapsed_ratio<Real> * collapsed_ratio<Real>);
    const P per_value = bends ? inverse_square_root(bends ? squared : one) : zero;
    result.value = bends ? squared * per_value : zero;
    result.defined = defined | padded;
    const std::array<P, 3> by_turn = {rest[6] * c0 * per_value, (rest[7] * c0 + rest[9] * c1) * per_value,
                                      (rest[8] * c0 + rest[10] * c1 + rest[11] * c2) * per_value};
    for (PackVector<Real>& gradient : result.gradient) gradient = PackVector<Real>{};
    for (std::size_t i = 0; i < 3; ++i) {
      // In lanes that do not bend, numbers may be infinite, and 0 times infinity is not 0.
      const PackVector<Real> none{}, tilt = select(bends, scaled<Real>(by_turn[i], edge[i].tilt), none),
                                     lift = select(bends, scaled<Real>(by_turn[i], edge[i].lift), none);
      const P foot = bends ? edge[i].foot : zero, foot_beyond = bends ? edge[i].foot_beyond : zero;
      PackVector<Real>&start = result.gradient[3 + (i + 1) % 3], &end = result.gradient[3 + (i + 2) % 3];
      result.gradient[i] = result.gradient[i] + lift;
      result.gradient[3 + i] = result.gradient[3 + i] + tilt;
      start = start - scaled<Real>(one - foot, tilt) - scaled<Real>(one - foot_beyond, lift);
      end = end - scaled<Real>(foot, tilt) - scaled<Real>(foot_beyond, lift);
      if constexpr (Kind::directors > 0)
        result.gradient[6 + i].x = bends ? by_turn[i] * edge[i].by_director : zero;
    }
    return result;
  }
};

}  // namespace

template <class Real, FoldBend::Law law>
struct PackKernel<Real, FoldBend, law> : FaceKernel<Real, FoldBend, law> {};
template <class Real, MidEdgeBend::Law law>
struct PackKernel<Real, MidEdgeBend, law> : FaceKernel<Real, MidEdgeBend, law> {};

BENDLAB_ELEMENT_KERNELS(FoldBend);
BENDLAB_ELEMENT_KERNELS(MidEdgeBend);

}  // namespace bendlab
