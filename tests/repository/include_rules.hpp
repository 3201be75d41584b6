#pragma once
// The one-way include direction of the folders (ARCHITECTURE.md), as functions on text.

#include <array>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/repository/source_tree.hpp"

namespace grainfield::repository {

struct Module {
    std::string_view name;         // folder [-]
    std::string_view may_include;  // folders, each between spaces [-]
};

constexpr std::array<Module, 7> modules = {{
    {"kernels", " kernels "},
    {"core", " kernels core "},
    {"packing", " kernels core packing "},
    {"randomfield", " kernels core randomfield "},
    {"triaxial", " kernels core packing randomfield triaxial "},
    {"bench", " kernels core packing randomfield triaxial bench "},
    {"tests", " kernels core packing randomfield triaxial bench tests "},
}};

inline std::string first_folder(std::string_view path) {
    const std::size_t slash = path.find('/');
    return std::string(slash == std::string_view::npos ? "" : path.substr(0, slash));
}

inline const Module* find_module(std::string_view name) {
    for (const Module& module : modules)
        if (module.name == name) return &module;
    return nullptr;
}

/// What is wrong with `#include OPERAND` in a file of `module`; empty if nothing is.
inline std::string include_fault(const Module& module, const std::string& operand) {
    static const std::regex quoted(R"re("([^"]+)")re");
    static const std::regex angled("<([^>]+)>");
    static const std::regex console("iostream|print|spdlog/.*|toml\\+\\+.*|CLI/.*|CLI11.*");
    static const std::regex containers("vector|deque|list|map|set|unordered_map|unordered_set");
    const bool quiet = module.name == "kernels" || module.name == "core";
    std::smatch match;
    if (std::regex_match(operand, match, quoted)) {
        const std::string folder = first_folder(match[1].str());
        if (find_module(folder) == nullptr || operand.find("..") != std::string::npos)
            return "is not written from the root of the repository";
        if (module.may_include.find(" " + folder + " ") == std::string_view::npos)
            return "is against the include direction: " + std::string(module.name) +
                   " may include" + std::string(module.may_include) + "only";
        return "";
    }
    if (!std::regex_match(operand, match, angled)) return "hides what it includes";
    const std::string header = match[1].str();
    if (find_module(first_folder(header)) != nullptr) return "is ours and belongs in quotes";
    if (quiet && std::regex_match(header, console)) return "brings a console or a config";
    if (module.name == "kernels" && std::regex_match(header, containers))
        return "allocates; kernels work on spans";
    return "";
}

/// What is wrong with one line of code (no comments, no insides of literals).
inline std::string code_fault(const Module& module, const std::string& code) {
    static const std::regex console(
        R"re(\b(cout|cerr|clog|stdout|stderr|printf|vprintf|puts|putchar|perror)\b|\bprint\s*\(\s*")re");
    static const std::regex allocation(R"re(\b(new|malloc|calloc|realloc|aligned_alloc)\b)re");
    std::smatch match;
    if (module.name != "kernels" && module.name != "core") return "";
    if (std::regex_search(code, match, console)) return "writes to a console: " + match.str();
    if (module.name == "kernels" && std::regex_search(code, match, allocation))
        return "allocates: " + match.str();
    return "";
}

/// The faults of one file, each as `path:line: text: what is wrong`; files outside the modules
/// have none.
inline std::vector<std::string> faults_of(const SourceFile& file) {
    static const std::regex include(R"re(^\s*#\s*(include|include_next|import)\b([^\n]*))re");
    const Module* module = find_module(first_folder(file.path));
    if (module == nullptr || !is_cpp(file.path)) return {};
    std::vector<std::string> faults;
    const std::vector<std::string> lines = split_lines(file.text);
    const std::vector<std::string> code = split_lines(code_only(file.text));
    for (std::size_t k = 0; k < lines.size(); ++k) {
        std::smatch match;
        std::string fault;
        if (std::regex_match(code[k], match, include)) {
            // The operand as it was written: its literal is blank in `code`.
            const auto at = static_cast<std::size_t>(match.position(2));
            std::string operand = lines[k].substr(at, code[k].find_last_not_of(" \r") + 1 - at);
            operand.erase(0, operand.find_first_not_of(' '));
            fault = include_fault(*module, operand);
        } else {
            fault = code_fault(*module, code[k]);
        }
        if (!fault.empty())
            faults.push_back(file.path + ":" + std::to_string(k + 1) + ": " + lines[k] + ": " +
                             fault);
    }
    return faults;
}

}  // namespace grainfield::repository
