#include "triaxial/report/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "core/base/errors.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

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

/// Status of a child that has ended. One that does not is killed, as it is where a signal asks the
/// program to stop. Throws FileError and Interrupted then.
int end_of(pid_t child, std::string_view figure) {
    using Clock = std::chrono::steady_clock;
    constexpr auto look_interval = std::chrono::milliseconds(2);
    constexpr auto patience = std::chrono::minutes(5);  // a figure takes a second at most
    const auto start = Clock::now();
    int status = 0;
    while (true) {
        const pid_t ended = ::waitpid(child, &status, WNOHANG);
        if (ended == child) return status;
        if (ended < 0 && errno != EINTR)
            throw FileError(fmt::format("gnuplot cannot be waited for: {}", std::strerror(errno)));
        const bool stop = interrupt_requested();
        if (stop || Clock::now() - start > patience) {
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
            if (stop) throw Interrupted("stopped by the user while the figures were drawn");
            throw FileError(fmt::format("gnuplot did not end on figure '{}': given up", figure));
        }
        std::this_thread::sleep_for(look_interval);
    }
}

}  // namespace

Gnuplot::Folder::Folder() {
    std::error_code error;
    const auto base = std::filesystem::temp_directory_path(error);
    std::string name = ((error ? "/tmp" : base) / "grainfield-report-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw FileError(fmt::format("{}: {}", name, std::strerror(errno)));
    path = name;
}

Gnuplot::Folder::~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
}

Gnuplot::Gnuplot(std::span<const GnuplotTemplate> more) {
    for (const auto& templates : {gnuplot_templates(), more})
        for (const auto& [name, text] : templates)
            core::write_file_atomically(folder_.path / fmt::format("{}.gnuplot", name), text);
}

std::string Gnuplot::run(std::string_view figure, std::string_view id, std::string_view terminal,
                         const GnuplotVariables& variables) const {
    if (!std::filesystem::exists(folder_.path / fmt::format("{}.gnuplot", figure)))
        throw std::out_of_range(fmt::format("no template '{}.gnuplot'", figure));
    const std::string script_file = fmt::format("{}.gp", id);
    const std::string log_file = fmt::format("{}.log", id);
    std::string script =
        fmt::format("set terminal {}\nset output '{}.out'\nload 'style.gnuplot'\n", terminal, id);
    for (const GnuplotVariable& variable : variables) script += variable.definition;
    script += fmt::format("load '{}.gnuplot'\n", figure);
    core::write_file_atomically(folder_.path / script_file, script);

    std::string program = "gnuplot", defaults = "-d", argument = script_file;  // -d: no ~/.gnuplot
    const std::array<char*, 4> arguments{program.data(), defaults.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.path.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log_file.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_t usual;  // a program that is ignored when it is signalled would go on
    posix_spawnattr_init(&usual);
    sigset_t ignored_here;
    sigemptyset(&ignored_here);
    for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&ignored_here, signal);
    posix_spawnattr_setsigdefault(&usual, &ignored_here);
    posix_spawnattr_setflags(&usual, POSIX_SPAWN_SETSIGDEF);
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, program.c_str(), &actions, &usual, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&usual);
    if (error != 0)
        throw FileError(fmt::format(
            "gnuplot cannot be started ({}); the report's figures need it: install the Debian "
            "package gnuplot-nox",
            std::strerror(error)));

    const int status = end_of(child, id);
    const auto output = folder_.path / fmt::format("{}.out", id);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !std::filesystem::exists(output))
        throw FileError(fmt::format("gnuplot failed on figure '{}': {}", id,
                                    core::read_whole_file(folder_.path / log_file)));
    return core::read_whole_file(output);
}

std::string Gnuplot::svg(std::string_view figure, std::string_view id, std::string_view title,
                         PictureSize size, const GnuplotVariables& variables) const {
    const std::string terminal =
        fmt::format("svg enhanced dynamic size {},{} font 'Helvetica,13' name '{}'", size.width,
                    size.height, id);
    return to_element(run(figure, id, terminal, variables), id, title);
}

std::string Gnuplot::png(std::string_view figure, std::string_view id, PictureSize size,
                         const GnuplotVariables& variables) const {
    const std::string terminal =
        fmt::format("pngcairo enhanced size {},{} font 'sans,17'", size.width, size.height);
    return run(figure, id, terminal, variables);
}

}  // namespace grainfield::triaxial::report
