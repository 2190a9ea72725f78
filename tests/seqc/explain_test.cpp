#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "cli_support.h"
#include "diagnostics/explanations.h"
#include "diagnostics/reference.h"
#include "language/reserved_words.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

using Explain = test::Cli;
using Json = nlohmann::json;

const char* const kWrong = "PROGRAM P STEP S: OWN ERROR; NEXT := Q; END_STEP END_PROGRAM\n";

std::string without_colours(const std::string& text) {
    return std::regex_replace(text, std::regex("\x1b\\[[0-9;]*m"), "");
}

TEST_F(Explain, ACodeInAnyCase) {
    ASSERT_EQ(run("explain E012"), 0) << read("err");
    const std::string page = read("out");
    EXPECT_TRUE(page.starts_with("E012: a block that is not closed\n\n")) << page;
    EXPECT_NE(page.find("\nWrong:\n    PROGRAM P\n"), std::string::npos) << page;
    EXPECT_NE(page.find("\nRight:\n    PROGRAM P\n"), std::string::npos) << page;
    ASSERT_EQ(run("explain e012"), 0);
    EXPECT_EQ(read("out"), page);
}

TEST_F(Explain, WithoutACodeAllAreListed) {
    ASSERT_EQ(run("explain"), 0);
    const std::string list = read("out");
    const std::vector<Explanation> all = explanations();
    EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), std::ssize(all));
    for (const Explanation& info : all)
        EXPECT_NE(list.find(std::string(info.code) + "  " + std::string(info.title) + "\n"),
                  std::string::npos);
}

TEST_F(Explain, AnUnknownCodeIsOneLineWithTheNearest) {
    // E014 is one away from E015; E013 and E012 are the next ones, for E020 is five away.
    EXPECT_EQ(run("explain e015"), 2);
    EXPECT_EQ(read("out"), "");
    EXPECT_EQ(read("err"),
              "seqc: there is no code 'e015'; near it are E014, E013 and E012 (seqc explain lists all)\n");
    EXPECT_EQ(run("explain nonsense"), 2);
    EXPECT_EQ(read("err"), "seqc: there is no code 'nonsense' (seqc explain lists all)\n");
    EXPECT_EQ(run("explain withni"), 2);
    EXPECT_EQ(read("err"),
              "seqc: there is no code 'withni'; did you mean 'WITHIN'? (seqc explain lists all)\n");
    EXPECT_EQ(run("explain follows"), 2);
    EXPECT_NE(read("err").find("a word of scenarios, which host-sim/scenario/README.md explains"),
              std::string::npos);
}

TEST_F(Explain, ModesAndBitsOfTheRegisters) {
    ASSERT_EQ(run("explain hiclk"), 0);
    EXPECT_NE(read("out").find(" of CNTRL_BITS"), std::string::npos);
    ASSERT_EQ(run("explain --json P_MODE"), 0);
    EXPECT_NE(read("out").find("MODE_REG"), std::string::npos);
}

TEST_F(Explain, EveryWordOfTheLanguageAndEveryCommand) {
    for (std::string_view word : reserved_words()) EXPECT_FALSE(passages_about(word).empty()) << word;
    for (std::string_view word : command_names()) EXPECT_FALSE(passages_about(word).empty()) << word;
    ASSERT_EQ(run("explain timer"), 0);
    const std::string page = read("out");
    EXPECT_TRUE(page.starts_with("TIMER\n\nLANGUAGE.md, ")) << page;
    EXPECT_NE(page.find("the timer is set, 1 ms to 65.535 s"), std::string::npos) << page;
    ASSERT_EQ(run("explain MOVING"), 0);
    EXPECT_NE(read("out").find("holds from a scan that sends an order that moves"), std::string::npos)
        << read("out");
    ASSERT_EQ(run("explain property"), 0);
    EXPECT_NE(read("out").find("says what a machine must never do"), std::string::npos) << read("out");
    for (const char* byte : {"03h", "63H"}) {  // as the manuals call CLEAR_P_IST, and as a table has it
        ASSERT_EQ(run(std::string("explain ") + byte), 0);
        EXPECT_TRUE(read("out").starts_with("CLEAR_P_IST\n")) << read("out");
    }
    ASSERT_EQ(run("explain --json MOVE_P7_BY_P_FNC"), 0);
    const Json document = Json::parse(read("out"));
    EXPECT_EQ(document["word"], "MOVE_P7_BY_P_FNC");
    EXPECT_NE(document["passages"][0]["text"].get<std::string>().find("moves by P7"), std::string::npos);
}

TEST_F(Explain, AsJson) {
    ASSERT_EQ(run("explain --json W004"), 0);
    EXPECT_EQ(Json::parse(read("out"))["code"], "W004");
    ASSERT_EQ(run("explain --json"), 0);
    EXPECT_EQ(Json::parse(read("out"))["codes"].size(), explanations().size());
    EXPECT_EQ(run("explain --json E777"), 2);
    EXPECT_TRUE(Json::parse(read("out")).contains("error"));
    EXPECT_EQ(read("err"), "");
}

TEST_F(Explain, ColoursAddToTheTextAndChangeNothingElse) {
    write("a.seq", kWrong);
    ASSERT_EQ(run("check a.seq"), 1);
    const std::string plain = read("err");
    EXPECT_EQ(plain.find('\x1b'), std::string::npos) << "not a terminal";
    ASSERT_EQ(run("check --color always a.seq"), 1);
    const std::string coloured = read("err");
    EXPECT_NE(coloured.find("\x1b[1;31merror E021\x1b[0m"), std::string::npos) << coloured;
    EXPECT_EQ(without_colours(coloured), plain);
    ASSERT_EQ(run("explain E021"), 0);
    const std::string page = read("out");
    ASSERT_EQ(run("--color=always explain E021"), 0);
    EXPECT_NE(read("out"), page);
    EXPECT_EQ(without_colours(read("out")), page);
    EXPECT_EQ(run("--color sometimes explain E021"), 2);
}

// `script` runs the program on a terminal of its own.
TEST_F(Explain, ColoursByThemselvesOnATerminalOnly) {
    if (std::system("command -v script >/dev/null") != 0) GTEST_SKIP() << "no 'script' here";
    write("a.seq", kWrong);
    const auto on_terminal = [&](const std::string& environment, const std::string& arguments) {
        const std::string command = "cd '" + folder_.string() + "' && " + environment + " script -qec \"'" +
                                    SEQC_PROGRAM + "' " + arguments + "\" /dev/null >out 2>err </dev/null";
        EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
        return read("out");
    };
    EXPECT_NE(on_terminal("env -u NO_COLOR", "check a.seq").find('\x1b'), std::string::npos);
    EXPECT_EQ(on_terminal("env NO_COLOR=1", "check a.seq").find('\x1b'), std::string::npos);
    EXPECT_EQ(on_terminal("env -u NO_COLOR", "--color never check a.seq").find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace nplc::seqc
