// Rigid-mode damping: pulls the velocity of every free vertex towards the velocity of the rigid motion that
// has the same linear and angular momentum. So only deformation is damped, and both momenta are preserved.
#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "bendlab/effects/effects.hpp"

namespace bendlab {
namespace rigid_damping_effect {

using Vector3d = Eigen::Vector3d;
using Matrix3d = Eigen::Matrix3d;

constexpr std::array fields = {
    field<&RigidDamping::rate>(
        {.name = "rate",
         .unit = "1/s",
         .meaning = "γ: the fraction 1 - exp(-γ h) of the deviation from rigid motion is removed per substep",
         .minimum = 0}),
};

// The rigid motion of the free vertices: their centre of mass, its velocity, and their angular velocity, from
// their angular momentum and inertia about the centre. The sums are computed in double in the order of the
// vertices, so they do not depend on the number of threads.
struct RigidMotion {
  Vector3d centre = Vector3d::Zero(), velocity = Vector3d::Zero(), spin = Vector3d::Zero();

  template <class Real>
  explicit RigidMotion(const State<Real>& state) {
    double mass = 0;
    for_free(state, [&](double m, const Vector3d& x, const Vector3d& v) {
      mass += m, centre += m * x, velocity += m * v;
    });
    if (!(mass > 0)) return;
    centre /= mass, velocity /= mass;
    Vector3d angular_momentum = Vector3d::Zero();
    Matrix3d inertia = Matrix3d::Zero();
    for_free(state, [&](double m, const Vector3d& x, const Vector3d& v) {
      const Vector3d r = x - centre;
      angular_momentum += m * r.cross(v);
      inertia += m * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
    });
    spin = solve_symmetric(inertia, angular_momentum);
  }

  Vector3d at(const Vector3d& x) const { return velocity + spin.cross(x - centre); }

 private:
  template <class Real, class Visit>
  static void for_free(const State<Real>& state, Visit visit) {
    for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v)
      if (state.position[v].w > 0)
        visit(state.mass[v], state.position[v].vector().template cast<double>(),
              state.velocity[v].vector().template cast<double>());
  }

  // Pseudo-inverse: vertices on a line have an axis without inertia, about which the spin is 0.
  static Vector3d solve_symmetric(const Matrix3d& inertia, const Vector3d& angular_momentum) {
    const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(inertia);
    constexpr double relative_rank = 1e-12;  // of the largest moment; the sums' rounding is smaller
    const double threshold = relative_rank * axes.eigenvalues().maxCoeff();
    Vector3d along = axes.eigenvectors().transpose() * angular_momentum;
    for (int i = 0; i < 3; ++i)
      along(i) = axes.eigenvalues()(i) > threshold ? along(i) / axes.eigenvalues()(i) : 0;
    return axes.eigenvectors() * along;
  }
};

template <class Real>
std::vector<Pass<Real>> compile(const RigidDamping& settings, const EffectInput&) {
  return {{"rigid_damping", Stage::damp, [rate = settings.rate](PassContext<Real>& context) {
             State<Real>& state = context.state;
             const RigidMotion rigid(state);
             const double removed = -std::expm1(-rate * static_cast<double>(context.substep));
             if (removed > 0) context.acted += static_cast<std::uint64_t>(state.vertex_count);
             for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v) {
               if (!(state.position[v].w > 0)) continue;
               const Vector3d velocity = state.velocity[v].vector().template cast<double>();
               const Vector3d target = rigid.at(state.position[v].vector().template cast<double>());
               state.velocity[v].set((velocity + removed * (target - velocity)).template cast<Real>());
             }
           }}};
}

bool idle(const RigidDamping& settings) {
  return settings.rate == 0;
}

}  // namespace rigid_damping_effect

constinit const EffectKind RigidDamping::kind{
    .name = "rigid_damping",
    .summary = "damps deformation; preserves linear and angular momentum of the free vertices",
    .source = "Müller et al. 2007, §3.5, with a rate instead of a factor per step",
    .settings = table_of<RigidDamping>(rigid_damping_effect::fields),
    .keeps_momentum = true,
    .keeps_angular_momentum = true,
    .damps = true,
    .compile_float = erased<rigid_damping_effect::compile<float>>,
    .compile_double = erased<rigid_damping_effect::compile<double>>,
    .idle = erased<rigid_damping_effect::idle>,
};
}  // namespace bendlab
