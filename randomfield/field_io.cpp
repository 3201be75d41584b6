#include "randomfield/field_io.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
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

void write_fields(const std::filesystem::path& path, const FieldGenerator& generator,
                  std::uint64_t count, const DeterministicValues& deterministic) {
    const std::string suffix = path.extension().string();
    if (suffix != ".csv" && suffix != ".h5") {
        throw InputError(fmt::format("{}: fields are written as .csv or .h5, not \"{}\"",
                                     path.string(), suffix));
    }
    if (count == 0) throw InputError("realizations = 0: must be at least 1");
    if (suffix == ".h5") {
        core::write_file_atomically(path, fields_as_h5(generator, count, deterministic));
        return;
    }
    core::AtomicFile file(path);
    write_field_csv(file.path(), path, generator, count, deterministic);
    file.commit();
}

}  // namespace grainfield::randomfield
