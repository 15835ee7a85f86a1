#include "hand.hpp"

#include <algorithm>

namespace bendlab {
namespace {

template <class Real>
std::vector<Pass<Real>> compile(const Hand& hand, const EffectInput& input) {
  std::vector<std::size_t> slots;
  for (const int vertex : hand.motion->vertices) slots.push_back(input.permuted(vertex));
  return {{"hand", Stage::predicted, [motion = hand.motion, slots](PassContext<Real>& context) {
             const double end = context.time + static_cast<double>(context.substep);
             const double share = std::clamp((end - motion->start) / motion->duration, 0.0, 1.0);
             for (std::size_t i = 0; i < slots.size(); ++i) {
               const auto row = static_cast<Eigen::Index>(i);
               const Vector3 now =
                   ((1 - share) * motion->from.row(row) + share * motion->to.row(row)).transpose();
               context.state.position[slots[i]].set((now - context.state.origin).template cast<Real>());
             }
             context.acted += slots.size();
           }}};
}

}  // namespace

const EffectKind Hand::kind{
    .name = "hand",
    .summary = "pinned vertices go where Python puts them",
    .settings = table_of<Hand>({}),
    .needs_projection = true,
    .acts_in_iterations = true,
    .needs_pins = true,
    .moves_pins = true,
    .compile_float = erased<compile<float>>,
    .compile_double = erased<compile<double>>,
    .drives = [](const void*) { return true; },
};

}  // namespace bendlab
