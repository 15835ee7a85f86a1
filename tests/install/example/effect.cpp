#include <numbers>

#include "mine.hpp"

using namespace bendlab;

constexpr std::array fields = {field<&Trap::frequency>(
    {.name = "frequency", .unit = "1/s", .meaning = "f: x'' = -(2 π f)² x", .minimum = 0})};

template <class Real>
std::vector<Pass<Real>> compile(const Trap& settings, const EffectInput&) {
  const double root = 2 * std::numbers::pi * settings.frequency;
  return {{"trap", Stage::force, [rate = static_cast<Real>(root * root)](PassContext<Real>& context) {
             State<Real>& state = context.state;
             const Vector3Of<Real> origin = state.origin.template cast<Real>();
             for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v)
               if (state.position[v].w > 0)  // else it is pinned
                 state.accelerate(v, -context.substep * rate * (state.position[v].vector() + origin));
             context.acted += static_cast<std::uint64_t>(state.vertex_count);
           }}};
}

const EffectKind Trap::kind{
    .name = "trap",
    .summary = "pulls every vertex towards the origin, in proportion to its distance",
    .settings = table_of<Trap>(fields),
    .compile_float = erased<compile<float>>,
    .compile_double = erased<compile<double>>,
    .idle = [](const void* trap) { return static_cast<const Trap*>(trap)->frequency == 0; },
    .drives = [](const void*) { return true; }};
