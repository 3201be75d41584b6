#include "triaxial/cli/argument_parser.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>

namespace grainfield::triaxial {

Argument& Argument::required() {
    option_->required();
    return *this;
}

Argument& Argument::range(int lowest, int highest) {
    option_->check(CLI::Range(lowest, highest));
    return *this;
}

Argument& Argument::range(double lowest, double highest) {
    option_->check(CLI::Range(lowest, highest));
    return *this;
}

Argument& Argument::one_of(const std::vector<std::string>& texts) {
    option_->check(CLI::IsMember(texts));
    return *this;
}

Argument& Argument::show_default() {
    option_->capture_default_str();
    return *this;
}

Argument& Argument::take_last() {
    option_->take_last();
    return *this;
}

Argument& Argument::one_value_each_time() {
    option_->allow_extra_args(false);
    return *this;
}

Argument& Argument::one_or_more_values() {
    option_->expected(1, -1);
    return *this;
}

ArgumentParser::ArgumentParser(const std::string& description, const std::string& name)
    : app_(std::make_shared<CLI::App>(description, name)) {}

template <class T>
Argument ArgumentParser::add(const std::string& name, T& target, const std::string& help) {
    return Argument(app_->add_option(name, target, help));
}

using Path = std::filesystem::path;
using Text = std::string;
template Argument ArgumentParser::add(const Text&, int&, const Text&);
template Argument ArgumentParser::add(const Text&, std::int64_t&, const Text&);
template Argument ArgumentParser::add(const Text&, double&, const Text&);
template Argument ArgumentParser::add(const Text&, Text&, const Text&);
template Argument ArgumentParser::add(const Text&, Path&, const Text&);
template Argument ArgumentParser::add(const Text&, std::optional<std::int32_t>&, const Text&);
template Argument ArgumentParser::add(const Text&, std::optional<std::int64_t>&, const Text&);
template Argument ArgumentParser::add(const Text&, std::optional<Text>&, const Text&);
template Argument ArgumentParser::add(const Text&, std::vector<Text>&, const Text&);

Argument ArgumentParser::add_flag(const std::string& name, bool& target, const std::string& help) {
    return Argument(app_->add_flag(name, target, help));
}

void ArgumentParser::add_version(const std::string& name, const std::string& text) {
    app_->set_version_flag(name, text);
}

ArgumentParser ArgumentParser::add_subcommand(const std::string& name,
                                              const std::string& description) {
    app_->require_subcommand(0, 1);
    return ArgumentParser(app_->get_subcommand_ptr(app_->add_subcommand(name, description)));
}

void ArgumentParser::set_footer(const std::string& text) {
    app_->footer(text);
}

std::string ArgumentParser::footer() const {
    return app_->get_footer();
}

std::string ArgumentParser::help() const {
    return app_->help();
}

bool ArgumentParser::parse(int argc, const char* const* argv) {
    try {
        app_->parse(argc, argv);
        return true;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw UsageError(error.what());
        app_->exit(error);
        return false;
    }
}

std::string ArgumentParser::chosen() const {
    const auto given = app_->get_subcommands();
    return given.empty() ? std::string() : given.front()->get_name();
}

std::optional<int> ArgumentParser::parse_or_print(int argc, const char* const* argv) {
    try {
        app_->parse(argc, argv);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        return app_->exit(error);
    }
}

}  // namespace grainfield::triaxial
