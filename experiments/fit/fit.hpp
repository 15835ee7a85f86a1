// Fits settings of a config, such as the rigidity of warp and weft, to measured shapes of cloth at rest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {

/// Points on a specimen at rest. A run simulates the specimen.
struct MeasuredShape {
  Positions points;  ///< #n by 3, m
};

struct FitProblem {
  std::vector<RunConfig> runs;        ///< one for each specimen
  std::vector<MeasuredShape> shapes;  ///< of the same specimens
  std::vector<std::string> pointers;  ///< the settings to find: numbers above 0
  /// Standard uncertainty of a measured point, m. The fit uses at least the scatter of the distances that
  /// remain, and `of_an_edge` times the mean edge: on 20 cells the droop of a strip has an error of up to
  /// 0.4 %.
  std::optional<double> uncertainty;
  static constexpr double of_an_edge = 0.05;
  /// The largest root mean square distance between points and cloth: in uncertainties if they are stated,
  /// otherwise as a share of the specimen's size. Points of a strip that are shifted by a tenth of its
  /// length leave 2.3 %.
  static constexpr double most_uncertainties = 5, of_the_size = 0.01;
  int most_evaluations = 200;
};

struct FittedSetting {
  std::string pointer;
  double value = 0;
  /// Standard uncertainty, relative to the value; infinite if no point depends on the setting.
  double uncertainty = 0;
  /// The relative change of the value if all points of a specimen move by 1 m, in the direction and for the
  /// specimen that change it most. Linear: valid for moves of a few millimetres.
  double change_per_metre = 0;
};

struct Fitted {
  std::vector<FittedSetting> settings;
  double rms = 0;          ///< of the distances between points and cloth, m
  int evaluations = 0;     ///< simulations of all specimens
  double correlation = 0;  ///< of two settings, with its sign: the largest in absolute value
  /// For each specimen, the move of all its points after which they fit best, m, and the root mean square
  /// distance after these moves; infinite if there are too few points.
  std::vector<Vector3> moves;
  double rms_if_moved = 0;
  /// The specimen whose points have to move farthest, if moves halve the distances; otherwise none. Such
  /// points probably have another origin than the mesh.
  std::optional<std::size_t> misplaced() const;
  /// The points do not determine a setting if its relative standard uncertainty is above this.
  static constexpr double known = 0.3;
  bool is_known() const;
};

/// Minimises the sum of squared distances from the points to the cloth (nlopt: BOBYQA, Powell 2009, over the
/// logarithms of the settings). Standard uncertainties follow from the derivatives of the distances at the
/// minimum. Throws ConfigError for a setting that is not a number above 0, std::invalid_argument if there are
/// not more points than settings, if a specimen does not come to rest, if the nearest cloth is far from the
/// points, or if the search does not end or ends at a factor of 100 from the first guess, and
/// std::runtime_error if nlopt fails.
Fitted fit(const FitProblem& problem);

/// Reads points from a text file: two columns x and z, or three columns x, y and z, in m. In a file with two
/// columns y is `middle`. Lines before the first number are titles. Throws std::invalid_argument.
MeasuredShape read_shape(const std::filesystem::path& file, double middle);

}  // namespace bendlab
