#pragma once
// What a .gnuplot file is given: numbers, texts and data blocks, as definitions in gnuplot's
// language.

#include <fmt/format.h>

#include <concepts>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace grainfield::triaxial::report {

/// Any text as a string constant of gnuplot that shows it as it is and never does anything: in
/// single quotes, what gnuplot's enhanced text reads as markup escaped, line breaks and other
/// control characters as spaces. Every text that is not ours reaches gnuplot through this.
std::string gnuplot_text(std::string_view text);

/// Enhanced text of ours, a literal of the source: "{/:Italic E}_{50}".
struct Markup {
    std::string_view text;
    consteval Markup(const char* literal) : text(literal) {}  // NOLINT: reads as the text
};

/// Rows of numbers, $NAME in gnuplot.
class DataBlock {
  public:
    /// Numbers with so many decimals; by default with as many digits as give them back.
    explicit DataBlock(int decimals = -1) : decimals_(decimals) {}

    template <class... Numbers>
    requires(std::is_arithmetic_v<Numbers>&&...) void row(Numbers... numbers) {
        (add(numbers), ...);
        end_row();
    }
    /// One number of the row that end_row() ends.
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void add(Number number) {
        if (std::is_floating_point_v<Number> && decimals_ >= 0)
            fmt::format_to(std::back_inserter(rows_), "{:.{}f} ", double(number), decimals_);
        else
            fmt::format_to(std::back_inserter(rows_), "{} ", number);
    }
    void end_row() { rows_ += '\n'; }
    /// Begins a part that plots pick out by index '[name]', one of our names. The brackets are
    /// there because gnuplot takes the first part that begins with what it looks for.
    void begin_part(std::string_view name) {
        rows_ += fmt::format("{}# [{}]\n", rows_.empty() ? "" : "\n\n", name);
    }
    /// Ends a part that plots pick out by `index` and its number, from 0 on.
    void end_part() { rows_ += "\n\n"; }

    const std::string& rows() const { return rows_; }

  private:
    int decimals_;
    std::string rows_;
};

/// A variable with its value, [name = value] as gnuplot reads it. Lists (arrays, from 1 on) hold
/// one value at least. A number that is not finite is gnuplot's NaN.
struct GnuplotVariable {
    GnuplotVariable(std::string_view name, std::floating_point auto value)
        : GnuplotVariable(name, number(value), 0) {}
    GnuplotVariable(std::string_view name, std::integral auto value)
        : GnuplotVariable(name, fmt::format("{:d}", value), 0) {}
    GnuplotVariable(std::string_view name, std::string_view text)
        : GnuplotVariable(name, gnuplot_text(text), 0) {}
    GnuplotVariable(std::string_view name, const std::string& text)
        : GnuplotVariable(name, gnuplot_text(text), 0) {}
    GnuplotVariable(std::string_view name, const char* text)
        : GnuplotVariable(name, gnuplot_text(text), 0) {}
    GnuplotVariable(std::string_view name, const Markup& markup);
    GnuplotVariable(std::string_view name, std::span<const double> numbers);
    GnuplotVariable(std::string_view name, std::span<const std::string> texts);
    GnuplotVariable(std::string_view name, const DataBlock& block);

    std::string definition;  ///< whole lines

  private:
    GnuplotVariable(std::string_view name, const std::string& value, int);
    static std::string number(double value);
};

using GnuplotVariables = std::vector<GnuplotVariable>;

}  // namespace grainfield::triaxial::report
