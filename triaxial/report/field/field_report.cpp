#include "triaxial/report/field/field_report.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <limits>

#include "core/files/atomic_file.hpp"
#include "core/files/folder.hpp"
#include "triaxial/report/field/field_figures.hpp"
#include "triaxial/report/field/field_verdicts.hpp"
#include "triaxial/report/page.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial {
namespace {

using namespace report;
using randomfield::Estimate;
using randomfield::FieldCheck;
using randomfield::FieldGenerator;
using randomfield::Property;
using randomfield::Verification;

/// As the columns of a field's file are called.
std::string column_name(const FieldCheck& check) {
    if (!check.property) return "G";
    return *check.property == Property::friction_angle ? "friction_angle" : "normal_stiffness";
}

std::string correlation_csv(const Verification& verification, const Vec3& edge) {
    std::string text = "field,axis,lag_cells,lag_m,estimate,exact,low_99,high_99\n";
    for (const FieldCheck& check : verification.fields)
        for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t h = 0; h < check.correlation[d].size(); ++h) {
                const Estimate& one = check.correlation[d][h];
                fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n",
                               column_name(check), "xyz"[d], h,
                               static_cast<double>(h) * edge[static_cast<Eigen::Index>(d)],
                               one.estimate, one.exact, one.low, one.high);
            }
    return text;
}

std::string histogram_csv(const Verification& verification) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::string text = "field,from,to,share,predicted,low_99,high_99\n";
    for (const FieldCheck& check : verification.fields) {
        if (!check.histogram) continue;
        const auto& edges = check.histogram->edges;
        for (std::size_t b = 0; b < check.histogram->shares.size(); ++b) {
            const Estimate& one = check.histogram->shares[b];
            fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", column_name(check),
                           b == 0 ? -infinity : edges[b - 1],
                           b == edges.size() ? infinity : edges[b], one.estimate, one.exact,
                           one.low, one.high);
        }
    }
    return text;
}

std::string variance_csv(const Verification& verification, const randomfield::GridSpec& grid) {
    std::string text = "field,i,j,k,variance_over_exact,conditional_variance_over_exact\n";
    const auto [nx, ny, nz] = grid.cells;
    for (const FieldCheck& check : verification.fields)
        for (std::int32_t k = 0; k < nz; ++k)
            for (std::int32_t j = 0; j < ny; ++j)
                for (std::int32_t i = 0; i < nx; ++i) {
                    const std::size_t cell = grid.index(i, j, k);
                    fmt::format_to(
                        std::back_inserter(text), "{},{},{},{},{},{}\n", column_name(check), i, j,
                        k, check.variance.ratio[cell],
                        check.data ? fmt::format("{}", check.data->variance.ratio[cell]) : "");
                }
    return text;
}

void add_field(Page& page, const Gnuplot& gnuplot, const FieldGenerator& generator,
               const FieldCheck& check, const randomfield::BlockField& first) {
    const std::string id = column_name(check);
    const randomfield::GridSpec& grid = generator.grid();
    page.section(check.property ? "The field of the " + property_name(check.property)
                                : "The field <i>G</i>");
    page.figures(std::array{correlation_figure(gnuplot, id + "_rho", check, grid.cell_size)},
                 "wide");
    std::vector<Figure> pair;
    if (check.histogram)
        pair.push_back(cell_histogram_figure(gnuplot, id + "_bins", *check.property,
                                             *check.histogram,
                                             generator.marginals(*check.property)));
    pair.push_back(variance_figure(gnuplot, id + "_var", check.variance));
    page.figures(pair);
    page.figures(std::array{slices_figure(gnuplot, id + "_varmap", grid, check.variance.ratio,
                                          "Variance over exact (-)",
                                          "The same variances in slices x–y of the sample.")},
                 "sample");
    const DisplayUnit unit = display_unit(check.property);
    std::vector<double> values = !check.property ? first.G
                                 : *check.property == Property::friction_angle
                                     ? first.friction_angle
                                     : first.normal_stiffness;
    for (double& value : values) value /= unit.size;
    page.figures(std::array{slices_figure(gnuplot, id + "_slices", grid, values, unit.label,
                                          fmt::format("Realization 0 in slices x–y: {}.",
                                                      property_name(check.property)))},
                 "sample");
    constexpr std::size_t most_cells = 300'000;  // their faces make a picture of some seconds
    if (check.property && grid.size() <= most_cells)
        page.figures(std::array{blocks_figure(gnuplot, id + "_blocks", first, *check.property)},
                     "sample");
}

std::string page_of(const FieldGenerator& generator, const Verification& verification) {
    const Gnuplot gnuplot;
    const std::vector<Verdict> found = verdicts(generator, verification);
    std::size_t outside = 0;
    for (const Verdict& verdict : found) outside += verdict.inside ? 0 : 1;
    const auto& [nx, ny, nz] = generator.grid().cells;
    Page page("Grainfield report · random field", "Verification of a random field",
              fmt::format("{} realizations of {} × {} × {} blocks against what they should be: {}.",
                          count(static_cast<double>(verification.realizations)), nx, ny, nz,
                          outside == 0 ? "every check is inside its band"
                                       : fmt::format("{} of {} checks are outside their band",
                                                     outside, found.size())));
    page.section("Checks");
    std::vector<std::vector<std::string>> rows;
    for (const Verdict& verdict : found)
        rows.push_back({escape(verdict.check), escape(verdict.finding),
                        verdict.inside ? "inside" : "<b>OUTSIDE</b>"});
    page.columns("", std::array<std::string, 3>{"check", "found", "verdict"}, rows);
    page.paragraph(
        fmt::format(
            "γ = {}, the exact variance of a block’s average <i>G</i>. A band of 99 % holds "
            "all numbers of its check together (Bonferroni): a correct field leaves it in "
            "one verification of a hundred. Bands follow from the exact covariance and the "
            "marginal alone: of means the exact variance over realizations, with its "
            "skewness, of variances the chi-squared distribution.{}",
            significant(verification.gamma, 8),
            generator.conditioning()
                ? " Data are left out of all checks but their own; the pictures of "
                  "realization 0 honour them."
                : ""),
        "note");
    const auto& correlation = generator.generator().correlation();
    const double longest = Vec3(nx, ny, nz).cwiseProduct(generator.grid().cell_size).maxCoeff();
    const randomfield::BlockField first = generator.draw(0);
    for (const FieldCheck& check : verification.fields)
        add_field(page, gnuplot, generator, check, first);
    page.section("The correlation function");
    page.figures(std::array{point_correlation_figure(gnuplot, correlation, longest)});
    return page.html();
}

}  // namespace

std::filesystem::path write_field_report(const std::filesystem::path& folder,
                                         const FieldGenerator& generator,
                                         const Verification& verification) {
    core::create_folder(folder);
    const randomfield::GridSpec& grid = generator.grid();
    core::write_file_atomically(folder / "correlation.csv",
                                correlation_csv(verification, grid.cell_size));
    core::write_file_atomically(folder / "histogram.csv", histogram_csv(verification));
    core::write_file_atomically(folder / "variance.csv", variance_csv(verification, grid));
    const std::filesystem::path page = folder / "verification.html";
    core::write_file_atomically(page, page_of(generator, verification));
    return page;
}

}  // namespace grainfield::triaxial
