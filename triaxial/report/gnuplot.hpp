#pragma once
// gnuplot as a child process: scripts and data go by file in a temporary folder, pictures come
// back.

#include <filesystem>
#include <string>
#include <string_view>

namespace grainfield::triaxial::report {

/// Colours of all figures: dark ink, one main colour, one contrast, greys.
namespace colour {
inline constexpr std::string_view ink = "#243039";
inline constexpr std::string_view muted = "#66727c";
inline constexpr std::string_view grid = "#e6eaed";
inline constexpr std::string_view main = "#1d4f7c";
inline constexpr std::string_view contrast = "#b4581d";
inline constexpr std::string_view soft = "#7fa3bf";
}  // namespace colour

struct PictureSize {
    int width = 640;   ///< [px]
    int height = 420;  ///< [px]
};

/// A temporary folder of its own, removed at the end, in which gnuplot runs.
class Gnuplot {
  public:
    /// Throws FileError where the temporary folder cannot be made.
    Gnuplot();
    ~Gnuplot();
    Gnuplot(const Gnuplot&) = delete;
    Gnuplot& operator=(const Gnuplot&) = delete;

    /// Puts a data file there for the scripts to come. Throws FileError.
    void data(std::string_view name, std::string_view text) const;

    // Both run one script and throw FileError where gnuplot is not installed or fails, with what
    // it said.
    /// An <svg> element to stand in a page: ids carry `id`, `title` is its text for screen readers.
    std::string svg(std::string_view id, std::string_view title, PictureSize size,
                    std::string_view script) const;
    /// The bytes of a PNG file.
    std::string png(std::string_view id, PictureSize size, std::string_view script) const;

  private:
    std::string run(std::string_view id, std::string_view script) const;

    std::filesystem::path folder_;
};

}  // namespace grainfield::triaxial::report
