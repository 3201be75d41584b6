#include "triaxial/campaign/plan.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "triaxial/campaign/row.hpp"

namespace grainfield::triaxial {

std::vector<Job> plan_campaign(const std::vector<CampaignCase>& cases, const Shard& shard) {
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
    std::map<std::pair<std::string, std::int64_t>, std::size_t> known;
    const auto add = [&](std::size_t c, std::int64_t realization) {
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
