// Elements: constraints that are one scalar function C of a fixed number of vertices. The bending models of
// the literature consist of elements. Each kind of element states its numbers of vertices and rest values;
// list, batch, projection, damping and energy have the same code for all kinds.
//
// A new kind needs a line in kinds.hpp and two files. A header has the struct below, with value and gradient
// of one constraint (the oracle). A source has value and gradient for a pack of lanes (element_kernel.hpp).
//
//   struct Kind {
//     static constexpr std::string_view name;  // in run files
//     static constexpr std::size_t arity, rest_values;
//     enum class Law { … };                     // variants of C
//     static constexpr std::array law_names;    // in the order of the enum
//     template <class Real>
//     static ConstraintValue<Real, arity> value(points, rest, law);
//     template <class Real>
//     static Real rest_size(rest);   // m, at most the constraint's size at rest (see largest_move)
//   };
//
// A kind may also define:
//
//     static constexpr std::size_t directors;   // its last corners are directors (directors.hpp)
//     static constexpr double padding;          // the rest values of lanes without a constraint; 1 if absent
//     static constexpr std::size_t components;  // ½ C² is Σ ½ C_k² with smooth functions C_k, if
//     static bool is_sum_of_squares(rest, law); // … this is true (absent: always)
//     template <class Real>                     // C_k and ∇C_k
//     static ConstraintValue<Real, arity> component(points, rest, law, k);
//     static constexpr bool linear_components;  // whether every ∇C_k is constant; if not:
//     template <class Real>                     // Σ C_k times weight k
//     static ConstraintValue<Real, arity> weighted_components(points, rest, law, weights);
//
// The usual energy of a kind is ½ C² / α. A OneSided kind has another energy, which is 0 for C ≥ 0; k and
// damping act only if C < 0. A OneSided kind defines functions that follow from ½ C² / α for other kinds:
//
//     static constexpr bool one_sided = true;
//     static double energy(C, rest, law);                        // times the compliance
//     static Potential potential(C, rest, law);                  // energy and derivatives by C, for C ≤ 0
//     static double change(C, rest, law, w, alpha, multiplier);  // Δλ of a projection, w = Σ w|∇C|²
//
// A kind whose elements can yield (moment_law.hpp) has C of both signs, or components, and defines:
//
//     template <class Real>   // rest values with which C is `share` times the present C
//     static std::array<Real, rest_values> moved_rest(points, rest, law, share);
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/moment_law.hpp"

namespace bendlab {

template <class Kind>
concept OneSided = requires {
  requires Kind::one_sided;
};

/// Number of directors among the corners of a kind.
template <class Kind>
inline constexpr std::size_t directors_of = [] {
  if constexpr (requires { Kind::directors; })
    return std::size_t{Kind::directors};
  else
    return std::size_t{0};
}();

/// A kind whose energy is a sum of squares of functions that are smooth where C is 0.
template <class Kind>
concept HasComponents = requires {
  Kind::components;
};
template <class Kind>
bool is_sum_of_squares(const std::array<double, Kind::rest_values>& rest, typename Kind::Law law) {
  if constexpr (requires { Kind::is_sum_of_squares(rest, law); })
    return Kind::is_sum_of_squares(rest, law);
  else
    return HasComponents<Kind>;
}

/// A kind whose rest values can follow its value, as yielding needs.
template <class Kind>
concept Yields = requires(std::array<Vector3Of<double>, Kind::arity> p,
                          std::array<double, Kind::rest_values> rest, typename Kind::Law law) {
  Kind::template moved_rest<double>(p, rest, law, 0.5);
};

template <class Kind>
struct ElementList {
  std::vector<std::array<int, Kind::arity>> vertices;       ///< #C
  std::vector<std::array<double, Kind::rest_values>> rest;  ///< #C, as the kind defines them
  std::vector<double> softness;  ///< #C, XPBD: α is the softness times the scene's compliance
  typename Kind::Law law{};      ///< of all elements in the list
  MomentLaws moment;             ///< empty: the energy of every element is ½ C² / α

  std::size_t size() const { return vertices.size(); }
};

template <class Real, class Kind>
struct ElementBatch {
  BatchOrder order;
  std::array<LargeArray<int>, Kind::arity> corner;       ///< offset_of() each vertex, by lane
  std::array<LargeArray<Real>, Kind::rest_values> rest;  ///< by lane
  LargeArray<Real> softness;                             ///< by lane
  LargeArray<Real> multiplier;                           ///< λ; empty without XPBD
  typename Kind::Law law{};
  StiffnessKind kind = StiffnessKind::k;
  Real k = 1;           ///< fraction per projection
  Real compliance = 0;  ///< α is this times the softness
  std::size_t count = 0;
  /// Collapsed elements open towards this rest shape; null: collapsed elements do not open.
  const Point<Real>* rest_points = nullptr;
  SofteningLaw softening;
  LargeArray<Real> length, yield, hardening;  ///< by lane, as in MomentLaws; empty: every moment is linear

  bool is_linear() const { return length.empty(); }
};

/// A batch from a list, in the given order. `vertex_count` is the index of the first dummy point.
template <class Real, class Kind>
ElementBatch<Real, Kind> make_element_batch(const ElementList<Kind>& list, BatchOrder order,
                                            int vertex_count);

}  // namespace bendlab
