#pragma once
// What a campaign has to do: which runs there are, and which rows each of them fills.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/monitor.hpp"
#include "triaxial/campaign/inputs.hpp"
#include "triaxial/config/load_config.hpp"

namespace grainfield::triaxial {

/// Which of the realizations a process works on: those with realization mod shards = shard - 1.
struct Shard {
    std::int32_t shard = 1;   ///< from 1
    std::int32_t shards = 1;  ///< how many there are
};

/// A row by its place in the campaign.
struct RowPlace {
    std::size_t case_index = 0;
    std::int64_t realization = 0;

    auto operator<=>(const RowPlace&) const = default;
};

/// A job: one run and the rows that it fills. Runs without a random field are the same for all
/// realizations and for all cases that differ in their fields only.
struct Job {
    std::shared_ptr<const Inputs> inputs;
    std::shared_ptr<const Inputs> start;  ///< those of its start
    std::int64_t realization = 0;         ///< of the field [-]
    std::vector<RowPlace> rows;
};

/// All runs of a shard, realization by realization, so that every case grows alike; deterministic
/// runs, if the campaign wants them, come first and belong to the first shard. InputError: the
/// shard has more than most_rows; Interrupted where the monitor asks to stop.
std::vector<Job> plan_campaign(const std::vector<CampaignCase>& cases, const Shard& shard,
                               const core::Monitor& monitor = {});

/// Rows of a shard, at most: they are all in memory [-].
inline constexpr std::int64_t most_rows = 10'000'000;

}  // namespace grainfield::triaxial
