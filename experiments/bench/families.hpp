// The families of benchmark cases.
#pragma once

#include "experiments/bench/bench.hpp"

namespace bendlab {

/// Strain, crossover springs, dense rings and whole steps on a cloth that moves; the oracle beside them.
std::vector<BenchCase> cloth_cases(const BenchOptions& options);

/// Time of each effect's passes in a step, per vertex and per action, over sizes.
std::vector<BenchCase> effect_cases(const BenchOptions& options);

/// An iteration of each solver method, per vertex, over sizes; gradient and solve of quasi_newton apart.
std::vector<BenchCase> method_cases(const BenchOptions& options);

/// Rings, pairs, colours and batches of `adaptive`: seconds and peak memory.
std::vector<BenchCase> set_up_cases(const BenchOptions& options);

/// Recording beside stepping, and a sweep with one job and with two.
std::vector<BenchCase> run_cases(const BenchOptions& options);

/// Strain error after the same number of sweeps, order `colour` against `mesh`.
std::vector<BenchCase> convergence_cases(const BenchOptions& options);

}  // namespace bendlab
