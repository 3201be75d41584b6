#include "triaxial/campaign/campaign.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <future>
#include <mutex>
#include <system_error>
#include <thread>

#include "core/base/errors.hpp"
#include "triaxial/campaign/progress.hpp"
#include "triaxial/campaign/run_job.hpp"
#include "triaxial/campaign/starts.hpp"
#include "triaxial/campaign/stopping.hpp"

namespace grainfield::triaxial {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto look_interval = std::chrono::milliseconds(200);
constexpr auto results_interval = std::chrono::seconds(20);

/// The rows of a run, as the folder keeps them.
std::vector<Row> rows_of(const Job& job, const Row& result,
                         const std::vector<CampaignCase>& cases) {
    std::vector<Row> rows;
    for (const RowPlace& place : job.rows) {
        Row row = result;
        row.case_name = cases[place.case_index].name;
        row.realization = place.realization;
        row.seed = cases[place.case_index].config.field.seed;
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string no_threads(const std::system_error& error, int wanted) {
    return fmt::format(
        "{} threads cannot be created: {}; lower --abreast or --threads, or raise the limits "
        "(ulimit -u, ulimit -v)",
        wanted, error.what());
}

/// Workers that share the threads: each takes the next job that nobody has taken.
class WorkerPool {
  public:
    WorkerPool(CampaignFolder& folder, const Starts& starts, std::vector<Job> todo,
               const std::map<RowPlace, Row>& finished)
        : folder_(folder), starts_(starts), todo_(std::move(todo)), stopping_(folder.cases()) {
        learn(finished);
    }

    /// Works until all is done, something broke, or the monitor asks to stop.
    void run(int abreast, int threads, Progress& progress, core::Monitor& monitor) {
        std::vector<std::jthread> workers;
        working_ = abreast;
        try {
            for (int w = 0; w < abreast; ++w)
                workers.emplace_back([this, threads, &progress] { work(threads, progress); });
            supervise(progress, monitor);
        } catch (const std::system_error& error) {
            stop_ = true;
            throw InputError(no_threads(error, abreast));
        } catch (...) {  // or the workers would go on to the end
            stop_ = true;
            throw;
        }
        workers.clear();
        if (error_) std::rethrow_exception(error_);
    }
    bool stopped() const { return stop_; }
    std::size_t computed() const { return computed_; }

  private:
    /// Until all workers have ended: shows progress, writes results now and then.
    void supervise(Progress& progress, core::Monitor& monitor) {
        auto written = Clock::now();
        std::unique_lock lock(mutex_);
        while (!changed_.wait_for(lock, look_interval, [this] { return working_ == 0; })) {
            if (monitor.stop_requested()) stop_ = true;
            progress.show(monitor);
            if (Clock::now() - written < results_interval) continue;
            lock.unlock();
            const std::map<RowPlace, Row> finished = folder_.write_results();
            lock.lock();
            learn(finished);
            written = Clock::now();
        }
    }

    /// One worker, on so many threads.
    void work(int threads, Progress& progress) {
        omp_set_num_threads(threads);
        tbb::task_arena arena(threads);
        try {
            while (const Job* job = next(progress)) {
                const Row first = rows_of(*job, {}, folder_.cases()).front();
                const auto state = folder_.path() / CampaignFolder::state_name(first);
                Row result;
                arena.execute([&] { result = run_job(*job, starts_, state, stop_); });
                finish(*job, result, progress);
            }
        } catch (const Interrupted&) {  // stop_ is set already
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!error_) error_ = std::current_exception();
            stop_ = true;
        }
        const std::lock_guard lock(mutex_);
        --working_;
        changed_.notify_all();
    }

    const Job* next(Progress& progress) {
        const std::lock_guard lock(mutex_);
        while (!stop_ && taken_ < todo_.size()) {
            const Job& job = todo_[taken_++];
            if (std::ranges::any_of(job.rows,
                                    [&](const RowPlace& p) { return stopping_.wants(p); })) {
                progress.started();
                return &job;
            }
            progress.skipped(job.rows.size());
        }
        return nullptr;
    }

    void finish(const Job& job, const Row& result, Progress& progress) {
        const std::vector<Row> rows = rows_of(job, result, folder_.cases());
        const std::lock_guard lock(mutex_);
        folder_.append(rows);
        progress.finished(rows);
        computed_ += rows.size();
        for (std::size_t r = 0; r < rows.size(); ++r) stopping_.add(job.rows[r], rows[r]);
    }

    /// What other shards have found out counts, too.
    void learn(const std::map<RowPlace, Row>& finished) {
        for (const auto& [place, row] : finished) stopping_.add(place, row);
    }

    CampaignFolder& folder_;
    const Starts& starts_;
    std::vector<Job> todo_;
    Stopping stopping_;
    std::size_t taken_ = 0, computed_ = 0;
    int working_ = 0;  // workers
    std::atomic<bool> stop_ = false;
    std::exception_ptr error_;
    std::mutex mutex_;
    std::condition_variable changed_;
};

/// Threads that a run gets if nobody says otherwise. Measured on two cores: two runs of 5,616
/// spheres side by side take 0.6 of the time of one after the other on two threads each, of 18,954
/// spheres 0.74, of 151,632 spheres, two of which do not fit the caches, 1.1.
int threads_a_run(std::size_t spheres) {
    return spheres < 100000 ? 1 : 2;
}

/// What is left of a plan. Rows whose run another row has already made are taken from it.
std::vector<Job> left_of(std::vector<Job> plan, const std::map<RowPlace, Row>& finished,
                         CampaignFolder& folder) {
    std::vector<Job> todo;
    for (Job& job : plan) {
        const auto known = std::find_if(job.rows.begin(), job.rows.end(),
                                        [&](const RowPlace& p) { return finished.contains(p); });
        if (known == job.rows.end()) {
            todo.push_back(std::move(job));
            continue;
        }
        const Row result = finished.at(*known);
        std::erase_if(job.rows, [&](const RowPlace& p) { return finished.contains(p); });
        folder.append(rows_of(job, result, folder.cases()));
    }
    return todo;
}

}  // namespace

CampaignResult run_campaign(CampaignFolder& folder, const CampaignOptions& options,
                            core::Monitor& monitor) {
    std::vector<Job> todo =
        left_of(plan_campaign(folder.cases(), folder.shard(), monitor), folder.finished(), folder);
    Starts starts(folder.path(), folder.packing());
    // In a thread that ends: OpenMP counts its team as long as it lives, and teams that together
    // have more threads than there are cores go to sleep at every barrier.
    std::future<void> prepared;
    try {
        prepared = std::async(std::launch::async, [&] {
            omp_set_num_threads(options.threads);
            for (const Job& job : todo) starts.prepare(*job.start, monitor);
        });
    } catch (const std::system_error& error) {
        throw InputError(no_threads(error, 1));
    }
    prepared.get();

    const int runs = static_cast<int>(std::min<std::size_t>(todo.size(), 1024));
    const int usual = std::max(1, options.threads / threads_a_run(starts.largest()));
    const int abreast = std::max(1, std::min(options.abreast.value_or(usual), runs));
    const int threads = std::max(1, options.threads / abreast);
    const std::map<RowPlace, Row> finished = folder.finished();
    Progress progress(finished, todo);
    WorkerPool pool(folder, starts, std::move(todo), finished);
    monitor.begin("campaign");
    pool.run(abreast, threads, progress, monitor);
    const CampaignResult result{folder.write_results(), pool.computed()};
    if (pool.stopped())
        throw Interrupted(fmt::format("stopped by the user; {}; the same command goes on from here",
                                      progress.counts()));
    return result;
}

}  // namespace grainfield::triaxial
