// The runs that others are compared with.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/config/run_config.hpp"

namespace bendlab {

/// What the errors of a run are measured against: the best solution of its own energies, or the stated cloth.
enum class Against { solver, physical };
inline constexpr std::array<Against, 2> references = {Against::solver, Against::physical};
/// Their names in settings and errors.
inline constexpr std::array<std::string_view, 2> against_names = {"solver", "physical"};
std::string_view name_of(Against against);
std::string reference_pointer(Against against, bool coarser);  ///< "/accuracy/solver_coarser": the setting

/// The run that this one starts after (/initial/after): itself with settings changed, and no errors; nothing
/// where it starts from its rest shape. It is derived once. Throws ConfigError with what is wrong in the
/// changed settings.
std::optional<RunConfig> run_before(const RunConfig& config);

/// The reference that /accuracy asks for: this run with settings changed; if `coarser`, with those of
/// `…_coarser` too. Nothing if it asks for none. It is derived once. Throws ConfigError with what is wrong in
/// the changed settings.
std::optional<RunConfig> reference_of(const RunConfig& config, Against against, bool coarser = false);

/// Throws ConfigError if every run's reference of a kind is wrong, or is the run itself: a mistake of the
/// config. One that only some runs cannot have (k has no energy) is reported by those runs.
void check_references(const std::vector<RunConfig>& runs, std::string_view source_name);

}  // namespace bendlab
