#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "cli_support.h"
#include "diagnostics/explanations.h"
#include "diagnostics/reference.h"
#include "language/reserved_words.h"
#include "registers/details.h"
#include "report/word_page.h"
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
    const std::string rest = " (seqc explain lists the codes, LANGUAGE.md the words)\n";
    const std::string none = " is no code, word, command, register, mode or bit";
    EXPECT_EQ(run("explain withni"), 2);
    EXPECT_EQ(read("err"), "seqc: 'withni'" + none + "; did you mean 'WITHIN'?" + rest);
    EXPECT_EQ(run("explain movng"), 2);
    EXPECT_EQ(read("err"), "seqc: 'movng'" + none + "; did you mean 'moving'?" + rest);
    EXPECT_EQ(run("explain VHOME"), 2);
    EXPECT_EQ(read("err"), "seqc: 'VHOME'" + none + "; did you mean 'HOME' or 'V_HOME'?" + rest);
    EXPECT_EQ(run("explain nonsense"), 2);
    EXPECT_TRUE(read("err").starts_with("seqc: 'nonsense'" + none)) << read("err");
    EXPECT_EQ(std::ranges::count(read("err"), '\n'), 1);
    EXPECT_EQ(run("explain qqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqq"), 2);
    EXPECT_EQ(read("err"), "seqc: 'qqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqq'" + none + rest);
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

TEST_F(Explain, WhatAWordMeansComesFirst) {
    ASSERT_EQ(run("explain within"), 0);
    EXPECT_TRUE(read("out").starts_with("WITHIN\n\nLANGUAGE.md, 15. Words:\n    a time limit: "))
        << read("out");
    ASSERT_EQ(run("explain RANGE"), 0);
    EXPECT_NE(read("out").find("Words:\n    `RANGE 60 .. 2000 rpm`: the lowest and the highest value"),
              std::string::npos)
        << read("out");
}

/// 001 §3.2.40 and §3.2.41; a MAC140 has 4096 counts a turn and 3125/6 samples a second, so 1 rpm is
/// 4096 / 60 / (3125/6) x 16 = 2.09715 steps. 004 gives register 40 of a MAC800.
TEST_F(Explain, TheRegisterOfAName) {
    ASSERT_EQ(run("explain v_home"), 0) << read("err");
    const std::string page = read("out");
    EXPECT_NE(page.find("Register 40: Homing velocity, its sign is the direction (MAC50, MAC95, MAC140"),
              std::string::npos)
        << page;
    EXPECT_NE(page.find("1 rpm = 2.09715; "), std::string::npos) << page;
    EXPECT_NE(page.find("- raw -32767 .. 32767; read and written"), std::string::npos) << page;
    EXPECT_NE(page.find("- manual: 001 §3.2.40"), std::string::npos) << page;
    EXPECT_NE(page.find("(MAC800)"), std::string::npos) << page;
    ASSERT_EQ(run("explain START_MODE"), 0) << "as the manual of the MAC800 writes it";
    ASSERT_EQ(run("explain HOME_MODE"), 0);
    EXPECT_NE(read("out").find("`BY_COMMAND`"), std::string::npos);
    EXPECT_NE(read("out").find("`HOME2_MODE`"), std::string::npos);
    ASSERT_EQ(run("explain --json T_HOME"), 0);
    const Json document = Json::parse(read("out"));
    EXPECT_EQ(document["registers"][0]["number"], 41);
    EXPECT_EQ(document["registers"][0]["name"], "T_HOME");
}

TEST_F(Explain, EveryRegisterModeAndBitThatAProgramMayName) {
    for (const registers::Model model : {registers::Model::mac140, registers::Model::mac800}) {
        for (const registers::Register& reg : registers::map_of(model)) {
            const WordPage page = page_of_word(reg.name);
            ASSERT_FALSE(page.registers.empty()) << reg.name;
            const auto is_it = [&](const RegisterPage& one) {
                return one.number == reg.number && one.name == reg.name && !one.title.empty() &&
                       one.facts.find(reg.section) != std::string::npos;
            };
            EXPECT_TRUE(std::any_of(page.registers.begin(), page.registers.end(), is_it)) << reg.name;
            for (const registers::Field& field : registers::fields_of(model, reg.number)) {
                EXPECT_FALSE(page_of_word(field.name).values.empty()) << field.name;
                for (const registers::NamedValue& value : field.values)
                    EXPECT_FALSE(page_of_word(value.name).values.empty()) << value.name;
            }
        }
    }
}

TEST_F(Explain, EveryWordOfTheLanguageAndEveryCommand) {
    std::vector<std::string_view> words(reserved_words().begin(), reserved_words().end());
    for (std::string_view word : {"BOOL", "Q", "AFTER", "BY", "FROM", "OFF", "SET", "RESET", "R_TRIG",
                                  "F_TRIG", "BLINKING", "CALL", "RETURN", "moving", "IN0", "OUT0"})
        words.push_back(word);
    for (std::string_view word : words) {
        const std::vector<Paragraph> passages = passages_about(word);
        ASSERT_FALSE(passages.empty()) << word;
        EXPECT_TRUE(passages.front().text.starts_with("| `" + std::string(word) + "` | ")) << word;
        EXPECT_EQ(passages.front().section, "15. Words") << word;
    }
    for (std::string_view word : command_names()) EXPECT_FALSE(passages_about(word).empty()) << word;
    ASSERT_EQ(run("explain timer"), 0);
    const std::string page = read("out");
    EXPECT_TRUE(page.starts_with("TIMER\n\nLANGUAGE.md, 15. Words:\n    the one timer: ")) << page;
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
