#include "triaxial/report/page.hpp"

#include <fmt/format.h>

#include "triaxial/report/page_style.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {

Page::Page(std::string_view kicker, std::string_view title, std::string_view lead)
    : title_(title),
      body_(fmt::format("<header>\n<p class=\"kicker\">{}</p>\n<h1>{}</h1>\n"
                        "<p class=\"lead\">{}</p>\n</header>\n",
                        kicker, title, lead)) {}

void Page::section(std::string_view title) {
    body_ += fmt::format("<h2>{}</h2>\n", title);
}

void Page::tables(std::span<const Table> tables) {
    body_ += "<div class=\"tables\">\n";
    for (const Table& table : tables) {
        body_ += fmt::format("<table>\n<caption>{}</caption>\n", table.title);
        for (const Row& row : table.rows) {
            const std::string note =
                row.note.empty() ? "" : fmt::format("<small>{}</small>", row.note);
            body_ += fmt::format("<tr><th scope=\"row\">{}{}</th><td>{}</td></tr>\n", row.name,
                                 note, row.value);
        }
        body_ += "</table>\n";
    }
    body_ += "</div>\n";
}

void Page::columns(std::string_view title, std::span<const std::string> header,
                   std::span<const std::vector<std::string>> rows) {
    body_ += fmt::format(
        "<div class=\"scroll\"><table class=\"columns\">\n<caption>{}</caption>\n<thead><tr>",
        title);
    for (const std::string& cell : header) body_ += fmt::format("<th scope=\"col\">{}</th>", cell);
    body_ += "</tr></thead>\n<tbody>\n";
    for (const std::vector<std::string>& row : rows) {
        body_ += "<tr>";
        for (std::size_t k = 0; k < row.size(); ++k)
            body_ += k == 0 ? fmt::format("<th scope=\"row\">{}</th>", row[k])
                            : fmt::format("<td>{}</td>", row[k]);
        body_ += "</tr>\n";
    }
    body_ += "</tbody>\n</table></div>\n";
}

void Page::figures(std::span<const Figure> figures, std::string_view layout) {
    if (figures.empty()) return;
    body_ += fmt::format("<div class=\"{}\">\n", layout);
    for (const Figure& figure : figures)
        body_ += fmt::format(
            "<figure>\n<div class=\"picture\">{}</div>\n<figcaption><b>Figure {}.</b> "
            "{}</figcaption>\n</figure>\n",
            figure.picture, ++figures_, figure.caption);
    body_ += "</div>\n";
}

void Page::paragraph(std::string_view html, std::string_view style) {
    body_ += fmt::format("<p class=\"{}\">{}</p>\n", style, html);
}

void Page::listing(std::string_view text) {
    body_ += fmt::format("<pre tabindex=\"0\">{}</pre>\n", escape(text));
}

void Page::values(const std::vector<std::pair<std::string, std::string>>& values) {
    body_ += "<dl>\n";
    for (const auto& [key, value] : values)
        body_ += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escape(key), escape(value));
    body_ += "</dl>\n";
}

std::string Page::html() const {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{} – Grainfield</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n{}</main>\n"
        "</body>\n</html>\n",
        title_, page_style, body_);
}

}  // namespace grainfield::triaxial::report
