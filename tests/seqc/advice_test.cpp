// Advice: guards that stop nothing, outputs left on, restarts, old targets; and where none is due.
#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

const std::string kHead =
    "PROGRAM P\nMOTOR MAC140;\n"
    "VAR_INPUT Well AT IN0 : BOOL; Start AT IN1 : BOOL; Ack AT IN2 : BOOL; END_VAR\n"
    "ON ERROR NEXT := Fault;\n";

std::string fault(const std::string& does, const std::string& next = "POWER_UP") {
    return "STEP Fault: OWN ERROR; " + does +
           "IF ANY ERROR AND Well AND R_TRIG(Ack) THEN RESET_ERROR; NEXT := " + next +
           "; END_IF END_STEP\nEND_PROGRAM\n";
}

std::string told(const std::string& source) {
    return test::codes(compile(source));
}

/// Runs at a speed until Start goes off, with a guard.
std::string runner(const std::string& guard, const std::string& steps, const std::string& in_fault) {
    return kHead + guard +
           "VAR_MOTOR Fast AT V1 := 600 rpm; END_VAR\nPOWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF Start THEN NEXT := Run; END_IF END_STEP\n"
           "STEP Run: ENTRY VELOCITY(Fast); IF NOT Start THEN STOP; NEXT := Idle; END_IF END_STEP\n" +
           steps + "STEP Fault: OWN ERROR; " + in_fault +
           "IF ANY ERROR AND R_TRIG(Ack) AND NOT Start THEN RESET_ERROR; NEXT := POWER_UP; END_IF END_STEP\n"
           "END_PROGRAM\n";
}

TEST(Advice, AGuardIsToStopTheMotor) {
    const std::string guard = "ON NOT Well NEXT := Fault;\n";
    EXPECT_EQ(told(runner(guard, "", "")), "W042");
    EXPECT_EQ(told(runner("ON NOT Well IN Idle NEXT := Fault;\n", "", "")), "") << "an ERROR stops by itself";
    EXPECT_EQ(told(runner(guard, "", "ALLOW W042 BECAUSE 'the relay cuts the supply'; ")), "");
    for (const char* order : {"STOP", "INIT(Fast)", "MODE_REG := 0", "V_SOLL := 0"})
        EXPECT_EQ(told(runner(guard, "", std::string("ENTRY ") + order + "; ")), "") << order;
}

TEST(Advice, AStopInTheScanAfterIsOneToo) {
    const std::string guard = "ON NOT Well IN Run NEXT := Halt;\n";
    const std::string waits =
        "STEP Halted: IF R_TRIG(Ack) AND Well THEN INIT(Fast); NEXT := Idle; END_IF END_STEP\n";
    EXPECT_EQ(told(runner(guard, "STEP Halt: STOP; NEXT := Halted; END_STEP\n" + waits, "ENTRY STOP; ")), "");
    EXPECT_EQ(told(runner(guard, "STEP Halt: OUT OUT0; NEXT := Halted; END_STEP\n" + waits, "ENTRY STOP; ")),
              "W042");
}

TEST(Advice, AStepThatMovesElsewhereNeedsNoStop) {
    EXPECT_EQ(
        told(kHead +
             "ON Well IN Run NEXT := Back;\nVAR_MOTOR Home AT P1 := 0 rev; Fast AT V1 := 600 rpm; END_VAR\n"
             "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
             "STEP Idle: IF R_TRIG(Start) THEN NEXT := Run; END_IF END_STEP\n"
             "STEP Run: ENTRY VELOCITY(Fast); IF NOT Start THEN NEXT := Back; END_IF END_STEP\n"
             "STEP Back: ENTRY POSITION(Home); IF INPOS WITHIN T#60s THEN NEXT := Idle; ELSE NEXT := Fault; "
             "END_IF END_STEP\n" +
             fault("ENTRY STOP; ")),
        "");
}

/// A valve that SET opens.
std::string valve(const std::string& idle, const std::string& resets) {
    return "PROGRAM P\nMOTOR MAC140;\nVAR_INPUT Start AT IN0 : BOOL; Ack AT IN2 : BOOL; END_VAR\n"
           "VAR_OUTPUT Gas AT OUT0 : BOOL; END_VAR\nON ERROR NEXT := Fault;\n"
           "STEP Idle: " +
           idle +
           "IF R_TRIG(Start) THEN SET Gas; TIMER := T#2s; NEXT := Run; END_IF END_STEP\n"
           "STEP Run: IF TIMER.Q THEN RESET Gas; NEXT := Idle; END_IF END_STEP\n"
           "STEP Fault: OWN ERROR; IF ANY ERROR AND R_TRIG(Ack) THEN RESET_ERROR; " +
           resets + "NEXT := Idle; END_IF END_STEP\nEND_PROGRAM\n";
}

TEST(Advice, AnOutputIsToBeResetBehindAnError) {
    EXPECT_EQ(told(valve("", "")), "W043");
    EXPECT_EQ(told(valve("", "RESET Gas; ")), "");
    EXPECT_EQ(told(valve("ENTRY RESET Gas; ", "")), "");
    EXPECT_EQ(told(valve("ALLOW W043 BECAUSE 'the clamp holds the part'; ", "")), "");
}

TEST(Advice, AGuardThatIsOverIsAcknowledged) {
    const auto halting = [](const std::string& asks) {
        return runner("ON NOT Well IN Run NEXT := Halt;\n",
                      "STEP Halt: ENTRY STOP; IF Well" + asks + " THEN NEXT := Idle; END_IF END_STEP\n",
                      "ENTRY STOP; ");
    };
    EXPECT_EQ(told(halting("")), "W037");
    EXPECT_EQ(told(halting(" AND R_TRIG(Ack)")), "");
    EXPECT_EQ(told(halting(" AND NOT Start")), "");
}

TEST(Advice, AWayBackThatTheGuardOrdersIsNoRestart) {
    EXPECT_EQ(
        told(kHead +
             "ON Well IN Run NEXT := Wait;\nVAR_MOTOR Back AT P1 := 0 rev; Fast AT V1 := 600 rpm; END_VAR\n"
             "STEP Idle: IF R_TRIG(Start) THEN NEXT := Run; END_IF END_STEP\n"
             "STEP Run: ENTRY VELOCITY(Fast); IF NOT Start THEN NEXT := Wait; END_IF END_STEP\n"
             "STEP Wait: ENTRY INIT(Fast); ENTRY TIMER := T#500ms; IF TIMER.Q THEN NEXT := Retreat; END_IF "
             "END_STEP\n"
             "STEP Retreat: ENTRY POSITION(Back); IF INPOS WITHIN T#60s THEN NEXT := Idle; ELSE NEXT := "
             "Fault; "
             "END_IF END_STEP\n" +
             fault("ENTRY STOP; ")),
        "");
}

TEST(Advice, MotionAtPowerUp) {
    const auto fan = [](const std::string& power_up, const std::string& more) {
        return kHead + "VAR_MOTOR Fast AT V1 := 600 rpm; END_VAR\nPOWER_UP " + power_up +
               "NEXT := Blow; END_POWER_UP\nSTEP Blow: OUT OUT0; IF NOT Start THEN NEXT := Rest; END_IF "
               "END_STEP\n"
               "STEP Rest: ENTRY STOP; IF R_TRIG(Start) THEN " +
               more + "NEXT := Blow; END_IF END_STEP\n" + fault("ENTRY STOP; ");
    };
    EXPECT_EQ(told(fan("VELOCITY(Fast); ", "")), "W044");
    EXPECT_EQ(told(fan("ALLOW W044 BECAUSE 'a fan'; VELOCITY(Fast); ", "")), "");
    EXPECT_EQ(told(fan("INIT(Fast); ", "VELOCITY(Fast); ")), "");
}

/// Searches a mark at a speed, and indexes from there.
std::string winder(const std::string& stands) {
    return kHead +
           "VAR_MOTOR Pitch AT P1 := 1 rev; Slow AT V1 := 60 rpm; Fast AT V2 := 600 rpm; END_VAR\n"
           "POWER_UP INIT(Slow); POSITIONS_RELATIVE_P_SOLL; NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF R_TRIG(Start) THEN NEXT := Search; END_IF END_STEP\n"
           "STEP Search: ENTRY VELOCITY(Slow); IF Well THEN STOP; TIMER := T#500ms; NEXT := Stand; END_IF "
           "END_STEP\n"
           "STEP Stand: IF TIMER.Q THEN INIT(Fast); " +
           stands +
           "NEXT := Ready; END_IF END_STEP\n"
           "STEP Ready: IF R_TRIG(Start) THEN NEXT := Index; END_IF END_STEP\n"
           "STEP Index: ENTRY POSITION(Pitch); IF INPOS WITHIN T#3s THEN NEXT := Ready; ELSE NEXT := Fault; "
           "END_IF "
           "END_STEP\n" +
           fault("ENTRY STOP; ");
}

TEST(Advice, ARelativeMoveBehindARun) {
    EXPECT_EQ(told(winder("")), "W046");
    EXPECT_EQ(told(winder("CLEAR_P_SOLL; ")), "W046");
    EXPECT_EQ(told(winder("CLEAR_P_IST; CLEAR_P_FNC; CLEAR_P_SOLL; ")), "");
    EXPECT_EQ(told(winder("CLEAR_P_FNC; CLEAR_P_SOLL; ")), "");
}

TEST(Advice, AStepThatIsNeverLeftCanBeMeant) {
    const auto one_part = [](const std::string& allows) {
        return kHead +
               "VAR_MOTOR Place AT P1 := 5 rev; Fast AT V1 := 500 rpm; END_VAR\n"
               "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
               "STEP Idle: IF Start THEN NEXT := Go; END_IF END_STEP\n"
               "STEP Go: OUT OUT0; ENTRY POSITION(Place); " +
               allows + "END_STEP\n" + fault("");
    };
    EXPECT_EQ(told(one_part("")), "W019");
    EXPECT_EQ(told(one_part("ALLOW W019 BECAUSE 'one part a day: the supply goes off'; ")), "");
}

}  // namespace
}  // namespace nplc::seqc
