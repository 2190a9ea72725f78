// Shell completion and the manual page, written from the command line's own description.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "arguments/pages.h"

namespace nplc::arguments {
namespace {

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

std::vector<std::string> command_names(const App& app) {
    std::vector<std::string> names;
    for (const App* command : app.get_subcommands()) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> flags_of(const App& app) {
    std::vector<std::string> flags;
    for (const OptionText& option : app.get_options()) {
        for (const std::string& name : option.long_names) flags.push_back("--" + name);
    }
    return flags;
}

/// A group's commands are known by its name and a blank before theirs.
std::string bash_cases(const App& app, const About& about, const std::string& before) {
    std::string cases;
    for (const App* command : app.get_subcommands()) {
        const std::string name = before + command->get_name();
        const auto inner = command_names(*command);
        std::vector<std::string> words = flags_of(*command);
        words.insert(words.end(), inner.begin(), inner.end());
        if (const auto more = about.words.find(name); more != about.words.end())
            words.insert(words.end(), more->second.begin(), more->second.end());
        cases += fmt::format("        \"{}\") words=\"{}\"; files={}{} ;;\n", name, joined(words),
                             about.file_commands.count(name),
                             inner.empty() ? "" : fmt::format("; group=\"{} \"", name));
        cases += bash_cases(*command, about, name + " ");
    }
    return cases;
}

std::string bash_completion(const App& app, const About& about) {
    const std::string cases = bash_cases(app, about, "");
    const std::string files = fmt::format("{}", fmt::join(about.file_options, "|"));
    std::string values;
    for (const auto& [option, words] : about.option_words)
        values += fmt::format("        {}) COMPREPLY=($(compgen -W \"{}\" -- \"$current\")); return ;;\n",
                              option, joined(words));
    return fmt::format(R"(# bash completion for {0}
_{0}() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD-1]}}"
    local common="{1}" words="{2}" files=0 word group=""
    case "$previous" in
        {4}) COMPREPLY=($(compgen -f -- "$current")); return ;;
{5}    esac
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case "$group$word" in
{3}        esac
    done
    COMPREPLY=($(compgen -W "$words $common" -- "$current"))
    [ "$files" = 1 ] && COMPREPLY+=($(compgen -f -- "$current"))
    return 0
}}
complete -o filenames -F _{0} {0}
)",
                       app.get_name(), joined(flags_of(app)), joined(command_names(app)), cases, files,
                       values);
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

std::string zsh_options(const App& app) {
    std::string text;
    for (const OptionText& option : app.get_options()) {
        for (const std::string& name : option.long_names) {
            text += fmt::format(" \\\n                '--{}[{}]{}'", name, zsh_text(option.description),
                                option.has_value ? ":value:_files" : "");
        }
    }
    return text;
}

std::string zsh_cases(const App& app, const About& about, const std::string& before);

/// What stands behind a command's name; of a group its commands, and what stands behind theirs.
std::string zsh_arguments(const App& command, const About& about, const std::string& name) {
    const auto inner = command_names(command);
    if (!inner.empty()) {
        const bool plain = std::all_of(inner.begin(), inner.end(), [&](const std::string& one) {
            return !about.words.contains(name + " " + one);
        });
        if (plain) return fmt::format(" '1:what:({})'", joined(inner));
        return fmt::format(
            " '1:what:({})' '*::argument:->inner'\n            [[ $state = inner ]] && case $line[1] in\n{}"
            "            esac",
            joined(inner), zsh_cases(command, about, name + " "));
    }
    const auto words = about.words.find(name);
    if (words == about.words.end()) return " '*:argument:_files'";
    return fmt::format(" '*:argument:({})'", joined(words->second));
}

std::string zsh_cases(const App& app, const About& about, const std::string& before) {
    std::string cases;
    for (const App* command : app.get_subcommands())
        cases += fmt::format("        {})\n            _arguments{}{}{} ;;\n", command->get_name(),
                             command_names(*command).empty() ? "" : " -C", zsh_options(*command),
                             zsh_arguments(*command, about, before + command->get_name()));
    return cases;
}

std::string zsh_completion(const App& app, const About& about) {
    std::string names;
    for (const App* command : app.get_subcommands())
        names += fmt::format("        '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
    const std::string cases = zsh_cases(app, about, "");
    return fmt::format(R"(#compdef {0}
# zsh completion for {0}
_{0}() {{
    local -a commands
    local state line
    commands=(
{1})
    _arguments -C{2} '1:command:->command' '*::argument:->argument'
    case $state in
        command) _describe 'command' commands ;;
        argument)
        case $line[1] in
{3}        esac ;;
    esac
}}
_{0} "$@"
)",
                       app.get_name(), names, zsh_options(app), cases);
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

std::string man_options(const App& app) {
    std::string text;
    for (const OptionText& option : app.get_options())
        text += fmt::format(".TP\n.B {}\n{}\n", roff(option.names), roff(option.description));
    return text;
}

std::string man_command(const App& command, const std::string& before) {
    std::string name = before + command.get_name();
    for (const OptionText& option : command.get_options()) {
        if (!option.positional.empty()) name += " " + option.positional;
    }
    std::string text =
        fmt::format(".SS {}\n{}.\n{}", roff(name), roff(command.get_description()), man_options(command));
    for (const App* inner : command.get_subcommands())
        text += man_command(*inner, before + command.get_name() + " ");
    return text;
}

std::string man_page(const App& app, const About& about) {
    std::string capitals = app.get_name();
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string commands;
    for (const App* command : app.get_subcommands()) commands += man_command(*command, "");
    return fmt::format(
        ".TH {} {} \"\" \"{} {}\" \"NanoPLC Gateway\"\n.SH NAME\n{} \\- {}\n"
        ".SH SYNOPSIS\n.B {}\n[options] command [arguments]\n.SH DESCRIPTION\n{}\n"
        ".SH OPTIONS\nThey may stand before or behind the command.\n{}.SH COMMANDS\n{}",
        capitals, about.section, app.get_name(), about.version, app.get_name(), about.title, app.get_name(),
        roff(app.get_footer()), man_options(app), commands);
}

}  // namespace

void add_pages(App& app, About about, const std::function<void(const std::string& text)>& print) {
    const auto known = std::make_shared<About>(std::move(about));
    known->words["help"] = command_names(app);
    app.add_help_command();
    const auto shell = std::make_shared<std::string>();
    App& completion = *app.add_subcommand("completion", "Print the completion for a shell");
    completion.add_option("shell", *shell, "bash or zsh")->required()->one_of({"bash", "zsh"});
    completion.callback([shell, known, &app, print] {
        print(*shell == "bash" ? bash_completion(app, *known) : zsh_completion(app, *known));
    });
    App& man = *app.add_subcommand("man", "Print the manual page, for `man -l -`");
    man.callback([known, &app, print] { print(man_page(app, *known)); });
    for (App* command : {&completion, &man}) command->fallthrough();
}

}  // namespace nplc::arguments
