#include "bendlab/scene/pointers.hpp"

#include <charconv>
#include <optional>
#include <utility>

namespace bendlab {
namespace {

using Pointer = Json::json_pointer;

// The index for the text `part` of a JSON pointer; nothing if a list of `size` entries has no such index.
std::optional<std::size_t> list_index(std::string_view part, std::size_t size) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool canonical =
      error == std::errc() && end == part.data() + part.size() && (part.size() == 1 || part[0] != '0');
  return canonical && index < size ? std::optional(index) : std::nullopt;
}

Json* place_at(Json& document, const Pointer& pointer) {
  if (pointer.empty()) return &document;
  Json* parent = place_at(document, pointer.parent_pointer());
  if (parent == nullptr) return nullptr;
  if (parent->is_array()) {
    const auto index = list_index(pointer.back(), parent->size());
    return index ? &(*parent)[*index] : nullptr;
  }
  if (!parent->is_object() && !parent->is_null()) return nullptr;
  return &(*parent)[pointer.back()];
}

}  // namespace

bool lies_within(std::string_view pointer, std::string_view container) {
  return pointer.starts_with(container) &&
         (pointer.size() == container.size() || pointer[container.size()] == '/');
}

const Json* value_at(const Json& document, const std::string& pointer) {
  const Pointer parsed(pointer);
  return document.contains(parsed) ? &document.at(parsed) : nullptr;
}

bool set_at(Json& document, const std::string& pointer, Json value) {
  Json* place = place_at(document, Pointer(pointer));
  if (place != nullptr) *place = std::move(value);
  return place != nullptr;
}

}  // namespace bendlab
