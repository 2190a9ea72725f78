// What one table does otherwise than another, in words.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "random_table.h"
#include "report/table_diff.h"
#include "support.h"

namespace nplc::seqc {
namespace {

/// A small machine to change: words of it are replaced.
std::string machine(const std::vector<std::pair<std::string, std::string>>& changes = {}) {
    std::string text =
        "PROGRAM P MOTOR MAC140; VAR_INPUT Start AT IN0; Guard AT IN1; END_VAR\n"
        "VAR_OUTPUT Lamp AT OUT0; Grip AT OUT1; END_VAR VAR_MOTOR Fast AT V1 := 1500 rpm; END_VAR\n"
        "ON ERROR NEXT := Fault; POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
        "STEP Idle: OUT Lamp; IF Start AND NOT Guard THEN VELOCITY(Fast); NEXT := Travel; END_IF END_STEP\n"
        "STEP Travel: OUT Grip; IF Guard THEN NEXT := Fault; ELSIF INPOS THEN TIMER := T#500ms; NEXT := "
        "Hold; "
        "END_IF END_STEP\n"
        "STEP Hold: IF TIMER.Q THEN NEXT := Idle; END_IF END_STEP\n"
        "STEP Fault: OWN ERROR; ENTRY STOP; IF ANY ERROR AND Start THEN RESET_ERROR; NEXT := POWER_UP; "
        "END_IF "
        "END_STEP END_PROGRAM";
    for (const auto& [from, to] : changes) {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    }
    return text;
}

TableDiff diff(const std::string& before, const std::string& now) {
    const Compilation a = test::compiled(before);
    const Compilation b = test::compiled(now);
    return diff_of({a.table, &a.symbols}, {b.table, &b.symbols});
}

std::string changes_text(const std::vector<std::pair<std::string, std::string>>& changes) {
    return text_of(diff(machine(), machine(changes)));
}

TEST(TableDiff, TheSameBytes) {
    EXPECT_EQ(changes_text({}), "the same bytes\n");
}

const std::vector<std::pair<std::string, std::string>> kWithSetPoint = {
    {"VAR_MOTOR Fast AT V1 := 1500 rpm; END_VAR",
     "SET_POINT Fast AT V1 := 1500 rpm RANGE 500 .. 2500 rpm STEP 100 rpm;"}};

TEST(TableDiff, StepsThatTakeSetPoints) {
    auto taking = kWithSetPoint;
    taking.emplace_back("STEP Hold:", "STEP Hold: TAKES SET_POINTS;");
    const TableDiff taken_out = diff(machine(taking), machine(kWithSetPoint));
    EXPECT_TRUE(taken_out.same_bytes);
    EXPECT_FALSE(taken_out.same_behaviour());
    EXPECT_EQ(text_of(taken_out), "the same bytes\nHold: takes set-points no more\n");
    const TableDiff added = diff(machine(kWithSetPoint), machine(taking));
    EXPECT_FALSE(added.same_behaviour());
    EXPECT_EQ(text_of(added), "the same bytes\nHold: takes set-points now\n");
    const auto json = nlohmann::json::parse(json_of(taken_out));
    EXPECT_FALSE(json.at("same_behaviour").get<bool>());
    EXPECT_EQ(json.at("take_set_points_no_more"), (std::vector<std::string>{"Hold"}));
    EXPECT_TRUE(json.at("take_set_points_now").empty());
}

/// No byte of the table shows them.
TEST(TableDiff, RangesStepsAndNamesOfSetPoints) {
    const std::string before = machine(kWithSetPoint);
    const auto changed = [&](const std::string& from, const std::string& to) {
        auto changes = kWithSetPoint;
        changes.emplace_back(from, to);
        const TableDiff result = diff(before, machine(changes));
        EXPECT_TRUE(result.same_bytes) << to;
        EXPECT_FALSE(result.same_behaviour()) << to;
        return text_of(result);
    };
    EXPECT_EQ(changed("RANGE 500 ..", "RANGE 700 .."),
              "the same bytes\nset-point Fast: 1500 rpm, 500 rpm to 2500 rpm in steps of 100 rpm -> 1500 "
              "rpm, 700 rpm "
              "to 2500 rpm in steps of 100 rpm\n");
    EXPECT_NE(changed(" STEP 100 rpm", "").find("set-point Fast: "), std::string::npos);
    EXPECT_NE(changed(" STEP 100 rpm", " STEP 50 rpm").find("in steps of 50 rpm"), std::string::npos);
}

// Travel's first two terms exclude each other (Guard, NOT Guard): their order means nothing.
TEST(TableDiff, OtherBytesThatDoTheSame) {
    const Compilation before = test::compiled(machine());
    auto table = before.table;
    std::size_t at = 0;
    while ((table[at] & 0x3F) != 2) at += 8;
    std::swap_ranges(table.begin() + static_cast<std::ptrdiff_t>(at),
                     table.begin() + static_cast<std::ptrdiff_t>(at + 8),
                     table.begin() + static_cast<std::ptrdiff_t>(at + 8));
    const TableDiff result = diff_of({before.table, &before.symbols}, {table, nullptr});
    EXPECT_FALSE(result.same_bytes);
    EXPECT_EQ(text_of(result), "other bytes, but every step does the same\n");
    EXPECT_TRUE(result.same_behaviour());
}

// A term that switches Grip on in one case: Fault, which goes on from there, no longer has it always off.
TEST(TableDiff, OutputsThatAreNotCertainAnyMore) {
    EXPECT_EQ(changes_text({{"END_IF END_STEP\nSTEP Hold",
                             "END_IF TERM 16#C2, 2, 2, 16#3E, 16#80, 2, 0, 0; END_STEP\nSTEP Hold"}}),
              "Travel, when Guard: sends STOP, has Grip on and goes to Fault; before: sends STOP, has Grip "
              "off and goes "
              "to Fault\n"
              "Fault, when ANY ERROR AND NOT Start: keeps Grip; before: has Grip off\n");
}

// 1000 rpm: 1000 / 60 rev/s x 4096 counts / 520.83 samples x 16 = 2097.15.
// 20000 rpm/s are 80.5 steps of A1, so 81, which is 20117: the shorter number that gives 81 is shown.
TEST(TableDiff, AValueOfPowerUp) {
    EXPECT_EQ(changes_text({{"1500 rpm", "1000 rpm"}}), "Fast: 3146 -> 2097 (1500 rpm -> 1000 rpm)\n");
    EXPECT_EQ(changes_text({{"1500 rpm;", "1500 rpm; Soft AT A1 := 81;"}}),
              "Soft: written now: 81 (20000 rpm/s)\n");
}

// 1 rev = 5 mm: 60 mm are 12 rev, 12 x 4096 = 49152; 50 mm are 40960.
TEST(TableDiff, PositionsInTheProgramsOwnUnit) {
    const std::string own = machine({{"MOTOR MAC140;", "MOTOR MAC140; SCALE 1 rev = 5 mm;"},
                                     {"1500 rpm;", "1500 rpm; Place AT P2 := 60 mm;"}});
    std::string moved = own;
    moved.replace(moved.find("60 mm"), 5, "50 mm");
    EXPECT_EQ(text_of(diff(own, moved)), "Place: 49152 -> 40960 (60 mm -> 50 mm)\n");
}

// 1 rpm are 2.09715 steps of V1: 234.6 are 491.99, 281.3 are 589.93. With 10 mm a revolution 1 mm/s are 6
// rpm, 12.583 steps: 39.1 are 491.99, 46.9 are 590.1.
TEST(TableDiff, AsFewPlacesAsTellTheValue) {
    EXPECT_EQ(text_of(diff(machine({{"1500 rpm", "492"}}), machine({{"1500 rpm", "590"}}))),
              "Fast: 492 -> 590 (234.6 rpm -> 281.3 rpm)\n");
    const std::string scale = "MOTOR MAC140; SCALE 1 rev = 10 mm;";
    EXPECT_EQ(text_of(diff(machine({{"MOTOR MAC140;", scale}, {"1500 rpm", "39.1 mm/s"}}),
                           machine({{"MOTOR MAC140;", scale}, {"1500 rpm", "46.9 mm/s"}}))),
              "Fast: 492 -> 590 (39.1 mm/s -> 46.9 mm/s)\n");
}

TEST(TableDiff, WhatASwitchDoes) {
    EXPECT_EQ(
        changes_text({{"IF Guard THEN NEXT", "IF Guard THEN HOME; NEXT"}}),
        "Travel, when Guard: sends HOME, STOP and goes to Fault; before: sends STOP and goes to Fault\n");
    EXPECT_EQ(
        changes_text({{"T#500ms", "T#700ms"}}),
        "Travel, when NOT Guard AND INPOS: sets TIMER := T#700ms and goes to Hold; before: sets TIMER := "
        "T#500ms and goes to Hold\n");
    EXPECT_EQ(changes_text({{"Start AND NOT Guard", "Start"}}),
              "Idle, when Start AND Guard: sends VELOCITY(V1) and goes to Travel; before: nothing\n");
    EXPECT_EQ(changes_text({{"IF TIMER.Q", "IF TIMER.Q AND NOT Guard"}}),
              "Hold, when Guard AND TIMER.Q: does nothing; before: goes to Idle\n");
}

TEST(TableDiff, OutputsAreToldOnceWithTheStep) {
    EXPECT_EQ(changes_text({{"OUT Grip", "OUT Grip, Lamp"}}), "Travel: OUT Lamp, Grip; before: Grip\n");
    EXPECT_EQ(changes_text({{"OUT Lamp;", ""}}), "Idle: OUT none; before: Lamp\n");
    EXPECT_EQ(changes_text({{"OUT Lamp;", "OUT Lamp; OUT Grip WHEN Guard;"}}),
              "Idle, when Guard: has Grip on; before: has Grip off\n");
}

TEST(TableDiff, AnEntryIsToldOnce) {
    EXPECT_EQ(changes_text({{"ENTRY STOP;", "ENTRY STOP; ENTRY CLEAR_IN_POS;"}}),
              "Fault, when entered: sends STOP, CLEAR_IN_POS; before: sends STOP\n");
}

TEST(TableDiff, StepsThatAreNewGoneOrRenamed) {
    EXPECT_EQ(changes_text({{"STEP Hold", "STEP Wait"}, {"NEXT := Hold", "NEXT := Wait"}}),
              "the same bytes\nHold is called Wait now\n");
    const TableDiff longer =
        diff(machine(), machine({{"STEP Hold: IF TIMER.Q THEN NEXT := Idle",
                                  "STEP Rest: IF Start THEN NEXT := Idle; END_IF END_STEP\n"
                                  "STEP Hold: IF TIMER.Q THEN NEXT := Rest"}}));
    EXPECT_EQ(text_of(longer),
              "Rest is new, step 3\n"
              "other step numbers, which change nothing: Hold 3 -> 4, Fault 4 -> 5\n"
              "Hold, when TIMER.Q: goes to Rest; before: goes to Idle\n");
    EXPECT_FALSE(longer.same_behaviour());
}

TEST(TableDiff, OnlyRenumberedIsTheSame) {
    const std::string hold = "STEP Hold: IF TIMER.Q THEN NEXT := Idle; END_IF END_STEP\n";
    const TableDiff moved = diff(machine(), machine({{hold, ""}, {"STEP Idle", hold + "STEP Idle"}}));
    EXPECT_TRUE(moved.same_behaviour());
    EXPECT_EQ(text_of(moved),
              "other bytes, but every step does the same\n"
              "other step numbers, which change nothing: Idle 1 -> 2, Travel 2 -> 3, Hold 3 -> 1\n");
}

TEST(TableDiff, BareTablesGoByNumber) {
    const Compilation a = test::compiled(machine());
    const Compilation b = test::compiled(machine({{"1500 rpm", "1000 rpm"}, {"T#500ms", "T#700ms"}}));
    EXPECT_EQ(
        text_of(diff_of({a.table, nullptr}, {b.table, nullptr})),
        "V1: 3146 -> 2097\n"
        "step 2, when NOT IN1 AND INPOS: sets TIMER := T#700ms and goes to step 3; before: sets TIMER := "
        "T#500ms and goes to step 3\n");
    EXPECT_EQ(text_of(diff_of({a.table, &a.symbols}, {a.table, nullptr})), "the same bytes\n");
}

TEST(TableDiff, AnotherMotorIsMentioned) {
    EXPECT_EQ(changes_text({{"MAC140", "MAC141"}}), "the same bytes\nfor another motor: MAC140 -> MAC141\n");
}

TEST(TableDiff, Json) {
    const auto json = nlohmann::json::parse(
        json_of(diff(machine(), machine({{"1500 rpm", "1000 rpm"}, {"T#500ms", "T#700ms"}}))));
    EXPECT_EQ(json["same_bytes"], false);
    EXPECT_EQ(json["same_behaviour"], false);
    EXPECT_EQ(json["values"][0]["register"], "V1");
    EXPECT_EQ(json["values"][0]["name"], "Fast");
    EXPECT_EQ(json["values"][0]["now_in_units"], "1000 rpm");
    EXPECT_EQ(json["reactions"][0]["step"], "Travel");
    EXPECT_EQ(json["reactions"][0]["when"], "NOT Guard AND INPOS");
}

// Nothing leads to Rest, so it does not settle what Idle is entered with.
TEST(TableDiff, ASwitchOfAStepThatIsNeverReached) {
    const std::string rest = "STEP Rest: TERM IF Start THEN OUT Grip; NEXT := Idle; END_IF; END_STEP\n";
    const std::string with = machine({{"STEP Hold", rest + "STEP Hold"}});
    std::string other = with;
    other.replace(other.find("OUT Grip; NEXT := Idle"), 8, "OUT Lamp");
    EXPECT_EQ(text_of(diff(with, other)),
              "Rest, when Start: has Lamp on, Grip off and goes to Idle; before: has Lamp off, "
              "Grip on and goes to Idle\n");
}

/// Clear beats preset beats count down; a counter at zero stays there (001 §6.1.7).
test::Scan effect_of(const std::vector<std::uint8_t>& table, int step, unsigned number) {
    test::Scan scan = test::scan_case(table, step, number);
    if (!scan.next) scan.next = step;
    if (scan.clears) scan.counter.reset();
    if (scan.clears || scan.counter || (number & 0x200U) != 0) scan.counts = false;
    if (!scan.counter && (number & 0x200U) != 0) scan.clears = false;
    return scan;
}

/// Whether two tables are the same is decided by running them, by a scan of our own.
bool run_alike(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, unsigned steps) {
    for (int step = 0; step < static_cast<int>(steps); ++step) {
        for (unsigned c = 0; c < 1024; ++c) {
            if (!(effect_of(a, step, c) == effect_of(b, step, c))) return false;
        }
    }
    return true;
}

TEST(TableDiff, FindsEveryChangeOfARandomTable) {
    constexpr unsigned kSeed = 36;
    constexpr unsigned kSteps = 3;
    test::Random random(kSeed);
    int same = 0;
    int different = 0;
    for (int round = 0; round < 400; ++round) {
        const auto before = test::random_table(random, kSteps, 2 + random() % 12);
        auto now = before;
        const std::size_t term = random() % (now.size() / 8 - 1);
        const std::size_t byte = term * 8 + 1 + random() % 7;
        now[byte] ^= static_cast<std::uint8_t>(1U << random() % 8);
        const TableDiff result = diff_of({before, nullptr}, {now, nullptr});
        SCOPED_TRACE("seed " + std::to_string(kSeed) + ", round " + std::to_string(round));
        EXPECT_FALSE(result.same_bytes);
        const bool alike = run_alike(before, now, kSteps);
        EXPECT_EQ(result.same_behaviour(), alike) << text_of(result);
        ++(alike ? same : different);
        EXPECT_TRUE(diff_of({before, nullptr}, {before, nullptr}).same_behaviour());
    }
    EXPECT_GT(same, 10);
    EXPECT_GT(different, 60);
}

}  // namespace
}  // namespace nplc::seqc
