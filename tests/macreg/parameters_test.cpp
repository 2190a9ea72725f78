#include "macreg/parameters.h"

#include <gtest/gtest.h>

#include "bench.h"

namespace nplc::macreg {
namespace {

using registers::Model;

std::string text_of(Bench& bench) {
    std::string text =
        header_text(bench.motor, registers::name_of(bench.motor.model()), "2000-01-01T00:00:00Z");
    static_cast<void>(read_parameters(bench.motor,
                                      [&](const auto& values, std::size_t, std::size_t) {
                                          for (const auto& [number, raw] : values)
                                              text += value_line(bench.motor.model(),
                                                                 *bench.motor.find(number), raw);
                                      },
                                      {}));
    return text;
}

std::string problem_of(const std::string& text) {
    const ParsedFile file = parse_parameters(text);
    return file.problems.empty() ? "" : std::to_string(file.problems[0].line) + ": " + file.problems[0].text;
}

TEST(Parameters, AFileIsReadAsItWasWritten) {
    for (const Model model : {Model::mac140, Model::mac800}) {
        Bench bench(model);
        bench.put("V_SOLL", -1234);
        bench.put("P1", -7'654'321);
        bench.put("ERR_STAT", 1 << 14);
        const ParameterSet own = read_parameters(bench.motor, {}, {});
        const ParsedFile file = parse_parameters(text_of(bench));
        ASSERT_TRUE(file.problems.empty()) << file.problems[0].line << ": " << file.problems[0].text;
        EXPECT_EQ(file.set.values, own.values);
        EXPECT_EQ(file.set.values.at(registers::V_SOLL), -1234);
        EXPECT_EQ(file.set.values.at(registers::ERR_STAT), 1 << 14);
        EXPECT_TRUE(differences(file.set, own).empty());
    }
}

// 001 §4.4.16: flash keeps parameters; what the motor measures and does is none.
TEST(Parameters, HoldNoStateOfTheMotor) {
    Bench bench;
    const ParameterSet set = read_parameters(bench.motor, {}, {});
    for (const char* name : {"P_IST", "V_IST", "MODE_REG", "P_SOLL", "P_FNC", "I2T", "FLWERR", "P_REG_P",
                             "REC_CNT", "PROG_VERSION", "ANINP", "U_SUPPLY"})
        EXPECT_EQ(set.values.count(bench.reg(name).number), 0U) << name;
    for (const char* name : {"V_SOLL", "T_SOLL", "KVOUT", "FLWERRMAX", "CNTRL_BITS", "STARTMODE", "P8", "Z4",
                             "KFF3", "MYADDR", "UV_HANDLE", "AMPLITUDE"})
        EXPECT_EQ(set.values.count(bench.reg(name).number), 1U) << name;
}

TEST(Parameters, EveryProblemOfAFileIsToldWithItsLine) {
    const std::string head = "model = MAC140\n";
    EXPECT_EQ(problem_of("V_SOLL = 5\n").substr(0, 2), "0:");
    EXPECT_NE(problem_of(head).find("no register"), std::string::npos);
    EXPECT_NE(problem_of("model = MAC15\nV_SOLL = 5\n").find("1: 'MAC15' is no model"), std::string::npos);
    for (const auto& [line, part] :
         std::vector<std::array<const char*, 2>>{{"V_SOLL", "NAME = VALUE"},
                                                 {"V_SOLL =", "NAME = VALUE"},
                                                 {"= 5", "NAME = VALUE"},
                                                 {"V_SOL = 5", "did you mean V_SOLL"},
                                                 {"V_SOLL = 99999 rpm", "out of range"},
                                                 {"T_SOLL = 20 A", "takes %peak"},
                                                 {"P_IST = 5", "no parameter"},
                                                 {"A_SOLL = 1\nA_SOLL = 2", "twice"}}) {
        const std::string problem = problem_of(head + line + "\nT_SOLL = 100%\n");
        EXPECT_NE(problem.find(part), std::string::npos) << line << ": " << problem;
    }
    EXPECT_EQ(parse_parameters("").problems.size(), 1U) << "not that it holds no register, too";
    EXPECT_EQ(parse_parameters(head + "V_SOL = 5\n").problems.size(), 1U);
    std::string wrong;
    for (int i = 0; i < 10'000; ++i) wrong += "V_SOL" + std::to_string(i) + " = 5\n";
    EXPECT_EQ(parse_parameters(head + wrong).problems.size(), 101U) << "a guess for each would take long";
    EXPECT_EQ(parse_parameters(head + "A = 1\nB = 2\nV_SOLL = x\nT_SOLL = 5\n").problems.size(), 3U);
}

// SAMPLE1 is 1 to 164 (001 §3.2.112), and 0 in a motor that never recorded.
TEST(Parameters, WhatAMotorHadIsTakenBackEvenOutOfRange) {
    EXPECT_EQ(parse_parameters("model = MAC140\nSAMPLE1 = raw:0\n").set.values.at(112), 0);
    EXPECT_NE(problem_of("model = MAC140\nSAMPLE1 = 0\nT_SOLL = 1\n"), "");
    EXPECT_NE(problem_of("model = MAC140\nSAMPLE1 = raw:65536\nT_SOLL = 1\n"), "");
}

TEST(Parameters, AnIncompleteFileSaysSo) {
    const auto file =
        parse_parameters("model = MAC140\nV_SOLL = 5\n" + incomplete_text("the motor # vanished"));
    EXPECT_TRUE(file.problems.empty());
    EXPECT_EQ(file.set.incomplete, "the motor   vanished");
    EXPECT_FALSE(parse_parameters("model = MAC140\nA_SOLL = 397").set.incomplete.empty()) << "cut short";
    EXPECT_TRUE(parse_parameters("model = MAC140\nA_SOLL = 397\n" + end_text(1)).set.incomplete.empty());
}

TEST(Parameters, AFileThatLacksALineIsIncomplete) {
    const std::string head = "model = MAC140\n";
    const auto incomplete = [&](const std::string& text) {
        return parse_parameters(head + text).set.incomplete;
    };
    EXPECT_EQ(incomplete("A_SOLL = 397\nV_SOLL = 5\n" + end_text(2)), "");
    EXPECT_NE(incomplete("A_SOLL = 397\n" + end_text(2)).find("says 2 registers, and it has 1"),
              std::string::npos);
    EXPECT_NE(incomplete("A_SOLL = 397\nV_SOLL = 5\n" + end_text(1)), "");
    EXPECT_EQ(incomplete("A_SOLL = 397\nend = 1\n"), "");
    EXPECT_NE(problem_of(head + "A_SOLL = 397\nend = all\n"), "");
    // What `dump --all` shows beside the parameters is counted with them.
    EXPECT_EQ(incomplete("A_SOLL = 397\n# P_IST = 0 counts  # 10, raw 0\n" + end_text(2)), "");
    EXPECT_NE(incomplete("A_SOLL = 397\n# P_IST = 0 counts  # 10, raw 0\n" + end_text(3)), "");
    EXPECT_NE(incomplete("A_SOLL = 397\n# a remark\n" + end_text(2)), "");
}

/// Cut off at any byte it is refused, or has every value of the whole one.
TEST(Parameters, AFileThatIsCutAnywhereIsRefusedOrWhole) {
    for (const Model model : {Model::mac140, Model::mac800}) {
        Bench bench(model);
        std::string text = text_of(bench);
        const ParameterSet whole = parse_parameters(text).set;
        text += end_text(whole.values.size());
        std::size_t taken = 0;
        for (std::size_t size = 0; size <= text.size(); ++size) {
            const ParsedFile cut = parse_parameters(std::string_view(text).substr(0, size));
            if (!cut.problems.empty() || !cut.set.incomplete.empty()) continue;
            EXPECT_EQ(cut.set.values, whole.values) << "at byte " << size;
            ++taken;
        }
        EXPECT_EQ(taken, std::string_view(" registers\n").size() + 1);
    }
}

TEST(Parameters, AMotorThatVanishesLosesNothingAlreadyRead) {
    Bench bench;
    bench.units.bytes_to_live = 9 * 3;  // three questions
    std::size_t told = 0;
    EXPECT_THROW(
        static_cast<void>(read_parameters(
            bench.motor, [&](const auto& values, std::size_t, std::size_t) { told += values.size(); }, {})),
        mactalk_client::LineError);
    EXPECT_GT(told, 20U);
}

TEST(Parameters, DifferencesAreFoundBothWays) {
    const ParameterSet left = parse_parameters("model = MAC140\nV_SOLL = 5\nA_SOLL = 1\n").set;
    const ParameterSet right = parse_parameters("model = MAC140\nV_SOLL = 6\nT_SOLL = 7\n").set;
    const auto all = differences(left, right);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].reg->name, "V_SOLL");
    EXPECT_EQ(all[0].left, 5);
    EXPECT_EQ(all[0].right, 6);
    EXPECT_FALSE(all[1].right.has_value());
    EXPECT_FALSE(all[2].left.has_value());
}

}  // namespace
}  // namespace nplc::macreg
