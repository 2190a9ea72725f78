#include "arguments/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "arguments/commit.h"
#include "text/edit_distance.h"

namespace nplc::arguments {
namespace {

CLI::Option& cli(void* option) {
    return *static_cast<CLI::Option*>(option);
}

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

OptionText text_of(const CLI::Option& option) {
    return {.long_names = option.get_lnames(),
            .names = option.get_name(option.get_positional(), true),
            .positional = option.get_positional() ? option.get_name(true) : std::string(),
            .description = option.get_description(),
            .has_value = option.get_items_expected_max() != 0};
}

/// Rejects an empty value; an option without a value must be omitted. Positional arguments are not checked.
CLI::Option* never_empty(CLI::Option* option) {
    if (option->get_positional()) return option;
    return option->check(CLI::Validator(
        [](const std::string& text) {
            return std::string(text.empty() ? "its value is empty: write one, or leave the option out" : "");
        },
        ""));
}

std::string guess(const std::string& word, const std::vector<std::string>& known) {
    const auto best = spelling::nearest(word, {known.begin(), known.end()});
    return best.empty() ? std::string() : "; did you mean '" + std::string(best) + "'?";
}

std::vector<std::string> commands_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> flags_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

/// The command that was read last, or the program.
const CLI::App& innermost(const CLI::App& app) {
    const auto read = app.get_subcommands();
    return read.empty() ? app : innermost(*read.back());
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::string no_command(const std::string& word, const CLI::App& app) {
    return "'" + word + "' is no command" + guess(word, commands_of(app));
}

/// Prints help or version.
ParseResult told(const CLI::App& app, const CLI::ParseError& error) {
    const int code = app.exit(error);
    std::cout.flush();
    if (std::cout.fail())
        return {.kind = ParseResult::Kind::wrong, .error = "cannot write to standard output"};
    return {.kind = ParseResult::Kind::told, .exit_code = code};
}

}  // namespace

Option* Option::required() {
    cli(option_).required();
    return this;
}

Option* Option::type_name(const std::string& name) {
    cli(option_).type_name(name);
    return this;
}

Option* Option::envname(const std::string& variable) {
    cli(option_).envname(variable);
    return this;
}

Option* Option::capture_default_str() {
    cli(option_).capture_default_str();
    return this;
}

Option* Option::delimiter(char between_values) {
    cli(option_).delimiter(between_values);
    return this;
}

Option* Option::repeatable() {
    cli(option_).expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    return this;
}

Option* Option::each(const std::function<void(const std::string&)>& take) {
    cli(option_).each(take);
    return this;
}

Option* Option::in_range(int min, int max) {
    cli(option_).check(CLI::Range(min, max));
    return this;
}

Option* Option::in_range(std::uint32_t min, std::uint32_t max) {
    cli(option_).check(CLI::Range(min, max));
    return this;
}

Option* Option::in_range(double min, double max) {
    cli(option_).check(CLI::Range(min, max));
    return this;
}

Option* Option::non_negative() {
    cli(option_).check(CLI::NonNegativeNumber);
    return this;
}

Option* Option::one_of(const std::vector<std::string>& words) {
    cli(option_).check(CLI::IsMember(words));
    return this;
}

Option* Option::excludes(Option* other) {
    cli(option_).excludes(&cli(other->option_));
    return this;
}

Option* Option::excludes(const std::string& other) {
    cli(option_).excludes(other);
    return this;
}

struct App::Parts {
    std::unique_ptr<CLI::App> own;  ///< owned by the program; a command's App is owned by CLI11
    CLI::App* app;
    bool help = false;  ///< has the command `help`
    std::vector<std::unique_ptr<Option>> options{};
    std::vector<std::unique_ptr<App>> commands{};
};

App::App(const std::string& description, const std::string& name) : parts_(std::make_unique<Parts>()) {
    parts_->own = std::make_unique<CLI::App>(description, name);
    parts_->app = parts_->own.get();
}

App::App(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

App::~App() = default;

Option* App::kept(void* option) {
    return parts_->options.emplace_back(new Option(option)).get();
}

Option* App::add_option(const std::string& name, std::string& variable, const std::string& description) {
    return kept(never_empty(parts_->app->add_option(name, variable, description)));
}

Option* App::add_option(const std::string& name, std::optional<std::string>& variable,
                        const std::string& description) {
    return kept(never_empty(parts_->app->add_option(name, variable, description)));
}

Option* App::add_option(const std::string& name, std::vector<std::string>& variable,
                        const std::string& description) {
    return kept(never_empty(parts_->app->add_option(name, variable, description)));
}

Option* App::add_option(const std::string& name, int& variable, const std::string& description) {
    return kept(parts_->app->add_option(name, variable, description));
}

Option* App::add_option(const std::string& name, std::uint32_t& variable, const std::string& description) {
    return kept(parts_->app->add_option(name, variable, description));
}

Option* App::add_option(const std::string& name, std::uint64_t& variable, const std::string& description) {
    return kept(parts_->app->add_option(name, variable, description));
}

Option* App::add_option(const std::string& name, double& variable, const std::string& description) {
    return kept(parts_->app->add_option(name, variable, description));
}

Option* App::add_option(const std::string& name, const std::string& description) {
    return kept(never_empty(parts_->app->add_option(name, description)));
}

Option* App::add_option_function(const std::string& name, const std::function<void(const std::string&)>& take,
                                 const std::string& description) {
    return kept(never_empty(parts_->app->add_option_function<std::string>(name, take, description)));
}

Option* App::add_flag(const std::string& name, bool& variable, const std::string& description) {
    return kept(parts_->app->add_flag(name, variable, description));
}

void App::set_version_flag(const std::string& name, const std::string& text) {
    parts_->app->set_version_flag(name, text + " (commit " + std::string(commit()) + ")");
}

App* App::add_subcommand(const std::string& name, const std::string& description) {
    auto parts = std::make_unique<Parts>();
    parts->app = parts_->app->add_subcommand(name, description);
    return parts_->commands.emplace_back(new App(std::move(parts))).get();
}

void App::require_subcommand(unsigned count) {
    parts_->app->require_subcommand(static_cast<int>(count));
}

void App::fallthrough() {
    parts_->app->fallthrough();
}

void App::callback(const std::function<void()>& work) {
    parts_->app->callback(work);
}

void App::footer(const std::string& text) {
    parts_->app->footer(text);
}

void App::add_help_command() {
    App& help = *add_subcommand("help", "Say what --help says of a command");
    parts_->help = true;
    help.parts_->app->add_option("command", "Its name");
}

ParseResult App::help_of(const std::vector<std::string>& commands) {
    std::vector<std::string> words = commands;
    const CLI::App* app = parts_->app;
    for (const std::string& name : commands) {
        const auto inner = app->get_subcommands([&](const CLI::App* one) { return one->check_name(name); });
        if (inner.empty()) return {.kind = ParseResult::Kind::wrong, .error = no_command(name, *app)};
        app = inner.front();
    }
    words.emplace_back("--help");
    std::reverse(words.begin(), words.end());
    try {
        parts_->app->parse(words);
    } catch (const CLI::ParseError& error) {
        return told(*parts_->app, error);
    }
    return {};
}

/// CLI11's message for an unknown command does not name the command.
std::string App::what_is_wrong(const std::string& error) const {
    const std::vector<std::string> rest = parts_->app->remaining(true);
    const CLI::App& last = innermost(*parts_->app);
    const bool lacks_command = error.find("ubcommand is required") != std::string::npos;
    if (rest.empty()) return lacks_command ? "a command is missing: " + listed(commands_of(last)) : error;
    const std::string& word = rest.front();
    if (lacks_command && !word.starts_with('-')) return no_command(word, last);
    if (!word.starts_with("--")) return error;
    std::vector<std::string> known = flags_of(last);
    for (const std::string& flag : flags_of(*parts_->app)) known.push_back(flag);
    return "'" + word + "' is no option here" + guess(word, known);
}

ParseResult App::parse(int argc, const char* const* argv) {
    const bool names_one = argc < 3 || !std::string_view(argv[2]).starts_with('-');
    if (parts_->help && argc > 1 && std::string_view(argv[1]) == "help" && names_one)
        return help_of({argv + 2, argv + argc});
    try {
        parts_->app->parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return told(*parts_->app, error);
        return {.kind = ParseResult::Kind::wrong, .error = one_line(what_is_wrong(error.what()))};
    }
    return {};
}

bool App::got_subcommand(const std::string& name) const {
    return parts_->app->got_subcommand(name);
}

std::string App::get_name() const {
    return parts_->app->get_name();
}

std::string App::get_description() const {
    return parts_->app->get_description();
}

std::string App::get_footer() const {
    return parts_->app->get_footer();
}

std::vector<const App*> App::get_subcommands() const {
    std::vector<const App*> all;
    for (const auto& command : parts_->commands) all.push_back(command.get());
    return all;
}

std::vector<OptionText> App::get_options() const {
    std::vector<OptionText> all;
    for (const CLI::Option* option : std::as_const(*parts_->app).get_options())
        all.push_back(text_of(*option));
    return all;
}

}  // namespace nplc::arguments
