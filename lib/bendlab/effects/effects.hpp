// Every effect as a struct: its settings with their defaults. The file <name>.cpp says what the settings mean
// and what the effect does. A new effect is a struct and its name in the list below, one file and one test.
#pragma once

#include <string>
#include <vector>

#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/settings/schedule.hpp"

namespace bendlab {

struct Gravity {
  Vector3 acceleration{0, 0, -9.81};  ///< m/s²
  static const EffectKind kind;
};

struct RigidDamping {
  double rate = 1;  ///< 1/s
  static const EffectKind kind;
};

struct ConstraintDamping {
  double rate = 1;  ///< 1/s
  static const EffectKind kind;
};

struct Tethers {
  enum class Distance { geodesic, straight };

  int per_vertex = 4;
  double slack = 0;  ///< fraction of the cloth's length
  Distance distance = Distance::geodesic;
  static const EffectKind kind;
};

struct ViscousDrag {
  /// N s/m³. With this default a flat sheet of 0.2 kg/m² falls at 2 m/s at most. With the quadratic drag of
  /// air, ½ · 1.2 kg/m³ · 1.28 v², the sheet would fall at 1.6 m/s at most.
  double coefficient = 1;
  static const EffectKind kind;
};

struct Wind {
  Vector3 velocity{0, 5, 0};   ///< m/s
  double air_density = 1.204;  ///< kg/m³
  double drag_coefficient = 1.28;
  double lift_coefficient = 1;
  double gust_amplitude = 0;  ///< fraction of the mean speed
  double gust_time = 0.5;     ///< s
  bool gusts_travel = false;
  std::uint32_t seed = 1;  ///< seed of the gusts
  static const EffectKind kind;
};

struct MovingPins {
  enum class Interpolation { linear, smooth };

  std::vector<Place> vertices;  ///< all pins move if vertices and indices are empty
  std::vector<int> indices;
  std::vector<double> times{0};  ///< s, times of the keyframes
  std::vector<double> offsets;   ///< m, three per keyframe
  std::vector<double> angles;    ///< degrees, one per keyframe
  Vector3 axis{0, 0, 1};
  Vector3 centre{0, 0, 0};  ///< m
  Interpolation interpolation = Interpolation::linear;
  static const EffectKind kind;
};

struct StrainLimiting {
  double min = 0.9, max = 1.1;  ///< principal stretches
  static const EffectKind kind;
};

/// Settings of every obstacle.
struct Body {
  double thickness = 0.005;   ///< m, distance that the cloth keeps from the surface
  Vector3 velocity{0, 0, 0};  ///< m/s
};

/// An obstacle that may turn about its axis.
struct SpinningBody : Body {
  double spin = 0;  ///< rad/s
};

struct Plane : SpinningBody {
  Vector3 point{0, 0, 0};   ///< m
  Vector3 normal{0, 0, 1};  ///< points to the cloth's side
  static const EffectKind kind;
};

struct Sphere : SpinningBody {
  Vector3 centre{0, 0, 0};  ///< m
  double radius = 0.25;     ///< m
  Vector3 axis{0, 0, 1};    ///< axis of the spin
  static const EffectKind kind;
};

struct Capsule : SpinningBody {
  Vector3 a{-0.25, 0, 0}, b{0.25, 0, 0};  ///< m, ends of the segment, which is the axis of the spin
  double radius = 0.1;                    ///< m
  static const EffectKind kind;
};

struct Disc : SpinningBody {
  Vector3 centre{0, 0, 0};  ///< m
  Vector3 axis{0, 0, 1};
  double radius = 0.5;   ///< m
  double height = 0.04;  ///< m
  static const EffectKind kind;
};

struct MeshObstacle : Body {
  std::string file;  ///< relative to the scene's folder
  double scale = 1;
  Vector3 offset{0, 0, 0};  ///< m
  static const EffectKind kind;
};

struct Friction {
  double at_rest = 0.5;  ///< static coefficient
  double kinetic = 0.4;
  static const EffectKind kind;
};

struct SelfCollision {
  double thickness = 0.005;  ///< m
  static const EffectKind kind;
};

/// Settings of every load: it grows linearly to its full size, or follows keyframes.
struct GrowingLoad : Schedule {
  double ramp = 0;  ///< s, until the load has its full size
};

struct Load : GrowingLoad {
  enum class Spread { equal, length, area };

  std::vector<Place> vertices;  ///< all vertices if vertices and indices are empty
  std::vector<int> indices;
  Vector3 force{0, 0, 0};  ///< N, of all vertices together
  Spread spread = Spread::equal;
  bool follows = false;
  static const EffectKind kind;
};

struct Pressure : GrowingLoad {
  double pressure = 0;  ///< Pa, along the normals
  static const EffectKind kind;
};

struct EdgeMoment : GrowingLoad {
  std::vector<Place> vertices;
  std::vector<int> indices;
  double moment = 0;  ///< N m, of the whole edge
  static const EffectKind kind;
};

/// All effects, in the order in which the program lists them.
inline constexpr auto listed_effects =
    listed_kinds<EffectKind, Gravity, RigidDamping, ConstraintDamping, Tethers, ViscousDrag, Wind, MovingPins,
                 StrainLimiting, Plane, Sphere, Capsule, Disc, MeshObstacle, Friction, SelfCollision, Load,
                 Pressure, EdgeMoment>;

}  // namespace bendlab
