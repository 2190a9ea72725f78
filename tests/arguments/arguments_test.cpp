// Reading command lines: every kind of variable and check, what is wrong with a line, and what pages are
// written from.
#include "arguments/arguments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <stdexcept>

#include "arguments/commit.h"

namespace nplc::arguments {
namespace {

using Kind = ParseResult::Kind;
using Words = std::vector<std::string>;

ParseResult parsed(App& app, Words words) {
    words.insert(words.begin(), "program");
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    return app.parse(static_cast<int>(argv.size()), argv.data());
}

void expect_wrong(App& app, const Words& words, const std::string& named) {
    const ParseResult outcome = parsed(app, words);
    EXPECT_EQ(outcome.kind, Kind::wrong) << words.back();
    EXPECT_NE(outcome.error.find(named), std::string::npos) << outcome.error;
    EXPECT_EQ(outcome.error.find_first_of("\r\n"), std::string::npos) << outcome.error;
}

TEST(Arguments, VariablesOfEveryKindAreRead) {
    App app("A program");
    std::string text;
    std::optional<std::string> perhaps;
    std::optional<std::string> absent;
    Words list;
    int whole = 0;
    std::uint32_t word = 0;
    std::uint64_t large = 0;
    double real = 0;
    bool flag = false;
    bool other = false;
    app.add_option("--text", text, "");
    app.add_option("--perhaps", perhaps, "");
    app.add_option("--absent", absent, "");
    app.add_option("--list", list, "")->delimiter(',');
    app.add_option("--whole", whole, "");
    app.add_option("--word", word, "");
    app.add_option("--large", large, "");
    app.add_option("--real", real, "");
    app.add_flag("--flag", flag, "");
    app.add_flag("--other", other, "");
    const ParseResult outcome =
        parsed(app, {"--text", "a b", "--perhaps", "c", "--list", "d,e", "--whole", "-3", "--word",
                     "4294967295", "--large", "4294967296", "--real", "0.5", "--flag"});
    ASSERT_EQ(outcome.kind, Kind::done) << outcome.error;
    EXPECT_EQ(text, "a b");
    EXPECT_EQ(perhaps, "c");
    EXPECT_FALSE(absent.has_value());
    EXPECT_EQ(list, (Words{"d", "e"}));
    EXPECT_EQ(whole, -3);
    EXPECT_EQ(word, 4'294'967'295U);
    EXPECT_EQ(large, 4'294'967'296U);
    EXPECT_EQ(real, 0.5);
    EXPECT_TRUE(flag);
    EXPECT_FALSE(other);
    for (const char* number : {"--whole", "--word", "--large", "--real"})
        expect_wrong(app, {number, "x"}, number);
    expect_wrong(app, {"--word", "4294967296"}, "--word");
    expect_wrong(app, {"--word", "-1"}, "--word");
}

TEST(Arguments, BothLimitsOfARangeAreInIt) {
    App app("A program");
    int whole = 0;
    std::uint32_t word = 0;
    double real = 0;
    double length = 0;
    app.add_option("--whole", whole, "")->in_range(-1, 254);
    app.add_option("--word", word, "")->in_range(300U, 4'000'000'000U);
    app.add_option("--real", real, "")->in_range(0.5, 1.5);
    app.add_option("--length", length, "")->non_negative();
    for (const auto& [name, good] :
         std::vector<std::pair<std::string, Words>>{{"--whole", {"-1", "254"}},
                                                    {"--word", {"300", "4000000000"}},
                                                    {"--real", {"0.5", "1.5"}},
                                                    {"--length", {"0", "1e9"}}}) {
        for (const std::string& value : good)
            EXPECT_EQ(parsed(app, {name, value}).kind, Kind::done) << name << " " << value;
    }
    for (const auto& [name, bad] :
         std::vector<std::pair<std::string, Words>>{{"--whole", {"-2", "255"}},
                                                    {"--word", {"299", "4000000001"}},
                                                    {"--real", {"0.4", "1.6"}},
                                                    {"--length", {"-1"}}}) {
        for (const std::string& value : bad) expect_wrong(app, {name, value}, name);
    }
}

TEST(Arguments, WordsOfAListOnly) {
    App app("A program");
    std::string shell;
    app.add_option("shell", shell, "")->required()->one_of({"bash", "zsh"});
    EXPECT_EQ(parsed(app, {"zsh"}).kind, Kind::done);
    EXPECT_EQ(shell, "zsh");
    expect_wrong(app, {"fish"}, "fish");
    const ParseResult none = parsed(app, {});
    EXPECT_EQ(none.kind, Kind::wrong);
    EXPECT_NE(none.error.find("shell"), std::string::npos) << none.error;
}

TEST(Arguments, OptionsThatExcludeEachOther) {
    App app("A program");
    bool a = false;
    bool b = false;
    bool c = false;
    Option* first = app.add_flag("--first", a, "");
    app.add_flag("--second", b, "")->excludes(first);
    app.add_flag("--third", c, "")->excludes("--first");
    EXPECT_EQ(parsed(app, {"--second", "--third"}).kind, Kind::done);
    expect_wrong(app, {"--first", "--second"}, "--second");
    expect_wrong(app, {"--third", "--first"}, "--third");
}

TEST(Arguments, ValuesGoToFunctions) {
    App app("A program");
    Words units;
    std::string model;
    app.add_option("--unit", "a unit")->repeatable()->each([&](const std::string& text) {
        units.push_back(text);
    });
    app.add_option_function(
        "--model", [&](const std::string& text) { model = text; }, "a model");
    ASSERT_EQ(parsed(app, {"--unit", "a", "--model", "m", "--unit", "b"}).kind, Kind::done);
    EXPECT_EQ(units, (Words{"a", "b"}));
    EXPECT_EQ(model, "m");
    expect_wrong(app, {"--unit", "a", "b"}, "b");
    expect_wrong(app, {"--model", "m", "--model", "n"}, "--model");
}

TEST(Arguments, ACommandsWorkIsDoneAndWhatItThrowsComesThrough) {
    App app("A program");
    app.require_subcommand(1);
    app.fallthrough();
    bool json = false;
    int runs = 0;
    app.add_flag("--json", json, "");
    App& run = *app.add_subcommand("run", "");
    run.fallthrough();
    run.callback([&] { ++runs; });
    app.add_subcommand("fail", "")->callback([] { throw std::out_of_range("of the work"); });
    EXPECT_EQ(parsed(app, {"run", "--json"}).kind, Kind::done);
    EXPECT_TRUE(json);
    EXPECT_EQ(runs, 1);
    EXPECT_TRUE(app.got_subcommand("run"));
    EXPECT_FALSE(app.got_subcommand("fail"));
    EXPECT_THROW(parsed(app, {"fail"}), std::out_of_range);
    const ParseResult unknown = parsed(app, {"walk"});
    EXPECT_EQ(unknown.kind, Kind::wrong);
    EXPECT_EQ(unknown.error, "'walk' is no command");
    EXPECT_EQ(parsed(app, {"rnu"}).error, "'rnu' is no command; did you mean 'run'?");
    EXPECT_EQ(parsed(app, {}).error, "a command is missing: run, fail");
    EXPECT_EQ(parsed(app, {"run", "--jsno"}).error, "'--jsno' is no option here; did you mean '--json'?");
    expect_wrong(app, {"run", "--bo\r\ngus"}, "--bo");
    EXPECT_EQ(runs, 1);
}

TEST(Arguments, AnEmptyValueIsWrongUsage) {
    App app("A program");
    std::string text;
    std::optional<std::string> perhaps;
    Words list;
    app.add_option("-o,--output", text, "");
    app.add_option("--perhaps", perhaps, "");
    app.add_option("--list", list, "");
    app.add_option_function(
        "--taken", [](const std::string&) {}, "");
    std::string argument = "untouched";
    app.add_option("argument", argument, "");
    for (const char* option : {"--output", "--perhaps", "--list", "--taken"})
        expect_wrong(app, {option, ""}, option);
    expect_wrong(app, {"-o", ""}, "--output: its value is empty");
    EXPECT_EQ(parsed(app, {""}).kind, Kind::done);
    EXPECT_EQ(argument, "");
}

TEST(Arguments, HelpOfACommandIsWhatItSaysWithHelp) {
    App app("What it is for", "program");
    app.require_subcommand(1);
    app.add_help_command();
    std::string file;
    App& group = *app.add_subcommand("group", "Of a group");
    group.add_subcommand("inner", "Of the inner one")->add_option("file", file, "")->required();
    const auto help = [&](const Words& words) {
        testing::internal::CaptureStdout();
        const ParseResult outcome = parsed(app, words);
        EXPECT_EQ(outcome.kind, Kind::told) << outcome.error;
        return testing::internal::GetCapturedStdout();
    };
    EXPECT_EQ(help({"help"}), help({"--help"}));
    EXPECT_NE(help({"help"}).find("help  "), std::string::npos);
    EXPECT_EQ(help({"help", "group"}), help({"group", "--help"}));
    EXPECT_EQ(help({"help", "group", "inner"}), help({"group", "inner", "--help"}));
    EXPECT_NE(help({"help", "group", "inner"}).find("Of the inner one"), std::string::npos);
    EXPECT_EQ(help({"help", "--help"}), help({"help", "help"}));
    EXPECT_EQ(parsed(app, {"help", "gruop"}).error, "'gruop' is no command; did you mean 'group'?");
    EXPECT_EQ(parsed(app, {"help", "group", "iner"}).error, "'iner' is no command; did you mean 'inner'?");
}

TEST(Arguments, TheEnvironmentStandsInForAnOption) {
    App app("A program");
    std::string port;
    app.add_option("--port", port, "")->envname("NPLC_ARGUMENTS_TEST");
    ASSERT_EQ(::setenv("NPLC_ARGUMENTS_TEST", "of the environment", 1), 0);
    EXPECT_EQ(parsed(app, {}).kind, Kind::done);
    EXPECT_EQ(port, "of the environment");
    EXPECT_EQ(parsed(app, {"--port", "typed"}).kind, Kind::done);
    EXPECT_EQ(port, "typed");
    ::unsetenv("NPLC_ARGUMENTS_TEST");
}

TEST(Arguments, HelpAndVersionArePrinted) {
    App app("What it is for", "program");
    unsigned speed = 19'200;
    app.set_version_flag("--version", "program 1.2");
    app.footer("The last words");
    app.add_option("--speed", speed, "of the line")->capture_default_str();
    app.add_option("--flash", "a file")->type_name("FILE");
    testing::internal::CaptureStdout();
    const ParseResult version = parsed(app, {"--version"});
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "program 1.2 (commit " + std::string(commit()) + ")\n");
    EXPECT_TRUE(commit() == "unknown" || std::all_of(commit().begin(), commit().begin() + 7,
                                                     [](unsigned char c) { return std::isxdigit(c) != 0; }))
        << commit();
    EXPECT_EQ(version.kind, Kind::told);
    EXPECT_EQ(version.exit_code, 0);
    testing::internal::CaptureStdout();
    EXPECT_EQ(parsed(app, {"--help"}).kind, Kind::told);
    const std::string help = testing::internal::GetCapturedStdout();
    for (const char* part :
         {"What it is for", "--speed", "=19200", "of the line", "--flash FILE", "The last words"})
        EXPECT_NE(help.find(part), std::string::npos) << part << " in\n" << help;
}

TEST(Arguments, PagesAreWrittenFromItsDescription) {
    App app("What it is for", "program");
    std::string text;
    bool flag = false;
    app.footer("The last words");
    App& command = *app.add_subcommand("run", "Runs it");
    command.add_option("file", text, "to read");
    command.add_option("-o,--output", text, "to write");
    command.add_flag("-q,--quiet,--silent", flag, "say nothing");
    EXPECT_EQ(app.get_name(), "program");
    EXPECT_EQ(app.get_description(), "What it is for");
    EXPECT_EQ(app.get_footer(), "The last words");
    ASSERT_EQ(app.get_subcommands(), std::vector<const App*>{&command});
    const auto options = command.get_options();
    ASSERT_EQ(options.size(), 4U);
    EXPECT_EQ(options[0].names, "-h,--help");
    EXPECT_EQ(options[0].long_names, Words{"help"});
    EXPECT_EQ(options[1].positional, "file");
    EXPECT_EQ(options[1].names, "file");
    EXPECT_EQ(options[1].description, "to read");
    EXPECT_TRUE(options[1].long_names.empty());
    EXPECT_EQ(options[2].names, "-o,--output");
    EXPECT_TRUE(options[2].positional.empty());
    EXPECT_EQ(options[3].long_names, (Words{"quiet", "silent"}));
    const auto has_value = [](const OptionText& option) { return option.has_value; };
    EXPECT_EQ((std::vector{has_value(options[0]), has_value(options[1]), has_value(options[2]),
                           has_value(options[3])}),
              (std::vector{false, true, true, false}));
}

}  // namespace
}  // namespace nplc::arguments
