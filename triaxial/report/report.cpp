#include "triaxial/report/report.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "core/files/atomic_file.hpp"
#include "triaxial/report/figures.hpp"
#include "triaxial/report/key_results.hpp"
#include "triaxial/report/page.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial {
namespace {

using namespace report;

/// Grading and stress profile of the packing, or a sentence why they are not there.
void add_packing(const Gnuplot& gnuplot, const RunFolder& run, Page& page) {
    page.section("Packing");
    if (!run.packing) {
        page.paragraph(
            "The folder holds no <code>packing.json</code> (the sample was read from a file of "
            "spheres, which says nothing of how it was packed): grading and stress profile are "
            "left out.",
            "note");
        return;
    }
    std::vector<Figure> figures;
    if (run.packing->has("grading")) figures.push_back(grading_figure(gnuplot, *run.packing));
    if (run.packing->has("stress_profile"))
        figures.push_back(stress_profile_figure(gnuplot, *run.packing));
    page.figures(figures);
    for (const char* key : {"grading", "stress_profile"}) {
        if (!run.packing->has(key))
            page.paragraph(fmt::format("<code>packing.json</code> has no key <code>{}</code>: its "
                                       "figure is left out.",
                                       key),
                           "note");
    }
}

std::string run_page(const RunFolder& run, std::span<const MohrCircle> companions) {
    const Gnuplot gnuplot;
    const std::string words = escape(case_in_words(run.summary));
    const std::string folder =
        escape(std::filesystem::weakly_canonical(run.path).filename().string());
    Page page(fmt::format("Grainfield report · run “{}”", folder),
              words.empty() ? "Triaxial test" : fmt::format("Triaxial test: {}", words),
              outcome(run));
    if (run.results.failure == Failure::strain_limit)
        page.paragraph(
            "No peak was found: the run ended before <i>q</i> had fallen for good or levelled off. "
            "All values “at the peak” are those of the largest <i>q</i> up to the strain at which "
            "it ended and may be too low.",
            "warning");
    for (const std::string& warning : run.summary.texts("warnings"))
        page.paragraph(escape("Warning: " + warning + "."), "warning");

    page.section("Key results");
    page.tables(key_tables(run));
    page.section("Stress and strain");
    const MohrCircle circle{run.results.confining_stress, run.results.peak_deviator_stress, folder,
                            soil_of(run.summary)};
    std::vector<MohrCircle> comparable;
    for (const MohrCircle& companion : companions) {
        const std::string difference = soil_difference(circle, companion);
        if (difference.empty()) {
            comparable.push_back(companion);
            continue;
        }
        page.paragraph(fmt::format("Run “{}” cannot be compared with this one and is left out of "
                                   "the Mohr circles: {}. One envelope through both would be that "
                                   "of no soil.",
                                   escape(companion.name), escape(difference)),
                       "warning");
    }
    page.figures(
        std::array{stress_strain_figure(gnuplot, run), mohr_figure(gnuplot, circle, comparable)});
    page.figures(std::array{servo_figure(gnuplot, run)}, "wide");
    if (!run.energies.empty()) {
        page.section("Energy");
        page.figures(std::array{energy_figure(gnuplot, run)}, "wide");
    }
    page.section("Sample");
    page.figures(std::array{sample_figure(gnuplot, run)}, "sample");
    add_packing(gnuplot, run, page);
    page.section("Parameters");
    page.paragraph("<code>config.toml</code>, every key as resolved:", "note");
    page.listing(run.config);
    page.section("All of summary.json");
    page.values(run.summary.flattened());
    return page.html();
}

}  // namespace

std::filesystem::path write_report(const std::filesystem::path& dir,
                                   std::span<const std::filesystem::path> companions) {
    const RunFolder run = read_run_folder(dir);
    std::vector<MohrCircle> circles;
    for (const auto& companion : companions) circles.push_back(read_mohr_circle(companion));
    const std::filesystem::path path = dir / "report.html";
    core::write_file_atomically(path, run_page(run, circles));
    return path;
}

}  // namespace grainfield::triaxial
