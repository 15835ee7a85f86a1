#include "bendlab/constraints/directors.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>

#include "bendlab/constraints/corners.hpp"
#include "bendlab/constraints/energy.hpp"

namespace bendlab {
namespace {

// Newton's method for the directors alone.
class Relaxation {
 public:
  // `least`: the longest move that counts as none, m.
  Relaxation(const Directors& directors, const ElementLists& elements, const OwnElements& own,
             const Positions& vertices, double least)
      : directors_(directors),
        elements_(elements),
        own_(own),
        first_(static_cast<int>(vertices.rows())),
        least_(least) {
    unknown_.assign(directors.vertices.size(), -1);
    for (std::size_t d = 0; d < unknown_.size(); ++d)
      if (directors.is_pinned[d] == 0) unknown_[d] = directors.coordinates * free_++;
    free_ *= directors.coordinates;
  }

  bool has_unknowns() const { return free_ > 0; }

  // Improves the directors among `points` (#P by 3). Returns false if they need no further move, or if no
  // move lowers the energy. In a strongly bent sheet the search takes tens of steps without the second
  // derivatives of constraints. With them the matrix may not be definite, and a step may go uphill; then the
  // step is found without them.
  bool improve(Positions& points) {
    for (const bool second : {true, false}) {
      if (!find_step(points, second)) continue;
      if (!(step_.cwiseAbs().maxCoeff() > least_)) return false;
      if (step_.dot(slope_) < 0 && move(points)) return true;
    }
    return false;
  }

 private:
  // Returns false if the matrix is singular.
  bool find_step(const Positions& points, bool second) {
    slope_.setZero(free_);
    entries_.clear();
    for (int u = 0; u < free_; ++u) entries_.emplace_back(u, u, 0);
    for_each_kind(elements_, [&]<class Kind>(const ElementList<Kind>& list) {
      if constexpr (directors_of < Kind >> 0) add(list, points, second);
    });
    add_own(points);
    step_.setZero(free_);
    if (slope_.isZero(0)) return true;
    Eigen::SparseMatrix<double> matrix(free_, free_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const double mean = matrix.diagonal().cwiseAbs().mean();
    for (int u = 0; u < free_; ++u)  // a director that no element reads
      matrix.coeffRef(u, u) += matrix.coeff(u, u) == 0 ? (mean > 0 ? mean : 1) : 1e-14 * mean;
    if (!is_analysed_) solver_.analyzePattern(matrix), is_analysed_ = true;
    solver_.factorize(matrix);
    if (solver_.info() != Eigen::Success) return false;
    step_ = -solver_.solve(slope_);
    return true;
  }

  double energy(const Positions& points) const {
    double sum = elastic_energy(own_, points);
    for_each_kind(elements_, [&]<class Kind>(const ElementList<Kind>& list) {
      if constexpr (directors_of < Kind >> 0) sum += elastic_energy(list, points);
    });
    return sum;
  }

  int unknown(int point, int coordinate) const {
    const int d = point - first_;
    if (d < 0 || coordinate >= directors_.coordinates || directors_.is_held(d, coordinate)) return -1;
    const int first = unknown_[static_cast<std::size_t>(d)];
    return first < 0 ? -1 : first + coordinate;
  }

  template <class Kind>
  void add(const ElementList<Kind>& list, const Positions& points, bool second) {
    constexpr std::size_t first = Kind::arity - Kind::directors;
    for (std::size_t c = 0; c < list.size(); ++c) {
      const auto p = corners(points, list.vertices[c]);
      std::array<std::array<double, Kind::directors>, Kind::components> slopes{};  // of C_k
      std::array<double, Kind::components> values{};                               // C_k
      bool defined = true;
      for (std::size_t k = 0; k < Kind::components && defined; ++k) {
        const auto part = Kind::template component<double>(p, list.rest[c], list.law, k);
        defined = part.defined, values[k] = part.value;
        for (std::size_t i = 0; i < Kind::directors; ++i) slopes[k][i] = part.gradient[first + i].x();
      }
      if (!defined) continue;
      std::array<double, Kind::directors> slope{};  // of ½ |C|²
      double squared = 0;
      for (std::size_t k = 0; k < Kind::components; ++k) {
        squared += values[k] * values[k];
        for (std::size_t i = 0; i < Kind::directors; ++i) slope[i] += values[k] * slopes[k][i];
      }
      const double value = std::sqrt(squared), secant = secant_of(list, c, value);
      // The slope of the secant, divided by |C|, from a difference quotient.
      constexpr double share = 1e-6;
      const double bend =
          second && value > 0 ? (secant_of(list, c, (1 + share) * value) - secant) / (share * squared) : 0;
      std::array<double, Kind::directors> curvature{};  // Σ C_k C_k''
      if (second) curvature = second_of(list, c, p, values, slope);
      for (std::size_t i = 0; i < Kind::directors; ++i) {
        const int row = unknown(list.vertices[c][first + i], 0);
        if (row < 0) continue;
        slope_(row) += secant * slope[i] / list.softness[c];
        for (std::size_t j = 0; j < Kind::directors; ++j) {
          const int column = unknown(list.vertices[c][first + j], 0);
          if (column < 0) continue;
          double entry = bend * slope[i] * slope[j] + (i == j ? secant * curvature[i] : 0);
          for (std::size_t k = 0; k < Kind::components; ++k) entry += secant * slopes[k][i] * slopes[k][j];
          entries_.emplace_back(row, column, entry / list.softness[c]);
        }
      }
    }
  }

  template <class Kind>
  static double secant_of(const ElementList<Kind>& list, std::size_t c, double value) {
    return list.moment.empty() ? 1 : resistance(list.moment, c, value).secant;
  }

  // Σ C_k C_k'' for each director of an element, from a difference quotient. A component is a sum of
  // functions of one director each, so all directors are moved together. `slope`: Σ C_k C_k'.
  template <class Kind, class Corners>
  static auto second_of(const ElementList<Kind>& list, std::size_t c, Corners p,
                        const std::array<double, Kind::components>& values,
                        const std::array<double, Kind::directors>& slope) {
    constexpr std::size_t first = Kind::arity - Kind::directors;
    std::array<double, Kind::directors> second{};
    const double apart = 1e-6 * (p[first - 1] - p[first - 2]).norm();  // of an edge, m
    for (std::size_t i = first; i < Kind::arity; ++i) p[i].x() += apart;
    const auto there = Kind::template weighted_components<double>(p, list.rest[c], list.law, values);
    if (apart > 0 && there.defined)
      for (std::size_t i = 0; i < Kind::directors; ++i)
        second[i] = (there.gradient[first + i].x() - slope[i]) / apart;
    return second;
  }

  void add_own(const Positions& points) {
    if (own_.size() == 0 || own_.directors == 0) return;
    const OwnValues all = evaluate(own_, points);
    const std::size_t width = 3 * own_.arity, first = 3 * (own_.arity - own_.directors);
    const std::vector<Eigen::MatrixXd> second = second_derivatives(own_, points, first);
    for (std::size_t c = 0; c < own_.size(); ++c) {
      const std::span<const int> vertices = own_.corners(c);
      const auto row_of = [&](std::size_t i) { return unknown(vertices[i / 3], static_cast<int>(i % 3)); };
      for (std::size_t i = first; i < width; ++i) {
        const int row = row_of(i);
        if (row < 0) continue;
        slope_(row) += all.gradients[c * width + i] / own_.softness[c];
        for (std::size_t j = first; j < width; ++j)
          if (const int column = row_of(j); column >= 0)
            entries_.emplace_back(
                row, column,
                second[c](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) / own_.softness[c]);
      }
    }
  }

  // Halves the step until the energy falls. Returns whether the directors moved.
  bool move(Positions& points) const {
    const double before = energy(points);
    constexpr int most_halvings = 20;
    for (int halving = 0; halving <= most_halvings; ++halving) {
      const double share = std::ldexp(1.0, -halving);
      Positions moved = points;
      for (int d = 0; d < directors_.count(); ++d)
        for (int k = 0; k < directors_.coordinates; ++k)
          if (const int u = unknown(first_ + d, k); u >= 0) moved(first_ + d, k) += share * step_(u);
      if (!(energy(moved) <= before)) continue;
      points = std::move(moved);
      return share * step_.cwiseAbs().maxCoeff() > least_;
    }
    return false;
  }

  const Directors& directors_;
  const ElementLists& elements_;
  const OwnElements& own_;
  int first_, free_ = 0;
  std::vector<int> unknown_;
  double least_;
  Eigen::VectorXd slope_, step_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool is_analysed_ = false;
};

// Directors with three coordinates are normals at vertices. A normal that is far from its triangles' normals
// may relax to their other side, so the search starts with the mean of these normals.
Positions upright_normals(const Directors& directors, const OwnElements& own, const Positions& vertices,
                          const Positions& start) {
  Positions sum = Positions::Zero(start.rows(), 3), normals = start;
  for (std::size_t c = 0; c < own.size(); ++c) {
    const std::span<const int> corner = own.corners(c);
    const auto p = [&](std::size_t i) -> Vector3 { return vertices.row(corner[i]).transpose(); };
    const Vector3 normal = (p(1) - p(0)).cross(p(2) - p(0));
    for (std::size_t i = own.arity - own.directors; i < own.arity; ++i)
      sum.row(corner[i] - static_cast<int>(vertices.rows())) += normal.transpose();
  }
  for (Eigen::Index d = 0; d < sum.rows(); ++d)
    if (directors.is_pinned[static_cast<std::size_t>(d)] == 0 && sum.row(d).norm() > 0) {
      for (int k = 0; k < 3; ++k)
        if (directors.is_held(static_cast<int>(d), k)) sum(d, k) = 0;
      normals.row(d) = start.row(d).norm() * sum.row(d).normalized();
    }
  return normals;
}

}  // namespace

Eigen::Matrix3d ClampedNormal::axes(const Vector3& a, const Vector3& b, const Vector3& c) {
  Eigen::Matrix3d result;
  result.col(0) = (b - a).normalized();
  result.col(2) = (b - a).cross(c - a).normalized();
  result.col(1) = result.col(2).cross(result.col(0));
  return result;
}

Positions joined(const Positions& vertices, const Positions& directors) {
  if (directors.rows() == 0) return vertices;
  Positions points(vertices.rows() + directors.rows(), 3);
  points << vertices, directors;
  return points;
}

Positions relaxed_directors(const Directors& directors, const ElementLists& elements, const OwnElements& own,
                            const Positions& vertices, const Positions& start) {
  if (directors.count() == 0) return start;
  constexpr int most_iterations = 20;  // a fold takes 6; in a random pose the search may not end
  Positions points =
      joined(vertices, directors.coordinates == 3 ? upright_normals(directors, own, vertices, start) : start);
  if (!points.allFinite()) return start;
  for (const ClampedNormal& normal : directors.clamped)
    if (directors.is_pinned[static_cast<std::size_t>(normal.director)] != 0)
      points.row(vertices.rows() + normal.director) = normal.at(vertices).transpose();
  const double size = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
  Relaxation relaxation(directors, elements, own, vertices,
                        16 * std::numeric_limits<double>::epsilon() * size);
  for (int i = 0; i < most_iterations && relaxation.has_unknowns(); ++i)
    if (!relaxation.improve(points)) break;
  return points.bottomRows(directors.count());
}

}  // namespace bendlab
