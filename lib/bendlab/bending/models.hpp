// Every bending model as a struct of its settings with their defaults. The file models/<name>.cpp of a model
// says what the settings mean and builds the constraints. A new model needs a struct, its name in the list
// below, one file, one test and one config.
#pragma once

#include "bendlab/bending/levels.hpp"
#include "bendlab/bending/model.hpp"
#include "bendlab/bending/ring_springs.hpp"
#include "bendlab/bending/thinned_rings.hpp"

namespace bendlab {

struct None {
  static const BendingKind kind;
};

struct Crossover {
  enum class Pairs { opposite, straight };

  Pairs pairs = Pairs::opposite;
  static const BendingKind kind;
};

struct KRing : RingSettings {
  int k = 2;
  RingFill rings = RingFill::all;
  static const BendingKind kind;
};

struct Adaptive : LevelSettings, RingSettings {
  RingFill rings = RingFill::all;
  static const BendingKind kind;
};

struct Lod : LevelSettings, RingSettings {
  int t = 0;  ///< 0: m for free and n for pinned vertices
  bool ring_1 = false;
  static const BendingKind kind;
};

struct SparseLod : ThinnedRingSettings {
  static const BendingKind kind;
};

struct Prestressed : ThinnedRingSettings {
  double excess = 0.02;  ///< relative to the distance that a spring spans
  static const BendingKind kind;
};

struct Dihedral {
  enum class Weight { uniform, area };

  Weight weight = Weight::uniform;
  static const BendingKind kind;
};

struct Bridson {
  static const BendingKind kind;
};

struct DiscreteShells {
  enum class Measure { theta, tangent };

  Measure measure = Measure::theta;
  static const BendingKind kind;
};

struct ChoiKo {
  int ring = 2;
  ArcSpring::Law force = ArcSpring::Law::exact;
  static const BendingKind kind;
};

struct Isometric {
  QuadraticBend::Law constraint = QuadraticBend::Law::norm;
  static const BendingKind kind;
};

struct MidEdge {
  Turn measure = Turn::tangent;
  static const BendingKind kind;
};

struct MidEdgeAverage {
  static const BendingKind kind;
};

struct CorotationalFace {
  static const BendingKind kind;
};

struct CorotationalEdge {
  static const BendingKind kind;
};

struct Laplacian {
  static const BendingKind kind;
};

struct Dkt {
  static const BendingKind kind;
};

/// All models, in the order in which the program lists them.
inline constexpr auto listed_bending_models =
    listed_kinds<BendingKind, None, Crossover, KRing, Adaptive, Lod, SparseLod, Prestressed, Dihedral,
                 Bridson, DiscreteShells, ChoiKo, Isometric, MidEdge, MidEdgeAverage, CorotationalFace,
                 CorotationalEdge, Laplacian, Dkt>;

}  // namespace bendlab
