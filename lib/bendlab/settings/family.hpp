// A family is a set of alternatives: bending models, effects, solver methods, or measures. Each member of a
// family has an object called its kind, with the member's name, properties and functions. Members other than
// measures also have a struct of settings, which refers to the kind:
//
//   struct Wind { Vector3 velocity = {0, 5, 0}; …; static const EffectKind kind; };
//
// A program may add members to a family.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace bendlab {

/// A member with its settings: `Effect wind = Wind{.velocity = {0, 3, 0}};`. Copies share the constant
/// settings.
template <class Kind>
class Chosen {
 public:
  template <class Settings>
  requires std::same_as<decltype(Settings::kind), const Kind> Chosen(Settings settings)
      : kind_(&Settings::kind), settings_(std::make_shared<const Settings>(std::move(settings))) {}

  /// A member with its default settings.
  explicit Chosen(const Kind& kind) : kind_(&kind), settings_(kind.settings.copy(kind.settings.defaults())) {}
  Chosen(const Kind& kind, std::shared_ptr<const void> settings)
      : kind_(&kind), settings_(std::move(settings)) {}

  const Kind& kind() const { return *kind_; }
  std::string_view name() const { return kind_->name; }
  const void* settings() const { return settings_.get(); }

  /// The settings, if they are of the type `Settings`; otherwise null.
  template <class Settings>
  const Settings* as() const {
    return kind_ == &Settings::kind ? static_cast<const Settings*>(settings_.get()) : nullptr;
  }

 private:
  const Kind* kind_;
  std::shared_ptr<const void> settings_;
};

/// Turns a function of a member's settings into the function type of the kind. For example, `.build =
/// erased<build>` for `build(const Adaptive&, …)`.
namespace detail {
template <auto function>
struct Erased;
template <class Result, class Settings, class... Rest, Result (*function)(const Settings&, Rest...)>
struct Erased<function> {
  static Result call(const void* settings, Rest... rest) {
    return function(*static_cast<const Settings*>(settings), std::forward<Rest>(rest)...);
  }
};
/// Throws std::invalid_argument if the name cannot be a key of a config, or if `taken` contains the name.
void check_new_name(std::string_view family, std::string_view name, std::span<const std::string_view> taken);

/// How many times a kind was added to a registry or removed from a registry.
inline std::atomic<int> registered{0};
}  // namespace detail
template <auto function>
inline constexpr auto erased = &detail::Erased<function>::call;

/// The result of make(), for example a table of the names of all registered kinds. The result is stored;
/// after kinds were added or removed, make() is called again. Earlier results stay valid.
template <auto make>
const auto& made_of_kinds() {
  static std::mutex access;
  static std::map<int, decltype(make())> made;
  const std::lock_guard lock(access);
  const int now = detail::registered;
  const auto earlier = made.find(now);
  return earlier != made.end() ? earlier->second : made.emplace(now, make()).first->second;
}

/// The kinds of a family: first the built-in kinds (`listed`), then the kinds that a program adds. Only one
/// thread at a time may change a registry, while no other thread reads configs.
template <class Kind>
class Registry {
 public:
  /// `family` is for error messages, for example "bending model".
  Registry(std::string_view family, std::span<const Kind* const> listed)
      : family_(family), kinds_(listed.begin(), listed.end()), listed_(std::ssize(listed)) {}

  /// `kind` must not be moved or destroyed afterwards. Throws std::invalid_argument if the name already
  /// exists or is not valid, or if the kind has no table of settings.
  void add(const Kind& kind) {
    std::vector<std::string_view> taken;
    for (const Kind* known : kinds_) taken.push_back(known->name);
    detail::check_new_name(family_, kind.name, taken);
    if constexpr (requires { kind.settings.copy; })
      if (kind.settings.copy == nullptr)
        throw std::invalid_argument(std::string(kind.name) +
                                    " has no table of settings: add .settings = table_of<…>({}) to the kind");
    kinds_.push_back(&kind);
    ++detail::registered;
  }
  /// Removes a kind that was added by add(); does nothing if there is none of that name.
  void remove(std::string_view name) {
    const auto added = std::ranges::find(kinds_.begin() + listed_, kinds_.end(), name, &Kind::name);
    if (added == kinds_.end()) return;
    kinds_.erase(added);
    ++detail::registered;
  }

  std::span<const Kind* const> all() const { return kinds_; }
  std::span<const Kind* const> added() const {
    return std::span(kinds_).subspan(static_cast<std::size_t>(listed_));
  }

  /// The kind with that name, or null.
  const Kind* find(std::string_view name) const {
    const auto kind = std::ranges::find(all(), name, &Kind::name);
    return kind == all().end() ? nullptr : *kind;
  }

 private:
  std::string_view family_;
  std::vector<const Kind*> kinds_;
  std::ptrdiff_t listed_;
};

/// The kinds of the given structs, in that order. For example, listed_kinds<EffectKind, Gravity, Wind>.
template <class Kind, class... Settings>
inline constexpr std::array<const Kind*, sizeof...(Settings)> listed_kinds = {&Settings::kind...};

}  // namespace bendlab
