#pragma once
// How far a campaign is: rows done, running and failed, rate, time left, and what comes out.

#include <chrono>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/base/monitor.hpp"
#include "triaxial/campaign/plan.hpp"
#include "triaxial/campaign/row.hpp"

namespace grainfield::triaxial {

/// "24.12 ± 0.31": the mean and half its 95 % interval, which one value has not.
std::string mean_text(std::span<const double> values);

/// Safe to use from many threads.
class Progress {
  public:
    /// `finished` are the rows that were there before, `todo` the runs to come.
    Progress(const std::map<RowPlace, Row>& finished, const std::vector<Job>& todo);

    void started();
    void finished(std::span<const Row> rows);
    void skipped(std::size_t rows);  ///< a run that is not needed any more
    void show(core::Monitor& monitor) const;
    /// "12 of 250 rows are done, 1 of them failed".
    std::string counts() const;

  private:
    void count(const Row& row);

    mutable std::mutex mutex_;
    std::size_t total_ = 0, done_ = 0, failed_ = 0, running_ = 0;
    std::size_t runs_ = 0, runs_done_ = 0;  // of this call
    std::chrono::steady_clock::time_point begin_;
    std::map<std::string, std::vector<double>> E50_;  // of each case [MPa]
    std::string last_case_;
};

}  // namespace grainfield::triaxial
