#include "experiments/advise/setting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bendlab/bending/model.hpp"
#include "bendlab/scene/counted.hpp"
#include "bendlab/solver/method.hpp"

namespace bendlab {

bool same_kind(const Setting& a, const Setting& b) {
  return a.model == b.model && a.method == b.method && a.solver == b.solver && a.cells == b.cells;
}

double work_of(const Setting& setting) {
  return static_cast<double>(setting.substeps) * setting.iterations;
}

Setting with_work(Setting setting, double factor) {
  int& count = find_method(setting.method)->projects ? setting.substeps : setting.iterations;
  count = std::max(1, static_cast<int>(factor < 1 ? std::floor(count * factor) : std::round(count * factor)));
  return setting;
}

const std::vector<Setting>& measured_fronts() {
  static const std::vector<Setting> fronts = {
#define BENDLAB_FRONT(model, method, solver, substeps, iterations) \
  Setting{model, method, solver, substeps, iterations},
#include "experiments/advise/fronts.def"
#undef BENDLAB_FRONT
  };
  return fronts;
}

std::vector<std::string> advised_methods() {
  std::vector<std::string> names;
  for (const Setting& setting : measured_fronts())
    if (std::ranges::find(names, setting.method) == names.end()) names.push_back(setting.method);
  return names;
}

std::string solver_text(const Setting& setting) {
  std::vector<std::string> parts;
  const Json settings = Json::parse(setting.solver);
  for (const auto& [name, value] : settings.items())
    parts.push_back(fmt::format("{} {}", name, value.is_string() ? value.get<std::string>() : value.dump()));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string setting_text(const Setting& setting) {
  const std::string solver = solver_text(setting);
  return fmt::format("{}, {}{}, {}, {}{}", setting.model, setting.method,
                     solver.empty() ? "" : fmt::format(" ({})", solver), counted(setting.substeps, "substep"),
                     counted(setting.iterations, "iteration"),
                     setting.cells > 0 ? ", " + counted(setting.cells, "cell") : "");
}

}  // namespace bendlab
