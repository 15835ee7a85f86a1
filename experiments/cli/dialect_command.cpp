// `bendlab dialect`: converts the bending number of another engine to a flexural rigidity, or back.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "bendlab/mesh/files.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/scene/nearest_name.hpp"
#include "bendlab/scene/pointers.hpp"
#include "experiments/cli/shared_options.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/dialects/dialect.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

struct DialectMesh {
  RestMesh rest;
  std::string what;                 // for the output
  std::optional<double> density{};  // kg/m², of a config
};

// The mesh of a config. Throws ConfigError if the runs of its sweep differ in mesh or density.
DialectMesh mesh_of_config(const fs::path& file, const std::vector<std::string>& overrides) {
  const Experiment experiment = load_experiment(file, overrides);
  const RunConfig& first = experiment.runs.front();
  const auto cloth = [](const RunConfig& run) {
    return std::pair(run.resolved().at("mesh"), run.scene().material.density);
  };
  for (const RunConfig& run : experiment.runs)
    if (cloth(run) != cloth(first))
      throw ConfigError(file.string(),
                        {{"/sweep",
                          "sweeps the mesh or the density, but a rigidity belongs to one cloth: choose it, "
                          "for example with --set /mesh/cells=32"}});
  return {RestMesh(rest_mesh_of(first.scene().mesh, first.folder()).mesh), "of the config " + file.string(),
          first.scene().material.density};
}

DialectMesh mesh_for(const fs::path& file, const std::vector<std::string>& overrides) {
  if (file.extension() == ".json") return mesh_of_config(file, overrides);
  if (!overrides.empty()) throw UsageError("--set changes a config, but no config is named");
  if (!file.empty()) return {RestMesh(read_mesh(file)), file.string()};
  const Mesh standard;
  return {RestMesh(rest_mesh_of(standard, {}).mesh),
          fmt::format("a grid of {:g} m × {:g} m with {} × {} cells, because none is named", standard.width,
                      standard.height, standard.cells, standard.cells)};
}

std::string_view cell_rule(int power) {
  constexpr std::array rules = {"does not depend on the cells' size",
                                "is proportional to the cells' size: cells of half the size halve B",
                                "is proportional to the square of the cells' size: cells of half the size "
                                "quarter B",
                                "is proportional to the cube of the cells' size: cells of half the size give "
                                "an eighth of B",
                                "is proportional to the fourth power of the cells' size: cells of half the "
                                "size give a sixteenth of B"};
  return rules.at(static_cast<std::size_t>(power));
}

std::string depends_text(const Dialect& dialect) {
  return fmt::format("on triangles of a given shape, B {}{}{}", cell_rule(dialect.cell_power),
                     dialect.depends.empty() ? "" : ". B also depends on ", dialect.depends);
}

const Dialect& dialect_named(const std::string& name) {
  if (const Dialect* const found = find_dialect(name)) return *found;
  std::vector<std::string_view> names;
  for (const Dialect* dialect : dialects()) names.push_back(dialect->name);
  throw UsageError(fmt::format("there is no dialect '{}'{}\nDialects: {}", name, suggestion(name, names),
                               fmt::join(names, ", ")));
}

std::string options_of(const Dialect& dialect) {
  std::string text = fmt::format("--{}", dialect.setting.name);
  for (const DialectSetting& argument : dialect.arguments) text += fmt::format(", --{}", argument.name);
  return text;
}

std::string with_unit(std::string_view text, std::string_view unit, const char* between = " ") {
  return unit == "1" ? std::string(text) : fmt::format("{}{}{}", text, between, unit);
}

struct DialectCommand : Command {
  std::string name;                                      // empty: list all dialects
  fs::path file;                                         // mesh, or config (.json); empty: a grid
  std::vector<std::string> overrides;                    // of the config
  std::map<std::string, std::optional<double>> numbers;  // of the dialects, by their names
  std::optional<double> rigidity;                        // N m, to be converted to the engine's number

  DialectCommand() {
    add(name, "[NAME]", "Dialect: a formula of an engine (default: list all dialects)");
    add(file, "[FILE]", "Mesh (.obj, .ply, .off or .stl), or config with a mesh (.json) (default: a grid)");
    add(rigidity, "--rigidity", "B in N m: print the engine's number that has this rigidity");
    std::map<std::string, std::map<std::string, std::string>> dialects_of;  // by number and meaning
    for (const Dialect* dialect : dialects()) {
      const auto collect = [&](const DialectSetting& number) {
        std::string& names =
            dialects_of[std::string(number.name)][with_unit(number.meaning, number.unit, ", in ")];
        names += fmt::format("{}{}", names.empty() ? "" : ", ", dialect->name);
      };
      collect(dialect->setting);
      std::ranges::for_each(dialect->arguments, collect);
    }
    for (const auto& [number, meanings] : dialects_of) {
      std::string text;
      for (const auto& [meaning, names] : meanings)
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", names, meaning);
      add(numbers[number], "--" + number, text);
    }
    add_set(*this, overrides);
    add(json, "--json", "Print one JSON object");
  }
  int run() override;
};

// The numbers that are given, without the dialect's own setting. Throws UsageError for an option that the
// dialect does not have, and unless either the setting or a rigidity is given.
DialectNumbers given_arguments(const Dialect& dialect, const DialectCommand& given) {
  DialectNumbers arguments;
  bool has_setting = false;
  for (const auto& [name, value] : given.numbers) {
    if (!value) continue;
    if (name == dialect.setting.name)
      has_setting = true;
    else if (std::ranges::find(dialect.arguments, name, &DialectSetting::name) != dialect.arguments.end())
      arguments[name] = *value;
    else
      throw UsageError(fmt::format("--{} does not belong to {}; its options: {} and --rigidity", name,
                                   dialect.name, options_of(dialect)));
  }
  if (has_setting == given.rigidity.has_value())
    throw UsageError(
        fmt::format("{}: give either --{} VALUE in {}, to learn the rigidity B, or --rigidity B in N m, to "
                    "learn {}",
                    dialect.name, dialect.setting.name, dialect.setting.unit, dialect.setting.name));
  return arguments;
}

struct Conversion {
  const Dialect& dialect;
  const DialectMesh& mesh;
  bool to_rigidity;  // or from a rigidity
  double value;      // of the setting
  DialectNumbers arguments, given;
  DirectionalMean rigidity;
};

Conversion convert(const Dialect& dialect, const DialectMesh& mesh, const DialectCommand& given) {
  DialectNumbers arguments = given_arguments(dialect, given);
  if (mesh.density &&
      std::ranges::find(dialect.arguments, "density", &DialectSetting::name) != dialect.arguments.end())
    arguments.emplace("density", *mesh.density);
  try {
    const DialectNumbers complete = complete_arguments(dialect, arguments);
    const double value = given.rigidity ? value_of(dialect, mesh.rest, *given.rigidity, complete)
                                        : *given.numbers.find(std::string(dialect.setting.name))->second;
    return {dialect,
            mesh,
            !given.rigidity,
            value,
            complete,
            std::move(arguments),
            rigidity_of(dialect, mesh.rest, value, complete)};
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

std::string arguments_text(const Conversion& conversion) {
  std::string text;
  for (const DialectSetting& argument : conversion.dialect.arguments)
    text += fmt::format(
        "{}{} {}{}", text.empty() ? "" : "; ", argument.name,
        with_unit(fmt::format("{:.6g}", conversion.arguments.at(std::string(argument.name))), argument.unit),
        conversion.given.contains(argument.name) ? "" : " (the engine's default)");
  return text;
}

void print_conversion(const Conversion& conversion) {
  const auto& [dialect, mesh, to_rigidity, value, arguments, given, rigidity] = conversion;
  const std::string number =
      with_unit(fmt::format("{} = {:.6g}", dialect.setting.name, value), dialect.setting.unit);
  const std::string b = fmt::format("B = {:.6g} N m", rigidity.mean);
  print_text("{}: {} means {} on this mesh\n\n", dialect.name, to_rigidity ? number : b,
             to_rigidity ? b : number);
  const auto row = [](std::string_view name, std::string_view text) {
    if (!text.empty()) print_text("{:<11} {}\n", name, text);
  };
  row("engine", dialect.engine);
  row("mesh", fmt::format("{}; {} vertices, mean edge {} m", mesh.what, mesh.rest.vertex_count(),
                          format_number(mesh.rest.mean_edge_length())));
  row("arguments", arguments_text(conversion));
  row("directions", rigidity.range
                        ? fmt::format("B is a mean over all directions of bending; {:.4g} N m in the softest "
                                      "direction, {:.4g} N m in the stiffest",
                                      rigidity.range->first, rigidity.range->second)
                        : "B is a mean over all directions of bending; this rest shape is not flat");
  row("depends on", depends_text(dialect));
  row("equilateral", fmt::format("{} on triangles of edge a", dialect.rule));
  row("limits", dialect.limits);
  row("source", dialect.source);
}

Json to_json(const Conversion& conversion) {
  const auto& [dialect, mesh, to_rigidity, value, arguments, given, rigidity] = conversion;
  return {{"dialect", dialect.name},
          {"engine", dialect.engine},
          {"setting", dialect.setting.name},
          {"value", value},
          {"unit", dialect.setting.unit},
          {"flexural_rigidity", rigidity.mean},
          {"least_flexural_rigidity", rigidity.range ? Json(rigidity.range->first) : Json(nullptr)},
          {"largest_flexural_rigidity", rigidity.range ? Json(rigidity.range->second) : Json(nullptr)},
          {"arguments", arguments},
          {"mesh", mesh.what},
          {"vertices", mesh.rest.vertex_count()},
          {"mean_edge_length_m", mesh.rest.mean_edge_length()},
          {"depends_on", depends_text(dialect)},
          {"equilateral", dialect.rule},
          {"limits", dialect.limits},
          {"source", dialect.source}};
}

void print_list(bool json) {
  Table table({"dialect", "options", "on equilateral triangles of edge a", "engine"});
  Json list = Json::array();
  for (const Dialect* dialect : dialects()) {
    table.add_row({std::string(dialect->name), options_of(*dialect), std::string(dialect->rule),
                   std::string(dialect->engine)});
    list.push_back({{"dialect", dialect->name},
                    {"engine", dialect->engine},
                    {"setting", dialect->setting.name},
                    {"unit", dialect->setting.unit},
                    {"meaning", dialect->setting.meaning},
                    {"depends_on", depends_text(*dialect)},
                    {"equilateral", dialect->rule},
                    {"limits", dialect->limits},
                    {"source", dialect->source}});
  }
  if (json)
    print_text("{}\n", list.dump(2));
  else
    print_text("{}", table.text());
}

int DialectCommand::run() {
  if (name.empty()) {
    const auto is_given = [](const auto& number) { return number.second.has_value(); };
    if (rigidity || std::ranges::any_of(numbers, is_given))
      throw UsageError("name a dialect before its numbers; 'bendlab dialect' lists all dialects");
    print_list(json);
    return exit_ok;
  }
  const Dialect& dialect = dialect_named(name);
  given_arguments(dialect, *this);  // before a mesh is read
  const DialectMesh mesh = mesh_for(file, overrides);
  const Conversion conversion = convert(dialect, mesh, *this);
  if (json)
    print_text("{}\n", json_text(to_json(conversion)));
  else
    print_conversion(conversion);
  return exit_ok;
}

}  // namespace

extern const CommandKind dialect_command{
    "dialect", "Convert a bending number of another engine to a flexural rigidity B, or back",
    "bendlab dialect newton --edge-ke 10 garment.obj", make<DialectCommand>};

}  // namespace bendlab
