#include "triaxial/campaign/campaign_folder.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/base/errors.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/folder.hpp"
#include "core/files/json_text.hpp"
#include "core/files/text_file.hpp"
#include "core/kernel_choice.hpp"
#include "triaxial/campaign/stopping.hpp"
#include "triaxial/cli/interrupt.hpp"
#include "triaxial/config/campaign_keys.hpp"
#include "triaxial/config/write_config.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

/// A case's name as part of the name of a file, whatever another folder's journal calls a case.
std::string file_name(const std::string& name) {
    std::string file = case_file_name(name);
    std::replace(file.begin(), file.end(), '/', '_');
    return file;
}

/// The cases of a folder must not share files, those of an earlier call included.
void check_file_names(const nlohmann::json& cases) {
    std::map<std::string, std::string> names;
    for (const auto& [name, one] : cases.items()) {
        const auto [other, is_new] = names.try_emplace(file_name(name), name);
        if (!is_new)
            throw InputError(
                fmt::format("the cases \"{}\" and \"{}\" would share their files: one of them is "
                            "in the folder already; names must differ in more than blanks and _",
                            other->second, name));
    }
}

std::string case_text(const CampaignCase& one) {
    Config config = one.config;
    config.montecarlo = {};
    return write_config(config);
}

/// "AMD EPYC ..., 2 threads", as far as the system says.
std::string machine() {
    std::string name = "unknown processor";
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) {
            name = core::trim(std::string_view(line).substr(line.find(':') + 1));
            break;
        }
    return fmt::format("{}, {} threads", name, std::thread::hardware_concurrency());
}

std::string hash_of(const fs::path& file) {
    const std::string bytes = core::read_whole_file(file);
    return fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

/// AVX2 and AVX-512 give the same bits.
bool fused(const kernels::KernelTable& kernels) {
    return kernels.isa != kernels::InstructionSet::scalar;
}

/// What the bits of a case's results depend on: instruction sets that give the same ones have one
/// name.
std::string kernels_text(const kernels::KernelTable& kernels) {
    return fmt::format("{}, {}", fused(kernels) ? "avx2 or avx512" : kernels::name(kernels.isa),
                       kernels.precision);
}

/// A case's config for comparing: which of those instruction sets is asked for is no matter.
std::string comparable_text(CampaignCase one, const kernels::KernelTable& kernels) {
    if (fused(kernels)) one.config.solver.isa = {};
    return case_text(one);
}

/// What identifies a campaign, case by case.
nlohmann::json identity_of(const std::vector<CampaignCase>& cases,
                           const std::optional<fs::path>& packing) {
    nlohmann::json json{{"version", GRAINFIELD_VERSION}, {"cases", nlohmann::json::object()}};
    if (packing) json["packing"] = hash_of(*packing);
    for (const CampaignCase& one : cases) {
        const kernels::KernelTable& kernels = core::choose_kernels(one.config.solver);
        json["cases"][one.name] = {{"kernels", kernels_text(kernels)},
                                   {"config", comparable_text(one, kernels)}};
        const randomfield::FieldOptions& field = one.config.field;
        if (!field.data.empty() && field.variable != randomfield::Variable::none)
            json["cases"][one.name]["data"] = hash_of(field.data);
    }
    return json;
}

nlohmann::json read_json(const fs::path& file) {
    const std::string text = core::read_whole_file(file);
    auto json = core::nested_too_deep(text) ? nlohmann::json()
                                            : nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("cases") || !json["cases"].is_object())
        throw FileError(fmt::format("{}: damaged; it is not what a campaign wrote", file.string()));
    return json;
}

/// First line in which two texts differ: "there ..., here ...".
std::string difference(const std::string& there, const std::string& here) {
    core::LineReader a(there), b(here);
    for (std::string_view x, y; a.next(x) && b.next(y);)
        if (x != y) return fmt::format("there {}, here {}", x, y);
    return "there is more in the one than in the other";
}

/// Throws unless both are parts of one campaign.
void compare(const nlohmann::json& there, const nlohmann::json& here, const fs::path& folder) {
    const auto differ = [&](const std::string& what) {
        return InputError(fmt::format("{} belongs to another campaign: {}; give another folder",
                                      folder.string(), what));
    };
    const auto text = [](const nlohmann::json& json, const char* key) {
        return json.contains(key) ? json.at(key).dump() : std::string("none");
    };
    for (const char* key : {"version", "packing"})
        if (text(there, key) != text(here, key))
            throw differ(
                fmt::format("{} there {}, here {}", key, text(there, key), text(here, key)));
    for (const auto& [name, one] : here["cases"].items()) {
        if (!there["cases"].contains(name)) continue;
        const nlohmann::json& other = there["cases"][name];
        if (other["config"] != one["config"])
            throw differ(
                fmt::format("case \"{}\": {}", name, difference(other["config"], one["config"])));
        if (text(other, "data") != text(one, "data"))
            throw differ(fmt::format(
                "case \"{}\": the values in the file of field.data were others there", name));
        if (other["kernels"] != one["kernels"])
            throw differ(
                fmt::format("case \"{}\" is computed there by {}, here by {} (--isa chooses)", name,
                            other["kernels"].dump(), one["kernels"].dump()));
    }
}

std::string journal_name(const Shard& shard) {
    return fmt::format("rows-{}-of-{}.journal", shard.shard, shard.shards);
}

std::vector<Row> read_journals(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".journal") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<Row> rows;
    for (const fs::path& file : files)
        for (Row& row : read_journal(file)) rows.push_back(std::move(row));
    return rows;
}

fs::path made(fs::path folder) {
    core::create_folder(folder);
    return folder;
}

}  // namespace

CampaignFolder::CampaignFolder(fs::path path, const std::vector<CampaignCase>& cases,
                               const std::optional<fs::path>& packing, const Shard& shard)
    : path_(made(std::move(path))),
      cases_(cases),
      packing_(packing),
      shard_(shard),
      locks_(lock_shard(path_, shard)),
      journal_(path_ / journal_name(shard)) {
    for (std::size_t c = 0; c < cases.size(); ++c) case_index_[cases[c].name] = c;
    for (const char* folder : {".", "cases", "packings", "starts", "failed"})
        core::remove_abandoned_files(path_ / folder);
    check_identity();
}

std::vector<FileLock> CampaignFolder::lock_shard(const fs::path& folder, const Shard& shard) {
    std::vector<FileLock> locks;
    const auto take = [&](const fs::path& file, FileLock::Kind kind) {
        auto lock = FileLock::try_lock(file, kind);
        if (!lock) {
            const std::string holder = lock_holder(file);
            throw InputError(
                fmt::format("{}: {} works on this campaign already; it has to end first",
                            folder.string(), holder.empty() ? "another process" : holder));
        }
        locks.push_back(std::move(*lock));
    };
    const bool alone = shard.shards == 1;
    take(folder / "campaign.lock", alone ? FileLock::Kind::alone : FileLock::Kind::shared);
    if (!alone)
        take(folder / fmt::format("shard-{}-of-{}.lock", shard.shard, shard.shards),
             FileLock::Kind::alone);
    return locks;
}

/// Only one process at a time writes what the shards have in common.
FileLock CampaignFolder::lock_results() const {
    return FileLock::wait_for(path_ / "results.lock", [] {
        if (interrupt_requested()) throw Interrupted("stopped by the user");
    });
}

void CampaignFolder::check_identity() const {
    nlohmann::json here = identity_of(cases_, packing_);
    const FileLock lock = lock_results();
    const fs::path file = path_ / "campaign.json";
    if (fs::exists(file)) {
        const nlohmann::json there = read_json(file);
        compare(there, here, path_);
        for (const auto& [name, one] : there["cases"].items())
            if (!here["cases"].contains(name)) here["cases"][name] = one;
        check_file_names(here["cases"]);
        here["machines"] = there.value("machines", nlohmann::json::array());
        nlohmann::json& machines = here["machines"];
        if (std::find(machines.begin(), machines.end(), nlohmann::json(machine())) ==
            machines.end())
            machines.push_back(machine());
        if (here == there) {
            write_cases(false);
            return;
        }
    } else {
        here["machines"] = nlohmann::json::array({machine()});
    }
    core::write_file_atomically(file, here.dump(2) + "\n");
    write_cases(true);
}

/// A kill may have come between campaign.json and these: what is missing is written whenever the
/// folder is opened.
void CampaignFolder::write_cases(bool all) const {
    core::create_folder(path_ / "cases");
    for (const CampaignCase& one : cases_) {
        const fs::path file = path_ / "cases" / (file_name(one.name) + ".toml");
        if (!all && fs::exists(file)) continue;
        core::write_file_atomically(
            file, fmt::format("# Row K of this case: grainfield triaxial with this file, --packing "
                              "starts/{}.h5 --realization K\n",
                              start_inputs(one.config).hash) +
                      case_text(one));
    }
}

std::map<RowPlace, Row> CampaignFolder::finished() const {
    std::map<RowPlace, Row> rows;
    for (Row& row : read_journals(path_)) {
        const auto at = case_index_.find(row.case_name);
        if (at == case_index_.end()) continue;  // a case of this folder, not of this call
        const MonteCarloOptions& wanted = cases_[at->second].config.montecarlo;
        const bool deterministic = row.realization == deterministic_run;
        if (deterministic ? !wanted.deterministic : row.realization >= wanted.realizations)
            continue;
        rows.try_emplace({at->second, row.realization}, std::move(row));
    }
    Stopping stopping(cases_);
    for (const auto& [place, row] : rows) stopping.add(place, row);
    std::erase_if(rows, [&](const auto& entry) { return !stopping.wants(entry.first); });
    return rows;
}

std::size_t CampaignFolder::merge(const fs::path& other) {
    compare(read_json(other / "campaign.json"), read_json(path_ / "campaign.json"), other);
    std::vector<Row> there = read_journals(other), mine = read_journals(path_), missing;
    std::sort(mine.begin(), mine.end(), row_before);
    std::sort(there.begin(), there.end(), row_before);
    const auto same = [](const Row& a, const Row& b) {
        return !row_before(a, b) && !row_before(b, a);
    };
    there.erase(std::unique(there.begin(), there.end(), same), there.end());
    for (const Row& row : there) {
        if (std::binary_search(mine.begin(), mine.end(), row, row_before)) continue;
        if (row.failed && fs::exists(other / state_name(row))) {
            core::create_folder(path_ / "failed");
            core::write_file_atomically(path_ / state_name(row),
                                        core::read_whole_file(other / state_name(row)));
        }
        missing.push_back(row);
    }
    journal_.append(missing);
    return missing.size();
}

fs::path CampaignFolder::state_name(const Row& row) {
    return fs::path("failed") / fmt::format("{}-{}.h5", file_name(row.case_name), row.realization);
}

SweptColumns CampaignFolder::swept_columns() const {
    std::set<std::string> keys;
    for (const CampaignCase& one : cases_) keys.insert(one.swept.begin(), one.swept.end());
    SweptColumns swept{{keys.begin(), keys.end()}, {}};
    for (const CampaignCase& one : cases_)
        swept.values[one.name] = table_texts(one.config, swept.keys);
    return swept;
}

std::map<RowPlace, Row> CampaignFolder::write_results() const {
    const FileLock lock = lock_results();
    std::map<RowPlace, Row> all = finished();
    std::vector<Row> rows, deterministic;
    std::string failures = "case,realization,reason,state\n";
    for (const auto& [place, row] : all)
        (place.realization == deterministic_run ? deterministic : rows).push_back(row);
    for (auto* part : {&deterministic, &rows}) {
        std::sort(part->begin(), part->end(), row_before);
        for (const Row& row : *part) {
            if (!row.failed) continue;
            const bool kept = fs::exists(path_ / state_name(row));
            failures += fmt::format("{},{},{},{}\n", row.case_name, row.realization,
                                    quoted_field(row.reason), kept ? state_name(row).string() : "");
        }
    }
    const SweptColumns swept = swept_columns();
    core::write_file_atomically(path_ / "results.csv", rows_csv(rows, swept));
    core::write_file_atomically(path_ / "deterministic.csv", rows_csv(deterministic, swept));
    core::write_file_atomically(path_ / "failures.csv", failures);
    deterministic.insert(deterministic.end(), rows.begin(), rows.end());
    core::write_file_atomically(path_ / "warnings.csv", warnings_csv(deterministic));
    return all;
}

}  // namespace grainfield::triaxial
