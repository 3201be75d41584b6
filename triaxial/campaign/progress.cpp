#include "triaxial/campaign/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grainfield::triaxial {

Progress::Progress(const std::map<RowPlace, Row>& finished, const std::vector<Work>& todo)
    : total_(finished.size()), runs_(todo.size()), begin_(std::chrono::steady_clock::now()) {
    for (const Work& work : todo) total_ += work.rows.size();
    for (const auto& [place, row] : finished) count(row);
}

void Progress::count(const Row& row) {
    ++done_;
    failed_ += row.failed ? 1u : 0u;
    if (row.failed || row.realization == deterministic_run) return;
    E50_[row.case_name].push_back(row.E50);
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
    const double share =
        static_cast<double>(runs_done_) / static_cast<double>(std::max<std::size_t>(1, runs_));
    monitor.progress(runs_done_ > 0 ? share : -1, -1, line);
}

}  // namespace grainfield::triaxial
