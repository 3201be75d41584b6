#include "randomfield/field_io.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/files/atomic_file.hpp"
#include "randomfield/field_formats.hpp"

namespace grainfield::randomfield {

void complete(BlockField& field, const DeterministicValues& deterministic) {
    if (field.friction_angle.empty()) {
        field.friction_angle.assign(field.G.size(), deterministic.friction_angle);
    }
    if (field.normal_stiffness.empty()) {
        field.normal_stiffness.assign(field.G.size(), deterministic.normal_stiffness);
    }
}

void report_progress(core::Monitor& monitor, std::uint64_t realization, std::uint64_t count) {
    if (monitor.stop_requested()) throw Interrupted("interrupted: no fields were written");
    monitor.progress(static_cast<double>(realization) / static_cast<double>(count), -1, "");
}

void require_field_suffix(const std::filesystem::path& path) {
    const std::string suffix = path.extension().string();
    if (suffix != ".csv" && suffix != ".h5")
        throw InputError(fmt::format("{}: fields are written as .csv or .h5, not \"{}\"",
                                     path.string(), suffix));
}

void write_fields(const std::filesystem::path& path, const FieldGenerator& generator,
                  std::uint64_t count, const DeterministicValues& deterministic) {
    core::Monitor nobody;
    write_fields(path, generator, count, deterministic, nobody);
}

void write_fields(const std::filesystem::path& path, const FieldGenerator& generator,
                  std::uint64_t count, const DeterministicValues& deterministic,
                  core::Monitor& monitor) {
    require_field_suffix(path);
    if (count == 0) throw InputError("realizations = 0: must be at least 1");
    if (path.extension() == ".h5") {
        core::write_file_atomically(path, fields_as_h5(generator, count, deterministic, monitor));
        return;
    }
    core::AtomicFile file(path);
    write_field_csv(file.path(), path, generator, count, deterministic, monitor);
    file.commit();
}

}  // namespace grainfield::randomfield
