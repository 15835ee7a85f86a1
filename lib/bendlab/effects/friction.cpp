// Friction: Coulomb's law where obstacles push the cloth.
//
// Friction is computed per vertex and substep, from displacements. D is the sum of all pushes by obstacles so
// far, and F is the sum of all friction so far. If |F| remains at most μ_s D, friction cancels the remaining
// sliding; otherwise |F| becomes μ_k D. D and F are sums over the iterations of the substep. The first
// iteration pushes most, but strain and bending may move a vertex in later iterations, and friction must act
// on such a vertex, too (like the accumulated impulses of Catto 2005, §4.3). Implicit methods use a force
// (contact_forces.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bendlab/effects/effects.hpp"

namespace bendlab {
namespace friction_effect {

constexpr std::array fields = {
    field<&Friction::at_rest>({.name = "static",
                               .unit = "1",
                               .meaning = "μ_s: cloth does not slide while friction is at most μ_s times the "
                                          "push",
                               .minimum = 0}),
    field<&Friction::kinetic>({.name = "kinetic",
                               .unit = "1",
                               .meaning = "μ_k: friction on sliding cloth is μ_k times the push, or less if "
                                          "a smaller friction stops the sliding",
                               .minimum = 0}),
};

// What obstacles and friction did to a vertex in this substep.
template <class Real>
struct Grip {
  using Vector = Vector3Of<Real>;

  std::size_t vertex;
  Real pressed = 0;                 // D, m: Σ depth
  Vector pushed = Vector::Zero();   // Σ depth · normal
  Vector carried = Vector::Zero();  // Σ depth · carried
  Vector held = Vector::Zero();     // F, m
  Vector normal = Vector::Zero();   // of the last push: friction must not move a vertex into the obstacle
};

template <class Real>
class Gripping {
 public:
  Gripping(int vertex_count, double at_rest, double sliding)
      : static_(static_cast<Real>(at_rest)),
        kinetic_(static_cast<Real>(sliding)),
        grip_of_(static_cast<std::size_t>(vertex_count), none) {}

  void operator()(PassContext<Real>& context) {
    if (context.time != time_) start(context.time);
    for (const Contact<Real>& contact : context.state.contacts) add(contact);
    context.state.contacts.clear();
    for (Grip<Real>& grip : grips_) context.acted += hold(context.state, grip);
  }

 private:
  using Vector = Vector3Of<Real>;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  void start(double time) {
    for (const Grip<Real>& grip : grips_) grip_of_[grip.vertex] = none;
    grips_.clear();
    time_ = time;
  }

  void add(const Contact<Real>& contact) {
    std::uint32_t& at = grip_of_[contact.vertex];
    if (at == none) {
      at = static_cast<std::uint32_t>(grips_.size());
      grips_.push_back({contact.vertex});
    }
    Grip<Real>& grip = grips_[at];
    grip.normal = contact.normal;
    grip.pressed += contact.depth;
    grip.pushed += contact.depth * contact.normal;
    grip.carried += contact.depth * contact.carried;
  }

  bool hold(State<Real>& state, Grip<Real>& grip) const {
    const Real across = grip.pushed.norm();
    if (!(across > 0)) return false;  // pushed equally from both sides: there is no tangent
    const Vector normal = grip.pushed / across;
    const auto tangential = [&](const Vector& v) -> Vector { return v - normal.dot(v) * normal; };
    Point<Real>& p = state.position[grip.vertex];
    const Vector slip =
        tangential(p.vector() - state.previous[grip.vertex].vector() - grip.carried / grip.pressed);
    const Vector before = tangential(grip.held);
    grip.held = before - slip;
    if (const Real wanted = grip.held.norm(); wanted > static_ * grip.pressed)
      grip.held *= std::min(Real(1), kinetic_ * grip.pressed / wanted);
    Vector change = grip.held - before;
    if (const Real into = change.dot(grip.normal); into < 0) change -= into * grip.normal;
    grip.held = before + change;
    p.set(p.vector() + change);
    return !change.isZero(0);
  }

  Real static_, kinetic_;
  double time_ = -1;  // s, time of the substep that grips_ belongs to
  std::vector<std::uint32_t> grip_of_;
  std::vector<Grip<Real>> grips_;
};

template <class Real>
std::vector<Pass<Real>> compile(const Friction& settings, const EffectInput& input) {
  const FrictionCoefficients coefficients = {settings.at_rest, settings.kinetic};
  return {{.name = "friction",
           .stage = Stage::contact,
           .run = Gripping<Real>(input.rest.vertex_count(), coefficients.at_rest, coefficients.sliding),
           .friction = coefficients}};
}

bool idle(const Friction& settings) {
  return settings.at_rest == 0 && settings.kinetic == 0;
}

std::optional<Doubt> doubt(const Friction& settings, const DoubtInput& input) {
  if (settings.kinetic <= settings.at_rest) return std::nullopt;
  return Doubt{
      fmt::format("{}: kinetic ({:.3g}) is above static ({:.3g}), so that sliding cloth has more friction "
                  "than cloth at rest. Set static to at least {:.3g}",
                  input.where, settings.kinetic, settings.at_rest, settings.kinetic)};
}

}  // namespace friction_effect

constinit const EffectKind Friction::kind{
    .name = "friction",
    .summary = "Coulomb friction, static and kinetic, where obstacles push the cloth",
    .source = "Macklin et al. 2014, §6.1, with sums over the iterations as in Catto 2005, §4.3",
    .settings = table_of<Friction>(friction_effect::fields),
    .needs_projection = true,
    .acts_in_iterations = true,
    .uses_contacts = true,
    .compile_float = erased<friction_effect::compile<float>>,
    .compile_double = erased<friction_effect::compile<double>>,
    .idle = erased<friction_effect::idle>,
    .doubt = erased<friction_effect::doubt>,
};
}  // namespace bendlab
