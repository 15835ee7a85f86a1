// The numbers by which other engines state bending, converted to a flexural rigidity B (N m) and back.
//
// A dialect is a formula of an engine for the stiffness k of a hinge. A hinge is an interior edge with the
// energy ½ k θ², where θ is the change of its fold angle. B is the rigidity of a smooth plate that has the
// same energy as the mesh if both are bent to a cylinder of curvature κ, averaged over all directions of
// bending:
//
//   B = Σ k <θ²> / (κ² area)
//
// To add a dialect, write one file here and add its name in dialects.cpp.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "experiments/dialects/hinges.hpp"

namespace bendlab {

/// A number of an engine.
struct DialectSetting {
  std::string_view name;  ///< the option of `bendlab dialect`, without --
  std::string_view unit = "", meaning = "";
  std::optional<double> standard = std::nullopt;  ///< the engine's default, if it fits any cloth
  double above = 0;                               ///< larger than this, or equal if `may_equal`
  bool may_equal = false;
  double most = std::numeric_limits<double>::infinity();
  bool whole = false;  ///< a whole number
};

/// Numbers by the names of their settings.
using DialectNumbers = std::map<std::string, double, std::less<>>;

struct Dialect {
  std::string_view name;
  std::string_view engine;                         ///< with the solver or kind of bending that is meant
  DialectSetting setting;                          ///< the number that states bending
  std::span<const DialectSetting> arguments = {};  ///< further numbers on which B depends
  std::string_view rule;          ///< B on a large mesh of equilateral triangles of edge a, h = a √3/2
  int cell_power = 0;             ///< B is proportional to (cell size)^cell_power
  std::string_view depends = "";  ///< what else B depends on: mesh, time step, iterations, …
  std::string_view limits;
  std::string_view source;  ///< repository, commit and file, or paper

  /// k of a hinge in N m if factor() is 1, or c of the energy ¼ c θ⁴ for a `cubic` dialect.
  double (*stiffness)(const MeshHinge& hinge, const DialectNumbers& arguments);
  /// B is proportional to this function of the setting. value() is its inverse, NaN if there is none.
  double (*factor)(double value, const DialectNumbers& arguments) = [](double number, const DialectNumbers&) {
    return number;
  };
  double (*value)(double factor, const DialectNumbers& arguments) = [](double number, const DialectNumbers&) {
    return number;
  };
  /// The moment is C κ³. Then B = C κ², at the argument "curvature" alone.
  bool cubic = false;
};

/// All dialects, in the order of dialects.cpp.
std::span<const Dialect* const> dialects();

/// The dialect of that name, or nullptr.
const Dialect* find_dialect(std::string_view name);

/// The arguments, with the engine's defaults for arguments that are not given. Throws std::invalid_argument
/// if an argument is missing, unknown or outside its bounds.
DialectNumbers complete_arguments(const Dialect& dialect, DialectNumbers given);

/// B in N m on a mesh, for a value of the dialect's setting. Throws std::invalid_argument like
/// complete_arguments(), for a value outside its bounds, and for a mesh without hinges.
DirectionalMean rigidity_of(const Dialect& dialect, const RestMesh& rest, double value,
                            const DialectNumbers& arguments = {});

/// The value of the setting with the mean rigidity B on a mesh. Throws like rigidity_of(), and
/// std::invalid_argument if no allowed value has this B.
double value_of(const Dialect& dialect, const RestMesh& rest, double rigidity,
                const DialectNumbers& arguments = {});

}  // namespace bendlab
