#include "bendlab/solver/pair_history.hpp"

#include <algorithm>

#include "bendlab/constraints/pack.hpp"
#include "bendlab/solver/memory.hpp"

namespace bendlab {

template <class Real>
void PairHistory<Real>::add(const Real* x, const Real* gradient, const Real* weights) {
  if (pairs_.empty()) return;
  if (last_x_.empty()) {
    last_x_.assign(x, x + size_), last_gradient_.assign(gradient, gradient + size_);
    return;
  }
  Pair& pair = pairs_[next_];
  pair.move.resize(size_), pair.change.resize(size_);
  for (std::size_t i = 0; i < size_; ++i) pair.move[i] = x[i] - last_x_[i];
  for (std::size_t i = 0; i < size_; ++i) pair.change[i] = gradient[i] - last_gradient_[i];
  std::copy_n(x, size_, last_x_.begin());
  std::copy_n(gradient, size_, last_gradient_.begin());
  pair.curvature = dot(pair.move.data(), pair.change.data());
  double inertia = 0;
  for (std::size_t v = 0; 4 * v < size_; ++v) {
    const Real* const s = &pair.move[4 * v];
    inertia += static_cast<double>(weights[v] * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]));
  }
  if (!(pair.curvature > 0.1 * inertia)) {
    count_ = std::min(count_, pairs_.size() - 1);  // the place of the oldest was used
    return;
  }
  next_ = (next_ + 1) % pairs_.size();
  count_ = std::min(count_ + 1, pairs_.size());
}

// 64 sums side by side, as many on every processor, so that all compute the same bits. Parts of 4096 numbers
// are added in double.
template <class Real>
double PairHistory<Real>::dot(const Real* a, const Real* b) const {
  constexpr std::size_t width = static_cast<std::size_t>(lanes<Real>), wide = 64, part = 4096;
  double whole = 0;
  for (std::size_t first = 0; first < size_; first += part) {
    const std::size_t last = std::min(first + part, size_);
    std::array<Pack<Real>, wide / width> sums{};
    std::size_t i = first;
    for (; i + wide <= last; i += wide)
      for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] = sums[k] + load(a + i + k * width) * load(b + i + k * width);
    for (const Pack<Real>& sum : sums)
      for (int lane = 0; lane < lanes<Real>; ++lane) whole += static_cast<double>(sum[lane]);
    for (; i < last; ++i) whole += static_cast<double>(a[i] * b[i]);
  }
  return whole;
}

template <class Real>
void PairHistory<Real>::add_scaled(Real* __restrict to, Real scale, const Real* __restrict from) const {
  for (std::size_t i = 0; i < size_; ++i) to[i] += scale * from[i];
}

template <class Real>
std::size_t PairHistory<Real>::memory_bytes() const {
  std::size_t sum = bytes_of(last_x_) + bytes_of(last_gradient_);
  for (const Pair& pair : pairs_) sum += bytes_of(pair.move) + bytes_of(pair.change);
  return sum;
}

template <class Real>
void PairHistory<Real>::archive(Archive& state) {
  state(count_, next_, last_x_, last_gradient_);
  for (Pair& pair : pairs_) state(pair.move, pair.change, pair.curvature);
}

template class PairHistory<float>;
template class PairHistory<double>;

}  // namespace bendlab
