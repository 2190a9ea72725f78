#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// A command line: options, flags and commands, their help, and what is wrong with one. Names and behaviour
/// are CLI11's, whose headers take long to compile and are included in arguments.cpp alone.
namespace nplc::arguments {

/// One option, flag or argument while it is described; it belongs to its App. Each returns itself.
class Option {
  public:
    Option* required();
    Option* type_name(const std::string& name);
    Option* envname(const std::string& variable);
    /// The variable's present value is shown in the help as the default.
    Option* capture_default_str();
    Option* delimiter(char between_values);
    /// May be given several times, with one value each.
    Option* repeatable();
    /// Called with each value.
    Option* each(const std::function<void(const std::string&)>& take);

    /// Both limits included. The help names them with their type.
    Option* in_range(int min, int max);
    Option* in_range(std::uint32_t min, std::uint32_t max);
    Option* in_range(double min, double max);
    Option* non_negative();
    Option* one_of(const std::vector<std::string>& words);

    Option* excludes(Option* other);
    /// An option that exists already, given with its dashes.
    Option* excludes(const std::string& other);

  private:
    friend class App;
    explicit Option(void* option) : option_(option) {}
    void* option_;  ///< a CLI::Option
};

/// An option as it was described, for pages that are written from it.
struct OptionText {
    std::vector<std::string> long_names{};  ///< without dashes
    std::string names;                      ///< all of them as in the help: -o,--output
    std::string positional;                 ///< an argument's name; empty for an option
    std::string description;
    bool has_value = false;  ///< false for a flag
};

struct ParseResult {
    enum class Kind : std::uint8_t {
        done,   ///< understood, and the callbacks were called
        told,   ///< help or version has been printed
        wrong,  ///< see `error`
    };
    Kind kind = Kind::done;
    int exit_code = 0;    ///< when `told`
    std::string error{};  ///< one line, when `wrong`
};

/// A program's command line, or one of its commands. Variables must outlive it.
class App {
  public:
    explicit App(const std::string& description, const std::string& name = {});
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    /// An option's text, here and below, is never empty: `-o ""` is wrong usage.
    Option* add_option(const std::string& name, std::string& variable, const std::string& description);
    Option* add_option(const std::string& name, std::optional<std::string>& variable,
                       const std::string& description);
    Option* add_option(const std::string& name, std::vector<std::string>& variable,
                       const std::string& description);
    Option* add_option(const std::string& name, int& variable, const std::string& description);
    Option* add_option(const std::string& name, std::uint32_t& variable, const std::string& description);
    Option* add_option(const std::string& name, std::uint64_t& variable, const std::string& description);
    Option* add_option(const std::string& name, double& variable, const std::string& description);
    /// Its values go to `each`.
    Option* add_option(const std::string& name, const std::string& description);
    Option* add_option_function(const std::string& name, const std::function<void(const std::string&)>& take,
                                const std::string& description);
    Option* add_flag(const std::string& name, bool& variable, const std::string& description);
    /// Adds --version, which prints `text` and the commit the program was built from (commit.h).
    void set_version_flag(const std::string& name, const std::string& text);

    App* add_subcommand(const std::string& name, const std::string& description);
    void require_subcommand(unsigned count);
    /// Adds `help [COMMAND]`, which prints the same as --help.
    void add_help_command();
    /// Options that a command does not have are searched in the App above it.
    void fallthrough();
    void callback(const std::function<void()>& work);
    void footer(const std::string& text);

    /// Prints help or version when asked to. An unknown command or option is answered with a guess. What a
    /// callback throws comes through.
    ParseResult parse(int argc, const char* const* argv);
    bool got_subcommand(const std::string& name) const;

    std::string get_name() const;
    std::string get_description() const;
    std::string get_footer() const;
    std::vector<const App*> get_subcommands() const;
    std::vector<OptionText> get_options() const;

  private:
    struct Parts;
    explicit App(std::unique_ptr<Parts> parts);
    Option* kept(void* option);
    ParseResult help_of(const std::vector<std::string>& commands);
    std::string what_is_wrong(const std::string& error) const;

    std::unique_ptr<Parts> parts_;
};

}  // namespace nplc::arguments
