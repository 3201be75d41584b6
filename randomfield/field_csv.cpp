#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "randomfield/field_formats.hpp"

namespace grainfield::randomfield {
namespace {

/// Written out as it grows: a large field's text is several times its numbers.
void write_rows(std::ostream& out, std::uint64_t realization, const BlockField& field,
                core::Monitor& monitor) {
    const auto [nx, ny, nz] = field.grid.cells;
    constexpr std::size_t much = std::size_t{1} << 20;  // [B]
    std::string text;
    const auto flush = [&] {
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        text.clear();
        if (monitor.stop_requested()) throw Interrupted("interrupted: no fields were written");
    };
    std::size_t cell = 0;
    for (std::int32_t k = 0; k < nz && out; ++k) {
        for (std::int32_t j = 0; j < ny; ++j) {
            if (text.size() > much) flush();
            for (std::int32_t i = 0; i < nx; ++i, ++cell) {
                fmt::format_to(std::back_inserter(text), "{},{},{},{},", realization, i, j, k);
                core::append_number(text, field.G[cell]);
                text += ',';
                core::append_number(text, field.friction_angle[cell]);
                text += ',';
                core::append_number(text, field.normal_stiffness[cell]);
                text += '\n';
            }
        }
    }
    flush();
}

}  // namespace

void write_field_csv(const std::filesystem::path& file, const std::filesystem::path& target,
                     const FieldGenerator& generator, std::uint64_t count,
                     const DeterministicValues& deterministic, core::Monitor& monitor) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    out << "realization,i,j,k,G,friction_angle,normal_stiffness\n";
    for (std::uint64_t realization = 0; realization < count && out; ++realization) {
        BlockField field = generator.draw(realization);
        complete(field, deterministic);
        write_rows(out, realization, field, monitor);
        report_progress(monitor, realization + 1, count);
    }
    out.close();
    if (!out) {
        throw FileError(
            fmt::format("{}: cannot be written: {}", target.string(), core::error_text(errno)));
    }
}

}  // namespace grainfield::randomfield
