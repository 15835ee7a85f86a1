// A bending model, an effect, a solver method and a measure that are added to the program, each in its own
// file.
#pragma once

#include "bendlab/bendlab.hpp"
#include "experiments/measures/measure.hpp"

struct EdgeHinge {
  double power = 1;
  static const bendlab::BendingKind kind;
};

struct Trap {
  double frequency = 1;  // 1/s
  static const bendlab::EffectKind kind;
};

struct SymplecticEuler {
  static const bendlab::MethodKind kind;
};

extern const bendlab::Measure height;
