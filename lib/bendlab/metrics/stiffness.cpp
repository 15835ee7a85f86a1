#include "bendlab/metrics/stiffness.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "bendlab/metrics/elastica.hpp"

namespace bendlab {
namespace {

constexpr double same_place = 1e-5;  // in mesh sizes; single precision rounds coordinates by 10⁻⁷ sizes
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void no_strip(const std::string& what) {
  throw std::invalid_argument("the cloth is not a cantilever strip: " + what);
}

Vector3 row(const Positions& positions, int vertex) {
  return positions.row(vertex).transpose();
}

// An edge with pinned ends, of a triangle whose third vertex is free. The free part is on the left side.
struct ClampEdge {
  int from, to;
};
std::vector<ClampEdge> clamp_edges(const RestMesh& rest, std::span<const char> is_pinned,
                                   const Vector3& down) {
  std::vector<ClampEdge> edges;
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const auto vertex = [&](int c) { return rest.triangles()(t, (corner + c) % 3); };
      const auto pinned = [&](int c) { return is_pinned[static_cast<std::size_t>(vertex(c))] != 0; };
      if (pinned(0) || !pinned(1) || !pinned(2)) continue;
      const Vector3 edge = rest.position(vertex(2)) - rest.position(vertex(1)),
                    to_free = rest.position(vertex(0)) - rest.position(vertex(1));
      if (edge.cross(to_free).dot(down) < 0)
        edges.push_back({vertex(1), vertex(2)});
      else
        edges.push_back({vertex(2), vertex(1)});
    }
  return edges;
}

// The direction of the rectangle's side that is nearest to `guess`: a box along this direction is smallest.
// (If the clamp's edge zigzags, its ends can be at different s, and `guess` is a little turned.)
Vector3 aligned(const Positions& positions, const Vector3& guess, const Vector3& down) {
  const Vector3 sideways = down.cross(guess);
  const auto turned = [&](double angle) -> Vector3 {
    return std::cos(angle) * guess + std::sin(angle) * sideways;
  };
  const auto extent = [&](const Vector3& direction) {
    const Eigen::VectorXd along = positions * direction;
    return along.maxCoeff() - along.minCoeff();
  };
  const auto box = [&](double angle) { return extent(turned(angle)) * extent(down.cross(turned(angle))); };
  double low = -0.3, high = 0.3;
  for (int third = 0; third < 80; ++third) {  // leaves 0.6 (2/3)^80 = 5e-15
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (box(a) < box(b) ? high : low) = box(a) < box(b) ? b : a;
  }
  return turned(0.5 * (low + high));
}

// The mean s of the free end over the width. The end may zigzag by less than an edge. Sums over the sides of
// all triangles there. All triangles are traversed in the same sense, so the two sides at an inner edge
// cancel.
double mean_end(const std::vector<double>& s, const RestMesh& rest, const Vector3& across) {
  const double from = *std::ranges::max_element(s) - 0.75 * rest.mean_edge_length();
  double width = 0, sum = 0;
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const auto vertex = [&](int c) { return rest.triangles()(t, (corner + c) % 3); };
      const auto at = [&](int c) { return s[static_cast<std::size_t>(vertex(c))]; };
      const auto y = [&](int c) { return rest.position(vertex(c)).dot(across); };
      if (at(0) < from || at(1) < from) continue;
      const bool turned = (at(1) - at(0)) * (y(2) - y(0)) < (y(1) - y(0)) * (at(2) - at(0));
      const double share = turned ? y(0) - y(1) : y(1) - y(0);
      width += share;
      sum += share * 0.5 * (at(0) + at(1));
    }
  return sum / width;
}

// Sorts the values of `s`, and leaves out values within `apart` of the last value that was not left out.
std::vector<double> distinct(std::vector<double> s, double apart) {
  std::ranges::sort(s);
  std::vector<double> kept;
  for (const double value : s)
    if (kept.empty() || value - kept.back() > apart) kept.push_back(value);
  return kept;
}

// The s of the slices, about an edge apart. If the vertices form rows across the strip, slices lie on rows;
// otherwise slices are evenly spaced. If rows are closer than 0.7 edges, only every n-th row gets a slice, so
// that all slices cut the triangles in the same way.
std::vector<double> stations(const std::vector<double>& s, double length, double edge) {
  std::vector<double> rows;
  for (const double vertex_s : s)
    if (vertex_s > 0.25 * edge && vertex_s < length - 0.25 * edge) rows.push_back(vertex_s);
  rows = distinct(std::move(rows), 1e-5 * length);
  double least = length;
  for (std::size_t i = 1; i < rows.size(); ++i) least = std::min(least, rows[i] - rows[i - 1]);
  std::vector<double> result = {0};
  if (least >= 0.25 * edge) {
    const double gap = length / static_cast<double>(rows.size() + 1);
    const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(0.7 * edge / gap)));
    for (std::size_t i = stride - 1; i < rows.size(); i += stride) result.push_back(rows[i]);
  } else {
    const auto count = static_cast<int>(std::round(length / edge));
    for (int i = 1; i < count; ++i) result.push_back(length * i / count);
  }
  result.push_back(length);
  return result;
}

// ∫ 1 dA and ∫ f dA over the part of a triangle beyond a line of constant s, for linear s and f.
struct Integral {
  double area = 0, of_f = 0;
};
Integral beyond(const std::array<double, 3>& s, const std::array<double, 3>& f, double area, double line) {
  const auto past = [&](std::size_t corner) { return s[corner] > line; };
  const Integral whole{area, area * (f[0] + f[1] + f[2]) / 3};
  const int count = past(0) + past(1) + past(2);
  if (count == 0) return {};
  if (count == 3) return whole;
  std::size_t apex = 0;  // the corner that is alone on its side of the line
  while (past(apex) != (count == 1)) ++apex;
  const std::size_t left = (apex + 1) % 3, right = (apex + 2) % 3;
  const double a = (s[apex] - line) / (s[apex] - s[left]), b = (s[apex] - line) / (s[apex] - s[right]);
  const Integral tip{area * a * b,
                     area * a * b * (f[apex] + (a * (f[left] - f[apex]) + b * (f[right] - f[apex])) / 3)};
  return count == 1 ? tip : Integral{whole.area - tip.area, whole.of_f - tip.of_f};
}

// Averages the logarithms of three consecutive slices with the weights 1/4, 1/2, 1/4. This mean removes
// errors that alternate from row to row, and does not change a power law.
MomentCurvatureFit fit(const std::vector<ProfileRow>& profile) {
  MomentCurvatureFit result;
  std::vector<double> log_k, log_m;
  for (std::size_t i = 1; i + 1 < profile.size(); ++i) {
    const ProfileRow &before = profile[i - 1], &here = profile[i], &after = profile[i + 1];
    if (!before.fitted || !here.fitted || !after.fitted) continue;
    log_k.push_back(0.25 * std::log(before.curvature * here.curvature * here.curvature * after.curvature));
    log_m.push_back(0.25 * std::log(before.moment * here.moment * here.moment * after.moment));
  }
  result.samples = static_cast<int>(log_k.size());
  if (result.samples < 3) return result;
  const auto mean = [&](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / result.samples;
  };
  const double k = mean(log_k), m = mean(log_m);
  double sum_kk = 0, sum_km = 0, sum_mm = 0;
  for (std::size_t i = 0; i < log_k.size(); ++i) {
    sum_kk += (log_k[i] - k) * (log_k[i] - k);
    sum_km += (log_k[i] - k) * (log_m[i] - m);
    sum_mm += (log_m[i] - m) * (log_m[i] - m);
  }
  result.exponent = sum_km / sum_kk;
  result.coefficient = std::exp(m - result.exponent * k);
  result.residual = std::sqrt(std::max(0.0, sum_mm - result.exponent * sum_km) / result.samples);
  result.rigidity = std::exp(m - k);
  result.quartic = std::exp(m - 3 * k);
  return result;
}

}  // namespace

StiffnessMeter::StiffnessMeter(const RestMesh& rest, std::span<const char> is_pinned, const StripLoad& load)
    : rest_positions_(rest.positions()),
      triangles_(rest.triangles()),
      areas_(rest.areas()),
      size_(rest.size()),
      load_(load) {
  if (!(load.density > 0)) no_strip("the density is not above 0, so the strip has no weight");
  if (!(load.gravity.norm() > 0))
    no_strip("there is no gravity that bends the strip; add the effect gravity");
  down_ = load.gravity.normalized();
  const auto heights = rest_positions_ * down_;
  if (const double high = heights.maxCoeff() - heights.minCoeff(); high > same_place * size_)
    no_strip(fmt::format("at rest the strip is {:.3g} m high; it has to be flat and horizontal", high));
  find_clamp(rest, is_pinned);
  find_slices(rest);
}

void StiffnessMeter::find_clamp(const RestMesh& rest, std::span<const char> is_pinned) {
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (is_pinned[static_cast<std::size_t>(v)]) pinned_.push_back(v);
  if (pinned_.empty()) no_strip("no vertex is pinned; pin one whole side");
  const std::vector<ClampEdge> edges = clamp_edges(rest, is_pinned, down_);
  if (edges.empty()) no_strip("no side with free cloth next to it is pinned; pin one whole side");

  // The sum of the edge vectors is as long as the clamp is wide, and perpendicular to the strip.
  Vector3 across = Vector3::Zero();
  double edge_length = 0;
  for (const ClampEdge& edge : edges) {
    across += rest.position(edge.to) - rest.position(edge.from);
    edge_length += (rest.position(edge.to) - rest.position(edge.from)).norm();
  }
  if (across.norm() < 0.5 * edge_length)
    no_strip("more than one side is pinned, or a region in the middle; pin one whole side");
  along_ = aligned(rest.positions(), across.cross(down_).normalized(), down_);
  across_ = down_.cross(along_);

  double origin = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ClampEdge& edge : edges) {
    const double from = rest.position(edge.from).dot(along_), to = rest.position(edge.to).dot(along_);
    const double share =
        (rest.position(edge.to) - rest.position(edge.from)).dot(across) / across.squaredNorm();
    origin += share * 0.5 * (from + to);
    low = std::min({low, from, to});
    high = std::max({high, from, to});
  }
  clamp_depth_ = high - low;
  if (clamp_depth_ > 2 * rest.mean_edge_length())
    no_strip(
        fmt::format("the clamp's edge is not straight: it zigzags by {:.3g} m, more than two edge lengths",
                    clamp_depth_));

  for (int v = 0; v < rest.vertex_count(); ++v) {
    const double s = rest.position(v).dot(along_);
    const bool pinned = is_pinned[static_cast<std::size_t>(v)] != 0;
    if (pinned ? s > high + same_place * size_ : s < low - same_place * size_)
      no_strip(fmt::format("vertex {} is {} the clamp's edge and {}; pin one whole side and nothing else", v,
                           pinned ? "beyond" : "behind", pinned ? "pinned" : "free"));
    s_.push_back(s - origin);
  }
  length_ = mean_end(s_, rest, across_);
}

void StiffnessMeter::find_slices(const RestMesh& rest) {
  double area = 0;
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    const auto corner = triangles_.row(static_cast<Eigen::Index>(t));
    const auto s = [&](int c) { return s_[static_cast<std::size_t>(corner(c))]; };
    area += beyond({s(0), s(1), s(2)}, {}, areas_[t], 0).area;
  }
  width_ = area / length_;
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  for (const double s : stations(s_, length_, rest.mean_edge_length()))
    slices_.push_back(slice(s, -unbounded, unbounded));
  if (slices_.size() < 5)
    no_strip(fmt::format("the free part is {} edges long, but at least 4 are needed to measure a curvature",
                         slices_.size() - 1));
  if (slices_[0].width < 0.6 * width_)
    no_strip(
        fmt::format("{:.3g} m of the width are pinned, but the strip is {:.3g} m wide; pin one whole side",
                    slices_[0].width, width_));
  for (std::size_t i = 0; i + 1 < slices_.size(); ++i)       // not the free end: it may zigzag
    if (std::abs(slices_[i].width - width_) > 0.4 * width_)  // a lattice two edges wide differs by a third
      no_strip(fmt::format(
          "at s = {:.3g} m the strip is {:.3g} m wide, but {:.3g} m on average; a strip must have the same "
          "width everywhere",
          slices_[i].s, slices_[i].width, width_));
  const auto last = slices_.end() - 1;
  const double low = std::ranges::max_element(slices_.begin(), last, {}, &Slice::low)->low,
               high = std::ranges::min_element(slices_.begin(), last, {}, &Slice::high)->high;
  for (Slice& cut : slices_) cut = slice(cut.s, low, high);
}

Vector3 StiffnessMeter::Slice::middle(const Positions& positions) const {
  Vector3 sum = Vector3::Zero();
  for (const auto& [vertex, weight] : weights) sum += weight * row(positions, vertex);
  return sum;
}

// Cuts the triangles along a line of constant s, across the strip from `low` to `high`. The line is moved a
// little towards the strip's middle, so that no vertex lies on the line.
StiffnessMeter::Slice StiffnessMeter::slice(double s, double low, double high) const {
  constexpr double hair = 1e-9;
  const double to_middle = length_ - 2 * s,
               aside = std::abs(to_middle) > 1e-3 * length_ ? to_middle : 1e-3 * length_;
  const double line = s + hair * aside;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Slice result{.s = s, .low = infinity, .high = -infinity};
  for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
    // Inside the triangle, the line has two ends. Each end is a weighted mean of two vertices.
    std::array<std::array<std::pair<int, double>, 2>, 2> ends;
    std::size_t crossed = 0;
    for (int c = 0; c < 3; ++c) {
      const int a = triangles_(t, c), b = triangles_(t, (c + 1) % 3);
      const double sa = s_[static_cast<std::size_t>(a)], sb = s_[static_cast<std::size_t>(b)];
      if ((sa > line) == (sb > line)) continue;
      const double part = (line - sa) / (sb - sa);
      ends[crossed++] = {{{a, 1 - part}, {b, part}}};
    }
    if (crossed < 2) continue;
    const auto y = [&](std::size_t end) {
      return ends[end][0].second * row(rest_positions_, ends[end][0].first).dot(across_) +
             ends[end][1].second * row(rest_positions_, ends[end][1].first).dot(across_);
    };
    if (y(0) > y(1)) std::swap(ends[0], ends[1]);
    const double from = std::max(y(0), low), to = std::min(y(1), high);
    if (!(from < to)) continue;
    result.low = std::min(result.low, from);
    result.high = std::max(result.high, to);
    result.width += to - from;
    const double middle = (0.5 * (from + to) - y(0)) / (y(1) - y(0));
    for (const auto& [vertex, weight] : ends[0])
      result.weights.emplace_back(vertex, (to - from) * (1 - middle) * weight);
    for (const auto& [vertex, weight] : ends[1])
      result.weights.emplace_back(vertex, (to - from) * middle * weight);
  }
  if (!(result.width > 0)) no_strip(fmt::format("at s = {:.3g} m there is no cloth", s));
  for (auto& [vertex, weight] : result.weights) weight /= result.width;
  return result;
}

std::vector<Vector3> StiffnessMeter::middle_line(const Positions& positions) const {
  if (positions.rows() != rest_positions_.rows() || !positions.allFinite())
    throw std::invalid_argument(
        fmt::format("stiffness: got {} positions ({}), but needs {} finite positions", positions.rows(),
                    positions.allFinite() ? "all finite" : "not all finite", rest_positions_.rows()));
  for (const int v : pinned_)
    if ((row(positions, v) - row(rest_positions_, v)).norm() > same_place * size_)
      no_strip(fmt::format("the clamp has moved or turned: vertex {} is {:.3g} m from its rest position", v,
                           (row(positions, v) - row(rest_positions_, v)).norm()));
  std::vector<Vector3> line;
  for (const Slice& cut : slices_) line.push_back(cut.middle(positions));
  return line;
}

double StiffnessMeter::height_over_width(const Positions& positions, double clamp_offset) const {
  const std::vector<Vector3> line = middle_line(positions);
  const Vector3 tip = line.back() - line.front();
  return tip.dot(down_) / (tip.dot(along_) + clamp_offset);
}

StripStiffness StiffnessMeter::measure(const Positions& positions, const StripOptions& options) const {
  const std::vector<Vector3> line = middle_line(positions);
  const Vector3 tip = line.back() - line.front();
  StripStiffness result{.length = length_,
                        .width = width_,
                        .effective_length = length_ + options.clamp_offset,
                        .drop = tip.dot(down_),
                        .reach = tip.dot(along_) + options.clamp_offset};
  result.height_over_width = result.drop / result.reach;
  for (std::size_t i = 1; i < line.size(); ++i) result.stretch += (line[i] - line[i - 1]).norm() / length_;
  result.stretch -= 1;

  const double weight = load_.density * load_.gravity.norm(), l = result.effective_length;
  const auto from_curve = [&](BendingLaw law, double length_power, double& gamma, double& factor,
                              double& stiffness) {
    gamma = factor = stiffness = nan;
    if (!(result.reach > 0 && result.height_over_width >= 1e-6 && result.height_over_width <= 500)) return;
    gamma = hanging_strip(law, result.height_over_width).gamma;
    factor = amplification(law, result.height_over_width);
    stiffness = weight * std::pow(l, length_power) / gamma;
  };
  from_curve(BendingLaw::linear, 3, result.gamma, result.amplification, result.flexural_rigidity);
  from_curve(BendingLaw::cubic, 5, result.quartic_gamma, result.quartic_amplification, result.quartic);
  result.bending_length = std::cbrt(result.flexural_rigidity / weight);
  result.profile = profile(positions, line, options);
  result.fit = fit(result.profile);
  return result;
}

double StiffnessMeter::moment(const Positions& positions, double s, double reach) const {
  Integral sum;
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    const auto corner = triangles_.row(static_cast<Eigen::Index>(t));
    std::array<double, 3> at{}, arm{};
    for (int c = 0; c < 3; ++c) {
      at[static_cast<std::size_t>(c)] = s_[static_cast<std::size_t>(corner(c))];
      arm[static_cast<std::size_t>(c)] = row(positions, corner(c)).dot(along_) - reach;
    }
    sum.of_f += beyond(at, arm, areas_[t], s).of_f;
  }
  return load_.density * load_.gravity.norm() * sum.of_f / width_;
}

std::vector<ProfileRow> StiffnessMeter::profile(const Positions& positions, const std::vector<Vector3>& line,
                                                const StripOptions& options) const {
  const auto angle = [&](std::size_t i) {  // of the chord from slice i to the next
    const Vector3 chord = line[i + 1] - line[i];
    return std::atan2(chord.dot(down_), chord.dot(along_));
  };
  std::vector<ProfileRow> rows;
  double largest = 0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const double turn = std::remainder(angle(i) - angle(i - 1), 2 * std::numbers::pi);
    const double curvature = turn / (0.5 * (slices_[i + 1].s - slices_[i - 1].s));
    rows.push_back({.s = slices_[i].s,
                    .angle = angle(i - 1) + 0.5 * turn,
                    .curvature = curvature,
                    .moment = moment(positions, slices_[i].s, line[i].dot(along_))});
    largest = std::max(largest, curvature);
  }
  // The fit ignores a κ below a hundredth of the largest κ, and a κ with rounding errors above a twentieth.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ProfileRow& entry = rows[i];
    const double step = 0.5 * (slices_[i + 2].s - slices_[i].s);
    entry.fitted = entry.s > options.exclude && entry.s < length_ - options.exclude && entry.moment > 0 &&
                   entry.curvature > std::max(0.01 * largest, 20 * 4 * options.rounding / (step * step));
  }
  return rows;
}

}  // namespace bendlab
