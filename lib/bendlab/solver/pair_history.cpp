#include "bendlab/solver/pair_history.hpp"

#include <algorithm>
#include <array>

#include "bendlab/constraints/pack.hpp"
#include "bendlab/solver/memory.hpp"

namespace bendlab {
namespace {

// Vectors are read in parts, so that a part stays in the first-level cache for all pairs.
constexpr std::size_t part_points = 256;

// The dot product of two parts. Every processor computes 64 partial sums, whatever the width of its vectors,
// so that the result has the same bits on all processors.
template <class Real>
double part_dot(const Real* a, const Real* b, std::size_t size) {
  constexpr std::size_t width = static_cast<std::size_t>(lanes<Real>), wide = 64;
  std::array<Pack<Real>, wide / width> sums{};
  std::size_t i = 0;
  for (; i + wide <= size; i += wide)
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] = sums[k] + load(a + i + k * width) * load(b + i + k * width);
  double whole = 0;
  for (const Pack<Real>& sum : sums)
    for (int lane = 0; lane < lanes<Real>; ++lane) whole += static_cast<double>(sum[lane]);
  for (; i < size; ++i) whole += static_cast<double>(a[i] * b[i]);
  return whole;
}

// Calls action(first point, count of numbers) for each part.
template <class Action>
void for_parts(std::size_t points, const Action& action) {
  for (std::size_t first = 0; first < points; first += part_points)
    action(first, 4 * std::min(part_points, points - first));
}

}  // namespace

template <class Real>
PairHistory<Real>::PairHistory(std::size_t count, std::size_t most)
    : count_(count),
      pair_(most + 1),
      move_change_(pair_.size() * pair_.size()),
      applied_change_(move_change_.size()),
      move_gradient_(pair_.size()),
      applied_gradient_(pair_.size()) {}

template <class Real>
auto PairHistory<Real>::add(const Place& place, const std::vector<Real>& weights) -> std::optional<Along> {
  const bool follows = !last_x_.empty();
  const std::size_t made = next_, width = pair_.size();
  Pair& pair = pair_[made];
  if (follows)
    pair.move.resize(count_), pair.applied.resize(count_);
  else
    last_x_.resize(count_), last_gradient_.resize(count_), last_applied_.resize(count_);
  std::ranges::fill(move_gradient_, 0), std::ranges::fill(applied_gradient_, 0);
  std::vector<double> moves_change(width), applied_change(width);
  double inertia = 0;
  for_parts(count_, [&](std::size_t first, std::size_t size) {
    const Real *const g = &place.gradient[first].x, *const p = &place.applied[first].x;
    const Real* const x = &place.x[first].x;
    Real *const x_last = &last_x_[first].x, *const g_last = &last_gradient_[first].x,
                *const p_last = &last_applied_[first].x;
    std::array<Real, 4 * part_points> y;
    if (follows) {
      if (place.gradient_before != nullptr) {
        const Real *const u = &(*place.gradient_before)[first].x, *const q =
                                                                      &(*place.applied_before)[first].x;
        for (std::size_t k = 0; k < size; ++k) g_last[k] += u[k], p_last[k] += q[k];
      }
      Real *const s = &pair.move[first].x, *const z = &pair.applied[first].x;
      for (std::size_t k = 0; k < size; ++k)
        s[k] = x[k] - x_last[k], y[k] = g[k] - g_last[k], z[k] = p[k] - p_last[k];
      Real part = 0;
      for (std::size_t k = 0; k < size; k += 4)
        part += weights[first + k / 4] * (s[k] * s[k] + s[k + 1] * s[k + 1] + s[k + 2] * s[k + 2]);
      inertia += static_cast<double>(part);
      move_gradient_[made] += part_dot(s, g, size), moves_change[made] += part_dot(s, y.data(), size);
      applied_gradient_[made] += part_dot(z, g, size), applied_change[made] += part_dot(z, y.data(), size);
    }
    for (std::size_t i = 0; i < pairs_; ++i) {
      const std::size_t at = newest(i);
      const Real *const s = &pair_[at].move[first].x, *const z = &pair_[at].applied[first].x;
      move_gradient_[at] += part_dot(s, g, size), applied_gradient_[at] += part_dot(z, g, size);
      if (!follows) continue;
      moves_change[at] += part_dot(s, y.data(), size), applied_change[at] += part_dot(z, y.data(), size);
    }
    std::copy_n(x, size, x_last), std::copy_n(g, size, g_last), std::copy_n(p, size, p_last);
  });
  if (!follows) return std::nullopt;
  const double after = move_gradient_[made];
  pair.curvature = moves_change[made];
  if (width > 1 && pair.curvature > 0.1 * inertia) {
    for (std::size_t i = 0; i < pairs_; ++i) {
      const std::size_t older = newest(i);
      moves(older, made) = moves_change[older], metrics(older, made) = applied_change[older];
    }
    metrics(made, made) = applied_change[made];
    next_ = (next_ + 1) % width;
    pairs_ = std::min(pairs_ + 1, width - 1);
  }
  return Along{after - pair.curvature, after};
}

template <class Real>
void PairHistory<Real>::direct(const Points<Real>& applied, Points<Real>& direction) const {
  std::vector<double> alpha(pairs_), rest(pairs_);  // rest: α - β
  for (std::size_t i = 0; i < pairs_; ++i) {        // from the newest pair on
    const std::size_t own = newest(i);
    double dot = move_gradient_[own];
    for (std::size_t newer = 0; newer < i; ++newer)
      dot -= alpha[newer] * move_change_[own * pair_.size() + newest(newer)];
    alpha[i] = dot / pair_[own].curvature;
  }
  for (std::size_t i = pairs_; i-- > 0;) {  // from the oldest pair on
    const std::size_t own = newest(i);
    double dot = applied_gradient_[own];
    for (std::size_t j = 0; j < pairs_; ++j) {
      const std::size_t older = j < i ? own : newest(j), newer = j < i ? newest(j) : own;
      dot -= alpha[j] * applied_change_[older * pair_.size() + newer];
    }
    for (std::size_t older = i + 1; older < pairs_; ++older)
      dot += rest[older] * move_change_[newest(older) * pair_.size() + own];
    rest[i] = alpha[i] - dot / pair_[own].curvature;
  }
  for_parts(count_, [&](std::size_t first, std::size_t size) {
    const Real* const p = &applied[first].x;
    std::array<Real, 4 * part_points> sum;
    for (std::size_t k = 0; k < size; ++k) sum[k] = p[k];
    for (std::size_t i = 0; i < pairs_; ++i) {
      const Pair& pair = pair_[newest(i)];
      const Real *const s = &pair.move[first].x, *const z = &pair.applied[first].x;
      const Real of_move = static_cast<Real>(rest[i]), of_metric = static_cast<Real>(alpha[i]);
      for (std::size_t k = 0; k < size; ++k) sum[k] += of_move * s[k] - of_metric * z[k];
    }
    std::copy_n(sum.begin(), size, &direction[first].x);
  });
}

template <class Real>
std::size_t PairHistory<Real>::memory_bytes() const {
  std::size_t sum = bytes_of(last_x_) + bytes_of(last_gradient_) + bytes_of(last_applied_);
  for (const Pair& pair : pair_) sum += bytes_of(pair.move) + bytes_of(pair.applied);
  return sum;
}

template <class Real>
void PairHistory<Real>::archive(Archive& state) {
  state(pairs_, next_, move_change_, applied_change_, last_x_, last_gradient_, last_applied_);
  for (Pair& pair : pair_) state(pair.move, pair.applied, pair.curvature);
}

template class PairHistory<float>;
template class PairHistory<double>;

}  // namespace bendlab
