#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>

#include "core/errors.hpp"
#include "core/files/text_file.hpp"
#include "randomfield/field_formats.hpp"

namespace grainfield::randomfield {
namespace {

void append_rows(std::string& text, std::uint64_t realization, const BlockField& field) {
    const auto [nx, ny, nz] = field.grid.cells;
    std::size_t cell = 0;
    for (std::int32_t k = 0; k < nz; ++k) {
        for (std::int32_t j = 0; j < ny; ++j) {
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
}

}  // namespace

void write_field_csv(const std::filesystem::path& file, const std::filesystem::path& target,
                     const FieldGenerator& generator, std::uint64_t count,
                     const DeterministicValues& deterministic) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    std::string text = "realization,i,j,k,G,friction_angle,normal_stiffness\n";
    for (std::uint64_t realization = 0; realization < count && out; ++realization) {
        BlockField field = generator.draw(realization);
        complete(field, deterministic);
        append_rows(text, realization, field);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        text.clear();
    }
    out.close();
    if (!out) {
        throw FileError(
            fmt::format("{}: cannot be written: {}", target.string(), core::error_text(errno)));
    }
}

}  // namespace grainfield::randomfield
