#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

/// A program with `at_start` before POWER_UP, which begins to home in step Begin and goes to step Wait.
std::string homing(const std::string& wait, const std::string& declarations = {},
                   const std::string& begin = "HOME;") {
    return "PROGRAM P MOTOR MAC140;\n" + declarations + "\nSTEP Begin: OWN ERROR; IF IN0 THEN " + begin +
           " NEXT := Wait; END_IF END_STEP\n"
           "STEP Wait: OWN ERROR; " +
           wait +
           " END_STEP\n"
           "STEP Done: OWN ERROR; IF IN1 THEN NEXT := POWER_UP; END_IF END_STEP\nEND_PROGRAM\n";
}
std::string start_mode(int mode) {
    return "VAR_MOTOR After AT STARTMODE := " + std::to_string(mode) + "; END_VAR";
}
std::string codes(const std::string& source) {
    return test::codes(compile(source));
}

const char* const kWaits = "IF INPOS THEN NEXT := Done; END_IF";

TEST(Homing, AWaitForInposNeedsAStartMode) {
    EXPECT_EQ(codes(homing(kWaits)), "W012");
    EXPECT_EQ(codes(homing(kWaits, {}, "MODE_REG := 12;")), "W012");
    EXPECT_EQ(codes(homing(kWaits, start_mode(2))), "");
    EXPECT_EQ(codes(homing(kWaits, {}, "STARTMODE := 2; HOME;")), "");
    EXPECT_EQ(codes(homing(kWaits, {}, "HOME; STARTMODE := 2;")), "");  // it is read when homing ends
}

// IN_POS is 0 in INIT, in the torque and manual modes and with an analogue velocity (001 §4.4.1, §4.4.5 to
// §4.4.8); velocity, position and gear modes and those that are like them set it (§4.4.2 to §4.4.4, §4.4.18
// to §4.4.22, §4.4.25).
TEST(Homing, OnlyModesThatSetInposHelp) {
    for (int mode : {1, 2, 3, 17, 18, 19, 20, 21, 24})
        EXPECT_EQ(codes(homing(kWaits, start_mode(mode))), "") << mode;
    for (int mode : {0, 4, 5, 6, 7, 10, 11, 12, 15, 16, 22, 23})
        EXPECT_EQ(codes(homing(kWaits, start_mode(mode))), "W012") << mode;
}

TEST(Homing, NoWordWhereTheProgramWaitsForSomethingElse) {
    EXPECT_EQ(codes(homing("IF IN2 THEN NEXT := Done; END_IF")), "");
    EXPECT_EQ(codes(homing("IF TIMER.Q THEN NEXT := Done; END_IF", {}, "TIMER := T#9s; HOME;")), "");
    EXPECT_EQ(codes(homing("OUT OUT0 WHEN INPOS; IF IN2 THEN NEXT := Done; END_IF")), "");
    EXPECT_EQ(codes(homing("IF IN2 AND NOT INPOS THEN NEXT := Done; END_IF")), "");
}

// A selection ends homing, so afterwards INPOS is that of the mode selected.
TEST(Homing, AMoveAfterItIsWaitedForAsAlways) {
    const std::string then_moves =
        "IF IN2 THEN INIT(V1); POSITION(P1); NEXT := Move; END_IF END_STEP\n"
        "STEP Move: OWN ERROR; IF INPOS THEN NEXT := Done; END_IF";
    EXPECT_EQ(codes(homing(then_moves)), "");
}

TEST(Homing, AStartModeOnOneWayOnlyIsNotEnough) {
    const std::string source =
        "PROGRAM P MOTOR MAC140;\n"
        "STEP Begin: OWN ERROR; IF IN0 THEN STARTMODE := 2; NEXT := Go; ELSIF IN1 THEN NEXT := Go; END_IF "
        "END_STEP\n"
        "STEP Go: OWN ERROR; IF IN2 THEN HOME; NEXT := Wait; END_IF END_STEP\n"
        "STEP Wait: OWN ERROR; IF INPOS THEN NEXT := POWER_UP; END_IF END_STEP\nEND_PROGRAM\n";
    EXPECT_EQ(codes(source), "W012");
}

TEST(Homing, IsCutShortByASelectionInTheSameScan) {
    EXPECT_EQ(codes(homing("IF IN2 THEN NEXT := Done; END_IF", {}, "HOME; VELOCITY(V1);")), "W014");
    EXPECT_EQ(codes(homing("IF IN2 THEN NEXT := Done; END_IF", {}, "VELOCITY(V1); HOME;")), "");
    EXPECT_EQ(codes(homing("ENTRY VELOCITY(V1); IF IN2 THEN NEXT := Done; END_IF")), "W014");
    EXPECT_EQ(codes(homing("IF IN2 THEN NEXT := Done; END_IF", {}, "HOME; P1 := 50;")), "");
}

std::string limited(const std::string& wait, const std::string& limit, const std::string& motor = "MAC140") {
    return "PROGRAM P MOTOR " + motor + ";\nVAR_MOTOR v AT V1 := 100; p AT P1; l AT " + limit +
           "; END_VAR\nPOWER_UP INIT(v); NEXT := S; END_POWER_UP\n"
           "STEP S: OWN ERROR; IF IN0 THEN TIMER := T#9s; POSITION(P1); NEXT := Wait; END_IF END_STEP\n"
           "STEP Wait: OWN ERROR; " +
           wait + " END_STEP\nEND_PROGRAM\n";
}

const char* const kEndless = "IF INPOS THEN NEXT := S; END_IF";

TEST(Limits, ThatDoNotShowInErrorAreSaid) {
    EXPECT_EQ(codes(limited(kEndless, "MIN_P_IST := -5")), "W013");
    EXPECT_EQ(codes(limited(kEndless, "MAX_P_IST := 5")), "W013");
    EXPECT_EQ(codes(limited(kEndless, "MAX_P_IST := 0")), "");  // no limit (001 §4.5.3)
    EXPECT_EQ(codes(limited(kEndless, "FLWERRMAX := 5")), "");  // bit 1 of ERR_STAT, which ERROR shows
    EXPECT_EQ(codes(limited(kEndless, "UV_HANDLE := 1", "MAC800")), "W013");
}

TEST(Limits, AreNoMatterWhereEachWaitHasATimeLimit) {
    const char* const timed = "IF INPOS THEN NEXT := S; ELSIF TIMER.Q THEN NEXT := POWER_UP; END_IF";
    EXPECT_EQ(codes(limited(timed, "MIN_P_IST := -5")), "");
    EXPECT_EQ(codes(limited("IF INPOS AND TIMER.Q THEN NEXT := S; END_IF", "MIN_P_IST := -5")), "W013");
}

/// All that is said but of names that this branch does not use, of the velocity that it leaves, and of a run.
std::string moves_in(const std::string& source) {
    Compilation result = compile(source);
    std::erase_if(result.diagnostics,
                  [](const Diagnostic& d) { return d.code == "W035" || d.code == "W048"; });
    return test::codes_in_frame(result);
}

/// The compiler's messages on orders in one branch, and of those that the ENTRY of its target adds.
std::string moves(const std::string& branch, const std::string& entry = {}) {
    return moves_in(
        "PROGRAM P MOTOR MAC140;\nVAR_MOTOR near AT P1 := 9; far AT P2 := 8; fast AT V1 := 100; slow AT V2 "
        ":= 50; "
        "END_VAR\n"
        "POWER_UP INIT(V1); NEXT := S; END_POWER_UP\nSTEP S: OWN ERROR; IF IN0 THEN " +
        branch + " NEXT := T; END_IF END_STEP\nSTEP T: OWN ERROR; " + entry +
        " IF IN1 AND NOT IN0 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n");
}

// 001 §5.2.1.4: each selection of a position sets P_SOLL, and INIT and 65h stop the motor.
TEST(ReplacedMoves, AMoveBehindAMoveIsTold) {
    EXPECT_EQ(moves("POSITION(near); POSITION(far);"), "W031");
    EXPECT_EQ(moves("POSITION(near);", "ENTRY POSITION(far);"), "W031");
    EXPECT_EQ(moves("", "ENTRY POSITION(near); ENTRY POSITION(far);"), "W031");
    EXPECT_EQ(moves("VELOCITY(fast); POSITION(near);"), "W031");
    EXPECT_EQ(moves("POSITION(near); VELOCITY(slow);"), "W031");
    EXPECT_EQ(moves("POSITION(near); HOME;"), "W031");
}

TEST(ReplacedMoves, AnEndBehindAMoveIsTold) {
    EXPECT_EQ(moves("VELOCITY(fast);", "ENTRY STOP;"), "W031");
    EXPECT_EQ(moves("POSITION(near); INIT(slow);"), "W031");
}

TEST(ReplacedMoves, WhatIsOneMoveIsNot) {
    EXPECT_EQ(moves("POSITION(near);"), "");
    EXPECT_EQ(moves("INIT(slow); POSITION(near);"), "");
    EXPECT_EQ(moves("VELOCITY(fast); VELOCITY(slow);"), "");
    EXPECT_EQ(moves("STOP; INIT(fast); POSITION(near);"), "");
}

// With relative positions the motor makes both moves (001 §5.2.1.4, 75h).
TEST(ReplacedMoves, RelativeMovesAddUp) {
    EXPECT_EQ(moves("POSITIONS_RELATIVE_P_SOLL; POSITION(near); POSITION(far);"), "");
}

}  // namespace
}  // namespace nplc::seqc
