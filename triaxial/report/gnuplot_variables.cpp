#include "triaxial/report/gnuplot_variables.hpp"

#include <cmath>

namespace grainfield::triaxial::report {
namespace {

std::string array_definition(std::string_view name, const std::vector<std::string>& values) {
    return fmt::format("array {}[{}] = [{}]\n", name, values.size(), fmt::join(values, ", "));
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
    constexpr std::string_view markup = "\\{}^_@&~";
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'') {
            out += "\\047";  // gnuplot takes a doubled quote at the beginning for an empty constant
            continue;
        }
        if (markup.find(c) != std::string_view::npos) out += '\\';
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        out += control ? ' ' : c;
    }
    return out + "'";
}

GnuplotVariable::GnuplotVariable(std::string_view name, const std::string& value, int)
    : definition(fmt::format("{} = {}\n", name, value)) {}

GnuplotVariable::GnuplotVariable(std::string_view name, const Markup& markup)
    : definition(fmt::format("{} = '{}'\n", name, markup.text)) {}

GnuplotVariable::GnuplotVariable(std::string_view name, std::span<const double> numbers) {
    std::vector<std::string> values;
    for (const double value : numbers) values.push_back(number(value));
    definition = array_definition(name, values);
}

GnuplotVariable::GnuplotVariable(std::string_view name, std::span<const std::string> texts) {
    std::vector<std::string> values;
    for (const std::string& text : texts) values.push_back(gnuplot_text(text));
    definition = array_definition(name, values);
}

GnuplotVariable::GnuplotVariable(std::string_view name, const DataBlock& block)
    : definition(fmt::format("${} << EOD\n{}EOD\n", name, block.rows())) {}

std::string GnuplotVariable::number(double value) {
    // With a point or an exponent: gnuplot divides whole numbers as C++ does.
    return std::isfinite(value) ? fmt::format("{:#}", value) : "NaN";
}

}  // namespace grainfield::triaxial::report
