#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

/// A machine that goes to a place while Start is on, with what leaves its fault step, and a step behind that.
std::string restarting(const std::string& leaves, const std::string& cleared = {},
                       const std::string& start = "Start AND NOT Guard") {
    return "PROGRAM P MOTOR MAC140;\n"
           "VAR_INPUT Start AT IN0 : BOOL; Guard AT IN1 : BOOL; Ack AT IN2 : BOOL; Auto AT IN3 : BOOL; "
           "END_VAR\n"
           "VAR_MOTOR Far AT P1 := 8 rev; Fast AT V1 := 600 rpm; END_VAR\n"
           "ON ERROR NEXT := Fault; ON Guard IN Go NEXT := Fault; ON NOT Auto AND Ack IN Go NEXT := Fault;\n"
           "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF " +
           start +
           " THEN NEXT := Go; END_IF END_STEP\n"
           "STEP Go: ENTRY POSITION(Far); IF INPOS AND NOT Start THEN NEXT := Idle; END_IF END_STEP\n"
           "STEP Fault: OWN ERROR; ENTRY STOP; " +
           leaves + " END_STEP\n" + cleared + "END_PROGRAM\n";
}
std::string codes(const std::string& source) {
    return test::codes(compile(source));
}
/// The branch that leaves the fault step, with this beside ANY ERROR.
std::string with(const std::string& asks, const std::string& next = "POWER_UP") {
    return "IF ANY ERROR" + asks + " THEN RESET_ERROR; NEXT := " + next + "; END_IF";
}

// Any input may stand on or off for as long as one likes: with Start on, Guard off and Ack on each of these
// goes on by itself.
TEST(Restart, NoInputHasToChange) {
    for (const char* asks :
         {"", " AND NOT Guard", " AND Ack", " AND Ack AND NOT Guard", " AND (Ack OR Auto)", " AND Auto"})
        EXPECT_EQ(codes(restarting(with(asks))), "W037") << asks;
    EXPECT_EQ(codes(restarting("IF ANY ERROR AND Ack FOR 2 s THEN RESET_ERROR; NEXT := POWER_UP; END_IF")),
              "W037");
    EXPECT_EQ(codes(restarting("OUT OUT0 BLINKING T#200ms; " + with(" AND Ack"))), "W037");
    EXPECT_EQ(codes(restarting("RESET_ERROR; NEXT := POWER_UP;")), "W037 W021");
}

/// One that is asked nowhere else is a button for that.
TEST(Restart, AnInputThatIsAskedNowhereElseAcknowledges) {
    EXPECT_EQ(codes(restarting(with(" AND IN4"))), "");
    EXPECT_EQ(codes(restarting(with(" AND IN4 AND NOT Guard"))), "");
    for (const char* asks : {" AND NOT IN4", " AND (IN4 OR Auto)"})
        EXPECT_EQ(codes(restarting(with(asks))), "W037") << asks;
}

TEST(Restart, AnEdgeIsAChange) {
    for (const char* asks : {" AND R_TRIG(Ack)", " AND F_TRIG(Ack)", " AND R_TRIG(Ack) AND NOT Guard"})
        EXPECT_EQ(codes(restarting(with(asks))), "") << asks;
    EXPECT_EQ(codes(restarting("OUT OUT0 BLINKING T#200ms; " + with(" AND R_TRIG(Ack)"))), "");
    EXPECT_EQ(codes(restarting(with(" AND Ack"), {}, "R_TRIG(Start) AND NOT Guard")), "");
}

TEST(Restart, SoIsAStepThatWaitsForTheOtherLevel) {
    const auto cleared = [](const std::string& waits) {
        return "STEP Cleared: OUT OUT1; IF " + waits + " THEN NEXT := POWER_UP; END_IF END_STEP\n";
    };
    EXPECT_EQ(codes(restarting(with(" AND Ack", "Cleared"), cleared("NOT Ack"))), "");
    EXPECT_EQ(codes(restarting(with(" AND Ack", "Cleared"), cleared("NOT Guard"))), "W037");
    EXPECT_EQ(codes(restarting(with(" AND Ack", "Cleared"), cleared("NOT Ack OR Auto"))), "W037");
    EXPECT_EQ(codes(restarting(with(" AND Ack AND NOT Start"))), "");  // Idle waits for Start
}

}  // namespace
}  // namespace nplc::seqc
