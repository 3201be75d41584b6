#pragma once
// gnuplot as a child process in a temporary folder: it draws a .gnuplot file with what that is
// given, and the picture comes back.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "triaxial/cli/interrupt.hpp"
#include "triaxial/report/gnuplot_template.hpp"
#include "triaxial/report/gnuplot_variables.hpp"

namespace grainfield::triaxial::report {

struct PictureSize {
    int width = 640;   ///< [px]
    int height = 420;  ///< [px]
};

/// A temporary folder of its own, removed at the end, in which gnuplot runs.
class Gnuplot {
  public:
    /// Knows the templates of triaxial/report/, and `more`. Throws FileError where the temporary
    /// folder cannot be made.
    explicit Gnuplot(std::span<const GnuplotTemplate> more = {});

    // Both draw a template with these variables. They throw FileError where gnuplot is not
    // installed, fails, with what it said, or does not end; Interrupted after a signal; and
    // std::out_of_range where there is no such template.
    /// An <svg> element to stand in a page: ids carry `id`, `title` is its text for screen readers.
    std::string svg(std::string_view figure, std::string_view id, std::string_view title,
                    PictureSize size, const GnuplotVariables& variables) const;
    /// The bytes of a PNG file.
    std::string png(std::string_view figure, std::string_view id, PictureSize size,
                    const GnuplotVariables& variables) const;

  private:
    std::string run(std::string_view figure, std::string_view id, std::string_view terminal,
                    const GnuplotVariables& variables) const;

    StopSafely asked_only_;  // before the folder, which is to be removed
    struct Folder {
        Folder();
        ~Folder();
        Folder(const Folder&) = delete;
        Folder& operator=(const Folder&) = delete;
        std::filesystem::path path;
    };
    Folder folder_;
};

}  // namespace grainfield::triaxial::report
