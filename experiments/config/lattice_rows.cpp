#include "experiments/config/lattice_rows.hpp"

#include <string>

#include "bendlab/mesh/generators.hpp"
#include "bendlab/parameters/names.hpp"
#include "experiments/config/pointers.hpp"

namespace bendlab {
namespace {

double number_at(const Json& settings, const char* pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && value->is_number() ? value->get<double>() : 1;  // the default of both lengths
}

}  // namespace

void state_rows(Json& settings) {
  const Json *const generator = value_at(settings, "/mesh/generator"), *const names = value_at(
                                                                           settings, "/pins/vertices");
  if (generator == nullptr || *generator != std::string(name_in(generator_names, Generator::equilateral)))
    return;
  if (settings["mesh"].contains("rows") || names == nullptr || !names->is_array()) return;
  bool along_x = false, along_y = false;
  for (const Json& name : *names) {
    along_x = along_x || name == "top" || name == "bottom";
    along_y = along_y || name == "left" || name == "right";
  }
  if (along_x == along_y) return;
  const bool x_is_long = number_at(settings, "/mesh/width") >= number_at(settings, "/mesh/height");
  settings["mesh"]["rows"] =
      std::string(name_in(rows_names, along_x == x_is_long ? Rows::parallel : Rows::perpendicular));
}

}  // namespace bendlab
