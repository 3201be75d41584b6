#include "bench/fields_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "triaxial/report/gnuplot.hpp"

namespace grainfield::bench {

std::string fields_picture(const std::vector<FieldPoint>& points) {
    std::vector<randomfield::CellCount> grids;
    for (const FieldPoint& p : points) {
        const bool known = std::find(grids.begin(), grids.end(), p.cells) != grids.end();
        if (p.error && p.method == "las" && !known) grids.push_back(p.cells);
    }
    triaxial::report::DataBlock data;
    std::vector<std::string> grid, methods;
    for (const auto& [nx, ny, nz] : grids) {
        grid.push_back(fmt::format("{} x {} x {}", nx, ny, nz));
        methods.emplace_back();
        for (const char* method : {"las-classic", "las", "cholesky", "circulant"}) {
            bool any = false;
            for (const FieldPoint& p : points) {
                if (p.cells != randomfield::CellCount{nx, ny, nz} || p.method != method || !p.error)
                    continue;
                if (!any) data.begin_part(fmt::format("{}-{}", grid.size(), method));
                any = true;
                data.row(1e9 * p.field / (1.0 * nx * ny * nz), *p.error, p.theta_y);
            }
            if (any) methods.back() += fmt::format("{} ", method);
        }
    }
    return triaxial::report::Gnuplot(gnuplot_templates())
        .png("fields_picture", "fields",
             {.width = 620 * static_cast<int>(grids.size()), .height = 460},
             {{"points", data}, {"grid", grid}, {"methods", methods}});
}

}  // namespace grainfield::bench
