// References: runs that other runs are compared with.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/config/run_config.hpp"

namespace bendlab {

/// What errors are measured against: the best solution for the run's own energies, or the stated cloth.
enum class Against { solver, physical };
inline constexpr std::array<Against, 2> references = {Against::solver, Against::physical};
/// The names of Against in settings and in metrics.
inline constexpr std::array<std::string_view, 2> against_names = {"solver", "physical"};
std::string_view name_of(Against against);
std::string reference_pointer(Against against, bool coarser);  ///< "/accuracy/solver_coarser": the setting

/// The earlier run at whose end the run `config` starts (/initial/after). The earlier run has the settings of
/// `config` with changes and without /accuracy. Nothing if `config` starts from its rest shape. The earlier
/// run is derived only once. Throws ConfigError with the problems of the changed settings.
std::optional<RunConfig> run_before(const RunConfig& config);

/// The reference of the run `config`: the run with the changes in /accuracy, and without /accuracy. If
/// `coarser`, the changes in `…_coarser` are added. Nothing if /accuracy does not state these changes. The
/// reference is derived only once. Throws ConfigError with the problems of the changed settings.
std::optional<RunConfig> reference_of(const RunConfig& config, Against against, bool coarser = false);

/// Throws ConfigError for a kind of reference that is wrong for every run: the changed settings are wrong, or
/// the reference is the run itself. If only some runs cannot have the reference (k has no energy, for
/// example), these runs report the problem themselves.
void check_references(const std::vector<RunConfig>& runs, std::string_view source_name);

}  // namespace bendlab
