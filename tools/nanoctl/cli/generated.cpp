// Shell completion and the manual page, written from the command line's own description.

#include <fmt/format.h>

#include <memory>
#include <set>

#include "cli/subcommands.h"

namespace nplc::nanoctl::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); });
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> flags_of(const CLI::App& app) {
    std::vector<std::string> flags;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    }
    return flags;
}

bool takes_files(const CLI::App& app) {
    const std::set<std::string> kNames{"upload", "verify", "download"};
    return kNames.count(app.get_name()) != 0;
}

std::string bash_completion(const CLI::App& app) {
    std::string cases;
    for (const CLI::App* command : commands_of(app)) {
        std::vector<std::string> words = flags_of(*command);
        for (const std::string& name : command_names(*command)) words.push_back(name);
        cases += fmt::format("        {}) words=\"{}\"; files={} ;;\n", command->get_name(), joined(words),
                             takes_files(*command) ? 1 : 0);
    }
    return fmt::format(R"(# bash completion for nanoctl
_nanoctl() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD-1]}}"
    local common="{}" words="{}" files=0 word
    case "$previous" in
        --port|--sym|-o|--output) COMPREPLY=($(compgen -f -- "$current")); return ;;
        --baud) COMPREPLY=($(compgen -W "9600 19200 38400 57600 115200 230400" -- "$current")); return ;;
    esac
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case "$word" in
{}        esac
    done
    COMPREPLY=($(compgen -W "$words $common" -- "$current"))
    [ "$files" = 1 ] && COMPREPLY+=($(compgen -f -- "$current"))
    return 0
}}
complete -o filenames -F _nanoctl nanoctl
)",
                       joined(flags_of(app)), joined(command_names(app)), cases);
}

/// A description inside single quotes of _arguments and _describe.
std::string zsh_text(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\'')
            result += "'\\''";
        else if (c == ':' || c == '[' || c == ']')
            result += std::string("\\") + c;
        else
            result += c;
    }
    return result;
}

std::string zsh_options(const CLI::App& app) {
    std::string text;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            text +=
                fmt::format(" \\\n                '--{}[{}]{}'", name, zsh_text(option->get_description()),
                            option->get_type_size() == 0 ? "" : ":value:_files");
        }
    }
    return text;
}

std::string zsh_completion(const CLI::App& app) {
    std::string names;
    std::string cases;
    for (const CLI::App* command : commands_of(app)) {
        names += fmt::format("        '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
        const auto inner = command_names(*command);
        cases += fmt::format(
            "        {})\n            _arguments{}{} ;;\n", command->get_name(), zsh_options(*command),
            inner.empty() ? " '*:argument:_files'" : fmt::format(" '1:what:({})'", joined(inner)));
    }
    return fmt::format(R"(#compdef nanoctl
# zsh completion for nanoctl
_nanoctl() {{
    local -a commands
    local state line
    commands=(
{})
    _arguments -C{} '1:command:->command' '*::argument:->argument'
    case $state in
        command) _describe 'command' commands ;;
        argument)
        case $line[1] in
{}        esac ;;
    esac
}}
_nanoctl "$@"
)",
                       names, zsh_options(app), cases);
}

std::string roff(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else if (c == '\n')
            result += "\n.br\n";
        else
            result += c;
    }
    return result;
}

std::string man_options(const CLI::App& app) {
    std::string text;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_name(false, true).empty()) continue;
        text += fmt::format(".TP\n.B {}\n{}\n", roff(option->get_name(option->get_positional(), true)),
                            roff(option->get_description()));
    }
    return text;
}

std::string man_command(const CLI::App& command, const std::string& before) {
    std::string name = before + command.get_name();
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) name += " " + option->get_name(true);
    }
    std::string text =
        fmt::format(".SS {}\n{}.\n{}", roff(name), roff(command.get_description()), man_options(command));
    for (const CLI::App* inner : commands_of(command))
        text += man_command(*inner, before + command.get_name() + " ");
    return text;
}

std::string man_page(const CLI::App& app) {
    std::string commands;
    for (const CLI::App* command : commands_of(app)) commands += man_command(*command, "");
    return fmt::format(
        ".TH NANOCTL 1 \"\" \"nanoctl {}\" \"NanoPLC Gateway\"\n.SH NAME\nnanoctl \\- {}\n"
        ".SH SYNOPSIS\n.B nanoctl\n[options] command [arguments]\n.SH DESCRIPTION\n{}\n"
        ".SH OPTIONS\nThey may stand before or behind the command.\n{}.SH COMMANDS\n{}",
        NPLC_VERSION, "a NanoPLC gateway from a terminal", roff(app.get_footer()), man_options(app),
        commands);
}

}  // namespace

void add_generated(CLI::App& app, Common& common) {
    const auto shell = std::make_shared<std::string>();
    CLI::App& completion = add_command(app, "completion", "Print the completion for a shell");
    completion.add_option("shell", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
    completion.callback([shell, &app, &common] {
        guard(common,
              [&] { fmt::print("{}", *shell == "bash" ? bash_completion(app) : zsh_completion(app)); });
    });
    add_command(app, "man", "Print the manual page, for `man -l -`").callback([&app, &common] {
        guard(common, [&] { fmt::print("{}", man_page(app)); });
    });
}

}  // namespace nplc::nanoctl::cli
