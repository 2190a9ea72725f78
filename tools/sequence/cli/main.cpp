#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>

#include "arguments/arguments.h"
#include "arguments/pages.h"
#include "cli/common.h"
#include "cli/subcommands.h"
#include "diagnostics/explanations.h"
#include "host/terminal.h"

namespace {

void add_colour_option(nplc::arguments::App& app) {
    using nplc::seqc::cli::ColourChoice;
    const std::map<std::string, ColourChoice> choices = {
        {"auto", ColourChoice::automatic}, {"always", ColourChoice::always}, {"never", ColourChoice::never}};
    app.fallthrough();  // allowed after the subcommand too
    app.add_option_function(
           "--color",
           [choices](const std::string& text) { nplc::seqc::cli::colour_choice() = choices.at(text); },
           "Colours: auto (on a terminal, unless NO_COLOR is set), always or never")
        ->one_of({"auto", "always", "never"});
}

nplc::arguments::About about() {
    nplc::arguments::About about{
        .version = NPLC_VERSION,
        .title = "compiles sequence programs for a NanoPLC gateway",
        .file_commands = {"build", "check", "dap", "decompile", "diff", "disasm", "fmt", "graph", "report",
                          "verify"},
        .file_options = {"-o", "--output", "--symbols", "--listing", "--property", "--junit", "--scenario",
                         "--trace", "--set-points", "--proof"},
        .option_words = {{"--color", {"auto", "always", "never"}},
                         {"--assume", {"driver", "any"}},
                         {"--emit", {"promela", "smt2"}}}};
    for (const nplc::seqc::Explanation& info : nplc::seqc::explanations())
        about.words["explain"].emplace_back(info.code);
    return about;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace nplc::seqc::cli;
    nplc::host::prepare_streams();
    nplc::arguments::App app(
        "Compiles sequence programs into tables for a NanoPLC gateway, and tables back into programs.",
        "seqc");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("seqc ") + NPLC_VERSION);
    app.footer(
        "Exit codes: 0 done (warnings do not count), 1 the program has errors and nothing was written,\n"
        "2 wrong usage or a file that cannot be read, written or understood.\n"
        "`seqc explain E012` tells more about a code.\n"
        "The language is described in tools/sequence/LANGUAGE.md; examples are in tools/sequence/examples.");
    add_colour_option(app);
    int exit_code = kOk;
    add_subcommands(app, exit_code);
    nplc::arguments::add_pages(
        app, about(), [&exit_code](const std::string& text) { exit_code = print_or_write(text, {}); });
    try {
        using Kind = nplc::arguments::ParseResult::Kind;
        const auto outcome = app.parse(argc, argv);
        if (outcome.kind == Kind::told) return outcome.exit_code;
        if (outcome.kind == Kind::wrong)
            return file_problem(fmt::format("{} (see seqc --help)", outcome.error));
    } catch (const std::filesystem::filesystem_error& error) {
        return file_problem(error.what());
    } catch (const std::bad_alloc&) {
        return file_problem("not enough memory for a file of this size");
    } catch (const std::system_error& error) {
        return file_problem(fmt::format("cannot write to standard output: {}", error.code().message()));
    }
    if (std::fflush(stdout) != 0) return file_problem("cannot write to standard output");
    return exit_code;
}
