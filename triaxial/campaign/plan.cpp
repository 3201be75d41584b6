#include "triaxial/campaign/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "triaxial/campaign/row.hpp"

namespace grainfield::triaxial {
namespace {

constexpr std::int64_t rows_a_look = 1024;  // at the monitor, between two

void require_room(const std::vector<CampaignCase>& cases, const Shard& shard) {
    std::int64_t rows = 0;
    for (const CampaignCase& one : cases)
        rows += one.config.montecarlo.realizations / shard.shards + 1;
    if (rows > most_rows)
        throw InputError(fmt::format(
            "montecarlo.realizations: the {} cases have {} rows in this shard: at most {} are "
            "allowed; give fewer realizations or cases, or more shards (--shard I/N)",
            cases.size(), rows, most_rows));
}

}  // namespace

std::vector<Job> plan_campaign(const std::vector<CampaignCase>& cases, const Shard& shard,
                               const core::Monitor& monitor) {
    require_room(cases, shard);
    const auto shared = [](Inputs inputs) {
        return std::make_shared<const Inputs>(std::move(inputs));
    };
    std::vector<std::shared_ptr<const Inputs>> random, deterministic, starts;
    std::int64_t most = 0;
    for (const CampaignCase& one : cases) {
        random.push_back(shared(run_inputs(one.config, false)));
        deterministic.push_back(shared(run_inputs(one.config, true)));
        starts.push_back(shared(start_inputs(one.config)));
        most = std::max<std::int64_t>(most, one.config.montecarlo.realizations);
    }
    std::vector<Job> plan;
    std::int64_t added = 0;
    std::map<std::pair<std::string, std::int64_t>, std::size_t> known;
    const auto add = [&](std::size_t c, std::int64_t realization) {
        if (++added % rows_a_look == 0 && monitor.stop_requested())
            throw Interrupted("stopped by the user while the campaign was planned");
        const auto& run = (realization == deterministic_run ? deterministic : random)[c];
        const bool varies = run->config.field.variable != randomfield::Variable::none;
        const std::int64_t field = varies ? realization : 0;
        const auto [at, is_new] = known.try_emplace({run->hash, field}, plan.size());
        if (is_new) plan.push_back({run, starts[c], field, {}});
        plan[at->second].rows.push_back({c, realization});
    };
    if (shard.shard == 1)
        for (std::size_t c = 0; c < cases.size(); ++c)
            if (cases[c].config.montecarlo.deterministic) add(c, deterministic_run);
    for (std::int64_t k = shard.shard - 1; k < most; k += shard.shards)
        for (std::size_t c = 0; c < cases.size(); ++c)
            if (k < cases[c].config.montecarlo.realizations) add(c, k);
    return plan;
}

}  // namespace grainfield::triaxial
