#include "experiments/fit/fit.hpp"

#include <fmt/format.h>
#include <nlopt.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bendlab/mesh/mesh_surface.hpp"
#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/scene_json.hpp"
#include "bendlab/scene/simulate.hpp"
#include "bendlab/scene/start_after.hpp"
#include "bendlab/settings/input_file.hpp"
#include "bendlab/settings/measured_lines.hpp"

namespace bendlab {
namespace {

using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();

// From the nearest place of the cloth to a point, m, and the normal of the triangle there.
struct Gap {
  Vector3 away = Vector3::Zero(), normal = Vector3::UnitZ();

  // The direction in which a small move of the cloth changes the distance. Inside the cloth it is the normal;
  // beyond a border it is that of the gap. A gap no longer than the points' `uncertainty`, m, does not show
  // on which side of the border the point is, so the direction is the normal.
  Vector3 direction(double uncertainty) const {
    constexpr double beside = 0.5;
    const double length = away.norm();
    return length <= uncertainty || std::abs(away.dot(normal)) >= beside * length ? normal
                                                                                  : away.normalized();
  }
};

Gap gap_to(const Vector3& point, const Positions& positions, const Triangles& triangles) {
  double least = infinity;
  Gap nearest;
  for (const auto corner : triangles.rowwise()) {
    const Vector3 a = positions.row(corner(0)).transpose(), b = positions.row(corner(1)).transpose(),
                  c = positions.row(corner(2)).transpose();
    const Vector3 weight = nearest_weights(point, a, b, c);
    const Vector3 away = point - (weight(0) * a + weight(1) * b + weight(2) * c);
    if (const double squared = away.squaredNorm(); squared < least) {
      least = squared;
      nearest = {away, (b - a).cross(c - a).stableNormalized()};
    }
  }
  return nearest;
}

// Simulates all specimens with given logarithms of the settings.
class Specimens {
 public:
  explicit Specimens(const FitProblem& problem) : problem_(problem), poses_(problem.runs.size()) {}

  // The gaps between the cloth and all measured points.
  std::vector<Gap> gaps(const VectorXd& logarithms) {
    std::vector<Gap> all;
    moving_.reset(), longest_edge_ = 0, largest_size_ = 0;
    for (std::size_t r = 0; r < problem_.runs.size(); ++r) {
      Cloth cloth(built(r, logarithms));
      cloth.run(problem_.runs[r].scene().duration);
      poses_[r] = cloth.positions();
      const double speed = cloth.velocities().rowwise().norm().maxCoeff();  // m/s
      const bool rests = cloth.scene().input.method.kind().has_motion
                             ? speed <= at_rest * cloth.scene().rest.size()
                             : cloth.simulation().settled();
      if (!rests) moving_ = r;
      longest_edge_ = std::max(longest_edge_, cloth.scene().rest.mean_edge_length());
      largest_size_ = std::max(largest_size_, cloth.scene().rest.size());
      for (const auto& point : problem_.shapes[r].points.rowwise())
        all.push_back(gap_to(point.transpose(), poses_[r], cloth.triangles()));
    }
    return all;
  }

  // A specimen that was not at rest at the end of its run, if there was one at the last call of gaps().
  std::optional<std::size_t> moving() const { return moving_; }
  double longest_edge() const { return longest_edge_; }  ///< the longest mean edge of a specimen's mesh, m
  double largest_size() const { return largest_size_; }  ///< of a specimen, m

 private:
  // An equilibrium starts from the last pose of the specimen, which is near the new pose. A method with
  // motion starts from the start of the scene.
  BuiltScene built(std::size_t r, const VectorXd& logarithms) const {
    const RunConfig& run = problem_.runs[r];
    Json settings = to_json(run.scene());
    for (std::size_t i = 0; i < problem_.pointers.size(); ++i)
      if (!set_at(settings, problem_.pointers[i], std::exp(logarithms(static_cast<Eigen::Index>(i)))))
        throw ConfigError("fit", {{problem_.pointers[i], "the config has no setting at this pointer"}});
    ConfigProblems problems;
    Scene scene = read_scene(settings, {}, problems);
    if (!problems.empty()) throw ConfigError("the fitted config", std::move(problems));
    scene.folder = run.folder();
    BuiltScene built = build_scene(scene);
    if (poses_[r].rows() == built.input.positions.rows() && built.input.method.kind().has_motion == false) {
      built.input.positions = poses_[r];
      built.input.starting_from = StartingFrom::same_mesh;
    } else {
      start_after(scene, built);
    }
    return built;
  }

  static constexpr double at_rest = 1e-3;  // sizes per second

  const FitProblem& problem_;
  std::vector<Positions> poses_;
  std::optional<std::size_t> moving_;
  double longest_edge_ = 0, largest_size_ = 0;
};

struct Objective {
  Specimens& specimens;
  nlopt_opt optimiser;
  int evaluations = 0;
  std::exception_ptr error;

  static double evaluate(unsigned n, const double* x, double*, void* data) {
    auto& self = *static_cast<Objective*>(data);
    try {
      double sum = 0;
      const auto gaps = self.specimens.gaps(Eigen::Map<const VectorXd>(x, static_cast<Eigen::Index>(n)));
      for (const Gap& gap : gaps) sum += gap.away.squaredNorm();
      ++self.evaluations;
      return sum / static_cast<double>(gaps.size());
    } catch (...) {
      self.error = std::current_exception();
      nlopt_force_stop(self.optimiser);
      return HUGE_VAL;
    }
  }
};

VectorXd start_of(const FitProblem& problem) {
  VectorXd start(static_cast<Eigen::Index>(problem.pointers.size()));
  const Json settings = to_json(problem.runs.front().scene());
  for (std::size_t i = 0; i < problem.pointers.size(); ++i) {
    if (!problem.pointers[i].starts_with('/'))
      throw ConfigError(
          "fit", {{problem.pointers[i], "a pointer begins with a slash: write /" + problem.pointers[i]}});
    const Json* const value = value_at(settings, problem.pointers[i]);
    if (value == nullptr || !value->is_number() || !(value->get<double>() > 0))
      throw ConfigError("fit",
                        {{problem.pointers[i],
                          "is not a number above 0 in the config: state a first guess there, or correct "
                          "the name of the setting"}});
    start(static_cast<Eigen::Index>(i)) = std::log(value->get<double>());
  }
  return start;
}

// What it would mean if the points of a specimen had another place.
struct Placement {
  VectorXd change_per_metre;   // of the logarithm of each setting, for the worst specimen and direction
  std::vector<Vector3> moves;  // m, of the points of each specimen, after which they fit best
  double rms = infinity;       // m, of the distances after these moves
};

// `slopes`: #points by #settings, the change of a point's distance with the logarithms of the settings.
// `sigma`: the uncertainty of a point, m. All numbers are those of the problem made linear at the minimum.
Placement placement_of(const FitProblem& problem, const std::vector<Gap>& gaps, const Eigen::MatrixXd& slopes,
                       double sigma) {
  // Directions that change the distances by less than this share of the largest change are ignored.
  constexpr double unknown = 0.03;
  const auto specimens = static_cast<Eigen::Index>(problem.shapes.size());
  Eigen::MatrixXd by_move = Eigen::MatrixXd::Zero(slopes.rows(), 3 * specimens);
  VectorXd distances(slopes.rows());
  Eigen::Index row = 0;
  for (Eigen::Index s = 0; s < specimens; ++s)
    for (Eigen::Index p = 0; p < problem.shapes[static_cast<std::size_t>(s)].points.rows(); ++p, ++row) {
      const Gap& gap = gaps[static_cast<std::size_t>(row)];
      const Vector3 direction = gap.direction(sigma);
      by_move.block<1, 3>(row, 3 * s) = direction.transpose();
      distances(row) = direction.dot(gap.away);
    }
  const auto decomposed = [&](const Eigen::MatrixXd& matrix) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> result;
    result.setThreshold(unknown);
    return result.compute(matrix);
  };
  Placement placement{.change_per_metre = VectorXd::Zero(slopes.cols()), .moves = {}};
  // Columns of settings get the size of columns of moves.
  VectorXd scale = slopes.colwise().norm().transpose() / std::sqrt(static_cast<double>(row));
  scale = (scale.array() > 0).select(scale, 1);
  const Eigen::MatrixXd scaled = slopes * scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd changes = scale.cwiseInverse().asDiagonal() * decomposed(scaled).solve(by_move);
  Eigen::MatrixXd both(slopes.rows(), slopes.cols() + by_move.cols());
  both << scaled, by_move;
  const auto solver = decomposed(both);
  const VectorXd best = solver.solve(-distances);
  for (Eigen::Index s = 0; s < specimens; ++s) {
    placement.change_per_metre =
        placement.change_per_metre.cwiseMax(changes.middleCols<3>(3 * s).rowwise().norm());
    placement.moves.emplace_back(best.segment<3>(slopes.cols() + 3 * s));
  }
  // So many unknowns fit few points by chance.
  if (row >= 3 * solver.rank())
    placement.rms = (distances + both * best).norm() / std::sqrt(static_cast<double>(row));
  return placement;
}

}  // namespace

bool Fitted::is_known() const {
  return std::ranges::all_of(settings, [](const FittedSetting& s) { return s.uncertainty <= known; });
}

std::optional<std::size_t> Fitted::misplaced() const {
  constexpr double falls_to = 0.5;
  if (moves.empty() || !(rms_if_moved < falls_to * rms)) return std::nullopt;
  const auto farthest = std::ranges::max_element(moves, {}, [](const Vector3& move) { return move.norm(); });
  if (!(farthest->norm() > rms)) return std::nullopt;
  return static_cast<std::size_t>(farthest - moves.begin());
}

Fitted fit(const FitProblem& problem) {
  Eigen::Index points = 0;
  for (const MeasuredShape& shape : problem.shapes) points += shape.points.rows();
  const auto count = static_cast<Eigen::Index>(problem.pointers.size());
  if (points <= count)
    throw std::invalid_argument(
        fmt::format("{} measured points cannot determine {} settings: measure more points", points, count));
  constexpr double farthest = 4.6;                      // a factor of 100 to both sides of the first guess
  constexpr double first_step = 0.2, precision = 1e-5;  // of a logarithm
  const VectorXd start = start_of(problem);
  VectorXd best = start;
  Specimens specimens(problem);
  nlopt_opt optimiser = nlopt_create(NLOPT_LN_BOBYQA, static_cast<unsigned>(count));
  Objective objective{specimens, optimiser, 0, nullptr};
  const VectorXd low = best.array() - farthest, high = best.array() + farthest;
  nlopt_set_min_objective(optimiser, Objective::evaluate, &objective);
  nlopt_set_lower_bounds(optimiser, low.data()), nlopt_set_upper_bounds(optimiser, high.data());
  nlopt_set_initial_step1(optimiser, first_step), nlopt_set_xtol_abs1(optimiser, precision);
  nlopt_set_maxeval(optimiser, problem.most_evaluations);
  double least = 0;
  const nlopt_result result = nlopt_optimize(optimiser, best.data(), &least);
  nlopt_destroy(optimiser);
  if (objective.error) std::rethrow_exception(objective.error);
  if (result < 0 && result != NLOPT_ROUNDOFF_LIMITED)
    throw std::runtime_error(fmt::format("the search failed: nlopt returned {}", static_cast<int>(result)));
  if (result == NLOPT_MAXEVAL_REACHED)
    throw std::invalid_argument(
        fmt::format("the search did not end within {} simulations of all specimens: state a nearer first "
                    "guess, or fit fewer settings",
                    problem.most_evaluations));
  for (Eigen::Index i = 0; i < count; ++i)
    if (std::abs(best(i) - start(i)) > farthest - 1e-3)
      throw std::invalid_argument(fmt::format(
          "the search ended at {:.2g}, which is {} the first guess of {}, and the cloth is still "
          "{:.2g} m from the points (root mean square): state a nearer first guess. Points are in "
          "m, in the coordinates of the mesh",
          std::exp(best(i)), best(i) > start(i) ? "100 times" : "a hundredth of",
          problem.pointers[static_cast<std::size_t>(i)], std::sqrt(least)));
  const std::vector<Gap> at_best = specimens.gaps(best);
  if (const auto moving = specimens.moving())
    throw std::invalid_argument(
        fmt::format("specimen {} still moves at the end of its run, but measured points are those of a cloth "
                    "at rest: set /solver/method to equilibrium, or raise /duration",
                    *moving + 1));

  const double of_mesh = FitProblem::of_an_edge * specimens.longest_edge(),
               most = problem.uncertainty
                          ? FitProblem::most_uncertainties * std::max(*problem.uncertainty, of_mesh)
                          : FitProblem::of_the_size * specimens.largest_size();
  if (std::sqrt(least) > most)
    throw std::invalid_argument(fmt::format(
        "the nearest cloth is {:.3g} m from the points (root mean square), but at most {:.2g} m are "
        "expected: this cloth does not have the shape of the points. Points are in m, in the "
        "coordinates of the mesh; the middle of a grid is the origin. If the points are right, "
        "state a larger --uncertainty",
        std::sqrt(least), most));

  const double rms = std::sqrt(least),
               scatter = rms * std::sqrt(static_cast<double>(points) / static_cast<double>(points - count)),
               sigma = std::max({problem.uncertainty.value_or(0), scatter, of_mesh});

  // Derivatives of the distances by the logarithms, by central differences.
  constexpr double step = 0.01;
  Eigen::MatrixXd slopes(points, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    VectorXd ahead = best, behind = best;
    ahead(i) += step, behind(i) -= step;
    const std::vector<Gap> far = specimens.gaps(ahead), near = specimens.gaps(behind);
    for (std::size_t p = 0; p < at_best.size(); ++p)
      slopes(static_cast<Eigen::Index>(p), i) =
          at_best[p].direction(sigma).dot(far[p].away - near[p].away) / (2 * step);
  }
  Fitted fitted{.settings = {}, .rms = rms, .evaluations = objective.evaluations};
  // A singular value that is no larger than the error of the simulations belongs to a combination of settings
  // that the points do not determine.
  // Its variance is far above that of a setting that is known, but not so far that rounding errors of the
  // combination reach other settings.
  constexpr double rounding = 1e-4, undetermined = 1e6;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(slopes, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double value = svd.singularValues()(k);
    const VectorXd along = svd.matrixV().col(k);
    const double variance = value > rounding * svd.singularValues()(0) && value > 0
                                ? sigma * sigma / (value * value)
                                : undetermined;
    covariance += variance * along * along.transpose();
  }
  const Placement placement = placement_of(problem, at_best, slopes, sigma);
  fitted.moves = placement.moves, fitted.rms_if_moved = placement.rms;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double variance = covariance(i, i);
    fitted.settings.push_back({problem.pointers[static_cast<std::size_t>(i)], std::exp(best(i)),
                               variance < 1e-3 * undetermined ? std::sqrt(variance) : infinity,
                               placement.change_per_metre(i)});
    for (Eigen::Index j = 0; j < i; ++j)
      if (const double c = covariance(i, j) / std::sqrt(covariance(i, i)) / std::sqrt(covariance(j, j));
          std::abs(c) > std::abs(fitted.correlation))
        fitted.correlation = c;
  }
  return fitted;
}

MeasuredShape read_shape(const std::filesystem::path& file, double middle) {
  std::vector<double> numbers;
  std::size_t columns = 0;
  const std::string text = read_input_file(file);
  for_measured_lines(text, [&](const std::vector<std::string_view>& words, int line) {
    if (numbers.empty() && !number_in(words[0])) return;  // titles of the columns
    if (columns == 0) columns = words.size();
    std::vector<double> row;
    for (const std::string_view word : words)
      if (const auto value = number_in(word)) row.push_back(*value);
    if (words.size() != columns || row.size() != columns || columns < 2 || columns > 3)
      throw std::invalid_argument(
          fmt::format("line {}: expected two numbers, x and z, or three, x, y and z, in every line", line));
    numbers.insert(numbers.end(), {row[0], columns == 3 ? row[1] : middle, row.back()});
  });
  if (numbers.empty()) throw std::invalid_argument("no points: expected lines of two or three numbers in m");
  return {as_rows(numbers)};
}

}  // namespace bendlab
