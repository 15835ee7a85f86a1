// The list of all dialects, and how a dialect is converted.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace dialect {
extern const Dialect newton, newton_semi_implicit, newton_xpbd, jolt, libuipc, mujoco, ppf, blender, mueller,
    pbd_dihedral, pbd_isometric, xpbd_isometric;
}

namespace {

constexpr std::array all = {&dialect::newton,        &dialect::newton_semi_implicit,
                            &dialect::newton_xpbd,   &dialect::jolt,
                            &dialect::libuipc,       &dialect::mujoco,
                            &dialect::ppf,           &dialect::blender,
                            &dialect::mueller,       &dialect::pbd_dihedral,
                            &dialect::pbd_isometric, &dialect::xpbd_isometric};

bool is_allowed(const DialectSetting& setting, double value) {
  return std::isfinite(value) && value <= setting.most && !(setting.whole && value != std::floor(value)) &&
         (value > setting.above || (setting.may_equal && value == setting.above));
}

void check(const DialectSetting& setting, double value) {
  if (is_allowed(setting, value)) return;
  throw std::invalid_argument(fmt::format(
      "--{} {:.6g}: has to be {}{} {:g}{}", setting.name, value, setting.whole ? "a whole number, " : "",
      setting.may_equal ? "at least" : "above", setting.above,
      std::isfinite(setting.most) ? fmt::format(" and at most {:g}", setting.most) : " and finite"));
}

// B for factor() = 1.
DirectionalMean unit_rigidity(const Dialect& dialect, const RestMesh& rest, const DialectNumbers& arguments) {
  const auto stiffness = [&](const MeshHinge& hinge) { return dialect.stiffness(hinge, arguments); };
  if (!dialect.cubic) return directional_mean(rest, stiffness);
  DirectionalMean unit = directional_mean(rest, stiffness, 4);
  const double square = std::pow(arguments.at("curvature"), 2);
  unit.mean *= square;
  if (unit.range) unit.range = {unit.range->first * square, unit.range->second * square};
  return unit;
}

std::string options_of(const Dialect& dialect) {
  std::string text;
  for (const DialectSetting& argument : dialect.arguments)
    text += fmt::format("{}--{}", text.empty() ? "" : ", ", argument.name);
  return text;
}

}  // namespace

std::span<const Dialect* const> dialects() {
  return all;
}

const Dialect* find_dialect(std::string_view name) {
  const auto found = std::ranges::find(all, name, &Dialect::name);
  return found == all.end() ? nullptr : *found;
}

DialectNumbers complete_arguments(const Dialect& dialect, DialectNumbers given) {
  for (const auto& [name, value] : given)
    if (std::ranges::find(dialect.arguments, name, &DialectSetting::name) == dialect.arguments.end())
      throw std::invalid_argument(
          fmt::format("{} does not depend on --{}{}", dialect.name, name,
                      dialect.arguments.empty() ? "" : ", only on " + options_of(dialect)));
  for (const DialectSetting& argument : dialect.arguments) {
    const auto found = given.find(argument.name);
    if (found == given.end() && !argument.standard)
      throw std::invalid_argument(fmt::format("{} also depends on {}: state --{} in {}", dialect.name,
                                              argument.meaning, argument.name, argument.unit));
    if (found == given.end()) given.emplace(argument.name, *argument.standard);
    check(argument, given.find(argument.name)->second);
  }
  return given;
}

DirectionalMean rigidity_of(const Dialect& dialect, const RestMesh& rest, double value,
                            const DialectNumbers& arguments) {
  const DialectNumbers complete = complete_arguments(dialect, arguments);
  check(dialect.setting, value);
  DirectionalMean rigidity = unit_rigidity(dialect, rest, complete);
  const double factor = dialect.factor(value, complete);
  rigidity.mean *= factor;
  if (rigidity.range) rigidity.range = {rigidity.range->first * factor, rigidity.range->second * factor};
  return rigidity;
}

double value_of(const Dialect& dialect, const RestMesh& rest, double rigidity,
                const DialectNumbers& arguments) {
  const DialectNumbers complete = complete_arguments(dialect, arguments);
  check({.name = "rigidity"}, rigidity);
  const double unit = unit_rigidity(dialect, rest, complete).mean;
  const double value = dialect.value(rigidity / unit, complete);
  if (is_allowed(dialect.setting, value)) return value;
  throw std::invalid_argument(
      fmt::format("--rigidity {:.6g}: no {} has this rigidity; on this mesh its largest value, {:g}, means "
                  "B = {:.6g} N m. Change {}",
                  rigidity, dialect.setting.name, dialect.setting.most,
                  unit * dialect.factor(dialect.setting.most, complete), options_of(dialect)));
}

}  // namespace bendlab
