// Families: bending models, effects, solver methods, measures. Each member of a family has a kind, which says
// its name, its traits and what it does; and, but for measures, a struct of settings that knows its kind:
//
//   struct Wind { Vector3 velocity = {0, 5, 0}; …; static const EffectKind kind; };
//
// A program may add to every family.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace bendlab {

/// A member of a family with its settings: `Effect wind = Wind{.velocity = {0, 3, 0}};`. Copies share the
/// settings, which do not change.
template <class Kind>
class Chosen {
 public:
  template <class Settings>
  requires std::same_as<decltype(Settings::kind), const Kind> Chosen(Settings settings)
      : kind_(&Settings::kind), settings_(std::make_shared<const Settings>(std::move(settings))) {}

  /// With its default settings.
  explicit Chosen(const Kind& kind) : kind_(&kind), settings_(kind.settings.copy(kind.settings.defaults())) {}
  Chosen(const Kind& kind, std::shared_ptr<const void> settings)
      : kind_(&kind), settings_(std::move(settings)) {}

  const Kind& kind() const { return *kind_; }
  std::string_view name() const { return kind_->name; }
  const void* settings() const { return settings_.get(); }

  /// The settings as the struct they are; null if they are another's.
  template <class Settings>
  const Settings* as() const {
    return kind_ == &Settings::kind ? static_cast<const Settings*>(settings_.get()) : nullptr;
  }

 private:
  const Kind* kind_;
  std::shared_ptr<const void> settings_;
};

/// A function of a kind that takes its settings: `.build = erased<build>` for `build(const Adaptive&, …)`.
namespace detail {
template <auto function>
struct Erased;
template <class Result, class Settings, class... Rest, Result (*function)(const Settings&, Rest...)>
struct Erased<function> {
  static Result call(const void* settings, Rest... rest) {
    return function(*static_cast<const Settings*>(settings), std::forward<Rest>(rest)...);
  }
};
/// Throws std::invalid_argument if the name cannot be a key of a config, or if it is taken; std::logic_error
/// if it comes too late.
void check_new_name(std::string_view family, std::string_view name, std::span<const std::string_view> taken,
                    bool too_late);
}  // namespace detail
template <auto function>
inline constexpr auto erased = &detail::Erased<function>::call;

/// The kinds of a family: those listed, and then those that the program registers before anybody reads them.
template <class Kind>
class Registry {
 public:
  /// `family`: "bending model", for messages.
  Registry(std::string_view family, std::span<const Kind* const> listed)
      : family_(family), kinds_(listed.begin(), listed.end()), listed_(listed.size()) {}

  /// The kind has to stay where it is. Throws std::invalid_argument for a name that is taken or no name,
  /// std::logic_error after the first all(): tables of settings were made of them. For one thread.
  void add(const Kind& kind) {
    std::vector<std::string_view> taken;
    for (const Kind* each : kinds_) taken.push_back(each->name);
    detail::check_new_name(family_, kind.name, taken, was_read_);
    kinds_.push_back(&kind);
  }

  /// All, which from here on are all that there will be.
  std::span<const Kind* const> all() {
    was_read_.store(true, std::memory_order_relaxed);
    return kinds_;
  }
  std::span<const Kind* const> so_far() const { return kinds_; }  ///< more may be added
  std::span<const Kind* const> added() const { return std::span(kinds_).subspan(listed_); }

  /// The kind of that name, or null.
  const Kind* find(std::string_view name) {
    const auto found = std::ranges::find(all(), name, &Kind::name);
    return found == all().end() ? nullptr : *found;
  }

 private:
  std::string_view family_;
  std::vector<const Kind*> kinds_;
  std::size_t listed_;
  std::atomic<bool> was_read_{false};
};

/// The kinds of structs, in their order: listed_kinds<EffectKind, Gravity, Wind>.
template <class Kind, class... Settings>
inline constexpr std::array<const Kind*, sizeof...(Settings)> listed_kinds = {&Settings::kind...};

}  // namespace bendlab
