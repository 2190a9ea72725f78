// What lasts from one step to the next: where the axis stands, what a STOP leaves, the target in position
// mode.
#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

std::string told_codes(const std::string& source) {
    return test::codes(compile(source));
}

const std::string kInitFault =
    "STEP Fault: OWN ERROR; ENTRY INIT(Fast); IF ANY ERROR AND R_TRIG(IN1) THEN RESET_ERROR; NEXT := "
    "POWER_UP; END_IF END_STEP\nEND_PROGRAM\n";

/// A machine that goes out and back at 1000 rpm, to the place of P1 first.
std::string out_and_back(const std::string& far, const std::string& back, const std::string& more = {}) {
    return "PROGRAM P\nMOTOR MAC140;\n"
           "VAR_MOTOR Near AT P1 := 1 rev; Far AT P2 := " +
           far +
           "; Fast AT V1 := 1000 rpm; END_VAR\nON ERROR NEXT := Fault;\n"
           "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF R_TRIG(IN0) THEN NEXT := Go; END_IF END_STEP\n"
           "STEP Go: ENTRY POSITION(Near); IF INPOS WITHIN T#9s THEN NEXT := Back; ELSE NEXT := Fault; "
           "END_IF "
           "END_STEP\n"
           "STEP Back: " +
           more + "ENTRY " + back +
           "; IF INPOS WITHIN T#2s THEN NEXT := Idle; ELSE NEXT := Fault; END_IF END_STEP\n" + kInitFault;
}

TEST(KnownPlaces, AMoveToWhereTheAxisStands) {
    EXPECT_EQ(told_codes(out_and_back("3 rev", "POSITION(Far)")), "");
    EXPECT_EQ(told_codes(out_and_back("3 rev", "POSITION(Near)")), "W033 W040");
    EXPECT_EQ(told_codes(out_and_back("1 rev", "POSITION(Far)")), "W040");
    EXPECT_EQ(told_codes(out_and_back("1 rev", "POSITION(Far)", "ALLOW W040 BECAUSE 'to be sure';")), "");
}

// 60 revolutions at 1000 rpm take 3.6 s.
TEST(KnownPlaces, ATimeLimitThatEndsBeforeTheMoveCan) {
    EXPECT_EQ(told_codes(out_and_back("61 rev", "POSITION(Far)")), "W041");
    EXPECT_EQ(
        told_codes(out_and_back("61 rev", "POSITION(Far)", "ALLOW W041 BECAUSE 'it stops at the part';")),
        "");
    EXPECT_EQ(told_codes(out_and_back("-61 rev", "POSITION(Far)")), "W041");
    EXPECT_EQ(told_codes(out_and_back("34 rev", "POSITION(Far)")), "");  // 33 revolutions, 1.98 s
    EXPECT_EQ(told_codes(out_and_back("35 rev", "POSITION(Far)")), "W041");
}

/// A homing that a guard ends.
std::string guarded_homing(const std::string& stop) {
    return "PROGRAM P\nMOTOR MAC140;\nVAR_MOTOR Kind AT HOME_MODE := BY_COMMAND = HOME1_MODE; How AT "
           "STARTMODE := "
           "P_MODE; Search AT V_HOME := -60 rpm; Fast AT V1 := 600 rpm; END_VAR\n"
           "ON ERROR NEXT := Fault; ON NOT IN2 IN Homing NEXT := Halt;\n"
           "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF R_TRIG(IN0) THEN NEXT := Homing; END_IF END_STEP\n"
           "STEP Homing: ENTRY HOME; IF INPOS WITHIN T#30s THEN NEXT := Idle; ELSE NEXT := Fault; END_IF "
           "END_STEP\n"
           "STEP Halt: ENTRY " +
           stop + "; IF IN2 AND R_TRIG(IN3) THEN NEXT := Idle; END_IF END_STEP\n" + kInitFault;
}

TEST(LastingMotion, AStopEndsNoHoming) {
    EXPECT_EQ(told_codes(guarded_homing("STOP")), "W050");
    EXPECT_EQ(told_codes(guarded_homing("V_SOLL := 0 rpm")), "W050");
    EXPECT_EQ(told_codes(guarded_homing("INIT(Fast)")), "");
    EXPECT_EQ(told_codes(guarded_homing("MODE_REG := 0")), "");
}

/// Goes to a place and does something there, or where it was stopped on the way.
std::string at_place(const std::string& does, const std::string& halted = "INIT(Fast)") {
    return "PROGRAM P\nMOTOR MAC140;\nVAR_MOTOR Far AT P1 := 40 rev; Fast AT V1 := 600 rpm; END_VAR\n"
           "ON ERROR NEXT := Fault; ON NOT IN2 IN Go NEXT := Halt;\n"
           "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF R_TRIG(IN0) THEN NEXT := Go; END_IF END_STEP\n"
           "STEP Go: ENTRY POSITION(Far); IF INPOS WITHIN T#9s THEN NEXT := There; ELSE NEXT := Fault; "
           "END_IF END_STEP\n"
           "STEP There: IF R_TRIG(IN3) THEN " +
           does +
           " NEXT := Idle; END_IF END_STEP\n"
           "STEP Halt: ENTRY STOP; IF IN2 AND R_TRIG(IN4) THEN " +
           halted + "; NEXT := Idle; END_IF END_STEP\n" + kInitFault;
}

TEST(LastingMotion, AnotherTargetIsAMove) {
    for (const char* does : {"CLEAR_P_FNC;", "CLEAR_P_SOLL;", "CLEAR_P_IST; CLEAR_P_FNC;"})
        EXPECT_EQ(told_codes(at_place(does)), "W051") << does;
    for (const char* does :
         {"INIT(Fast); CLEAR_P_IST; CLEAR_P_FNC;", "CLEAR_P_SOLL; CLEAR_P_IST; CLEAR_P_FNC;", "INIT(Fast);"})
        EXPECT_EQ(told_codes(at_place(does)), "") << does;
    // P_FNC still counts from the old 0.
    EXPECT_EQ(told_codes(at_place("CLEAR_P_IST; CLEAR_P_SOLL;")), "W046 W051");
    EXPECT_EQ(told_codes(at_place("CLEAR_P_IST;")), "W046");
}

TEST(LastingMotion, ASpeedTakesUpAStoppedMove) {
    EXPECT_EQ(told_codes(at_place("INIT(Fast);", "V_SOLL := 600 rpm")), "W052");
    EXPECT_EQ(told_codes(at_place("INIT(Fast);", "INIT(Fast); V_SOLL := 600 rpm")), "");
}

// It stands at Far where There leads to Lift, and on its way where the guard does.
TEST(LastingMotion, AMoveThatIsNeededOnOneWayIsTakenOutOnNone) {
    const auto program = [](const std::string& guard) {
        return "PROGRAM P\nMOTOR MAC140;\n"
               "VAR_MOTOR Near AT P1 := 1 rev; Far AT P2 := 9 rev; Fast AT V1 := 600 rpm; END_VAR\n"
               "ON ERROR NEXT := Fault;" +
               guard +
               "\nPOWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
               "STEP Idle: IF R_TRIG(IN0) THEN NEXT := Go; END_IF END_STEP\n"
               "STEP Go: ENTRY POSITION(Near); IF INPOS WITHIN T#9s THEN NEXT := Onward; ELSE NEXT := Fault; "
               "END_IF END_STEP\n"
               "STEP Onward: ENTRY POSITION(Far); IF INPOS WITHIN T#9s THEN NEXT := There; ELSE NEXT := "
               "Fault; "
               "END_IF END_STEP\n"
               "STEP There: IF R_TRIG(IN3) THEN NEXT := Lift; END_IF END_STEP\n"
               "STEP Lift: ENTRY POSITION(Far); IF INPOS AND R_TRIG(IN4) THEN NEXT := Idle; END_IF "
               "END_STEP\n" +
               kInitFault;
    };
    EXPECT_EQ(told_codes(program("")), "W040");
    EXPECT_EQ(told_codes(program(" ON NOT IN2 IN Go NEXT := Lift;")).find("W040"), std::string::npos);
}

TEST(LastingMotion, ASelectionThatChangesTheModeStartsTowardsAnOldTarget) {
    const auto program = [](const std::string& first, const std::string& then) {
        return "PROGRAM P\nMOTOR MAC140;\n"
               "VAR_MOTOR Far AT P1 := 9 rev; Fast AT V1 := 600 rpm; Back AT V2 := -600 rpm; "
               "Soft AT A1 := 10000 rpm/s; END_VAR\n"
               "ON ERROR NEXT := Fault;\nPOWER_UP INIT(Fast, Soft); NEXT := Idle; END_POWER_UP\n"
               "STEP Idle: IF R_TRIG(IN0) THEN NEXT := Run; END_IF END_STEP\n"
               "STEP Run: ENTRY " +
               first + "; IF R_TRIG(IN2) THEN " + then +
               "; NEXT := Turned; END_IF END_STEP\n"
               "STEP Turned: IF R_TRIG(IN3) THEN INIT(Fast); NEXT := Idle; END_IF END_STEP\n" +
               kInitFault;
    };
    const auto is_refused = [&](const std::string& first, const std::string& then) {
        return told_codes(program(first, then)).find("E052") != std::string::npos;
    };
    EXPECT_TRUE(is_refused("VELOCITY(Fast)", "POSITION(Back)"));
    EXPECT_TRUE(is_refused("POSITION(Far)", "VELOCITY(Soft)"));
    EXPECT_FALSE(is_refused("VELOCITY(Fast)", "VELOCITY(Back)"));
    EXPECT_FALSE(is_refused("VELOCITY(Fast)", "POSITION(Far, Fast)"));
    EXPECT_FALSE(is_refused("POSITION(Far)", "POSITION(Fast)"));
}

/// What a step without a way out may declare.
TEST(Allowed, AStepThatIsNeverLeft) {
    const auto program = [](const std::string& says) {
        return "PROGRAM P\nMOTOR MAC140;\nVAR_MOTOR Far AT P1 := 4 rev; Fast AT V1 := 600 rpm; END_VAR\n"
               "ON ERROR NEXT := Fault;\nPOWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
               "STEP Idle: IF R_TRIG(IN0) THEN NEXT := Go; END_IF END_STEP\n"
               "STEP Go: OUT OUT0; ENTRY POSITION(Far); " +
               says + " END_STEP\n" + kInitFault;
    };
    EXPECT_EQ(told_codes(program("")), "W019");
    EXPECT_EQ(told_codes(program("ALLOW W019 BECAUSE 'one part a day, then the supply goes off';")), "");
}

}  // namespace
}  // namespace nplc::seqc
