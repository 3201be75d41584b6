#include "triaxial/report/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

/// What every figure has in common.
std::string preamble() {
    return fmt::format(
        "set encoding utf8\n"
        "set border 3 lc rgb '{muted}' lw 1\n"
        "set tics nomirror out scale 0.6 textcolor rgb '{ink}'\n"
        "set grid lc rgb '{grid}' lw 1 lt 1\n"
        "set key textcolor rgb '{ink}' samplen 2 spacing 1.25\n"
        "set xlabel textcolor rgb '{ink}'\n"
        "set ylabel textcolor rgb '{ink}'\n",
        fmt::arg("muted", colour::muted), fmt::arg("ink", colour::ink),
        fmt::arg("grid", colour::grid));
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

/// Makes an SVG file one element of a page: no prologue, ids of its own, a title.
std::string to_element(std::string svg, std::string_view id, std::string_view title) {
    svg.erase(0, svg.find("<svg"));
    const std::size_t begin = svg.find("<title>");
    const std::size_t end = svg.find("</desc>");
    if (begin != std::string::npos && end != std::string::npos)
        svg.replace(begin, end + 7 - begin, fmt::format("<title>{}</title>", escape(title)));
    for (const std::string_view quote : {"'", "\""}) {
        replace_all(svg, fmt::format(" id={}", quote), fmt::format(" id={}{}_", quote, id));
        replace_all(svg, fmt::format("href={}#", quote), fmt::format("href={}#{}_", quote, id));
    }
    replace_all(svg, "url(#", fmt::format("url(#{}_", id));
    replace_all(svg, "url('#", fmt::format("url('#{}_", id));
    return svg;
}

}  // namespace

Gnuplot::Gnuplot() {
    std::error_code error;
    const auto base = std::filesystem::temp_directory_path(error);
    std::string name = ((error ? "/tmp" : base) / "grainfield-report-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw FileError(fmt::format("{}: {}", name, std::strerror(errno)));
    folder_ = name;
}

Gnuplot::~Gnuplot() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void Gnuplot::data(std::string_view name, std::string_view text) const {
    core::write_file_atomically(folder_ / name, text);
}

std::string Gnuplot::run(std::string_view id, std::string_view script) const {
    const std::string script_file = fmt::format("{}.gp", id);
    const std::string log_file = fmt::format("{}.log", id);
    data(script_file, script);

    std::string program = "gnuplot", defaults = "-d", argument = script_file;  // -d: no ~/.gnuplot
    const std::array<char*, 4> arguments{program.data(), defaults.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log_file.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw FileError(fmt::format(
            "gnuplot cannot be started ({}); the report's figures need it: install the Debian "
            "package gnuplot-nox",
            std::strerror(error)));

    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const auto output = folder_ / fmt::format("{}.out", id);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !std::filesystem::exists(output))
        throw FileError(fmt::format("gnuplot failed on figure '{}': {}", id,
                                    core::read_whole_file(folder_ / log_file)));
    return core::read_whole_file(output);
}

std::string Gnuplot::svg(std::string_view id, std::string_view title, PictureSize size,
                         std::string_view script) const {
    const std::string head = fmt::format(
        "set terminal svg enhanced dynamic size {},{} font 'Helvetica,13' name '{}'\n"
        "set output '{}.out'\n",
        size.width, size.height, id, id);
    return to_element(run(id, head + preamble() + std::string(script)), id, title);
}

std::string Gnuplot::png(std::string_view id, PictureSize size, std::string_view script) const {
    const std::string head = fmt::format(
        "set terminal pngcairo enhanced size {},{} font 'sans,17'\n"
        "set output '{}.out'\n",
        size.width, size.height, id);
    return run(id, head + preamble() + std::string(script));
}

}  // namespace grainfield::triaxial::report
