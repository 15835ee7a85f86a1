#include "experiments/config/schema.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "bendlab/bending/model.hpp"
#include "bendlab/constraints/kinds.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/fields_json.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/expectations.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab::schema_test {
using Catch::Matchers::ContainsSubstring;

namespace {

// The text in one line. (Descriptions are wrapped in the text.)
std::string unwrapped(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c == '\n' || c == ' ')
      result += result.ends_with(' ') ? "" : " ";
    else
      result += c;
  return result;
}

// The schema of the section at `pointer`.
const Json& section_schema(const Json& schema, const std::string& pointer) {
  if (pointer.empty()) return schema;
  const std::size_t slash = pointer.rfind('/');
  return section_schema(schema, pointer.substr(0, slash)).at("properties").at(pointer.substr(slash + 1));
}

}  // namespace

TEST_CASE("schema: the text has every row of every table") {
  const std::string text = unwrapped(schema_text());
  const auto check_row = [&](const Field& row) {
    CHECK_THAT(text, ContainsSubstring(" " + std::string(row.name)));
    CHECK_THAT(text, ContainsSubstring(unwrapped(std::string(row.meaning))));
    CHECK_THAT(text, ContainsSubstring(unwrapped(expected_text(row))));
  };
  for (const Section& section : config_sections()) {
    CHECK_THAT(text, ContainsSubstring(unwrapped(std::string(section.meaning))));
    for (const SettingRow& row : section.rows) check_row(row.field);
  }
  for (const EffectKind* effect : effects())
    for (const Field& row : effect->settings.fields) check_row(row);
  for (const Field& row : expectation_table().fields) check_row(row);
}

TEST_CASE("schema: the JSON Schema has every row with type, default, unit and range") {
  const Json schema = schema_json();
  CHECK(schema["required"] == Json::array({"name"}));
  for (const Section& section : config_sections()) {
    const Json object = section_schema(schema, std::string(section.pointer));
    CHECK(object["additionalProperties"] == false);
    for (const auto& [row, usual] : section.rows) {
      const Json& setting = object["properties"].at(std::string(row.name));
      CHECK(setting.contains("type"));
      CHECK(setting["description"] == row.meaning);
      CHECK(setting.contains("default") == !std::holds_alternative<std::monostate>(usual));
      CHECK(setting.contains("x-unit") == !row.unit.empty());
    }
  }
  const Json& mesh = schema["properties"]["mesh"]["properties"];
  CHECK(mesh["cells"].dump() == R"({"type":"integer","minimum":1.0,"maximum":4096.0,"default":32,)"
                                R"("description":"Resolution: cells along the width","x-unit":"1"})");
  CHECK(mesh["width"]["exclusiveMinimum"] == 0);
  CHECK(mesh["file"]["type"] == Json::array({"string", "null"}));
  CHECK(schema["properties"]["material"]["properties"]["warp_direction"]["minItems"] == 3);
  CHECK(schema["properties"]["material"]["properties"]["warp_direction"]["maxItems"] == 3);
  CHECK(schema["properties"]["bending"]["properties"]["model"]["enum"].size() == bending_models().size());
  CHECK(schema["properties"]["effects"]["items"]["oneOf"].size() == effects().size());
  CHECK(schema["properties"].contains("sweep"));
  CHECK(schema["properties"]["expect"]["items"]["required"] == Json::array({"metric", "why"}));
}

TEST_CASE("schema: a config is described by the sections that its resolved form has") {
  const RunConfig run = parse_experiment(R"({"name": "t", "defaults": "paper"})", "test").runs.at(0);
  const Json schema = schema_json();
  for (const auto& [key, value] : run.resolved().items()) CHECK(schema["properties"].contains(key));
}

TEST_CASE("schema: models and effects are listed with settings, defaults and sources") {
  const Json models = models_json(), effect_list = effects_json();
  REQUIRE(models.size() == bending_models().size());
  REQUIRE(effect_list.size() == effects().size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    const BendingKind& model = *bending_models()[i];
    CHECK(models[i]["name"] == model.name);
    CHECK(models[i]["source"] == model.source);
    CHECK(models[i]["limits"] == model.limits);
    REQUIRE(models[i]["settings"].size() == model.settings.fields.size());
    for (std::size_t p = 0; p < model.settings.fields.size(); ++p)
      CHECK(models[i]["settings"][p]["name"] == model.settings.fields[p].name);
    CHECK_THAT(unwrapped(models_text()), ContainsSubstring(unwrapped(std::string(model.summary))));
  }
  for (std::size_t i = 0; i < effect_list.size(); ++i) {
    CHECK(effect_list[i]["name"] == effects()[i]->name);
    CHECK_THAT(unwrapped(effects_text()), ContainsSubstring(unwrapped(std::string(effects()[i]->summary))));
  }
}

TEST_CASE("schema: the data for figures state the kind of constraints of each model") {
  const Json all = model_traits_json();
  for (const auto& [name, traits] : all.items()) {
    INFO(name);
    const bool is_energy = find_bending_model(name)->needs_energy;  // k has no energy
    const std::string config = R"({"name": "t", "mesh": {"cells": 4}, "pins": {"vertices": []},
                                   "defaults": ")" +
                               std::string(is_energy ? "reference" : "paper") +
                               R"(", "bending": {"model": ")" + name + "\"}}";
    const BuiltScene scene = build_scene(parse_experiment(config, "test").runs.front().scene());
    const std::size_t springs = scene.input.distance.size(), elements = element_count(scene.input.elements);
    CHECK(traits["label"] == find_bending_model(name)->label);
    CHECK((traits["made_of"] == "nothing") == (springs + elements + scene.input.own.size() == 0));
    CHECK((traits["made_of"] == "springs") == (springs > 0));
    // The sheet has 5 × 5 vertices, 32 triangles and 40 interior edges: diagonals and sides.
    if (traits["made_of"] == "hinges")
      CHECK(elements + scene.input.own.size() == std::map<std::string, std::size_t>{{"laplacian", 25},
                                                                                    {"mid_edge", 32},
                                                                                    {"mid_edge_average", 32},
                                                                                    {"corotational_face", 32},
                                                                                    {"dkt", 32}}
                                                     .emplace(name, 40)
                                                     .first->second);
  }
  CHECK(model_traits_json().size() == bending_models().size());
  CHECK(model_traits_json()["choi_ko"]["made_of"] == "elements");
  CHECK(model_traits_json()["prestressed"]["prestressed"] == true);
  CHECK(model_traits_json()["sparse_lod"]["prestressed"] == false);
}

TEST_CASE("schema: the data for figures state the defaults of methods") {
  const Json chosen = method_traits_json();
  CHECK(chosen.size() == methods().size());
  CHECK(chosen["newton"]["integrator"] == "bdf2");
  CHECK(chosen["quasi_newton"]["integrator"] == "euler");
  CHECK(chosen["pbd"]["sweep"] == "forward");
  CHECK(chosen["equilibrium"].empty());
}

TEST_CASE("schema: the text of effects has an empty line between two effects, but not before or after") {
  const std::string text = effects_text();
  CHECK(text.starts_with(effects().front()->name));
  for (std::size_t i = 1; i < effects().size(); ++i)
    CHECK_THAT(text, ContainsSubstring("\n\n" + std::string(effects()[i]->name)));
  CHECK_FALSE(text.ends_with("\n\n"));
}

TEST_CASE("schema: every setting that a method reads is in /solver and has one meaning") {
  const std::vector<SettingRow>& solver = find_section("/solver")->rows;
  const auto row_of = [&](std::string_view name) {
    return std::ranges::find_if(solver, [&](const SettingRow& row) { return row.field.name == name; });
  };
  const Json listed = methods_json();
  REQUIRE(listed.size() == methods().size());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const MethodKind& method = *methods()[i];
    INFO(method.name);
    CHECK(listed[i]["name"] == method.name);
    CHECK(listed[i]["limits"] == method.limits);
    CHECK_THAT(unwrapped(methods_text()), ContainsSubstring(unwrapped(std::string(method.summary))));
    for (const Json& shared : listed[i]["shared"]) {
      CHECK(row_of(shared.get<std::string>()) != solver.end());
      CHECK(method.settings.find(shared.get<std::string>()) == nullptr);
    }
    for (const Field& own : method.settings.fields) {
      REQUIRE(row_of(own.name) != solver.end());
      CHECK(row_of(own.name)->field.meaning == own.meaning);
    }
  }
}

TEST_CASE("schema: a resolved config has exactly the solver settings that its method reads") {
  const Json listed = methods_json();
  for (std::size_t i = 0; i < methods().size(); ++i) {
    const MethodKind& method = *methods()[i];
    const RunConfig run = parse_experiment(R"({"name": "t", "mesh": {"cells": 2},
          "solver": {"method": ")" + std::string(method.name) +
                                               R"("}, "bending": {"model": "none"},
        "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}}})",
                                           "test")
                              .runs.at(0);
    for (const SettingRow& row : find_section("/solver")->rows) {
      const std::string name(row.field.name);
      const Json& names = listed[i]["shared"];
      const bool shared = std::find(names.begin(), names.end(), Json(name)) != names.end();
      CHECK(run.resolved()["solver"].contains(name) ==
            (name == "method" || shared || method.settings.find(name) != nullptr));
    }
  }
}

TEST_CASE("schema: configs/schema.json is up to date") {
  std::ifstream file(std::string(places::source) + "/configs/schema.json");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  INFO("./bendlab schema --json > configs/schema.json");
  CHECK((text == schema_json().dump(2) + "\n"));
}

}  // namespace bendlab::schema_test
