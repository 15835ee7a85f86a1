// Every bending model as a value: its settings, with their defaults. Each one's file, models/<name>.cpp, says
// what its settings mean, and what constraints it makes. A new model is a struct and its name in the list
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
  double excess = 0.02;  ///< of the distance that a spring spans
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

/// In the order in which they are listed.
inline constexpr auto listed_bending_models =
    listed_kinds<BendingKind, None, Crossover, KRing, Adaptive, Lod, SparseLod, Prestressed, Dihedral,
                 Bridson, DiscreteShells, ChoiKo, Isometric>;

}  // namespace bendlab
