#pragma once
// The folder of a campaign: who works in it, what belongs to it, and its results.
//
//   campaign.json          every case with its whole config and kernels; machines that worked on it
//   cases/NAME.toml        the same for `grainfield triaxial`
//   *.journal              finished rows, one file a shard (journal.hpp)
//   results.csv            all of them, sorted
//   deterministic.csv      those of deterministic runs
//   failures.csv, failed/  case, realization, reason of runs that failed; their states
//   warnings.csv           what makes numbers of runs doubtful
//   packings/, starts/     samples that runs start from (starts.hpp)

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "triaxial/campaign/file_lock.hpp"
#include "triaxial/campaign/journal.hpp"
#include "triaxial/campaign/plan.hpp"

namespace grainfield::triaxial {

class CampaignFolder {
  public:
    /// Takes the folder for one shard, or for all of the campaign. Makes it if it is new; else
    /// checks that it belongs to this campaign: cases may be added and the number of realizations
    /// changed, nothing else. `packing` is the file all runs start from, if one is given.
    /// `cases` must outlive the folder. InputError: another process works in it, or it belongs to
    /// another campaign; FileError.
    CampaignFolder(std::filesystem::path path, const std::vector<CampaignCase>& cases,
                   const std::optional<std::filesystem::path>& packing, const Shard& shard);

    const std::filesystem::path& path() const { return path_; }
    const std::vector<CampaignCase>& cases() const { return cases_; }
    const std::optional<std::filesystem::path>& packing() const { return packing_; }
    const Shard& shard() const { return shard_; }
    /// Finished rows of this campaign, whichever shard they are from, read anew; only those that
    /// the config asks for (stopping.hpp).
    std::map<RowPlace, Row> finished() const;
    /// Adds finished rows; they are on the disk when it returns.
    void append(std::span<const Row> rows) { journal_.append(rows); }
    /// Takes the rows of another folder of the same campaign over. Returns how many were new.
    /// InputError: it belongs to another campaign.
    std::size_t merge(const std::filesystem::path& other);
    /// Writes results.csv, deterministic.csv, failures.csv and warnings.csv from all journals.
    /// Returns finished().
    std::map<RowPlace, Row> write_results() const;
    /// Where the state of a failed run goes, within the folder.
    static std::filesystem::path state_name(const Row& row);

  private:
    static std::vector<FileLock> lock_shard(const std::filesystem::path& folder,
                                            const Shard& shard);
    FileLock lock_results() const;
    SweptColumns swept_columns() const;
    /// Throws if the folder is another campaign's; else writes campaign.json and cases/.
    void check_identity() const;
    void write_cases(bool all) const;  // else those that are missing

    std::filesystem::path path_;
    const std::vector<CampaignCase>& cases_;
    std::optional<std::filesystem::path> packing_;
    Shard shard_;
    std::map<std::string, std::size_t> case_index_;
    std::vector<FileLock> locks_;
    Journal journal_;
};

}  // namespace grainfield::triaxial
