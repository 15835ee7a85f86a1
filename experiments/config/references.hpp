// References: runs that other runs are compared with.
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
/// The names of Against in settings and in metrics.
inline constexpr std::array<std::string_view, 2> against_names = {"solver", "physical"};
std::string_view name_of(Against against);
std::string reference_pointer(Against against, bool coarser);  ///< "/accuracy/solver_coarser": the setting

/// The run after whose end `config` starts (/initial/after): the same run with changed settings and without
/// errors. Nothing if `config` starts from its rest shape. The run is derived only once. Throws ConfigError
/// with the problems of the changed settings.
std::optional<RunConfig> run_before(const RunConfig& config);

/// The reference that /accuracy asks for: `config` with changed settings, and without errors; if `coarser`,
/// with the changes of `…_coarser`, too. Nothing if /accuracy asks for no such reference. The reference is
/// derived only once. Throws ConfigError with the problems of the changed settings.
std::optional<RunConfig> reference_of(const RunConfig& config, Against against, bool coarser = false);

/// Throws ConfigError if no run has a valid reference of a kind, because its settings are wrong or the
/// reference is the run itself: this is a mistake in the config. If only some runs cannot have the reference
/// (k has no energy, for example), these runs report it themselves.
void check_references(const std::vector<RunConfig>& runs, std::string_view source_name);

}  // namespace bendlab
