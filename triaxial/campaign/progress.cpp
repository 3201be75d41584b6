#include "triaxial/campaign/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "triaxial/statistics/moments.hpp"

namespace grainfield::triaxial {

std::string mean_text(std::span<const double> values) {
    const auto interval = statistics::interval_of_mean(values);
    return fmt::format("{:.2f}{}", *statistics::mean(values),
                       interval
                           ? fmt::format(" ± {:.2f}", 0.5 * (interval->upper - interval->lower))
                           : std::string());
}

Progress::Progress(const std::map<RowPlace, Row>& finished, const std::vector<Job>& todo)
    : total_(finished.size()), runs_(todo.size()), begin_(std::chrono::steady_clock::now()) {
    for (const Job& job : todo) total_ += job.rows.size();
    for (const auto& [place, row] : finished) count(row);
}

void Progress::count(const Row& row) {
    ++done_;
    failed_ += row.failed ? 1u : 0u;
    if (row.failed || row.realization == deterministic_run) return;
    E50_[row.case_name].push_back(row.E50 / 1e6);
    last_case_ = row.case_name;
}

void Progress::started() {
    const std::lock_guard lock(mutex_);
    ++running_;
}

void Progress::finished(std::span<const Row> rows) {
    const std::lock_guard lock(mutex_);
    --running_;
    ++runs_done_;
    for (const Row& row : rows) count(row);
}

void Progress::skipped(std::size_t rows) {
    const std::lock_guard lock(mutex_);
    total_ -= rows;
    --runs_;
}

std::string Progress::counts() const {
    const std::lock_guard lock(mutex_);
    return fmt::format("{} of {} rows are done, {} of them failed", done_, total_, failed_);
}

void Progress::show(core::Monitor& monitor) const {
    const std::lock_guard lock(mutex_);
    std::string line =
        fmt::format("done {} of {}, running {}, failed {}", done_, total_, running_, failed_);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
    if (runs_done_ > 0)
        line += fmt::format(", {:.0f} runs/h",
                            3600 * static_cast<double>(runs_done_) / elapsed.count());
    if (const auto at = E50_.find(last_case_); at != E50_.end() && at->second.size() > 1)
        line += fmt::format(", {}: E50 {} MPa", last_case_, mean_text(at->second));
    const double share =
        static_cast<double>(runs_done_) / static_cast<double>(std::max<std::size_t>(1, runs_));
    monitor.progress(runs_done_ > 0 ? share : -1, -1, line);
}

}  // namespace grainfield::triaxial
