#pragma once
// Runs a campaign: all of its realizations, side by side, whatever happens. A case goes one way:
//   campaign.toml -> cases  config/load_config: names and whole configs
//   cases -> jobs           plan: a run each, with the rows it fills and what it is made from
//   jobs -> starts          starts: the samples that runs share, each made once
//   jobs -> rows            run_job: one result each, for all of its rows, into the journal
//   rows -> files           campaign_folder: results.csv and the others, from all journals

#include <cstdint>
#include <map>
#include <optional>

#include "core/base/monitor.hpp"
#include "triaxial/campaign/campaign_folder.hpp"

namespace grainfield::triaxial {

struct CampaignOptions {
    int threads = 1;                      ///< in all [-]
    std::optional<std::int32_t> abreast;  ///< runs side by side; unset: as is fastest [-]
};

struct CampaignResult {
    std::map<RowPlace, Row> rows;  ///< all that are finished, other shards' too
    std::size_t computed = 0;      ///< rows that runs of this call gave [-]
};

/// Computes the rows of the folder's shard that are not there yet. Each is on the disk before the
/// next run of its thread begins; results.csv follows now and then and at the end. A run that fails
/// is a row that says so. Rows are the same whatever the threads and however often the campaign was
/// stopped. Throws Interrupted (finished rows are kept), InputError, FileError.
CampaignResult run_campaign(CampaignFolder& folder, const CampaignOptions& options,
                            core::Monitor& monitor);

}  // namespace grainfield::triaxial
