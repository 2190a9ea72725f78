#include "analysis/verify.h"

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "seqc/properties.h"

namespace nplc::verify {
namespace {

constexpr std::uint8_t kAny = 0xC0;        // STATE: neither timer nor counter need be zero
constexpr std::uint8_t kTimerZero = 0x40;  // STATE: the timer must be zero

/// A term in FastMAC format without a command.
struct Row {
    std::uint8_t state, input, care, next, output;
    std::uint16_t preset = 0;
    std::uint8_t command = 0x80;
};

class Bench {
  public:
    Bench(std::initializer_list<Row> rows) {
        for (const Row& r : rows) {
            for (const unsigned byte :
                 {unsigned{r.state}, unsigned{r.input}, unsigned{r.care}, unsigned{r.next},
                  unsigned{r.command}, unsigned{r.output}, r.preset & 0xFFU, unsigned{r.preset} >> 8U})
                bytes_.push_back(static_cast<std::uint8_t>(byte));
        }
        bytes_.insert(bytes_.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
        loaded_ = sequencer::Table::load(bytes_);
        EXPECT_TRUE(loaded_.ok);
    }

    Result judge(const std::string& form, Assume assume) {
        const seqc::PropertyReading reading =
            seqc::read_properties(assumed_ + "PROPERTY P: " + form + ";", {});
        EXPECT_TRUE(reading.diagnostics.empty());
        Options options;
        options.assumptions = reading.assumptions;
        options.assume = assume;
        options.order_time = [](std::span<const sequencer::MotorOrder>) { return Delay{4, 8, 0}; };
        const Report report = verify(loaded_.table, {}, reading.properties, options);
        for (const Result& result : report.results) {
            if (result.name == "P") return result;
        }
        return {};
    }
    /// What a check found in a step.
    Result finding(const std::string& code, std::uint8_t step) {
        Options options;
        options.order_time = [](std::span<const sequencer::MotorOrder>) { return Delay{4, 8, 0}; };
        for (const Result& result : verify(loaded_.table, {}, {}, options).results) {
            if (result.code == code && result.step == step) return result;
        }
        return {};
    }
    Bench& assuming(std::string assumptions) {
        assumed_ = std::move(assumptions);
        return *this;
    }
    Verdict verdict(const std::string& form, Assume assume = Assume::any) {
        return judge(form, assume).verdict;
    }

  private:
    std::string assumed_;
    std::vector<std::uint8_t> bytes_;
    sequencer::Table::LoadResult loaded_;
};

/// Step 0 to 1 when IN0 comes, with the timer at 500; 1 to 2 when the timer is zero, with OUT0.
Bench timed() {
    return {{kAny, 0x01, 0x01, 1, 0, 500}, {kTimerZero | 1, 0, 0, 2, 1}};
}

TEST(Verify, TheTimerIsWaitedFor) {
    EXPECT_EQ(timed().verdict("NEVER step = 2 AND NOT OUT0"), Verdict::proved);
    for (const Assume assume : {Assume::any, Assume::driver}) {
        const Result result = timed().judge("NEVER OUT0", assume);
        EXPECT_EQ(result.verdict, Verdict::broken);
        ASSERT_TRUE(result.course);
        std::uint32_t time = 0;
        for (const PlayedScan& scan : *result.course) time += scan.dt_ms;
        EXPECT_EQ(time, 500U);
        EXPECT_EQ(result.course->size(),
                  assume == Assume::any ? 2U : 252U);  // 500 ms in scans of 2 ms, and two
    }
}

std::uint32_t ms_before_the_last(const Result& result) {
    std::uint32_t time = 0;
    for (std::size_t i = 0; result.course && i + 1 < result.course->size(); ++i)
        time += (*result.course)[i].dt_ms;
    return time;
}

TEST(Verify, AForgottenPresetIsFoundBehindAWait) {
    // Step 1 presets 1500 ms and waits for them, step 2 waits for the timer that was not preset again.
    Bench forgot{{kAny, 1, 1, 1, 0, 1500}, {kTimerZero | 1, 0, 0, 2, 1}, {kTimerZero | 2, 0, 0, 0, 0}};
    const Result result = forgot.finding("V007", 2);
    EXPECT_EQ(result.verdict, Verdict::broken);
    EXPECT_GE(ms_before_the_last(result), 1500U);
}

TEST(Verify, AMoveThatStandsIsFoundBehindAWait) {
    // The second move is ordered while V_SOLL is 0 from the STOP, after a wait of 600 ms.
    Bench stands{
        {kAny, 1, 1, 1, 0, 600}, {kTimerZero | 1, 0, 0, 2, 0, 0, 0x40}, {kAny | 2, 2, 2, 0, 0, 0, 0x65}};
    const Result result = stands.finding("V011", 2);
    EXPECT_EQ(result.verdict, Verdict::broken);
    EXPECT_GE(ms_before_the_last(result), 1200U);
    EXPECT_EQ(stands.finding("V009", 2).verdict, Verdict::broken);
}

TEST(Verify, WhatBreaksALongTimeBreaksAShorterOne) {
    // IN0 may be off for the scan of power-up alone, which sends: then nothing leads to step 1.
    Bench missed{{kAny, 0, 0, 2, 0, 0, 0x65}, {kAny | 2, 0, 1, 1, 0}};
    for (const char* ms : {"0", "2", "20", "200", "320", "400", "3600000"}) {
        const Result result = missed.judge(
            std::string("WHENEVER NOT IN0 AND NOT ERROR THEN step = 1 WITHIN ") + ms + " ms", Assume::driver);
        EXPECT_EQ(result.verdict, Verdict::broken) << ms;
    }
}

TEST(Verify, AProofOfNothingIsToldFromOne) {
    // Step 0 has OUT0 on, step 1 OUT1; IN0 leads to and fro.
    Bench either{{kAny, 1, 1, 1, 2}, {kAny, 0, 1, 0, 1}, {kAny | 1, 0, 1, 0, 1}, {kAny | 1, 1, 1, 1, 2}};
    for (const char* nothing :
         {"WHENEVER OUT0 AND OUT1 THEN IN0", "WHENEVER OUT0 AND OUT1 THEN IN0 WITHIN 20 ms",
          "BETWEEN (OUT0 AND OUT1) AND IN0 OUT0 STAYS OFF", "WHENEVER OUT0 AND OUT1 FOR 10 ms THEN IN0",
          "NEVER OUT0 WHILE OUT0 AND OUT1 FOR 10 ms", "OUT2 ONLY AFTER IN0", "OUT2 CHANGES ONLY IN IN0",
          "EVERY_SCAN FROM OUT2 ENDS IN OUT0", "WHENEVER OUT0 FOLLOWED BY OUT2 THEN IN0"}) {
        const Result result = either.judge(nothing, Assume::driver);
        EXPECT_EQ(result.verdict, Verdict::proved) << nothing;
        EXPECT_TRUE(result.vacuous) << nothing;
    }
    EXPECT_EQ(either.judge("WHENEVER OUT0 AND OUT1 THEN IN0", Assume::any).reason,
              "but it says nothing: OUT0 AND OUT1 never holds");
    for (const char* something :
         {"WHENEVER OUT1 AND IN0 THEN NOT OUT0", "NEVER OUT0 AND OUT1", "OUT1 ONLY AFTER IN0",
          "ALWAYS POSSIBLE OUT0", "OUT1 ONLY FROM step = 0 AND IN0"}) {
        const Result result = either.judge(something, Assume::any);
        EXPECT_EQ(result.verdict, Verdict::proved) << something;
        EXPECT_FALSE(result.vacuous) << something;
    }
    for (const auto& [nothing, why] : std::initializer_list<std::pair<const char*, const char*>>{
             {"NEVER step = 40", "it asks for a step that the table does not have"},
             {"NEVER OUT0 AND NOT OUT0",
              "its condition contradicts itself, and never holds whatever the machine does"},
             {"NEVER step = 0 AND step = 1",
              "its condition contradicts itself, and never holds whatever the machine does"},
             {"ALWAYS OUT0 OR NOT OUT0", "its condition always holds, whatever the machine does"},
             {"NEVER IN0 AND OUT2", "OUT2 never holds by itself"}}) {
        const Result result = either.judge(nothing, Assume::driver);
        EXPECT_EQ(result.verdict, Verdict::proved) << nothing;
        EXPECT_EQ(result.reason, std::string("but it says nothing: ") + why) << nothing;
    }
    for (const char* something : {"NEVER OUT2", "NEVER step = 1 AND OUT0"}) {
        EXPECT_EQ(either.verdict(something, Assume::driver), Verdict::proved) << something;
        EXPECT_FALSE(either.judge(something, Assume::driver).vacuous) << something;
    }
    either.assuming("ASSUME NEVER IN0;");
    EXPECT_EQ(either.judge("NEVER OUT1 AND step = 1", Assume::driver).reason,
              "but it says nothing: OUT1 never holds by itself under the assumptions");
    EXPECT_TRUE(either.judge("NEVER OUT1 AND IN0", Assume::driver).vacuous);
    EXPECT_FALSE(either.judge("NEVER OUT1", Assume::driver).vacuous);
}

TEST(Verify, WhatNoMachineCouldBreakSaysNothing) {
    Bench either{{kAny, 1, 1, 1, 2}, {kAny, 0, 1, 0, 1}, {kAny | 1, 0, 1, 0, 1}, {kAny | 1, 1, 1, 1, 2}};
    const std::string always = " condition always holds, whatever the machine does";
    for (const auto& [nothing, why] : std::initializer_list<std::pair<const char*, std::string>>{
             {"OUT1 ONLY AFTER TRUE", "AFTER's" + always},
             {"OUT1 ONLY AFTER IN0 OR NOT IN0", "AFTER's" + always},
             {"OUT1 ONLY AFTER OUT1 OR IN0", "it holds whatever the machine does"},
             {"OUT1 ONLY FROM TIMER.Q",
              "FROM's condition holds when the first scan begins, whatever the machine does"},
             {"OUT1 CHANGES ONLY IN TRUE", "IN's" + always},
             {"OUT1 CHANGES ONLY IN NOT OUT1", "it holds whatever the machine does"},
             {"EVERY_SCAN FROM OUT1 ENDS IN TRUE", "ENDS IN's" + always},
             {"EVERY_SCAN FROM IN0 AND OUT1 ENDS IN IN0", "it holds whatever the machine does"},
             {"BETWEEN OUT1 AND OUT0 TRUE STAYS ON", "the STAYS" + always},
             {"BETWEEN OUT1 AND (NOT OUT1) OUT1 STAYS ON", "it holds whatever the machine does"},
             {"BETWEEN OUT1 AND OUT1 OUT0 STAYS ON", "BETWEEN never begins"},
             {"WHENEVER OUT1 THEN TRUE", "THEN's" + always},
             {"WHENEVER OUT1 AND IN0 THEN IN0", "it holds whatever the machine does"},
             {"WHENEVER OUT1 THEN TRUE WITHIN 20 ms", "THEN's" + always},
             {"WHENEVER OUT1 FOR 20 ms THEN OUT1", "it holds whatever the machine does"},
             {"WHENEVER OUT0 FOLLOWED BY OUT1 THEN OUT1 OR IN0", "it holds whatever the machine does"},
             {"NEVER NOT OUT1 WHILE OUT1 FOR 20 ms", "it holds whatever the machine does"},
             {"TRUE IS REACHABLE", "its" + always},
             {"ALWAYS POSSIBLE TRUE", "its" + always},
             {"AFTER OUT1 ALWAYS POSSIBLE OUT1 OR OUT0", "it holds whatever the machine does"}}) {
        for (const Assume assume : {Assume::any, Assume::driver}) {
            const Result result = either.judge(nothing, assume);
            EXPECT_EQ(result.verdict, Verdict::proved) << nothing;
            EXPECT_TRUE(result.vacuous) << nothing;
            EXPECT_EQ(result.reason, "but it says nothing: " + why) << nothing;
        }
    }
    either.assuming("ASSUME NEVER IN0;");
    EXPECT_EQ(either.judge("WHENEVER OUT0 THEN NOT IN0", Assume::driver).reason,
              "but it says nothing: the assumptions about inputs alone rule it out");
}

TEST(Verify, WhatIsPossibleByWayOfErrorAloneIsToldApart) {
    // Step 0: IN0 -> step 1, where all ends. ERROR leads to step 2, from there IN1 with a reset to step 0.
    constexpr std::uint8_t kError = 0x80;
    constexpr std::uint8_t kReset = 0x61;
    for (const Assume assume : {Assume::any, Assume::driver}) {
        Bench ends{{kAny, 1, 1, 1, 1},
                   {kAny, kError, 0, 2, 2},
                   {kAny | 1, kError, 0, 2, 2},
                   {kAny | 2, kError | 2, 2, 0, 0, 0, kReset},
                   {kAny | 2, 2, 2, 0, 0, 0, kReset}};
        const Result back = ends.judge("ALWAYS POSSIBLE step = 0", assume);
        EXPECT_EQ(back.verdict, Verdict::proved);
        EXPECT_TRUE(back.only_by_error);
        EXPECT_EQ(back.reason,
                  "but only by way of ERROR: from step 1 nothing leads there unless the motor gets one");
        EXPECT_TRUE(ends.judge("AFTER OUT0 ALWAYS POSSIBLE step = 0", assume).only_by_error);
        EXPECT_TRUE(ends.judge("OUT1 IS REACHABLE", assume).only_by_error);
        for (const char* plain :
             {"AFTER OUT1 ALWAYS POSSIBLE OUT0", "ALWAYS POSSIBLE OUT0", "OUT0 IS REACHABLE"}) {
            const Result result = ends.judge(plain, assume);
            EXPECT_EQ(result.verdict, Verdict::proved) << plain;
            EXPECT_FALSE(result.only_by_error) << plain << result.reason;
            EXPECT_EQ(result.reason, "") << plain;
        }
        ends.assuming("ASSUME NEVER ERROR;");
        EXPECT_EQ(ends.verdict("ALWAYS POSSIBLE step = 0", assume), Verdict::broken);
    }
}

TEST(Verify, InputsThatKeepTheirLevelsLeaveWhatIsAlwaysPossible) {
    // IN0 leads from 0 to 1, and IN0 off back.
    Bench there{{kAny, 1, 1, 1, 2}, {kAny | 1, 0, 1, 0, 1}};
    for (const char* input : {"IN3 STABLE FOR 20 ms", "IN0 STABLE FOR 2 ms", "IN0 STABLE FOR 3600 s"}) {
        there.assuming(std::string("ASSUME NEVER ERROR; ASSUME ") + input + ";");
        EXPECT_EQ(there.verdict("ALWAYS POSSIBLE step = 0", Assume::driver), Verdict::proved) << input;
    }
    // Steps 1 and 2 go to and fro as long as IN0 is on, so that no scan does nothing.
    Bench busy{{kAny, 1, 1, 1, 2},
               {kAny | 1, 1, 1, 2, 2},
               {kAny | 1, 0, 1, 0, 1},
               {kAny | 2, 1, 1, 1, 2},
               {kAny | 2, 0, 1, 0, 1}};
    busy.assuming("ASSUME NEVER ERROR;");
    EXPECT_EQ(busy.verdict("ALWAYS POSSIBLE step = 0", Assume::driver), Verdict::proved);
    busy.assuming("ASSUME NEVER ERROR; ASSUME IN0 STABLE FOR 20 ms;");
    const Result open = busy.judge("ALWAYS POSSIBLE step = 0", Assume::driver);
    EXPECT_EQ(open.verdict, Verdict::undecided);
    EXPECT_NE(open.reason.find("; without ASSUME IN0 STABLE FOR 20 ms it is proved"), std::string::npos)
        << open.reason;
}

TEST(Verify, DeadlinesKnowTheTimer) {
    EXPECT_EQ(
        timed().verdict("WHENEVER IN0 AND NOT ERROR THEN step = 1 OR step = 2 WITHIN 0 ms", Assume::driver),
        Verdict::proved);
    EXPECT_EQ(timed().verdict("WHENEVER step = 1 THEN step = 2 WITHIN 502 ms", Assume::driver),
              Verdict::broken);
    // ERROR stops the terms above. Without it the step ends with the first scan after 500 ms.
    Bench whatever_error{{kAny, 0x01, 0x01, 1, 0, 500},
                         {kTimerZero | 1, 0x00, 0x00, 2, 1},
                         {kTimerZero | 1, 0x80, 0x00, 2, 1}};
    EXPECT_EQ(
        whatever_error.verdict("WHENEVER step = 1 THEN step = 2 OR ERROR WITHIN 502 ms", Assume::driver),
        Verdict::proved);
    EXPECT_EQ(whatever_error.verdict("WHENEVER step = 1 THEN step = 2 WITHIN 500 ms", Assume::driver),
              Verdict::broken);
    EXPECT_EQ(whatever_error.verdict("WHENEVER step = 1 THEN step = 2 WITHIN 499 ms", Assume::driver),
              Verdict::broken);
    EXPECT_EQ(whatever_error.verdict("WHENEVER step = 1 THEN step = 2 WITHIN 502 ms", Assume::any),
              Verdict::broken);
}

TEST(Verify, WhileThereIsAnErrorALinkMayComeBackAndHoldAScanUp) {
    // The gateway stops the motor then, before the sequence goes on: 8 ms at 19200 baud, as rehearsed with a
    // cut line; 300 ms if the line breaks again meanwhile.
    Bench blinks{{kAny, 0x01, 0x01, 1, 0, 500},
                 {kTimerZero | 1, 0x00, 0x00, 2, 1},
                 {kTimerZero | 1, 0x80, 0x00, 2, 1}};
    const std::string kLeaves = "WHENEVER step = 1 THEN step = 2 WITHIN ";
    EXPECT_EQ(blinks.verdict(kLeaves + "502 ms", Assume::driver), Verdict::undecided);
    EXPECT_EQ(blinks.verdict(kLeaves + "800 ms", Assume::driver), Verdict::undecided);
    EXPECT_EQ(blinks.verdict(kLeaves + "801 ms", Assume::driver), Verdict::proved);
    EXPECT_EQ(blinks.verdict(kLeaves + "502 ms; ASSUME NEVER ERROR", Assume::driver), Verdict::proved);
}

TEST(Verify, AnInputKeepsItsLevelUnderDriver) {
    // IN0 changes from scan to scan, at most 2 ms apart. Three changes fit into 6 ms, four would need 9 ms in
    // 8 ms.
    Bench flicker{{kAny, 0x01, 0x01, 1, 0},     {kAny | 1, 0x00, 0x01, 2, 0}, {kAny | 1, 0x01, 0x01, 6, 0},
                  {kAny | 2, 0x01, 0x01, 3, 1}, {kAny | 2, 0x00, 0x01, 6, 0}, {kAny | 3, 0x00, 0x01, 4, 0},
                  {kAny | 3, 0x01, 0x01, 6, 0}, {kAny | 4, 0x01, 0x01, 5, 0}, {kAny | 4, 0x00, 0x01, 6, 0}};
    for (const char* step : {"NEVER step = 4", "NEVER step = 5"}) {
        EXPECT_EQ(flicker.verdict(step, Assume::any), Verdict::broken);
        EXPECT_EQ(flicker.verdict(step, Assume::driver) == Verdict::broken,
                  step == std::string("NEVER step = 4"));
    }
}

TEST(Verify, ErrorStaysUntilItIsResetUnderDriver) {
    constexpr std::uint8_t kResetError = 0x61;
    Bench without{{kAny, 0x80, 0, 1, 0}, {kAny | 1, 0x00, 0, 0, 0}};
    EXPECT_EQ(without.verdict("ALWAYS POSSIBLE step = 0", Assume::any), Verdict::proved);
    EXPECT_EQ(without.verdict("ALWAYS POSSIBLE step = 0", Assume::driver), Verdict::broken);
    Bench with{
        {kAny, 0x80, 0, 1, 0}, {kAny | 1, 0x00, 0, 0, 0}, {kAny | 1, 0x81, 1, 0x3E, 0, 0, kResetError}};
    EXPECT_EQ(with.verdict("ALWAYS POSSIBLE step = 0", Assume::driver), Verdict::proved);
    Bench with_in_pos{
        {kAny, 0x80, 0, 1, 0}, {kAny | 1, 0x00, 0, 0, 0}, {kAny | 1, 0xC0, 0x40, 0x3E, 0, 0, kResetError}};
    EXPECT_EQ(with_in_pos.verdict("ALWAYS POSSIBLE step = 0", Assume::driver),
              Verdict::broken);  // a lost link
}

/// Step 0 sends `begin` with IN0 and goes to 1; step 1 sends `end` with IN1 and goes to 2.
Bench moves(std::uint8_t begin, std::uint8_t end) {
    return {{kAny, 1, 1, 1, 0, 0, begin}, {kAny | 1, 2, 2, 2, 0, 0, end}};
}

TEST(Verify, MovingIsFromAnOrderUntilInPosOrAStop) {
    constexpr std::uint8_t kPosition = 0x40;  // selects P1 in position mode (001 §5.2.1.4)
    constexpr std::uint8_t kVelocity = 0x28;  // V1 in velocity mode
    constexpr std::uint8_t kStop = 0x65;
    constexpr std::uint8_t kNop = 0x60;
    for (const Assume assume : {Assume::any, Assume::driver}) {
        EXPECT_EQ(moves(kPosition, kStop).verdict("NEVER moving AND step = 0", assume), Verdict::proved);
        EXPECT_EQ(moves(kPosition, kStop).verdict("WHENEVER step = 1 AND NOT INPOS THEN moving", assume),
                  Verdict::broken);  // INPOS came in a scan before
        EXPECT_EQ(moves(kVelocity, kStop).verdict("WHENEVER step = 1 THEN moving", assume), Verdict::proved);
        EXPECT_EQ(moves(kPosition, kStop).verdict("NEVER moving AND step = 2", assume), Verdict::proved);
        EXPECT_EQ(moves(kPosition, kNop).verdict("NEVER moving AND step = 2", assume), Verdict::broken);
        EXPECT_EQ(moves(kPosition, kNop).verdict("moving ONLY AFTER IN0", assume), Verdict::proved);
        EXPECT_EQ(moves(kPosition, kNop).verdict("NEVER moving AND INPOS AND NOT IN0", assume),
                  Verdict::proved);
    }
}

/// Step 0 orders a move with IN0 and gives it 500 ms; step 1 ends in 2 with INPOS, in 3 without it in time.
Bench timed_move() {
    return {{kAny, 1, 1, 1, 0, 500, 0x40}, {kAny | 1, 0x40, 0x40, 2, 0}, {kTimerZero | 1, 0, 0x40, 3, 0}};
}

TEST(Verify, AMoveEndsInTheTimeAssumed) {
    Bench move = timed_move();
    for (const Assume assume : {Assume::any, Assume::driver}) {
        move.assuming("ASSUME NEVER ERROR;");
        EXPECT_EQ(move.verdict("NEVER step = 3", assume), Verdict::broken);
        // The first scan that sees the timer at 0 comes after 500 ms, more than 499: it sees INPOS.
        move.assuming("ASSUME NEVER ERROR; ASSUME moving ENDS WITHIN 499 ms;");
        EXPECT_EQ(move.verdict("NEVER step = 3", assume), Verdict::proved);
        EXPECT_EQ(move.verdict("step = 3 IS REACHABLE", assume), Verdict::broken);
        EXPECT_EQ(move.verdict("step = 3 ONLY AFTER step = 2", assume), Verdict::proved);
        EXPECT_EQ(move.verdict("ALWAYS POSSIBLE step = 2", assume), Verdict::proved);
        EXPECT_EQ(move.verdict("NEVER step = 1 WHILE moving FOR 500 ms", assume), Verdict::proved);
        EXPECT_EQ(move.verdict("NEVER step = 1 WHILE moving FOR 499 ms", assume), Verdict::broken);
        move.assuming("ASSUME NEVER ERROR; ASSUME moving ENDS WITHIN 500 ms;");
        const Result late = move.judge("NEVER step = 3", assume);
        EXPECT_EQ(late.verdict, Verdict::broken);
        ASSERT_TRUE(late.course);
        std::uint32_t time = 0;
        for (std::size_t i = 0; i + 1 < late.course->size(); ++i) time += (*late.course)[i].dt_ms;
        EXPECT_EQ(time, 500U);
        EXPECT_EQ(move.verdict("step = 3 ONLY AFTER step = 2", assume), Verdict::broken);
        // The shortest of several times counts.
        move.assuming("ASSUME NEVER ERROR; ASSUME moving ENDS WITHIN 499 ms; ASSUME moving ENDS WITHIN 3 s;");
        EXPECT_EQ(move.verdict("NEVER step = 3", assume), Verdict::proved);
    }
}

TEST(Verify, OfAMoveThatAnErrorDisturbedNothingIsAssumed) {
    Bench move = timed_move();
    move.assuming("ASSUME moving ENDS WITHIN 100 ms;");
    EXPECT_EQ(move.verdict("NEVER step = 3", Assume::any), Verdict::broken);
    EXPECT_EQ(move.verdict("NEVER step = 3", Assume::driver), Verdict::proved);  // ERROR stays there
    EXPECT_EQ(move.verdict("NEVER TRUE WHILE moving FOR 101 ms", Assume::driver), Verdict::broken);
}

TEST(Verify, TheNextOrderBeginsAMoveAnew) {
    // Step 1 orders another move 60 ms after the first, which ends no more than 100 ms after that.
    Bench twice{
        {kAny, 1, 1, 1, 0, 60, 0x40}, {kTimerZero | 1, 0, 0, 2, 0, 0, 0x41}, {kAny | 2, 0x40, 0x40, 3, 0}};
    twice.assuming("ASSUME NEVER ERROR; ASSUME moving ENDS WITHIN 100 ms;");
    EXPECT_EQ(twice.verdict("NEVER TRUE WHILE moving FOR 160 ms", Assume::driver), Verdict::broken);
    EXPECT_EQ(twice.verdict("NEVER TRUE WHILE moving FOR 163 ms", Assume::driver), Verdict::proved);
    EXPECT_EQ(twice.verdict("NEVER TRUE WHILE moving AND step = 2 FOR 101 ms", Assume::driver),
              Verdict::proved);
}

/// Scans are 2 ms apart: the last one that sees no INPOS comes after 300 ms at the latest, the next 2 ms
/// later.
TEST(Verify, ADeadlineCountsOnTheEndOfAMove) {
    Bench move{{kAny, 1, 1, 1, 0, 0, 0x40}, {kAny | 1, 0x40, 0x40, 2, 0}};
    move.assuming("ASSUME NEVER ERROR;");
    EXPECT_EQ(move.verdict("WHENEVER step = 1 THEN step = 2 WITHIN 3600 s", Assume::driver), Verdict::broken);
    move.assuming("ASSUME NEVER ERROR; ASSUME moving ENDS WITHIN 300 ms;");
    EXPECT_EQ(move.verdict("WHENEVER step = 1 THEN step = 2 WITHIN 302 ms", Assume::driver), Verdict::proved);
    EXPECT_EQ(move.verdict("WHENEVER step = 1 THEN step = 2 WITHIN 301 ms", Assume::driver), Verdict::broken);
}

TEST(Verify, WhileCountsFromTheScanWhereItBegan) {
    // Step 1 lasts 100 ms, with OUT0; without ERROR it ends with the first scan after them.
    Bench pulse{{kAny, 1, 1, 1, 1, 100}, {kTimerZero | 1, 0, 0, 2, 0}};
    pulse.assuming("ASSUME NEVER ERROR;");
    EXPECT_EQ(pulse.verdict("NEVER OUT0 WHILE step = 1 FOR 99 ms", Assume::driver), Verdict::broken);
    EXPECT_EQ(pulse.verdict("NEVER OUT0 WHILE step = 1 FOR 100 ms", Assume::driver), Verdict::proved);
    EXPECT_EQ(pulse.verdict("WHENEVER step = 1 FOR 100 ms THEN OUT1", Assume::driver), Verdict::proved);
    EXPECT_EQ(pulse.verdict("WHENEVER step = 1 FOR 50 ms THEN OUT1", Assume::driver), Verdict::broken);
}

TEST(Verify, AssumptionsLeaveCoursesOut) {
    Bench both{{kAny, 3, 3, 1, 1}, {kAny | 1, 0, 0, 0x3E, 1}};
    for (const Assume assume : {Assume::any, Assume::driver}) {
        both.assuming("");
        EXPECT_EQ(both.verdict("NEVER step = 1", assume), Verdict::broken);
        both.assuming("ASSUME NEVER IN0 AND IN1;");
        EXPECT_EQ(both.verdict("NEVER step = 1", assume), Verdict::proved);
        EXPECT_EQ(both.verdict("step = 1 IS REACHABLE", assume), Verdict::broken);
    }
    // IN0 comes, and goes while the timer's 20 ms last.
    Bench tap{
        {kAny, 0, 1, 1, 0}, {kAny | 1, 1, 1, 2, 0, 20}, {kAny | 2, 0, 1, 3, 0}, {kTimerZero | 2, 1, 1, 4, 0}};
    EXPECT_EQ(tap.verdict("NEVER step = 3 AND NOT TIMER.Q", Assume::driver), Verdict::broken);
    tap.assuming("ASSUME NEVER ERROR; ASSUME IN0 STABLE FOR 30 ms;");
    EXPECT_NE(tap.verdict("NEVER step = 3 AND NOT TIMER.Q", Assume::driver), Verdict::broken);
}

TEST(Verify, TheCounterIsExact) {
    // Counts 3 down with IN0, then goes on.
    Bench counts{{kAny, 0, 0, 1 | 0x40, 0, 3}, {kAny | 1, 1, 1, 0x3E, 0x80}, {0x80 | 1, 0, 1, 2, 1}};
    const Result result = counts.judge("NEVER step = 2", Assume::any);
    EXPECT_EQ(result.verdict, Verdict::broken);
    ASSERT_TRUE(result.course);
    EXPECT_EQ(result.course->size(), 5U);
}

}  // namespace
}  // namespace nplc::verify
