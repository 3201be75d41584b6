#pragma once
// The command line of a program: options, positional arguments, subcommands. CLI11 does the work
// in argument_parser.cpp and is seen nowhere else: reading it takes seconds in every file.

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace grainfield::triaxial {

/// A command line that cannot be parsed. what() names the argument and what is expected.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An argument of a parser, to say more about it. Lives as long as the parser's program.
class Argument {
  public:
    explicit Argument(CLI::Option* option) : option_(option) {}

    Argument& required();
    Argument& range(int lowest, int highest);        ///< both allowed
    Argument& range(double lowest, double highest);  ///< both allowed
    Argument& one_of(const std::vector<std::string>& texts);
    Argument& show_default();         ///< in the help: the value the target has now
    Argument& take_last();            ///< given more than once, the last counts
    Argument& one_value_each_time();  ///< a list, of one value for each time the name is given
    Argument& one_or_more_values();   ///< a list, of all values that follow the name

  private:
    CLI::Option* option_;
};

/// A program or one of its subcommands. A copy is the same parser.
class ArgumentParser {
  public:
    explicit ArgumentParser(const std::string& description, const std::string& name = "");

    /// An option (`--name`) or a positional argument (`name`). `target` gets the value when the
    /// command line is parsed and must live until then; without a value it keeps its own.
    /// T: int, double, std::int64_t, std::string, std::filesystem::path, std::optional of
    /// std::int32_t, std::int64_t or std::string, std::vector of std::string.
    template <class T>
    Argument add(const std::string& name, T& target, const std::string& help);
    /// An option without a value, true where it is given.
    Argument add_flag(const std::string& name, bool& target, const std::string& help);
    /// An option that prints `text` and ends the parsing.
    void add_version(const std::string& name, const std::string& text);
    /// One subcommand at most may be given.
    ArgumentParser add_subcommand(const std::string& name, const std::string& description);

    /// The end of the help.
    void set_footer(const std::string& text);
    std::string footer() const;
    std::string help() const;

    /// Parses. False where help or the version was asked for: it stands on stdout then. Throws
    /// UsageError.
    bool parse(int argc, const char* const* argv);
    /// Name of the subcommand that was given; empty: none.
    std::string chosen() const;

    /// All that a program without subcommands needs: parses, and prints what is wrong. The exit
    /// code where the program ends here.
    std::optional<int> parse_or_print(int argc, const char* const* argv);

  private:
    explicit ArgumentParser(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

    std::shared_ptr<CLI::App> app_;
};

}  // namespace grainfield::triaxial
