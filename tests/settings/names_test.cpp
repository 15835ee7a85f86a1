#include "bendlab/settings/names.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include "tests/catch.hpp"

namespace bendlab::names_test {
namespace {

enum class Colour { red, green };
constexpr std::array<std::string_view, 2> colour_names = {"red", "green"};

}  // namespace

TEST_CASE("names: a table converts texts to enumerators and back", "[settings]") {
  for (const Colour colour : {Colour::red, Colour::green})
    CHECK(bendlab::named<Colour>(bendlab::name_in(colour_names, colour), colour_names) == colour);
  CHECK(bendlab::name_in(colour_names, Colour::green) == "green");
}

TEST_CASE("names: an unknown name is refused, and the message lists the known names", "[settings]") {
  std::string message;
  try {
    bendlab::named<Colour>("blue", colour_names);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message == "'blue' is not one of red, green");
}

}  // namespace bendlab::names_test
