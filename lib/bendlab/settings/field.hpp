// Describes the settings of a struct by a table, with a row for each member: name, unit, range and meaning.
// The table is used to read JSON, to write JSON and to print the reference of settings, so there is no second
// list. The default of a setting is the initialiser of the member.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace bendlab {

/// The value of a setting of any type. `std::monostate` means an optional setting that is not set.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::int64_t>,
                           std::vector<double>, std::vector<std::string>>;

enum class FieldType {
  boolean,
  integer,
  number,    ///< finite; lower and upper bound inclusive unless `above` is set
  text,      ///< free text (a path, a name), or one of `choices` if there are any
  integers,  ///< list of whole numbers
  numbers,   ///< list of finite numbers, of length `length` if that is not 0
  texts,     ///< list of texts, each one of `choices` if there are any
};

/// What a row says about a setting. `minimum` and `maximum` bound a number, or each entry of a list.
struct FieldNotes {
  std::string_view name = {};
  std::string_view unit = {};  ///< SI, "1" for a pure number, empty if a unit has no meaning
  std::string_view meaning = {};
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool above = false;                              ///< the minimum itself is not allowed
  bool required = false;                           ///< must be given, so there is no default
  std::span<const std::string_view> choices = {};  ///< allowed texts; those of an enum in its order
  bool names_file = false;                         ///< a file that the scene reads, relative to its folder
  bool (*read_when)(const void* scene) = nullptr;  ///< null: always; see read_when()
  bool (*kept_when)(const void* scene) = nullptr;  ///< when scene_json.hpp writes it; null: as read_when
  std::string_view depends_on = {};  ///< pointer to the choice that read_when depends on; empty: no choice
};

/// A row: a setting and its member.
struct Field : FieldNotes {
  FieldType type = FieldType::number;
  bool optional = false;                              ///< a std::optional, which may be absent
  std::size_t length = 0;                             ///< of a list of numbers; 0: any length
  const void* (*place)(const void* owner) = nullptr;  ///< address of the member
  Value (*get)(const Field& field, const void* place) = nullptr;
  void (*set)(const Field& field, void* place, const Value& value) = nullptr;

  bool is_read(const void* scene) const { return read_when == nullptr || read_when(scene); }
  bool is_kept(const void* scene) const { return kept_when ? kept_when(scene) : is_read(scene); }
  Value of(const void* owner) const { return get(*this, place(owner)); }
  /// `value` has to be allowed by the row.
  void put(void* owner, const Value& value) const { set(*this, const_cast<void*>(place(owner)), value); }
};

namespace detail {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

template <class T>
constexpr FieldType field_type() {
  if constexpr (is_optional<T>)
    return field_type<typename T::value_type>();
  else if constexpr (std::is_same_v<T, bool>)
    return FieldType::boolean;
  else if constexpr (std::is_integral_v<T>)
    return FieldType::integer;
  else if constexpr (std::is_floating_point_v<T>)
    return FieldType::number;
  else if constexpr (std::is_same_v<T, std::string> || std::is_enum_v<T>)
    return FieldType::text;
  else if constexpr (std::is_same_v<T, Eigen::Vector3d> || std::is_same_v<T, std::vector<double>>)
    return FieldType::numbers;
  else if constexpr (std::is_same_v<T, std::vector<int>>)
    return FieldType::integers;
  else
    return FieldType::texts;
}

std::string name_of_choice(const Field& field, std::size_t index);
std::size_t index_of_choice(const Field& field, const std::string& name);

template <class T>
Value value_of(const Field& field, const T& member) {
  if constexpr (is_optional<T>) {
    return member ? value_of(field, *member) : Value();
  } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, double> ||
                       std::is_same_v<T, std::string>) {
    return member;
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<std::int64_t>(member);
  } else if constexpr (std::is_enum_v<T>) {
    return name_of_choice(field, static_cast<std::size_t>(member));
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    return std::vector<double>(member.data(), member.data() + 3);
  } else if constexpr (std::is_same_v<T, std::vector<int>>) {
    return std::vector<std::int64_t>(member.begin(), member.end());
  } else if constexpr (is_list<T> && std::is_enum_v<typename T::value_type>) {
    std::vector<std::string> names;
    for (const auto entry : member) names.push_back(name_of_choice(field, static_cast<std::size_t>(entry)));
    return names;
  } else {
    return member;
  }
}

template <class T>
void assign(const Field& field, T& member, const Value& value) {
  if constexpr (is_optional<T>) {
    if (std::holds_alternative<std::monostate>(value))
      member.reset();
    else
      assign(field, member.emplace(), value);
  } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
    member = std::get<T>(value);
  } else if constexpr (std::is_same_v<T, double>) {
    const auto* whole = std::get_if<std::int64_t>(&value);
    member = whole != nullptr ? static_cast<double>(*whole) : std::get<double>(value);
  } else if constexpr (std::is_integral_v<T>) {
    member = static_cast<T>(std::get<std::int64_t>(value));
  } else if constexpr (std::is_enum_v<T>) {
    member = static_cast<T>(index_of_choice(field, std::get<std::string>(value)));
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    member = Eigen::Vector3d(std::get<std::vector<double>>(value).data());
  } else if constexpr (std::is_same_v<T, std::vector<int>>) {
    member.clear();
    for (const std::int64_t entry : std::get<std::vector<std::int64_t>>(value))
      member.push_back(static_cast<int>(entry));
  } else if constexpr (is_list<T> && std::is_enum_v<typename T::value_type>) {
    member.clear();
    for (const std::string& name : std::get<std::vector<std::string>>(value))
      member.push_back(static_cast<typename T::value_type>(index_of_choice(field, name)));
  } else {
    member = std::get<T>(value);
  }
}

template <class T>
struct MemberPointer;
template <class C, class M>
struct MemberPointer<M C::*> {
  using Class = C;
  using Member = M;
};

}  // namespace detail

/// The row of a member, for example field<&Wind::velocity>({.name = "velocity", .unit = "m/s", …}). For a
/// member of a base class, the derived struct is the second argument: field<&Sphere::thickness, Sphere>({…}).
template <auto member, class Owner = typename detail::MemberPointer<decltype(member)>::Class>
constexpr Field field(const FieldNotes& notes) {
  using Member = typename detail::MemberPointer<decltype(member)>::Member;
  Field row{notes};
  row.type = detail::field_type<Member>();
  row.optional = detail::is_optional<Member>;
  row.length = std::is_same_v<Member, Eigen::Vector3d> ? 3 : 0;
  row.place = [](const void* owner) -> const void* { return &(static_cast<const Owner*>(owner)->*member); };
  row.get = [](const Field& field, const void* place) {
    return detail::value_of(field, *static_cast<const Member*>(place));
  };
  row.set = [](const Field& field, void* place, const Value& value) {
    detail::assign(field, *static_cast<Member*>(place), value);
  };
  return row;
}

/// A condition for FieldNotes::read_when: read_when<Scene>([](const Scene& scene) { return …; }).
template <class Scene, class Predicate>
constexpr auto read_when(Predicate) {
  return +[](const void* scene) { return static_cast<bool>(Predicate{}(*static_cast<const Scene*>(scene))); };
}

/// The rows of a struct, and functions that make such a struct.
struct FieldTable {
  std::span<const Field> fields = {};
  const void* (*usual)(const void* own) = nullptr;  ///< defaults()
  std::shared_ptr<void> (*copy)(const void* owner) = nullptr;
  const void* own = nullptr;  ///< defaults of a table that is made at run time

  const void* defaults() const { return usual(own); }  ///< a struct with all defaults

  Value default_of(const Field& field) const { return field.of(defaults()); }
  /// The row with that name, or null.
  const Field* find(std::string_view name) const;
};

template <class Struct>
constexpr FieldTable table_of(std::span<const Field> fields) {
  return {fields,
          [](const void*) -> const void* {
            static const Struct usual{};
            return &usual;
          },
          [](const void* owner) -> std::shared_ptr<void> {
            return std::make_shared<Struct>(*static_cast<const Struct*>(owner));
          }};
}

/// All rows of several tables, in order, as one table.
template <std::size_t... sizes>
constexpr auto joined(const std::array<Field, sizes>&... tables) {
  std::array<Field, (sizes + ...)> all{};
  std::size_t next = 0;
  const auto append = [&](const auto& table) {
    for (const Field& field : table) all[next++] = field;
  };
  (append(tables), ...);
  return all;
}

}  // namespace bendlab
