#include "bendlab/constraints/kinds.hpp"

#include <array>

#include "bendlab/settings/names.hpp"

namespace bendlab {

std::size_t index_of_kind(std::string_view name) {
  static constexpr auto names = []<class... Kinds>(std::type_identity<std::tuple<Kinds...>>) {
    return std::array{Kinds::name...};
  }(std::type_identity<ElementKinds>{});
  enum class Index : std::size_t {};
  return static_cast<std::size_t>(named<Index>(name, names));
}

}  // namespace bendlab
