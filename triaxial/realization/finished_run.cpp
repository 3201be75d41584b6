#include "triaxial/realization/finished_run.hpp"

#include <fmt/format.h>

#include <system_error>

#include "core/base/errors.hpp"

namespace grainfield::triaxial {

namespace fs = std::filesystem;

namespace {

bool holds_finished(const fs::path& folder) {
    return fs::exists(folder / "summary.json") || fs::exists(folder / "repeats.json");
}

}  // namespace

fs::path repeat_folder(const fs::path& series, std::size_t k) {
    return series / fmt::format("repeat{}", k);
}

fs::path failed_state_file(const fs::path& folder) {
    return folder / (holds_finished(folder) ? "state.failed.h5" : "state.h5");
}

fs::path packing_in_progress(const fs::path& folder) {
    return folder / (holds_finished(folder) ? "packing.part.h5" : "packing.h5");
}

void drop_packing_in_progress(const fs::path& folder) {
    std::error_code ignored;
    for (const char* name : {"packing.part.json", "packing.part.h5"})
        fs::remove(folder / name, ignored);
}

void clear_earlier_run(const fs::path& folder) {
    std::error_code ignored;  // what cannot be removed is written over, or in nobody's way
    const auto drop = [&](const fs::path& from, std::initializer_list<const char*> names) {
        for (const char* name : names) fs::remove(from / name, ignored);
    };
    const auto results = {"summary.json", "report.html", "state.h5", "state.failed.h5"};
    if (fs::exists(folder / "repeats.json"))
        for (std::size_t k = 0; fs::exists(repeat_folder(folder, k)); ++k) {
            const fs::path repeat = repeat_folder(folder, k);
            drop(repeat, results);
            drop(repeat, {"config.toml", "curve.csv", "energy.csv", "packing.json"});
            fs::remove(repeat, ignored);  // unless somebody keeps files there
        }
    drop(folder, results);
    drop(folder, {"repeats.json", "repeats.csv"});
}

void keep_packing(const fs::path& folder) {
    for (const char* suffix : {".json", ".h5"}) {
        const fs::path part = fs::path(folder / "packing.part").concat(suffix);
        if (!fs::exists(part)) continue;
        std::error_code error;
        fs::rename(part, fs::path(folder / "packing").concat(suffix), error);
        if (error)
            throw FileError(
                fmt::format("{}: cannot be renamed: {}", part.string(), error.message()));
    }
}

}  // namespace grainfield::triaxial
