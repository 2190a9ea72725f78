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

/// Goes to a place within a time. `late`: what the end of the time leads to, `steps` what may stand there.
std::string mover(const std::string& late, const std::string& in_fault, const std::string& steps = {},
                  const std::string& allows = {}) {
    return kHead +
           "VAR_MOTOR There AT P1 := 5 rev; Fast AT V1 := 600 rpm; END_VAR\n"
           "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF R_TRIG(Start) THEN NEXT := Go; END_IF END_STEP\n"
           "STEP Go: ENTRY POSITION(There); " +
           allows + "IF INPOS WITHIN T#3s THEN NEXT := Idle; ELSE " + late + " END_IF END_STEP\n" + steps +
           fault(in_fault);
}

TEST(Advice, ATimeLimitIsToStopTheMotor) {
    EXPECT_EQ(told(mover("NEXT := Fault;", "")), "W047");
    EXPECT_EQ(told(mover("NEXT := Fault;", "", "", "ALLOW W047 BECAUSE 'a slow belt'; ")), "");
    EXPECT_EQ(told(mover("STOP; NEXT := Fault;", "")), "");
    for (const char* order : {"STOP", "INIT(Fast)", "MODE_REG := 0", "V_SOLL := 0"})
        EXPECT_EQ(told(mover("NEXT := Fault;", std::string("ENTRY ") + order + "; ")), "") << order;
    const std::string halt =
        "STEP Halt: INIT(Fast); NEXT := Halted; END_STEP\n"
        "STEP Halted: OUT OUT0; IF R_TRIG(Ack) THEN NEXT := Idle; END_IF END_STEP\n";
    EXPECT_EQ(told(mover("NEXT := Halt;", "", halt)), "") << "a scan later";
}

TEST(Advice, TimerBesideInPosIsALimitToo) {
    const auto limited = [](const std::string& in_fault) {
        return kHead +
               "VAR_MOTOR There AT P1 := 5 rev; Fast AT V1 := 600 rpm; END_VAR\n"
               "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
               "STEP Idle: IF R_TRIG(Start) THEN NEXT := Go; END_IF END_STEP\n"
               "STEP Go: ENTRY POSITION(There); ENTRY TIMER := T#3s; IF INPOS AND NOT Start THEN NEXT := "
               "Idle; ELSIF TIMER.Q THEN NEXT := Fault; END_IF END_STEP\n" +
               fault(in_fault);
    };
    EXPECT_EQ(told(limited("")), "W047");
    EXPECT_EQ(told(limited("ENTRY STOP; ")), "");
}

TEST(Advice, AStepThatAwaitsTheMoveNeedsNoStop) {
    const std::string slow =
        "STEP Slow: OUT OUT0; IF INPOS WITHIN T#9s THEN NEXT := Idle; ELSE NEXT := Fault; END_IF END_STEP\n";
    EXPECT_EQ(told(mover("NEXT := Slow;", "ENTRY STOP; ", slow)), "");
    EXPECT_EQ(told(mover("NEXT := Slow;", "", slow)), "W047");
    const std::string holding =
        "STEP Hold: IF TIMER.Q THEN INIT(Fast); NEXT := Idle; END_IF END_STEP\n";  // it presses for a time
    EXPECT_EQ(told(mover("TIMER := T#1s; NEXT := Hold;", "ENTRY STOP; ", holding)), "");
}

/// A move that the timer alone ends; `entry` and `leaves`: of its step, `grip`: of the one behind.
std::string timed(const std::string& entry, const std::string& leaves, const std::string& grip) {
    return kHead +
           "VAR_MOTOR There AT P1 := 5 rev; Fast AT V1 := 600 rpm; END_VAR\n"
           "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF R_TRIG(Start) THEN COUNTER := 9; NEXT := Go; END_IF END_STEP\n"
           "STEP Go: " +
           entry + "ENTRY TIMER := T#3s; " + leaves + " END_STEP\nSTEP Grip: " + grip + " END_STEP\n" +
           fault("ENTRY STOP; ");
}

TEST(Advice, ATimeIsNoArrival) {
    const std::string move = "ENTRY POSITION(There); ";
    const std::string leaves = "IF TIMER.Q THEN NEXT := Grip; END_IF";
    const std::string clamp = "OUT OUT0; IF NOT Start THEN NEXT := Idle; END_IF";
    EXPECT_EQ(told(timed(move, leaves, clamp)), "W038");
    EXPECT_EQ(told(timed(move, "IF TIMER.Q THEN SET OUT0; NEXT := Grip; END_IF",
                         "IF NOT Start THEN RESET OUT0; NEXT := Idle; END_IF")),
              "W038 W043");  // the fault step does not reset it
    EXPECT_EQ(told(timed(move, "IF TIMER.Q THEN COUNT_DOWN; NEXT := Grip; END_IF",
                         "IF NOT Start AND COUNTER.Q THEN NEXT := Idle; END_IF")),
              "W038");
    EXPECT_EQ(told(timed("ALLOW W038 BECAUSE 'a soft stop'; " + move, leaves, clamp)), "");
}

TEST(Advice, ATimeThatIsNotTakenForAnArrival) {
    const std::string move = "ENTRY POSITION(There); ";
    const std::string leaves = "IF TIMER.Q THEN NEXT := Grip; END_IF";
    const std::string clamp = "OUT OUT0; IF NOT Start THEN NEXT := Idle; END_IF";
    EXPECT_EQ(told(timed("ENTRY VELOCITY(Fast); ", "IF TIMER.Q THEN STOP; NEXT := Grip; END_IF", clamp)),
              "W033")
        << "a run, without There";
    EXPECT_EQ(told(timed(move, leaves,
                         "OUT OUT0; IF INPOS WITHIN 3 s THEN NEXT := Idle; ELSE NEXT := Fault; "
                         "END_IF")),
              "")
        << "the next step asks";
    EXPECT_EQ(told(timed(move, "IF TIMER.Q AND Ack THEN NEXT := Grip; END_IF", clamp)), "") << "a sensor";
    EXPECT_EQ(told(timed(move, "IF Ack THEN NEXT := Grip; ELSIF TIMER.Q THEN NEXT := Fault; END_IF", clamp)),
              "")
        << "a sensor with a limit";
    EXPECT_EQ(told(timed(move, leaves, "IF NOT Start THEN NEXT := Idle; END_IF")), "") << "nothing acts";
    EXPECT_EQ(told(timed("OUT OUT0; " + move, leaves, clamp)), "") << "it was on before";
    EXPECT_EQ(told(timed(move, "IF TIMER.Q THEN INIT(Fast); NEXT := Grip; END_IF", clamp)), "")
        << "it pressed";
}

/// Runs while Start is on; `leaves`: what ends that.
std::string conveyor(const std::string& leaves, const std::string& steps = {}) {
    return kHead +
           "VAR_MOTOR Fast AT V1 := 600 rpm; END_VAR\n"
           "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF R_TRIG(Start) THEN NEXT := Run; END_IF END_STEP\n"
           "STEP Run: ENTRY VELOCITY(Fast); " +
           leaves + " END_STEP\n" + steps + fault("ENTRY STOP; ");
}

TEST(Advice, ARunIsToBeEnded) {
    EXPECT_EQ(told(conveyor("IF NOT Start THEN NEXT := Idle; END_IF")), "W048");
    EXPECT_EQ(
        told(conveyor("ALLOW W048 BECAUSE 'the belt never stops'; IF NOT Start THEN NEXT := Idle; END_IF")),
        "");
    for (const char* order : {"STOP", "INIT(Fast)", "V_SOLL := 0"})
        EXPECT_EQ(told(conveyor(std::string("IF NOT Start THEN ") + order + "; NEXT := Idle; END_IF")), "")
            << order;
}

TEST(Advice, AGearStandsWithItsMaster) {
    EXPECT_EQ(told(kHead +
                   "VAR_MOTOR Fast AT V1 := 600 rpm; END_VAR\n"
                   "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
                   "STEP Idle: IF R_TRIG(Start) THEN NEXT := Run; END_IF END_STEP\n"
                   "STEP Run: ENTRY MODE_REG := GP_MODE; IF NOT Start THEN NEXT := Idle; END_IF END_STEP\n" +
                   fault("ENTRY STOP; ")),
              "");
}

TEST(Advice, AStepInTheMiddleOfARunIsPartOfIt) {
    const std::string to_count =
        "IF Well THEN NEXT := Count; ELSIF NOT Start THEN STOP; NEXT := Idle; END_IF";
    EXPECT_EQ(
        told(conveyor(to_count, "STEP Count: OUT OUT0; IF NOT Well THEN NEXT := Run; END_IF END_STEP\n")),
        "");
    EXPECT_EQ(told(conveyor("IF Well THEN NEXT := Eject; END_IF",
                            "STEP Eject: OUT OUT0; IF NOT Well THEN STOP; NEXT := Idle; END_IF END_STEP\n")),
              "");
    EXPECT_EQ(told(conveyor("IF Well THEN NEXT := Eject; END_IF",
                            "STEP Eject: OUT OUT0; IF NOT Well THEN NEXT := Idle; END_IF END_STEP\n")),
              "W048");
    EXPECT_EQ(told(conveyor("IF Well THEN NEXT := Creep; END_IF",
                            "STEP Creep: ENTRY V_SOLL := 60 rpm; IF NOT Well THEN STOP; NEXT := Idle; END_IF "
                            "END_STEP\n")),
              "");
}

TEST(Advice, AnErrorIsToBeAcknowledged) {
    const auto resets = [](const std::string& leaves, const std::string& steps = {}) {
        return kHead +
               "ON NOT Well NEXT := Fault;\n"
               "VAR_MOTOR There AT P1 := 5 rev; Fast AT V1 := 600 rpm; END_VAR\n"
               "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
               "STEP Idle: IF R_TRIG(Start) AND NOT Ack THEN NEXT := Go; END_IF END_STEP\n"
               "STEP Go: ENTRY POSITION(There); IF INPOS THEN NEXT := Idle; END_IF END_STEP\n"
               "STEP Fault: OWN ERROR; ENTRY STOP; " +
               leaves + " END_STEP\n" + steps + "END_PROGRAM\n";
    };
    const auto with = [&](const std::string& asks) {
        return resets("IF ANY ERROR" + asks + " THEN RESET_ERROR; NEXT := POWER_UP; END_IF");
    };
    EXPECT_EQ(told(with("")), "W049");
    EXPECT_EQ(told(with(" AND Well")), "W049") << "no person: the guard is over";
    EXPECT_EQ(told(resets("ENTRY TIMER := T#2s; IF ANY ERROR AND TIMER.Q AND Well THEN RESET_ERROR; NEXT := "
                          "POWER_UP; END_IF")),
              "W049");
    EXPECT_EQ(
        told(resets("ALLOW W049 BECAUSE 'the host counts them'; IF ANY ERROR AND Well THEN RESET_ERROR; "
                    "NEXT := POWER_UP; END_IF")),
        "");
    for (const char* asks : {" AND Ack", " AND R_TRIG(Ack)", " AND Well AND F_TRIG(Ack)", " AND NOT Start"})
        EXPECT_EQ(told(with(asks)), "") << asks;
    EXPECT_EQ(told(resets("IF ANY ERROR AND R_TRIG(Ack) THEN NEXT := Clear; END_IF",
                          "STEP Clear: OWN ERROR; IF ANY ERROR THEN RESET_ERROR; NEXT := POWER_UP; END_IF "
                          "END_STEP\n")),
              "")
        << "asked on the way";
}

}  // namespace
}  // namespace nplc::seqc
