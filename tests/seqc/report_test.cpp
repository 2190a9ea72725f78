// The report on a program, with its figures worked out by hand.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/table_report.h"
#include "support.h"

namespace nplc::seqc {
namespace {

const char* const kSource =
    "PROGRAM Door MOTOR MAC140; VAR_INPUT Start AT IN0; END_VAR VAR_MOTOR Fast AT V1 := 1000; END_VAR\n"
    "POWER_UP INIT(Fast); NEXT := Shut; END_POWER_UP\n"
    "STEP Shut: OWN ERROR; IF Start THEN VELOCITY(Fast); NEXT := Open; END_IF END_STEP\n"
    "STEP Open: OWN ERROR; IF NOT Start THEN NEXT := Shut; END_IF END_STEP\n"
    "STEP Spare: OWN ERROR; END_STEP END_PROGRAM\n";

TableReport report(const LineSettings& settings = {}) {
    const Compilation compiled = compile(kSource);
    EXPECT_TRUE(compiled.ok) << test::shown(compiled, kSource);
    return report_of(compiled.table, &compiled.symbols, settings);
}

// Terms: POWER_UP writes V1 and sends INIT: 2. Shut and Open have one way out: 1 each. Spare has none. The
// end: 1.
TEST(TableReport, CountsStepsAndTerms) {
    const auto json = nlohmann::json::parse(json_of(report()));
    EXPECT_EQ(json["program"], "Door");
    EXPECT_EQ(json["motor"], "MAC140");
    EXPECT_EQ(json["terms"], 5);
    EXPECT_EQ(json["bytes"], 40);
    EXPECT_EQ(json["terms_free"], 1024 - 5);
    EXPECT_EQ(json["steps_most"], 61);
    EXPECT_EQ(json["steps"][0]["terms"], 2);
    EXPECT_EQ(json["steps"][1]["name"], "Shut");
    EXPECT_NE(text_of(report()).find("5 of 1024, the end included; 40 of 8192 bytes"), std::string::npos);
    EXPECT_NE(text_of(report()).find("most in POWER_UP 2, Shut 1, Open 1"), std::string::npos);
}

// At 10,000 baud a character takes 1 ms. POWER_UP: 1Fh twice (2, answered at 4), pause until 5, 9 for the
// word V1 (14), pause until 17, 7Eh x3 (20, answered at 22), INIT twice (24, answered at 26): 16 characters,
// 4 messages.
TEST(TableReport, TellsHowLongTheLineIsKept) {
    const TableReport table = report({.baud = 10'000});
    ASSERT_EQ(table.transitions.size(), 3U);
    EXPECT_EQ(table.transitions[0].from, 0);  // the longest first
    EXPECT_EQ(table.transitions[0].orders, (std::vector<std::string>{"V1 := 1000", "INIT(V1)"}));
    const auto json = nlohmann::json::parse(json_of(table))["transitions"];
    EXPECT_DOUBLE_EQ(json[0]["line_ms"], 2 + 9 + 3 + 2);
    EXPECT_DOUBLE_EQ(json[0]["until_done_ms"], 26);
    EXPECT_EQ(json[0]["messages"], 4);
    EXPECT_DOUBLE_EQ(json[0]["at_most_ms"], 26 + 2 * 4);
    EXPECT_EQ(json[1]["condition"], "Start");
    EXPECT_DOUBLE_EQ(json[1]["until_done_ms"], 4);
    EXPECT_DOUBLE_EQ(json[2]["until_done_ms"], 0);
    const std::string text = text_of(table);
    EXPECT_NE(text.find("POWER_UP takes 26.00 to 34.00 ms: 2 orders, 16 characters"), std::string::npos)
        << text;
    EXPECT_NE(text.find("1 switch sends nothing"), std::string::npos) << text;
}

TEST(TableReport, RapidCommunicationSendsOnce) {
    const auto json =
        nlohmann::json::parse(json_of(report({.baud = 10'000, .safe_communication = false})))["transitions"];
    EXPECT_DOUBLE_EQ(json[0]["line_ms"], 1 + 9 + 3 + 1);
}

TEST(TableReport, ABareTableHasNumbersAndNoPowerUp) {
    const Compilation compiled = compile(kSource);
    const TableReport bare = report_of(compiled.table, nullptr, {});
    const std::string text = text_of(bare);
    EXPECT_NE(text.find("3 of 62\n"), std::string::npos)
        << text;  // 0, Shut and Open; nothing of Spare is left
    EXPECT_NE(text.find("step 1 -> step 2, IN0"), std::string::npos) << text;
}

TEST(TableReport, StandsAtTheEndOfTheListing) {
    const Compilation compiled = compile(kSource);
    const std::string text = listing(compiled, kSource, "door.seq");
    const std::size_t at = text.find("terms  5 of 1024");
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_GT(at, text.find("end of the table"));
    EXPECT_NE(text.find("longest after it: Shut -> Open, Start: 2.08 to 3.12 ms"), std::string::npos) << text;
}

TEST(TableReport, SaysWhichStepsTheCompilerMade) {
    const std::string source =
        "PROGRAM P MOTOR MAC140;\nSTEP S: OWN ERROR; IF NOT TIMER.Q THEN HOME; NEXT := T; END_IF END_STEP\n"
        "STEP T: OWN ERROR; OUT OUT1; IF IN0 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n";
    const Compilation compiled = compile(source);
    const std::string text = text_of(report_of(compiled.table, &compiled.symbols, {}));
    EXPECT_NE(text.find("3 of 61, and POWER_UP; 1 made by the compiler"), std::string::npos) << text;
    EXPECT_NE(text.find("S_to_T  helper step: does in the scan after what a branch of 'S'"),
              std::string::npos)
        << text;
    EXPECT_NE(listing(compiled, source, "p.seq").find("S_to_T  helper step"), std::string::npos);
}

TEST(TableReport, TakesATableWithTooManyTerms) {
    std::vector<std::uint8_t> table;
    for (int i = 0; i < 1100; ++i) table.insert(table.end(), {0xC0, 0, 0, 1, 0x80, 0, 0, 0});
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_NE(text_of(report_of(table, nullptr, {})).find("77 more than every gateway holds"),
              std::string::npos);
}

}  // namespace
}  // namespace nplc::seqc
