// Random settings, drawn from the tables that read configs. The tests of properties of every valid config use
// them, and so does the fuzzer that looks for configs that break these properties.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "bendlab/effects/effect.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab::test {

using Random = std::mt19937_64;

/// True with the given probability.
inline bool chance(Random& random, double probability) {
  return static_cast<double>(random() >> 11) * 0x1p-53 < probability;
}

template <class List>
const auto& one_of(Random& random, const List& list) {
  return list[random() % list.size()];
}

/// The largest value for random runs. Large values of these settings only make a run slow.
inline double largest_quick(std::string_view name, double largest) {
  constexpr std::array<std::pair<std::string_view, double>, 9> quick = {{{"cells", 8},
                                                                         {"substeps", 8},
                                                                         {"iterations", 8},
                                                                         {"threads", 2},
                                                                         {"creases", 8},
                                                                         {"folds", 4},
                                                                         {"ring", 4},
                                                                         {"frames_per_second", 1000},
                                                                         {"seed", 1000}}};
  const auto limit = std::ranges::find(quick, name, &std::pair<std::string_view, double>::first);
  return limit == quick.end() ? largest : std::min(largest, limit->second);
}

/// A number that the row allows: often an end of its range. If the range has no end, the number comes from
/// twelve powers of ten.
inline double random_number(const Field& row, Random& random) {
  const double highest = largest_quick(row.name, row.maximum);
  const bool low = std::isfinite(row.minimum), high = std::isfinite(highest);
  const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
  if (low && chance(random, 0.15) && !row.above) return row.minimum;
  if (high && chance(random, 0.15)) return highest;
  const double least = std::max(row.minimum, row.above && high ? 1e-3 * highest : row.minimum);
  if (low && high && (highest < 1e4 || chance(random, 0.5))) return least + unit * (highest - least);
  const double size = std::pow(10, -6 + 12 * unit);
  if (!low) return chance(random, 0.15) ? 0 : chance(random, 0.5) ? size : -size;
  return std::min(row.minimum + size, highest);
}

/// A value that the row allows. null for a free text: such a text names a file or a change of settings.
inline Json random_value(const Field& row, Random& random) {
  const auto entries = [&](auto entry) {
    Json list = Json::array();
    const std::size_t count = row.length > 0 ? row.length : random() % 4;
    for (std::size_t i = 0; i < count; ++i) list.push_back(entry());
    return list;
  };
  const auto whole = [&] {
    return static_cast<std::int64_t>(std::ceil(std::min(random_number(row, random), 1e15)));
  };
  switch (row.type) {
    case FieldType::boolean:
      return chance(random, 0.5);
    case FieldType::integer:
      return whole();
    case FieldType::number:
      return random_number(row, random);
    case FieldType::text:
      return row.choices.empty() ? Json(nullptr) : Json(one_of(random, row.choices));
    case FieldType::integers:
      return entries([&] { return random() % 9; });
    case FieldType::numbers:
      return entries([&] { return random_number(row, random); });
    case FieldType::texts:
      if (row.choices.empty()) return nullptr;
      return entries([&] { return one_of(random, row.choices); });
  }
  return nullptr;
}

/// A value for the setting at a pointer.
struct Change {
  std::string pointer;
  Json value;
};

/// An effect that reads no file, with a random part of its settings.
inline Json random_effect(Random& random) {
  for (;;) {
    const EffectKind& effect = *one_of(random, effects());
    if (std::ranges::any_of(effect.settings.fields, &Field::names_file)) continue;
    Json entry = {{"type", effect.name}};
    for (const Field& row : effect.settings.fields)
      if (row.required || chance(random, 0.4)) entry[std::string(row.name)] = random_value(row, random);
    return entry;
  }
}

/// Changes one setting of a section, or the list of effects. For a setting of a bending model, the model is
/// changed with it.
inline std::vector<Change> random_changes(Random& random) {
  if (chance(random, 0.2)) {
    Json list = Json::array();
    if (chance(random, 0.7)) list.push_back({{"type", "gravity"}});
    for (std::size_t count = random() % 3; count > 0; --count) list.push_back(random_effect(random));
    return {{"/effects", std::move(list)}};
  }
  const Section& section = one_of(random, config_sections());
  if (section.rows.empty()) return {};
  const Field& row = one_of(random, section.rows).field;
  if (section.pointer.empty() && (row.name == "name" || row.name == "description" || row.name == "allow"))
    return {};
  std::vector<Change> changes = {{child_pointer(section.pointer, row.name), random_value(row, random)}};
  if (changes.front().value.is_null()) return {};
  if (section.pointer.starts_with("/bending/"))
    changes.push_back({"/bending/model", std::string(section_key(section))});
  return changes;
}

}  // namespace bendlab::test
