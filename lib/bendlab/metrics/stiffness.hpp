// Measures the stiffness of a cantilever strip from its shape. The strip is flat at rest, clamped
// horizontally along one side, and hangs under its own weight.
//
//     pinned   s = 0                         s = L        s along the strip at rest, θ downward
//   |////////|-----------------------------------|
//            ^ clamp's edge                  free end
//
// The stiffness is measured in two ways, which can be compared:
//
// * From the free end alone, H below the clamp and W in front of the clamp: H/W gives B if m = B κ, or C if
//   m = C κ³ (elastica.hpp).
// * From the whole shape: the weight gives the moment m(s) at every s, whatever the bending law is. Comparing
//   m with the curvature κ(s) shows the bending law.
//
// A slice is a cut s = const through the triangles. The centres of all slices form the strip's middle line.
// There is about one slice per edge, on the rows of vertices if the mesh has rows. All slices cover the same
// range of the coordinate y across the strip, because every second row of a lattice is an edge wider, and
// because a sheet bent along its length also bends a little across, most at the sides.
#pragma once

#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct StripLoad {
  double density = 0;                 ///< kg/m²
  Vector3 gravity = Vector3::Zero();  ///< m/s²
};

struct StripOptions {
  /// How far behind the clamp's edge the strip begins to bend, m: a bending constraint across that edge bends
  /// the strip on both sides. h/2 for hinges, if the rows are h apart; t h/4 for springs over t rows.
  double clamp_offset = 0;
  /// Reach of a constraint, m. The fit of m(κ) ignores slices nearer than this to the clamp or to the free
  /// end.
  double exclude = 0;
  /// Rounding error of a coordinate, m. The fit of m(κ) ignores curvatures that this error could cause.
  double rounding = 0;
};

/// A slice of the strip that has come to rest under its weight.
struct ProfileRow {
  double s = 0;          ///< m from the clamp's edge, at rest
  double angle = 0;      ///< θ, rad below horizontal
  double curvature = 0;  ///< κ = dθ/ds, 1/m
  double moment = 0;     ///< ρ g ∫ (x(σ) - x(s)) dA / width over the part beyond s, N
  bool fitted = false;   ///< whether the fit uses κ and m
};

/// The fit ln m = ln c + p ln κ by least squares; NaN if there are fewer than three samples. A sample is a
/// mean of three neighbouring slices with weights 1/4, 1/2, 1/4, because every second row of a lattice is
/// stiffer.
struct MomentCurvatureFit {
  double exponent = std::numeric_limits<double>::quiet_NaN();     ///< p: 1 linear, 3 springs
  double coefficient = std::numeric_limits<double>::quiet_NaN();  ///< c, N m^p
  double residual = std::numeric_limits<double>::quiet_NaN();     ///< root mean square, of ln m
  double rigidity = std::numeric_limits<double>::quiet_NaN();     ///< B, N m: geometric mean of m / κ
  double quartic = std::numeric_limits<double>::quiet_NaN();      ///< C, N m³: geometric mean of m / κ³
  int samples = 0;                                                ///< in the fit
};

/// Metrics from H/W are NaN if H/W is outside 10⁻⁶ to 500: the strip has hardly dropped, or hangs straight
/// down.
struct StripStiffness {
  double length = 0;             ///< L, m, of the free part at rest
  double width = 0;              ///< m, mean of the free part
  double effective_length = 0;   ///< L + clamp_offset, m
  double drop = 0;               ///< H of the free end, m
  double reach = 0;              ///< W of the free end, clamp_offset included, m
  double height_over_width = 0;  ///< H / W
  double stretch = 0;            ///< of the middle line: its length over L, minus 1

  double gamma = 0;                  ///< Γ = ρ g L³ / B
  double amplification = 0;          ///< d ln Γ / d ln(H/W)
  double flexural_rigidity = 0;      ///< B, N m, if m = B κ
  double bending_length = 0;         ///< (B / ρ g)^(1/3), m (ASTM D1388)
  double quartic_gamma = 0;          ///< Γ_c = ρ g L⁵ / C
  double quartic_amplification = 0;  ///< d ln Γ_c / d ln(H/W)
  double quartic = 0;                ///< C, N m³, if m = C κ³

  MomentCurvatureFit fit;
  std::vector<ProfileRow> profile;  ///< all slices except the first and the last
};

class StiffnessMeter {
 public:
  /// `is_pinned` is #V. At rest the strip has to be flat and horizontal, with one whole side pinned and
  /// nothing else. Otherwise throws std::invalid_argument with the reason.
  StiffnessMeter(const RestMesh& rest, std::span<const char> is_pinned, const StripLoad& load);

  /// s of each vertex at rest: #V, m from the clamp's edge, negative in the clamp.
  std::span<const double> along() const { return s_; }
  double length() const { return length_; }            ///< m, of the free part at rest
  double clamp_depth() const { return clamp_depth_; }  ///< m, width of the zigzag of the clamp's edge

  /// `positions` is #V by 3, m. Throws std::invalid_argument if a position is not finite or the clamp has
  /// moved.
  StripStiffness measure(const Positions& positions, const StripOptions& options = {}) const;

  /// Measures only H/W, also while the strip moves. Throws like measure().
  double height_over_width(const Positions& positions, double clamp_offset) const;

 private:
  struct Slice {
    double s = 0;                                 // m from the clamp's edge
    double width = 0;                             // m, of the part in the common band
    double low = 0, high = 0;                     // m, range of y across the strip
    std::vector<std::pair<int, double>> weights;  // vertex, weight; the mean is the slice's middle
    Vector3 middle(const Positions& positions) const;
  };

  void find_clamp(const RestMesh& rest, std::span<const char> is_pinned);
  void find_slices(const RestMesh& rest);
  Slice slice(double s, double low, double high) const;
  std::vector<Vector3> middle_line(const Positions& positions) const;
  double moment(const Positions& positions, double s, double reach) const;
  std::vector<ProfileRow> profile(const Positions& positions, const std::vector<Vector3>& line,
                                  const StripOptions& options) const;

  Positions rest_positions_;
  Triangles triangles_;
  std::vector<double> areas_;  // #T, m²
  std::vector<int> pinned_;
  double size_ = 0;
  StripLoad load_;
  Vector3 down_, along_, across_;
  std::vector<double> s_;  // #V, m from the clamp's edge
  double length_ = 0, width_ = 0, clamp_depth_ = 0;
  std::vector<Slice> slices_;
};

}  // namespace bendlab
