#pragma once
// The page as HTML: pieces in reading order, one style sheet, nothing from outside.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "triaxial/report/figures.hpp"
#include "triaxial/report/key_results.hpp"

namespace grainfield::triaxial::report {

class Page {
  public:
    /// `kicker`, `title` and `lead` are HTML; `title` also names the document.
    Page(std::string_view kicker, std::string_view title, std::string_view lead);

    void section(std::string_view title);
    void tables(std::span<const Table> tables);
    /// A table of columns over the width of the page; all cells are HTML, the first of a row its
    /// name.
    void columns(std::string_view title, std::span<const std::string> header,
                 std::span<const std::vector<std::string>> rows);
    /// Figures side by side where the page is wide; they are numbered in the order of the page.
    void figures(std::span<const Figure> figures, std::string_view layout = "pair");
    void paragraph(std::string_view html, std::string_view style = "");
    /// Text as it stands in a box that scrolls on screen and is whole on paper.
    void listing(std::string_view text);
    /// Keys and values in columns.
    void values(const std::vector<std::pair<std::string, std::string>>& values);

    std::string html() const;

  private:
    std::string title_;
    std::string body_;
    int figures_ = 0;
};

}  // namespace grainfield::triaxial::report
