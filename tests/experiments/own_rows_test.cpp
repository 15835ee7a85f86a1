// Bending models and measures that a program must not add. For valid additions see tests/install.
#include "bendlab/bending/models.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/measures/measure.hpp"
#include "tests/catch.hpp"

namespace bendlab::own_rows_test {
namespace {

using Catch::Matchers::ContainsSubstring;

BendingConstraints no_constraints(const void*, const BendingInput&) {
  return {};
}

std::unique_ptr<Measurement> nothing(const RunConfig&, const BuiltScene&) {
  return std::make_unique<Measurement>();
}

std::vector<Quantity> number(const char* name) {
  return {{name, "1", "a number"}};
}

TEST_CASE("own rows: a model needs a new name and a function that builds its constraints", "[measures]") {
  static constexpr BendingKind taken{.name = "lod", .build = no_constraints}, empty{.name = "own"};
  CHECK_THROWS_WITH(register_bending_model(taken), ContainsSubstring("bending model 'lod'"));
  CHECK_THROWS_WITH(register_bending_model(empty),
                    ContainsSubstring("'own'") && ContainsSubstring("build()"));
  CHECK(added_bending_models().empty());
}

TEST_CASE("own rows: a measure and its metrics need new names", "[measures]") {
  static const Measure taken{.name = "drape", .begin = nothing}, empty{.name = "own"},
      summary{.name = "own", .gives = [] { return number("drop"); }, .begin = nothing},
      fact{.name = "own", .gives = [] { return number("vertices"); }, .begin = nothing},
      twice{.name = "own",
            .gives =
                [] {
                  return std::vector{number("a")[0], number("a")[0]};
                },
            .begin = nothing},
      frame{.name = "own",
            .columns =
                [] {
                  return std::vector<Column>{{"time", "s", "the time"}};
                },
            .begin = nothing};
  CHECK_THROWS_WITH(register_measure(taken), ContainsSubstring("measure 'drape'"));
  CHECK_THROWS_WITH(register_measure(empty), ContainsSubstring("begin()"));
  CHECK_THROWS_WITH(register_measure(summary), ContainsSubstring("metric 'drop'"));
  CHECK_THROWS_WITH(register_measure(fact), ContainsSubstring("metric 'vertices'"));
  CHECK_THROWS_WITH(register_measure(twice), ContainsSubstring("metric 'a'"));
  CHECK_THROWS_WITH(register_measure(frame), ContainsSubstring("metric 'time'"));
  CHECK(added_measures().empty());
}

TEST_CASE("own rows: settings follow when a model or measure is added or removed", "[measures]") {
  static constexpr BendingKind model{.name = "own", .settings = table_of<None>({}), .build = no_constraints},
      no_table{.name = "own", .build = no_constraints};
  static const Measure measure{.name = "own", .begin = nothing};
  CHECK_THROWS_WITH(register_bending_model(no_table), ContainsSubstring("table_of"));
  const std::string config =
      R"({"name": "own", "bending": {"model": "own"}, "output": {"measures": ["own"]}})";
  const auto parse = [&] { return parse_experiment(config, "test"); };
  CHECK_THROWS_WITH(parse(), ContainsSubstring("/bending/model") && ContainsSubstring("/output/measures"));
  register_bending_model(model), register_measure(measure);
  CHECK_NOTHROW(parse());
  remove_bending_model("own"), remove_measure("own");
  CHECK_THROWS(parse());
  CHECK(added_bending_models().empty());
  remove_bending_model("lod");
  CHECK(find_bending_model("lod") != nullptr);
}

}  // namespace
}  // namespace bendlab::own_rows_test
