#pragma once
// The repository as text, for the tests that keep the house's rules.

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grainfield::repository {

struct SourceFile {
    std::string path;  // from the root of the repository, with '/' [-]
    std::string text;  // all of it [-]
};

inline std::vector<std::string> split_lines(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

inline bool is_cpp(std::string_view path) {
    const auto ends = [&](std::string_view suffix) { return path.ends_with(suffix); };
    return ends(".cpp") || ends(".hpp") || ends(".h");
}

/// Every file below `root` but for build results and what belongs to git, an editor or a workplace;
/// from the root, with '/', sorted.
inline std::vector<std::string> file_paths(const std::filesystem::path& root) {
    constexpr std::array<std::string_view, 9> foreign = {
        ".git", "build", "out", "shared", ".cache", ".vscode", ".idea", ".venv", "__pycache__"};
    std::vector<std::string> paths;
    for (std::filesystem::recursive_directory_iterator entry(root), end; entry != end; ++entry) {
        const std::string name = entry->path().filename().string();
        if (entry->is_directory() || name == ".git") {  // in a worktree .git is a file
            if (std::find(foreign.begin(), foreign.end(), name) != foreign.end())
                entry.disable_recursion_pending();
            continue;
        }
        if (!entry->is_regular_file() || name.ends_with(".swp")) continue;
        paths.push_back(std::filesystem::relative(entry->path(), root).generic_string());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// Those that are text, sorted by path. A file with a zero byte is not text.
inline std::vector<SourceFile> text_files(const std::filesystem::path& root) {
    std::vector<SourceFile> files;
    for (const std::string& path : file_paths(root)) {
        std::ifstream stream(root / path, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        if (text.find('\0') == std::string::npos) files.push_back({path, std::move(text)});
    }
    return files;
}

/// True if `text[at]` is the ' of a number such as 1'000.
inline bool is_digit_separator(std::string_view text, std::size_t at) {
    std::size_t start = at;
    while (start > 0 && (std::isalnum(static_cast<unsigned char>(text[start - 1])) != 0 ||
                         text[start - 1] == '\''))
        --start;
    return start < at && std::isdigit(static_cast<unsigned char>(text[start])) != 0;
}

/// Calls comment(from, to) for every comment of a C++ text and literal(from, to) for the inside of
/// every literal.
template <class Comment, class Literal>
void scan_cpp(std::string_view text, const Comment& comment, const Literal& literal) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.substr(i, 2) == "//") {
            const std::size_t end = std::min(text.find('\n', i), text.size());
            comment(i, end);
            i = end;
        } else if (text.substr(i, 2) == "/*") {
            const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
            comment(i, end);
            i = end - 1;
        } else if (text.substr(i, 2) == "R\"") {
            const std::size_t open = std::min(text.find('(', i), text.size());
            std::string close = ")";
            close.append(text.substr(i + 2, open - i - 2)).append("\"");
            const std::size_t end = std::min(text.find(close, open), text.size());
            literal(i + 2, end);
            i = end + close.size() - 1;
        } else if (text[i] == '"' || (text[i] == '\'' && !is_digit_separator(text, i))) {
            std::size_t end = i + 1;
            while (end < text.size() && text[end] != text[i] && text[end] != '\n')
                end += text[end] == '\\' ? 2 : 1;
            literal(i + 1, end);
            i = end;
        }
    }
}

/// C++ text with comments and the insides of literals blanked; every line and column stays.
inline std::string code_only(std::string_view text) {
    std::string code(text);
    const auto blank = [&](std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < std::min(to, code.size()); ++k)
            if (code[k] != '\n') code[k] = ' ';
    };
    scan_cpp(text, blank, blank);
    return code;
}

/// C++ text with everything but comments blanked; every line and column stays.
inline std::string comments_only(std::string_view text) {
    std::string comments(text.size(), ' ');
    for (std::size_t k = 0; k < text.size(); ++k)
        if (text[k] == '\n') comments[k] = '\n';
    scan_cpp(
        text,
        [&](std::size_t from, std::size_t to) {
            to = std::min(to, text.size());
            std::copy(text.begin() + static_cast<std::ptrdiff_t>(from),
                      text.begin() + static_cast<std::ptrdiff_t>(to),
                      comments.begin() + static_cast<std::ptrdiff_t>(from));
        },
        [](std::size_t, std::size_t) {});
    return comments;
}

}  // namespace grainfield::repository
