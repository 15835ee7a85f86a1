#include "bendlab/bending/bend_spans.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bendlab {
namespace {

// Number of samples along a line; `fine` if a part of the line may lie on held triangles.
constexpr std::size_t most_samples = 6, fine = 24;

constexpr std::array<bool, fine> every_place = [] {
  std::array<bool, fine> list{};
  list.fill(true);
  return list;
}();

double middle(std::size_t sample, std::size_t samples) {
  return (static_cast<double>(sample) + 0.5) / static_cast<double>(samples);
}

double moment_at(std::size_t sample, std::size_t samples, const std::array<bool, fine>& bends) {
  const double at = middle(sample, samples);
  double sum = 0;
  for (std::size_t other = 0; other < samples; ++other) {
    const double s = middle(other, samples);
    if (bends[other]) sum += std::min(at, s) * (1 - std::max(at, s));
  }
  return sum;
}

void add(Shares& shares, int vertex, double part) {
  if (!(part > 1e-6)) return;
  const auto same = std::ranges::find(shares, vertex, &Share::vertex);
  if (same == shares.end())
    shares.push_back({vertex, static_cast<float>(part)});
  else
    same->part += static_cast<float>(part);
}

}  // namespace

std::vector<char> held_triangles(const RestMesh& rest, const Pins& pins) {
  std::vector<char> held;
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto corner = rest.triangles().row(t);
    held.push_back(pins.pinned(corner(0)) && pins.pinned(corner(1)) && pins.pinned(corner(2)));
  }
  return held;
}

Span hinge_span(const std::array<int, 4>& hinge, const Pins& pins) {
  constexpr float edge = 4.0f / 9, opposite = 1.0f / 9;
  const bool edge_held = pins.pinned(hinge[0]) && pins.pinned(hinge[1]);
  std::vector<int> free;
  for (const std::size_t i : {2u, 3u})
    if (!(edge_held && pins.pinned(hinge[i]))) free.push_back(hinge[i]);
  Span span{{{hinge[0], edge}, {hinge[1], edge}}, 0.5 * static_cast<double>(free.size())};
  for (const int vertex : free) span.shares.push_back({vertex, opposite / static_cast<float>(free.size())});
  return span;
}

PairSpans::PairSpans(const RestMesh& rest, const Pins& pins, const std::vector<char>& held,
                     std::span<const Vector2> plane)
    : mean_edge_(rest.mean_edge_length()),
      pins_(pins),
      held_(held),
      plane_(plane),
      find_(rest.triangles(), plane, rest.mean_edge_length()) {}

std::size_t PairSpans::sample_count(int a, int b, double length) const {
  if (pins_.pinned(a) || pins_.pinned(b)) return fine;
  return std::clamp(static_cast<std::size_t>(std::ceil(length / mean_edge_)), std::size_t{2}, most_samples);
}

Span PairSpans::operator()(int a, int b) const {
  const Vector2 from = plane_[static_cast<std::size_t>(a)], to = plane_[static_cast<std::size_t>(b)];
  const std::size_t samples = sample_count(a, b, (to - from).norm());
  Span span{{}, 0};
  std::array<std::optional<TriangleFinder::Place>, fine> place;
  std::array<bool, fine> bends{};
  for (std::size_t s = 0; s < samples; ++s) {
    place[s] = find_(from + middle(s, samples) * (to - from));
    bends[s] = !(place[s] && held_[static_cast<std::size_t>(place[s]->triangle)]);
  }
  for (std::size_t s = 0; s < samples; ++s) {
    if (!bends[s]) continue;
    const double moment = moment_at(s, samples, bends);
    span.seen += moment;
    for (std::size_t i = 0; place[s] && i < 3; ++i)
      add(span.shares, place[s]->corner[i], moment * place[s]->weight[i]);
    if (!place[s])  // the line crosses a gap
      add(span.shares, a, moment / 2), add(span.shares, b, moment / 2);
  }
  for (Share& share : span.shares) share.part /= static_cast<float>(span.seen);
  double unheld = 0;
  for (std::size_t s = 0; s < samples; ++s) unheld += moment_at(s, samples, every_place);
  span.seen /= unheld;
  return span;
}

}  // namespace bendlab
