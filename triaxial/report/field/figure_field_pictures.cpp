// Pictures of a realization: slices, and the blocks from outside.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "triaxial/report/box_frame.hpp"
#include "triaxial/report/field/field_figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

using randomfield::GridSpec;

std::string image(const std::string& png, PictureSize size, const std::string& words) {
    return fmt::format(
        "<img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\">",
        escape(words), size.width, size.height, base64(png));
}

/// One sphere a cell with the cell's properties, for Colouring.
core::ParticleStore spheres_of(const randomfield::BlockField& field) {
    core::ParticleStore store;
    store.resize(field.G.size());
    std::ranges::copy(field.friction_angle, store.friction_angle.begin());
    std::ranges::copy(field.normal_stiffness, store.normal_stiffness.begin());
    return store;
}

/// A face of a cell, which lies in a face of the box: normal to `axis`, at its upper end.
struct Face {
    Eigen::Index axis;
    double light;
};
constexpr Face faces[]{{0, 0.86}, {1, 1.0}, {2, 0.95}};  // right, top, front, as sample_view.cpp

/// Corners and colour of a cell's face.
void add_face(const Camera& camera, const Vec3& lower, const Vec3& size, const Face& face,
              const Rgb& colour, DataBlock& rows) {
    const Eigen::Index u = (face.axis + 1) % 3, v = (face.axis + 2) % 3;
    constexpr double corner[][2]{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const auto& [a, b] : corner) {
        Vec3 p = lower;
        p[face.axis] += size[face.axis];
        p[u] += a * size[u];
        p[v] += b * size[v];
        rows.add(camera.right(p));
        rows.add(camera.up(p));
    }
    rows.add(colour.times(face.light).packed());
    rows.end_row();
}

}  // namespace

Figure slices_figure(const Gnuplot& gnuplot, const std::string& id, const GridSpec& grid,
                     std::span<const double> values, Markup label, const std::string& caption) {
    const auto [nx, ny, nz] = grid.cells;
    const Vec3& edge = grid.cell_size;
    const double width = nx * edge.x(), height = ny * edge.y();
    const std::int32_t panels = std::min(nz, 6);
    const double pace = width * 1.12;
    DataBlock rows;
    std::vector<double> z;
    for (std::int32_t panel = 0; panel < panels; ++panel) {
        const std::int32_t k = panels == 1 ? 0 : panel * (nz - 1) / (panels - 1);
        for (std::int32_t j = 0; j < ny; ++j)
            for (std::int32_t i = 0; i < nx; ++i) {
                const double x = panel * pace + i * edge.x(), y = j * edge.y();
                const double value = values[grid.index(i, j, k)];
                if (std::isnan(value)) continue;
                rows.row(x + edge.x() / 2, y + edge.y() / 2, x, x + edge.x(), y, y + edge.y(),
                         value);
            }
        z.push_back((k + 0.5) * edge.z());
    }
    const double total = pace * panels - 0.12 * width;
    // To scale, unless the panels would be too narrow for their labels, too flat or too tall [px].
    const double pixels = std::clamp(420 * total / height, 175.0 * panels, 1300.0);
    const double to_scale = pixels * height / total;
    const double high = std::clamp(to_scale, 115.0, 800.0);
    const PictureSize size{static_cast<int>(pixels) + 320, static_cast<int>(high) + 110};
    const std::string png = gnuplot.png("figure_slices", id, size,
                                        {{"cells", rows},
                                         {"z", z},
                                         {"pace", pace},
                                         {"width", width},
                                         {"total", total},
                                         {"height", height},
                                         {"to_scale", high == to_scale},
                                         {"pixels_wide", size.width},
                                         {"pixels_high", size.height},
                                         {"palette", Colouring::palette()},
                                         {"quantity", label}});
    return {image(png, size, caption), caption};
}

Figure blocks_figure(const Gnuplot& gnuplot, const std::string& id,
                     const randomfield::BlockField& field, randomfield::Property property) {
    const bool friction = property == randomfield::Property::friction_angle;
    const core::ParticleStore cells = spheres_of(field);
    const Colouring colouring(cells, friction ? ColourBy::friction : ColourBy::stiffness);
    const GridSpec& grid = field.grid;
    const auto [nx, ny, nz] = grid.cells;
    const core::Box box{Vec3::Zero(), Vec3(nx, ny, nz).cwiseProduct(grid.cell_size)};
    const Camera camera;
    BoxFrame frame = box_frame(box, camera, colouring);
    DataBlock rows(5);
    for (const Face& face : faces) {
        const auto axis = static_cast<std::size_t>(face.axis);
        randomfield::CellCount first{0, 0, 0};
        first[axis] = grid.cells[axis] - 1;
        for (std::int32_t k = first[2]; k < nz; ++k)
            for (std::int32_t j = first[1]; j < ny; ++j)
                for (std::int32_t i = first[0]; i < nx; ++i)
                    add_face(camera, Vec3(i, j, k).cwiseProduct(grid.cell_size), grid.cell_size,
                             face, colouring.colour(grid.index(i, j, k)), rows);
    }
    frame.variables.emplace_back("faces", rows);
    const std::string words =
        fmt::format("The blocks of realization 0 from outside, {}", colouring.in_words());
    const std::string png = gnuplot.png("figure_blocks", id, frame.size, frame.variables);
    return {image(png, frame.size, words), words + "."};
}

}  // namespace grainfield::triaxial::report
