#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/files/hdf5_writer.hpp"
#include "randomfield/field_formats.hpp"
#include "randomfield/memory_limit.hpp"

namespace grainfield::randomfield {

std::string fields_as_h5(const FieldGenerator& generator, std::uint64_t count,
                         const DeterministicValues& deterministic, core::Monitor& monitor) {
    using Column = std::vector<double> BlockField::*;
    std::vector<std::pair<std::string, Column>> columns{
        {"G", &BlockField::G},
        {"friction_angle", &BlockField::friction_angle},
        {"normal_stiffness", &BlockField::normal_stiffness}};
    if (generator.options().variable == Variable::both) {
        columns.emplace_back("G_stiffness", &BlockField::G_stiffness);
    }
    // The columns, and the compressed file that HDF5 grows and hands over, at most as large each.
    const double numbers =
        static_cast<double>(count) * static_cast<double>(generator.grid().size() * columns.size());
    require_memory(generator.grid(), 3.0 * sizeof(double) * numbers, count, "in one .h5 file");
    std::vector<std::vector<double>> values(columns.size());
    for (auto& column : values) column.reserve(count * generator.grid().size());
    for (std::uint64_t realization = 0; realization < count; ++realization) {
        BlockField field = generator.draw(realization);
        complete(field, deterministic);
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const std::vector<double>& column = field.*columns[c].second;
            values[c].insert(values[c].end(), column.begin(), column.end());
        }
        report_progress(monitor, realization + 1, count);
    }

    const CellCount& cells = generator.grid().cells;
    const std::vector<std::size_t> shape{count, static_cast<std::size_t>(cells[2]),
                                         static_cast<std::size_t>(cells[1]),
                                         static_cast<std::size_t>(cells[0])};
    core::Hdf5Writer writer;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        writer.dataset<double>(columns[c].first, shape, values[c]);
        values[c] = {};
    }
    // Vec3 is three doubles in a row.
    writer.dataset<double>("cell_size", {3}, {generator.grid().cell_size.data(), 3});
    writer.dataset<double>("correlation_length", {3},
                           {generator.options().correlation_length.data(), 3});
    writer.attribute("/", "cells", std::array<std::int64_t, 3>{cells[0], cells[1], cells[2]});
    writer.attribute("/", "seed", std::array{static_cast<std::int64_t>(generator.options().seed)});
    writer.attribute("/", "content", "grainfield random field");
    return writer.finish();
}

}  // namespace grainfield::randomfield
