// Properties of every registered solver method.
#include "bendlab/solver/method.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::method_test {
namespace {

// A sheet that every method accepts: it has springs, and every stiffness is a compliance.
SimulationInput sheet_for(const MethodKind& method) {
  const RestMesh rest(grid(1, 1, 3, 3));
  const Pins pins = make_pins(rest, {0}, 0);
  SimulationInput input = test::sheet(rest, pins, "crossover");
  if (method.membrane == Membrane::edges) input.strain = {}, input.edges = edge_springs(rest, pins);
  input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = 1e-3};
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = 1};
  input.method = Method(method);
  return input;
}

template <class Real>
void check_orders(const SimulationInput& input) {
  if (input.method.kind().make<Real>() == nullptr) {
    CHECK_THROWS_AS(make_simulation<Real>(input, {}), std::invalid_argument);
    return;
  }
  const auto simulation = make_simulation<Real>(input, {});
  const auto constraints_of = [](const BatchOrder& order) {
    std::multiset<int> all;
    for (const int constraint : order.constraint_of_lane())
      if (constraint >= 0) all.insert(constraint);
    return all;
  };
  const auto every = [](std::size_t count) {
    std::multiset<int> all;
    for (std::size_t c = 0; c < count; ++c) all.insert(static_cast<int>(c));
    return all;
  };
  CHECK(constraints_of(simulation->strain_order()) == every(input.strain.size()));
  CHECK(constraints_of(simulation->distance_order()) == every(input.distance.size()));
  for_each_kind(input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    CHECK(constraints_of(simulation->element_order(Kind::name)) == every(list.size()));
  });
  CHECK_THROWS_AS(simulation->element_order("no such kind"), std::invalid_argument);
  REQUIRE(simulation->step());
}

}  // namespace

TEST_CASE("methods: each has a description and at least one precision", "[solver]") {
  std::set<std::string_view> names;
  for (const MethodKind* method : methods()) {
    INFO(method->name);
    names.insert(method->name);
    CHECK(find_method(method->name) == method);
    for (const std::string_view text : {method->summary, method->source, method->limits})
      CHECK_FALSE(text.empty());
    CHECK((method->make_float != nullptr || method->make_double != nullptr));
  }
  CHECK(names.size() == methods().size());
  CHECK(find_method("no_such_method") == nullptr);
}

TEST_CASE("methods: the order of each holds every constraint once, and unknown kinds are refused",
          "[solver]") {
  for (const MethodKind* method : methods()) {
    INFO(method->name);
    const SimulationInput input = sheet_for(*method);
    check_orders<float>(input);
    check_orders<double>(input);
  }
}

TEST_CASE("methods: each describes all its passes", "[solver]") {
  for (const MethodKind* method : methods()) {
    const SimulationInput input = sheet_for(*method);
    const auto simulation = make_simulation<double>(input, test::effect_passes<double>("gravity"));
    for (const PassStatistics& pass : simulation->passes()) {
      INFO(method->name << ": " << pass.name);
      if (pass.name == "bending" || pass.name == "gravity") continue;
      CHECK(std::ranges::find(method->passes, pass.name, &MethodPass::name) != method->passes.end());
    }
  }
}

TEST_CASE("methods: settings are read from their struct, and settings of another method are refused",
          "[solver]") {
  SimulationInput input = sheet_for(KangCho::kind);
  CHECK(settings_of<KangCho>(input).tangent == KangCho::Tangent::along);
  input.method = KangCho{.tangent = KangCho::Tangent::taut};
  CHECK(settings_of<KangCho>(input).tangent == KangCho::Tangent::taut);
  input.method = Pbd{};
  CHECK_THROWS_AS(settings_of<KangCho>(input), std::logic_error);
}

}  // namespace bendlab::method_test
