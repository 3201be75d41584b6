#pragma once
// One job of a campaign: a run.

#include <atomic>
#include <filesystem>

#include "triaxial/campaign/plan.hpp"
#include "triaxial/campaign/row.hpp"
#include "triaxial/campaign/starts.hpp"

namespace grainfield::triaxial {

/// Draws the field, maps it onto the run's start and shears, on the threads that OpenMP gives the
/// caller. The same as `grainfield triaxial` with the start as its packing. A run that fails,
/// or has no start, returns a row that says why and leaves its state in `failed_state`. The row's
/// case and realization are left to the caller. Throws Interrupted once `stop` is true, and what
/// has nothing to do with this run alone (files, memory).
Row run_job(const Job& job, const Starts& starts, const std::filesystem::path& failed_state,
            const std::atomic<bool>& stop);

}  // namespace grainfield::triaxial
