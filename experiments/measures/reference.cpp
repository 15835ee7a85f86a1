#include "experiments/measures/reference.hpp"

#include <fmt/format.h>

#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

std::string_view when(const Measure& measure) {
  if (!measure.applies) return "if /output/measures names it";
  return measure.applies == always ? "always" : measure.when;
}

template <class Rows>
std::string rows_text(const char* heading, const Rows& rows) {
  std::string text;
  for (const auto& row : rows)
    text += fmt::format("{}    {} ({}): {}\n", text.empty() ? fmt::format("  {}\n", heading) : "", row.name,
                        row.unit, row.meaning);
  return text;
}

template <class Rows>
Json rows_json(const Rows& rows) {
  Json json = Json::array();
  for (const auto& row : rows)
    json.push_back({{"name", row.name}, {"unit", row.unit}, {"meaning", row.meaning}});
  return json;
}

template <class Make>
auto rows_of(Make make) {
  return make ? make() : decltype(make()){};
}

}  // namespace

std::string measures_text() {
  std::string text;
  for (const Measure* measure : measures())
    text += fmt::format("{}{}: {}\n  a run has it {}; it costs {}\n{}{}{}", text.empty() ? "" : "\n",
                        measure->name, measure->summary, when(*measure), measure->cost,
                        rows_text("numbers of a run", rows_of(measure->gives)),
                        rows_text("numbers of every frame", rows_of(measure->columns)),
                        rows_text("numbers of every triangle in every frame", rows_of(measure->fields)));
  return text;
}

Json measures_json() {
  Json json = Json::array();
  for (const Measure* measure : measures())
    json.push_back({{"name", measure->name},
                    {"summary", measure->summary},
                    {"when", when(*measure)},
                    {"cost", measure->cost},
                    {"run", rows_json(rows_of(measure->gives))},
                    {"frame", rows_json(rows_of(measure->columns))},
                    {"triangle", rows_json(rows_of(measure->fields))}});
  return json;
}

}  // namespace bendlab
