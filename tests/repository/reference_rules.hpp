#pragma once
// What comments and documents may refer to: files that exist, lines that are there, and a short
// list of files that a user has or a run makes.

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/repository/source_tree.hpp"

namespace grainfield::repository {

/// Names of files that are not in the repository: what a run writes, then what a user brings or an
/// example calls its file. Matched by the last part of a path.
inline constexpr std::array foreign_files = std::to_array<std::string_view>(
    {// of a packing, a run, a scene
     "P.h5", "P.json", "packing.h5", "packing.part.h5", "packing.json", "state.h5",
     "state.failed.h5", "summary.json", "curve.csv", "energy.csv", "contacts.csv", "trajectory.csv",
     "config.toml", "report.html",
     // of a campaign, of `field`
     "results.csv", "deterministic.csv", "failures.csv", "warnings.csv", "statistics.csv",
     "campaign.json", "repeats.csv", "repeats.json", "NAME.toml", "HASH.h5", "field.csv",
     "verification.html", "correlation.csv", "histogram.csv", "variance.csv", "scatter.csv",
     // of a test run
     "test_times.csv",
     // what a user brings
     "scene.toml", "spheres.csv", "campaign.toml", "cpt.csv"});

/// The repository as references see it.
class ReferenceTargets {
  public:
    /// Files by path; the text is looked at only where a link points to a line.
    explicit ReferenceTargets(std::map<std::string, std::string> files) : files_(std::move(files)) {
        for (const auto& [path, text] : files_) {
            const std::filesystem::path whole(path);
            for (auto folder = whole.parent_path(); !folder.empty(); folder = folder.parent_path())
                folders_.insert(folder.generic_string());
        }
    }

    bool is_file(const std::string& path) const { return files_.contains(path); }
    bool is_folder(const std::string& path) const { return folders_.contains(path); }
    /// True if some file has this path but for its suffix.
    bool is_stem(const std::string& path) const {
        const auto next = files_.lower_bound(path + ".");
        return next != files_.end() && next->first.starts_with(path + ".");
    }
    /// How many files have a path that ends with this one.
    std::size_t endings(const std::string& path) const {
        return count_if(
            [&](const std::string& file) { return file == path || file.ends_with("/" + path); });
    }
    /// How many files match, in full or from some folder on; * is any text without a slash.
    std::size_t matches(const std::string& glob) const {
        std::string pattern = "(.*/)?";
        for (const char c : glob)
            pattern += c == '*' ? std::string("[^/]*") : c == '.' ? "[.]" : std::string(1, c);
        const std::regex regex(pattern);
        return count_if([&](const std::string& file) { return std::regex_match(file, regex); });
    }
    std::vector<std::string> lines(const std::string& path) const {
        return split_lines(files_.at(path));
    }

  private:
    template <class Condition>
    std::size_t count_if(const Condition& condition) const {
        std::size_t count = 0;
        for (const auto& [path, text] : files_) count += condition(path) ? 1 : 0;
        return count;
    }

    std::map<std::string, std::string> files_;
    std::set<std::string> folders_;
};

/// A path as it is meant in a file of this folder: without . and .. parts.
inline std::string path_from(const std::string& file, const std::string& path) {
    return (std::filesystem::path(file).parent_path() / path).lexically_normal().generic_string();
}

/// Comments of scripts and configs: from # to the end of the line, and docstrings.
inline std::string script_comments(std::string_view text) {
    std::string comments;
    bool docstring = false;
    for (const std::string& line : split_lines(text)) {
        const std::size_t quotes = line.find("\"\"\"");
        const bool closes =
            quotes != std::string::npos && line.find("\"\"\"", quotes + 3) != std::string::npos;
        const std::size_t hash = line.find('#');
        if (docstring || quotes != std::string::npos)
            comments += line;
        else if (hash != std::string::npos && (hash == 0 || line[hash - 1] == ' '))
            comments += line.substr(hash);
        if (quotes != std::string::npos && !closes) docstring = !docstring;
        comments += '\n';
    }
    return comments;
}

/// Text of a document without its fenced blocks: commands and configs of users.
inline std::string without_fences(std::string_view text) {
    std::string prose;
    bool fenced = false;
    for (const std::string& line : split_lines(text)) {
        const bool fence = line.find("```") == line.find_first_not_of(' ') && !line.empty();
        if (!fenced && !fence) prose += line;
        prose += '\n';
        fenced = fenced != fence;
    }
    return prose;
}

/// The part of a file that may refer to others; nothing for data.
inline std::string referring_text(const SourceFile& file) {
    const std::string& path = file.path;
    if (path.starts_with("tests/fuzz/corpus/")) return {};
    if (is_cpp(path)) return comments_only(file.text);
    if (path.ends_with(".md")) return without_fences(file.text);
    for (const std::string_view suffix : {".py", ".toml", ".cmake", ".sh", ".gnuplot", ".in"})
        if (path.ends_with(suffix)) return script_comments(file.text);
    if (path.ends_with("CMakeLists.txt") || file.text.starts_with("#!"))
        return script_comments(file.text);
    return {};
}

/// What is wrong with one name of a file, or nothing. `name` has a suffix.
inline std::optional<std::string> fault_of_name(const std::string& file, std::string name,
                                                const ReferenceTargets& targets) {
    if (name.starts_with("./")) name.erase(0, 2);
    const std::string last = name.substr(name.rfind('/') + 1);
    if (last.starts_with('.')) return {};  // a suffix alone
    if (std::find(foreign_files.begin(), foreign_files.end(), last) != foreign_files.end())
        return {};
    if (name.find('*') != std::string::npos) {
        if (targets.matches(name) > 0) return {};
        return name + ": matches no file";
    }
    if (targets.is_file(name) || targets.is_file(path_from(file, name))) return {};
    const std::size_t endings = targets.endings(name);
    if (endings == 1) return {};
    return name + (endings == 0
                       ? ": no such file"
                       : ": " + std::to_string(endings) + " files end so; name the folder");
}

/// What is wrong with a link of a document, or nothing.
inline std::optional<std::string> fault_of_link(const std::string& file, const std::string& text,
                                                const std::string& target,
                                                const ReferenceTargets& targets) {
    if (target.find("://") != std::string::npos || target.starts_with('#')) return {};
    const std::size_t hash = target.find('#');
    std::string path = path_from(file, target.substr(0, hash));
    if (path.ends_with('/')) path.pop_back();
    if (!targets.is_file(path))
        return targets.is_folder(path) && hash == std::string::npos
                   ? std::optional<std::string>()
                   : "link to " + target + ": no such file";
    static const std::regex line_anchor("L([0-9]+)(-L([0-9]+))?");
    std::smatch anchor;
    const std::string mark = hash == std::string::npos ? "" : target.substr(hash + 1);
    if (!std::regex_match(mark, anchor, line_anchor)) return {};
    const std::vector<std::string> lines = targets.lines(path);
    const std::size_t first = std::stoul(anchor[1]);
    const std::size_t last = anchor[3].matched ? std::stoul(anchor[3]) : first;
    if (first < 1 || last < first || last > lines.size())
        return "link to " + target + ": " + path + " has " + std::to_string(lines.size()) +
               " lines";
    // The last identifier of the text, compute_forces of `VectorEngine::compute_forces()`.
    static const std::regex identifier("[A-Za-z_][A-Za-z0-9_]*");
    std::string name;
    for (std::sregex_iterator word(text.begin(), text.end(), identifier), end; word != end; ++word)
        name = word->str();
    const std::regex whole_word("\\b" + name + "\\b");
    if (name.empty() || !std::regex_search(lines[first - 1], whole_word))
        return "link to " + target + ": line " + std::to_string(first) + " has no '" + name + "'";
    return {};
}

/// What is wrong with `core/drive/servo` or `core/state/` in a document, or nothing: a folder, or
/// files by their common name.
inline std::optional<std::string> fault_of_common_name(std::string path,
                                                       const ReferenceTargets& targets) {
    if (path.ends_with('/')) path.pop_back();
    const bool ours = targets.is_folder(path.substr(0, path.find('/')));
    const bool has_suffix = path.substr(path.rfind('/') + 1).find('.') != std::string::npos;
    if (!ours || has_suffix || targets.is_folder(path) || targets.is_file(path) ||
        targets.is_stem(path))
        return {};
    return path + ": neither a folder nor a file, with whatever suffix";
}

/// The faults of one file, each as `path:line: what`.
inline std::vector<std::string> reference_faults(const SourceFile& file,
                                                 const ReferenceTargets& targets) {
    static const std::regex link("\\[([^\\]]*)\\]\\(([^) ]*)\\)");
    static const std::regex quoted("`([A-Za-z0-9_-]+/[A-Za-z0-9_./-]*)`");
    static const std::regex url("[a-z]+://[^ )>]*");
    static const std::regex named(
        "(^|[^A-Za-z0-9_./*{}<>$~+-])([A-Za-z0-9_.*/+-]*[.](cpp|hpp|inc|md|py|toml|gnuplot|csv|h5|"
        "json|html|sh|sbatch))(?![A-Za-z0-9_/*(-]|[.][A-Za-z0-9])");
    std::vector<std::string> faults;
    const std::vector<std::string> lines = split_lines(referring_text(file));
    for (std::size_t k = 0; k < lines.size(); ++k) {
        std::string line = lines[k];
        const auto each = [&](const std::regex& regex, const auto& fault_of) {
            for (std::sregex_iterator m(line.begin(), line.end(), regex), end; m != end; ++m)
                if (const std::optional<std::string> fault = fault_of(*m))
                    faults.push_back(file.path + ":" + std::to_string(k + 1) + ": " + *fault);
        };
        if (file.path.ends_with(".md")) {
            each(link, [&](const std::smatch& m) {
                return fault_of_link(file.path, m[1], m[2], targets);
            });
            line = std::regex_replace(line, link, "");
            each(quoted, [&](const std::smatch& m) { return fault_of_common_name(m[1], targets); });
        }
        line = std::regex_replace(line, url, "");
        each(named, [&](const std::smatch& m) { return fault_of_name(file.path, m[2], targets); });
    }
    return faults;
}

}  // namespace grainfield::repository
