#include "triaxial/campaign/plan.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <map>
#include <utility>

#include "triaxial/campaign/row.hpp"
#include "triaxial/config/write_config.hpp"

namespace grainfield::triaxial {
namespace {

/// The config of a run: what does not change it is left as it comes by default.
Config run_config(const Config& config, bool deterministic) {
    Config run = config;
    run.montecarlo = {};
    if (deterministic) run.field.variable = randomfield::Variable::none;
    if (run.field.variable == randomfield::Variable::none) run.field = {};
    return run;
}

}  // namespace

std::vector<Work> plan_campaign(const std::vector<CampaignCase>& cases, const Shard& shard) {
    struct Run {
        std::shared_ptr<const Config> config;
        std::string hash;
    };
    std::vector<Run> random, deterministic;
    std::int64_t most = 0;
    for (const CampaignCase& one : cases) {
        for (auto* runs : {&random, &deterministic}) {
            auto config =
                std::make_shared<const Config>(run_config(one.config, runs == &deterministic));
            std::string hash = config_hash(*config);
            runs->push_back({std::move(config), std::move(hash)});
        }
        most = std::max<std::int64_t>(most, one.config.montecarlo.realizations);
    }
    std::vector<Work> plan;
    std::map<std::pair<std::string, std::int64_t>, std::size_t> known;
    const auto add = [&](std::size_t c, std::int64_t realization) {
        const Run& run = realization == deterministic_run ? deterministic[c] : random[c];
        const bool varies = run.config->field.variable != randomfield::Variable::none;
        const std::int64_t field = varies ? realization : 0;
        const auto [at, is_new] = known.try_emplace({run.hash, field}, plan.size());
        if (is_new) plan.push_back({run.config, field, {}});
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

Config packing_part(const Config& config) {
    Config part = config;
    part.field = {};
    part.triaxial = {};
    part.montecarlo = {};
    return part;
}

Config start_part(const Config& config) {
    Config part = packing_part(config);
    part.triaxial.confining_stress = config.triaxial.confining_stress;
    part.triaxial.gravity = config.triaxial.gravity;
    return part;
}

std::string config_hash(const Config& config) {
    const std::string text = write_config(config);
    return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

}  // namespace grainfield::triaxial
