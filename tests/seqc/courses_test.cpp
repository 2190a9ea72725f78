#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/checks.h"
#include "cli_support.h"
#include "diagnostics/codes.h"
#include "diagnostics/explanations.h"

namespace nplc::seqc {
namespace {

using Json = nlohmann::json;

class Courses : public test::Cli {
  protected:
    /// The codes that `seqc verify` finds in a program, and its exit code.
    std::set<std::string> found_in(std::string_view program) {
        write("p.seq", whole_program(program));
        exit_code_ = run("verify --json p.seq");
        std::set<std::string> codes;
        for (const Json& result : results()) {
            if (result["verdict"] != "proved") codes.insert(result["code"]);
        }
        return codes;
    }

    /// Of what `seqc verify --json` has printed.
    Json results() const { return Json::parse(read("out"))["results"]; }

    int exit_code_ = 0;
};

TEST_F(Courses, EachCheckHasItsCodeAndSeverity) {
    std::size_t count = 0;
    for (const CodeRow& row : kCodes) count += row.phase == Phase::courses ? 1 : 0;
    EXPECT_EQ(count, verify::checks().size());
    for (const verify::Check& check : verify::checks()) {
        const CodeRow* row = find_code(check.code);
        ASSERT_NE(row, nullptr) << check.code;
        EXPECT_EQ(row->severity == Severity::error, check.severity == verify::Severity::fault) << check.code;
    }
}

TEST_F(Courses, WrongProgramsGiveTheirCodeAndRightOnesNothing) {
    for (const Explanation& info : explanations()) {
        const CodeRow* row = find_code(info.code);
        if (row->phase != Phase::courses) continue;
        EXPECT_EQ(found_in(info.wrong), std::set<std::string>{std::string(info.code)});
        EXPECT_EQ(exit_code_, row->severity == Severity::error ? 1 : 0) << info.code;
        EXPECT_EQ(found_in(info.right), std::set<std::string>{}) << info.code;
        EXPECT_EQ(exit_code_, 0) << info.code;
    }
}

TEST_F(Courses, AForgottenPresetIsFoundBehindATimer) {
    // Cool waits for the timer that Seal has used up.
    EXPECT_EQ(found_in("PROGRAM P\nMOTOR MAC140;\nON ERROR NEXT := Fault;\n"
                       "STEP Idle: IF IN0 THEN NEXT := Seal; END_IF END_STEP\n"
                       "STEP Seal: OUT OUT0; ENTRY TIMER := T#1500ms; IF TIMER.Q THEN NEXT := Cool; END_IF "
                       "END_STEP\n"
                       "STEP Cool: OUT OUT1; IF TIMER.Q THEN NEXT := Idle; END_IF END_STEP\n"
                       "STEP Fault: OWN ERROR; OUT OUT3; ENTRY STOP; IF ANY ERROR AND IN1 THEN RESET_ERROR; "
                       "NEXT := POWER_UP; END_IF END_STEP\nEND_PROGRAM\n"),
              std::set<std::string>{"V007"});
    for (const Json& result : results()) {
        EXPECT_NE(result["verdict"], "undecided");
        if (result.value("code", "") != "V007") continue;
        unsigned ms = 0;
        for (const Json& scan : result["course"])
            ms += scan.value("times", 1U) * scan["dt_ms"].get<unsigned>();
        EXPECT_GE(ms, 1500U);
    }
    EXPECT_EQ(run("verify p.seq"), 0);
    EXPECT_NE(read("out").find("Seal -> Cool"), std::string::npos) << read("out");
    EXPECT_NE(read("out").find("here V007 shows"), std::string::npos) << read("out");
}

/// A lamp that shows the counter in a step that ends with the condition; Idle sets the counter.
std::string with_a_lamp(const std::string& end) {
    return "PROGRAM P\nMOTOR MAC140;\nON ERROR NEXT := Fault;\n"
           "STEP Idle: ENTRY COUNTER := 2; IF IN0 THEN NEXT := Work; END_IF END_STEP\n"
           "STEP Work: OUT OUT0 WHEN COUNTER.Q; IF " +
           end +
           " THEN COUNT_DOWN; NEXT := Rest; END_IF END_STEP\n"
           "STEP Rest: IF IN2 THEN NEXT := Work; END_IF END_STEP\n"
           "STEP Fault: OWN ERROR; IF ANY ERROR AND R_TRIG(IN3) THEN RESET_ERROR; NEXT := Idle; END_IF "
           "END_STEP\nEND_PROGRAM\n";
}

TEST_F(Courses, ACopyOfAStepIsNotAnotherStepThatTheCounterLedTo) {
    for (const char* end :
         {"R_TRIG(IN1)", "F_TRIG(IN1)", "R_TRIG(IN1) OR R_TRIG(IN4)", "IN1 AND NOT IN4 FOR T#50ms"})
        EXPECT_EQ(found_in(with_a_lamp(end)), std::set<std::string>{}) << end;
}

TEST_F(Courses, ACounterUsedUpByAnotherStepIsFoundBehindCopies) {
    EXPECT_EQ(found_in("PROGRAM P\nMOTOR MAC140;\nON ERROR NEXT := Fault;\n"
                       "STEP Idle: ENTRY COUNTER := 2; IF IN0 THEN NEXT := Work; END_IF END_STEP\n"
                       "STEP Work: IF COUNTER.Q THEN NEXT := Rest; ELSIF R_TRIG(IN1) THEN EVERY_SCAN "
                       "COUNT_DOWN; END_IF END_STEP\n"
                       "STEP Rest: IF COUNTER.Q AND R_TRIG(IN2) THEN NEXT := Work; END_IF END_STEP\n"
                       "STEP Fault: OWN ERROR; IF ANY ERROR AND R_TRIG(IN3) THEN RESET_ERROR; NEXT := Idle; "
                       "END_IF END_STEP\nEND_PROGRAM\n")
                  .count("V007"),
              1U);
}

/// A move into Go, whose rest is given; Back awaits the end of its own move.
std::string with_a_move(const std::string& rest) {
    return "PROGRAM P\nMOTOR MAC140;\nVAR_MOTOR A AT P1 := 0 rev; B AT P2 := 5 rev; Fast AT V1 := 300 rpm; "
           "Soft AT A1 := 10000 rpm/s; END_VAR\nON ERROR NEXT := Fault;\n"
           "POWER_UP INIT(Fast, Soft); NEXT := Idle; END_POWER_UP\n"
           "STEP Idle: IF R_TRIG(IN0) THEN NEXT := Go; END_IF END_STEP\n"
           "STEP Go: ENTRY POSITION(B); " +
           rest +
           " END_STEP\nSTEP Back: ENTRY POSITION(A); IF INPOS WITHIN T#4s THEN NEXT := Idle; ELSE NEXT := "
           "Fault; END_IF END_STEP\n"
           "STEP Fault: OWN ERROR; ENTRY STOP; IF ANY ERROR AND R_TRIG(IN2) THEN RESET_ERROR; NEXT := "
           "POWER_UP; END_IF END_STEP\nEND_PROGRAM\n";
}

TEST_F(Courses, ATimerThatOnlyLimitsAStepAwaitsNoEndOfAMove) {
    for (const char* rest :
         {"IF NOT IN1 THEN NEXT := Back; END_IF",
          "IF NOT IN1 WITHIN T#2s THEN NEXT := Back; ELSE NEXT := Fault; END_IF",
          "IF R_TRIG(IN1) WITHIN T#2s THEN NEXT := Back; ELSE NEXT := Fault; END_IF",
          "OUT OUT0 BLINKING T#500ms; IF NOT IN1 THEN NEXT := Back; END_IF",
          "OUT OUT0 BLINKING T#500ms; IF NOT IN1 WITHIN T#2s THEN NEXT := Back; ELSE NEXT := Fault; END_IF"})
        EXPECT_EQ(found_in(with_a_move(rest)), std::set<std::string>{"V009"}) << rest;
    for (const char* rest :
         {"ENTRY TIMER := T#2s; IF TIMER.Q THEN NEXT := Back; END_IF",
          "IF INPOS WITHIN T#2s THEN NEXT := Back; ELSE NEXT := Fault; END_IF",
          "OUT OUT0 BLINKING T#500ms; IF INPOS WITHIN T#2s THEN NEXT := Back; ELSE NEXT := Fault; END_IF"})
        EXPECT_EQ(found_in(with_a_move(rest)), std::set<std::string>{}) << rest;
}

TEST_F(Courses, ATableWithItsSymbolsIsJudgedAsItsProgram) {
    write("p.seq", with_a_move("IF NOT IN1 WITHIN T#2s THEN NEXT := Back; ELSE NEXT := Fault; END_IF"));
    ASSERT_EQ(run("verify p.seq"), 0);
    const std::string finding =
        ": a move is ordered on the way into step Go, and no step after it looks at INPOS";
    ASSERT_NE(read("out").find("advice V009" + finding), std::string::npos) << read("out");
    ASSERT_EQ(run("build p.seq -o p.bin"), 0);
    ASSERT_EQ(run("verify p.bin"), 0);
    EXPECT_NE(read("out").find("advice V009" + finding), std::string::npos) << read("out");
}

TEST_F(Courses, AProofOfNothingIsToldInWordsAndInJson) {
    write("p.seq",
          "PROGRAM P\nMOTOR MAC140;\n"
          "STEP A: OWN ERROR; OUT OUT0; IF IN0 THEN NEXT := B; END_IF END_STEP\n"
          "STEP B: OWN ERROR; OUT OUT1; IF NOT IN0 THEN NEXT := A; END_IF END_STEP\n"
          "PROPERTY Nothing: WHENEVER OUT0 AND OUT1 THEN IN0;\n"
          "PROPERTY Something: NEVER OUT0 AND OUT1;\nEND_PROGRAM\n");
    run("verify p.seq");
    EXPECT_NE(read("out").find("but it says nothing: OUT0 AND OUT1 never holds"), std::string::npos);
    run("verify --json p.seq");
    for (const Json& result : results()) {
        EXPECT_EQ(result.value("vacuous", false), result["name"] == "Nothing") << result["name"];
    }
}

TEST_F(Courses, AWayThroughErrorAloneIsToldInWordsAndInJson) {
    write("p.seq",
          "PROGRAM P\nMOTOR MAC140;\nON ERROR NEXT := Fault;\n"
          "STEP Idle: IF IN0 THEN NEXT := Done; END_IF END_STEP\n"
          "STEP Done: OUT OUT0; ALLOW W019 BECAUSE 'a test'; END_STEP\n"
          "STEP Fault: OWN ERROR; OUT OUT1; IF ANY ERROR AND IN1 THEN RESET_ERROR; NEXT := Idle; END_IF "
          "END_STEP\n"
          "PROPERTY Ready_Again: ALWAYS POSSIBLE STEP = Idle;\n"
          "PROPERTY Restarts: AFTER OUT1 ALWAYS POSSIBLE OUT0;\nEND_PROGRAM\n");
    run("verify p.seq");
    EXPECT_NE(read("out").find(
                  "proved    Ready_Again: ALWAYS POSSIBLE STEP = Idle\n  but only by way of ERROR: from "
                  "step Done nothing leads there unless the motor gets one\n"),
              std::string::npos)
        << read("out");
    run("verify --json --junit p.xml p.seq");
    for (const Json& result : results())
        EXPECT_EQ(result.value("only_by_error", false), result["name"] == "Ready_Again") << result["name"];
    EXPECT_NE(read("p.xml").find("<system-out>but only by way of ERROR"), std::string::npos);
}

// With 1 part no way leads to a second one; each count is a state of its own, too many to be kept.
TEST_F(Courses, AWideRangeOfCountsHidesNothingThatAFewPartsBreak) {
    write("p.seq",
          "PROGRAM P\nMOTOR MAC140;\nSET_POINT Parts := 1 RANGE 1 .. 9999;\nON ERROR NEXT := Fault;\n"
          "STEP Idle: TAKES SET_POINTS; IF IN0 THEN COUNTER := Parts; NEXT := First; END_IF END_STEP\n"
          "STEP First: IF COUNTER.Q THEN NEXT := Second; ELSIF IN1 THEN COUNT_DOWN; NEXT := Gap; END_IF "
          "END_STEP\n"
          "STEP Gap: IF NOT IN1 THEN NEXT := First; END_IF END_STEP\n"
          "STEP Second: IF IN0 THEN COUNTER := Parts; NEXT := Box; END_IF END_STEP\n"
          "STEP Box: IF IN1 THEN COUNT_DOWN; NEXT := Full; END_IF END_STEP\n"
          "STEP Full: IF COUNTER.Q THEN NEXT := Idle; ELSIF NOT IN1 THEN NEXT := More; END_IF END_STEP\n"
          "STEP More: OUT OUT0; IF IN1 THEN COUNT_DOWN; NEXT := Full; END_IF END_STEP\n"
          "STEP Fault: OWN ERROR; IF ANY ERROR AND IN2 THEN RESET_ERROR; NEXT := Idle; END_IF END_STEP\n"
          "PROPERTY Kept: NEVER STEP = More AND COUNTER.Q;\nPROPERTY Single: NEVER OUT0;\n"
          "PROPERTY Lit: NEVER OUT1;\nPROPERTY Second: OUT0 IS REACHABLE;\nEND_PROGRAM\n");
    EXPECT_EQ(run("verify --json p.seq"), 1);
    std::map<std::string, std::string> verdicts;
    std::vector<std::string> order;
    for (const Json& result : results()) {
        if (result.contains("code")) continue;
        order.push_back(result["name"]);
        verdicts[order.back()] = result["verdict"];
        if (order.back() == "Single" || order.back() == "Second") {
            const char* count = order.back() == "Single" ? "with Parts = 2" : "with Parts = 1";
            EXPECT_NE(std::string(result["reason"]).find(count), std::string::npos) << result["reason"];
        }
    }
    EXPECT_EQ(verdicts["Single"], "broken");
    EXPECT_NE(verdicts["Kept"], "broken");
    EXPECT_NE(verdicts["Lit"], "broken");
    EXPECT_EQ(order, (std::vector<std::string>{"Kept", "Single", "Lit", "Second"}));
}

TEST_F(Courses, JsonHasTheOrdersOfACourse) {
    write("p.seq",
          "PROGRAM P\nMOTOR MAC140;\n"
          "VAR_MOTOR Near AT P1 := 2 rev; Fast AT V1 := 100 rpm; END_VAR\n"
          "POWER_UP INIT(Fast); NEXT := A; END_POWER_UP\n"
          "STEP A: OWN ERROR; IF IN0 THEN POSITION(Near); COUNTER := 3; NEXT := B; END_IF END_STEP\n"
          "STEP B: OWN ERROR; OUT OUT1; IF NOT IN0 THEN NEXT := A; END_IF END_STEP\n"
          "PROPERTY Dark: NEVER OUT1;\nEND_PROGRAM\n");
    run("verify --json p.seq");
    for (const Json& result : results()) {
        if (result["name"] != "Dark") continue;
        const Json& course = result["course"];
        EXPECT_EQ(course.front()["orders"], (Json{"Near := 2 rev", "Fast := 100 rpm", "INIT(Fast)"}));
        EXPECT_EQ(course.back()["orders"], Json{"POSITION(Near)"});
        EXPECT_EQ(course.back()["counter"], 3);
        return;
    }
    FAIL() << read("out");
}

TEST_F(Courses, AnAllowedFaultIsToldWithItsReasonAndIsNoFault) {
    const std::string program =
        "PROGRAM P\nMOTOR MAC140;\nON ERROR NEXT := Fault;\n"
        "STEP S: IF IN0 THEN NEXT := T; END_IF END_STEP\n"
        "STEP T: IF IN1 THEN NEXT := S; END_IF END_STEP\n"
        "STEP Fault: ALLOW V004 BECAUSE 'a relay takes the supply away'; OWN ERROR; END_STEP\n"
        "END_PROGRAM\n";
    write("p.seq", program);
    EXPECT_EQ(run("verify p.seq"), 0);
    EXPECT_NE(read("out").find("p.seq:6:6: allowed V004: "), std::string::npos) << read("out");
    EXPECT_NE(read("out").find("  because a relay takes the supply away\n"), std::string::npos);
    ASSERT_EQ(run("verify --json p.seq"), 0);
    const Json document = Json::parse(read("out"));
    for (const Json& result : document["results"]) {
        if (result["code"] == "V004") {
            EXPECT_EQ(result["allowed"], "a relay takes the supply away");
            EXPECT_EQ(result["severity"], "advice");
        }
    }
}

const char* const kProgram =
    "PROGRAM P\nMOTOR MAC140;\nON ERROR NEXT := Fault;\nVAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR\n"
    "STEP S: OUT Lamp; IF IN0 THEN NEXT := T; END_IF END_STEP\n"
    "STEP T: IF NOT IN0 THEN NEXT := S; END_IF END_STEP\n"
    "STEP Fault: OWN ERROR; IF ANY ERROR AND IN5 THEN RESET_ERROR; NEXT := S; END_IF END_STEP\n"
    "ASSUME NEVER IN0 AND IN5;\n"
    "PROPERTY Lit: Lamp CHANGES ONLY IN step = S OR step = POWER_UP;\n"
    "PROPERTY Wrong: BETWEEN step = S AND step = Fault Lamp STAYS ON;\nEND_PROGRAM\n";

TEST_F(Courses, AssumptionsStandWithTheVerdicts) {
    write("p.seq", kProgram);
    EXPECT_EQ(run("verify p.seq"), 1);
    EXPECT_NE(read("out").find("; ASSUME NEVER IN0 AND IN5\n"), std::string::npos) << read("out");
    EXPECT_EQ(run("verify --json p.seq"), 1);
    EXPECT_EQ(Json::parse(read("out"))["assumptions"], Json::array({"ASSUME NEVER IN0 AND IN5"}));
}

TEST_F(Courses, AssumptionsThatAllowNoInputsAreRefused) {
    write("p.seq", kProgram);
    write("p.prop", "ASSUME NEVER IN0; ASSUME NEVER NOT IN0;");
    EXPECT_EQ(run("verify p.seq --property p.prop"), 2);
    EXPECT_EQ(read("out"), "");
    EXPECT_NE(read("err").find("p.seq: the assumptions allow no inputs at all"), std::string::npos)
        << read("err");
}

TEST_F(Courses, JUnitHasATestForEachPropertyAndCheck) {
    write("p.seq", kProgram);
    EXPECT_EQ(run("verify --junit p.xml p.seq"), 1);
    const std::string xml = read("p.xml");
    // 15 checks and 2 properties, one of them broken.
    EXPECT_NE(xml.find("<testsuites tests=\"17\" failures=\"1\" errors=\"0\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("name=\"Wrong: BETWEEN step = S AND step = Fault Lamp STAYS ON\" file=\"p.seq\">\n"
                       "      <failure message=\"at the end of this course its condition has not stayed as "
                       "required\" type=\"broken\">"),
              std::string::npos)
        << xml;
}

TEST_F(Courses, WhatIsReadIsNeverWrittenOver) {
    write("p.seq", kProgram);
    write("w.prop", "PROPERTY Also: NEVER step = S;");
    for (const char* options :
         {"--scenario p.seq", "--stimulus ./p.seq", "--trace w.prop", "--junit p.seq", "--proof w.prop",
          "--scenario x --stimulus ./x", "--scenario w --trace w-Also.prop --stimulus w.prop"}) {
        EXPECT_EQ(run(std::string("verify p.seq --property w.prop ") + options), 2) << options;
        EXPECT_EQ(read("p.seq"), kProgram) << options;
        EXPECT_EQ(read("w.prop"), "PROPERTY Also: NEVER step = S;") << options;
    }
    // Of further properties the file's name is made.
    write("w-Also.prop", "PROPERTY Also: NEVER step = S;");
    EXPECT_EQ(run("verify p.seq --property w-Also.prop --trace w.prop"), 2);
    EXPECT_EQ(read("w-Also.prop"), "PROPERTY Also: NEVER step = S;");
    EXPECT_NE(read("err").find("'w-Also.prop' was read"), std::string::npos) << read("err");
}

TEST_F(Courses, ACourseIsWrittenAsATrace) {
    write("p.seq", kProgram);
    EXPECT_EQ(run("verify p.seq --trace t.csv"), 1);
    const std::string trace = read("t.csv");
    EXPECT_TRUE(
        trace.starts_with("time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n0,"))
        << trace;
}

/// V_SOLL is 0 from the STOP when Move is entered again.
const char* const kStands =
    "PROGRAM V\nMOTOR MAC140;\nVAR_INPUT Go AT IN0; Shut AT IN1; Ack AT IN2; END_VAR\n"
    "VAR_MOTOR Fast AT V1 := 1000 rpm; Soft AT A1 := 1000 rpm/s; There AT P1 := 3 rev; END_VAR\n"
    "ON ERROR NEXT := Fault; POWER_UP INIT(Fast, Soft); NEXT := Idle; END_POWER_UP\n"
    "STEP Idle: IF Go THEN NEXT := Move; END_IF END_STEP\n"
    "STEP Move: ENTRY POSITION(There); IF Shut THEN STOP; NEXT := Idle; END_IF END_STEP\n"
    "STEP Fault: OWN ERROR; ENTRY STOP; IF ANY ERROR AND Ack THEN RESET_ERROR; NEXT := POWER_UP; END_IF "
    "END_STEP\n";

TEST_F(Courses, AFaultOfACheckIsWrittenAsACourseToo) {
    write("p.seq", kStands + std::string("END_PROGRAM\n"));
    write("s.csv", "old");
    EXPECT_EQ(run("verify p.seq --stimulus s.csv --trace t.csv --scenario c.scn"), 1);
    EXPECT_TRUE(read("s.csv").starts_with("dt_ms,inputs,inpos,error\n")) << read("s.csv");
    EXPECT_TRUE(read("t.csv").starts_with("time_ms,step,")) << read("t.csv");
    EXPECT_NE(read("c.scn").find("log \"here V011 shows\""), std::string::npos) << read("c.scn");
    EXPECT_NE(read("out").find("c.scn"), std::string::npos) << read("out");
    run("verify p.seq --scenario c.scn --json");
    for (const Json& result : results()) {
        if (result.value("code", "") != "V011") continue;
        EXPECT_EQ(result["scenario"]["file"], "c.scn");
    }
}

TEST_F(Courses, APropertyIsWrittenToTheNamedFileBeforeACheck) {
    write("p.seq", kStands + std::string("PROPERTY Never_Moves: NEVER STEP = Move;\nEND_PROGRAM\n"));
    EXPECT_EQ(run("verify p.seq --stimulus s.csv --scenario c.scn"), 1);
    EXPECT_NE(read("c.scn").find("here Never_Moves breaks"), std::string::npos) << read("c.scn");
    EXPECT_NE(read("c-MoveHasVelocity.Move.scn").find("here V011 shows"), std::string::npos);
    EXPECT_TRUE(read("s-MoveHasVelocity.Move.csv").starts_with("dt_ms,"));
}

TEST_F(Courses, WhereNothingWasFoundNoOldFileIsTakenForIt) {
    write("p.seq",
          "PROGRAM P\nMOTOR MAC140;\nSTEP S: OWN ERROR; IF IN0 THEN NEXT := T; END_IF END_STEP\n"
          "STEP T: OWN ERROR; IF NOT IN0 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n");
    write("old.scn", "old");
    EXPECT_EQ(run("verify p.seq --scenario old.scn --stimulus new.csv --json"), 0);
    EXPECT_EQ(read("old.scn"), "old");
    EXPECT_FALSE(results().empty());
    EXPECT_EQ(read("err"),
              "nothing to write: no course breaks a property or shows a fault; old.scn is as it was before, "
              "and not of this run\n"
              "nothing to write: no course breaks a property or shows a fault; new.csv was not written\n");
}

TEST_F(Courses, TheLongestTimeOfMovesIsToldWithTheVerdicts) {
    write("p.seq", kProgram);
    write("m.prop", "ASSUME moving ENDS WITHIN 2 s;");
    run("verify p.seq --property m.prop");
    EXPECT_NE(read("out").find("; ASSUME NEVER IN0 AND IN5; ASSUME moving ENDS WITHIN 2 s\n"),
              std::string::npos)
        << read("out");
    run("verify p.seq --property m.prop --json");
    EXPECT_EQ(Json::parse(read("out"))["assumptions"],
              Json::array({"ASSUME NEVER IN0 AND IN5", "ASSUME moving ENDS WITHIN 2 s"}));
}

TEST_F(Courses, AMistakeInAPropertyIsOneMistake) {
    write("p.seq",
          "PROGRAM P\nMOTOR MAC140;\nSTEP S: OWN ERROR; IF IN0 THEN NEXT := T; END_IF END_STEP\n"
          "STEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP\n"
          "PROPERTY Ends: WHENEVER STEP = S THEN STEP = T WITHIN 20 ms;\n"
          "PROPERTY Fine: STEP = T IS REACHABLE;\nEND_PROGRAM\n");
    EXPECT_EQ(run("check p.seq"), 1);
    EXPECT_NE(read("err").find("p.seq: 1 error"), std::string::npos) << read("err");
}

TEST_F(Courses, WhatIsNoTableIsRefused) {
    std::string table(8, '\0');
    table[0] = 0x3F;
    write("t.bin", table);
    EXPECT_EQ(run("verify t.bin"), 0);
    write("t.bin", table + std::string(16, '\x55'));
    EXPECT_EQ(run("verify t.bin"), 2);
    EXPECT_NE(read("err").find("t.bin: 16 bytes stand behind the end of the table"), std::string::npos)
        << read("err");
    EXPECT_EQ(run("verify '" SEQC_PROGRAM "'"), 2);
    EXPECT_EQ(read("out"), "");
}

TEST_F(Courses, NoWayBackNamesTheOutputThatStaysOn) {
    const auto said = [&](const std::string& work) {
        found_in(
            "PROGRAM P MOTOR MAC140; VAR_OUTPUT Clamp AT OUT0 : BOOL; END_VAR\n"
            "STEP Idle: OWN ERROR; IF IN0 THEN SET Clamp; NEXT := Work; END_IF END_STEP\n"
            "STEP Work: OWN ERROR; IF NOT IN0 THEN " +
            work +
            "NEXT := Idle; END_IF END_STEP\n"
            "STEP Open: OWN ERROR; IF IN1 AND IN2 AND NOT IN2 THEN RESET Clamp; NEXT := Idle; END_IF "
            "END_STEP\nEND_PROGRAM\n");
        for (const Json& result : results()) {
            if (result["code"] == "V003" && result["verdict"] != "proved") return result.dump();
        }
        return std::string();
    };
    const std::string text = said("");
    EXPECT_NE(
        text.find("steps Idle, Work lead to each other only, and none of them switches Clamp off: Idle is "
                  "never entered again with Clamp off"),
        std::string::npos)
        << text;
    EXPECT_EQ(said("RESET Clamp; "), "");
}

}  // namespace
}  // namespace nplc::seqc
