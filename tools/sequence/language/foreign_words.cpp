#include "language/foreign_words.h"

#include <algorithm>
#include <array>

#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr std::string_view kGo = "another step is named with NEXT := Step;";
constexpr std::string_view kCall =
    "SEQUENCE Name(..) .. END_SEQUENCE holds steps that several places use, CALL Name(..); NEXT := Step; "
    "goes through them, and RETURN; "
    "ends them";
constexpr std::string_view kLeave =
    "another step is named with NEXT := Step; what is done on leaving stands beside it";
constexpr std::string_view kWait =
    "a step waits by itself: TIMER := T#500ms; on the way to it and IF TIMER.Q THEN ... in it, or IF INPOS "
    "THEN ...";
constexpr std::string_view kCount =
    "the counter counts down to 0: COUNTER := 5; presets it, COUNT_DOWN; takes one off, COUNTER.Q is true at "
    "0";
constexpr std::string_view kTimer = "there is one timer: TIMER := T#500ms; presets it, TIMER.Q is true at 0";
constexpr std::string_view kLoop =
    "steps repeat: go back with NEXT := Step; and end with a condition or with COUNTER.Q";
constexpr std::string_view kMove =
    "POSITION(P..) moves to a place, VELOCITY(V..) runs at a speed, HOME searches the home position, STOP "
    "stops";
constexpr std::string_view kRelative =
    "POSITIONS_RELATIVE_P_FNC; at POWER_UP makes the moves of POSITION(P..) relative; `seqc explain "
    "POSITIONS_RELATIVE_P_FNC` says from where";
constexpr std::string_view kJog =
    "run while a button is held: VELOCITY(V..) on the way to a step that leaves with STOP when it is let go "
    "(RECIPES.md)";
constexpr std::string_view kPower =
    "the motor is on when a mode is selected: POSITION(..), VELOCITY(..); INIT(..) lets it rest";
constexpr std::string_view kShow =
    "a sequence cannot show text: switch a lamp on with OUT Name; `nanoctl watch` shows step and inputs";
constexpr std::string_view kOut =
    "OUT Name; in the step switches it on, and what OUT does not name is off; OUT Name WHEN condition; "
    "follows "
    "an input";
constexpr std::string_view kStep = "steps are written as STEP Name: ... END_STEP";
constexpr std::string_view kNames =
    "inputs stand in VAR_INPUT ... END_VAR, outputs in VAR_OUTPUT, registers and values of the motor in "
    "VAR_MOTOR";
constexpr std::string_view kSwitch =
    "SET Clamp; switches an output on until RESET Clamp;, in a branch, in ENTRY or in POWER_UP";
constexpr std::string_view kShare = "INCLUDE 'wiring.seqi'; takes what several programs share from a file";
constexpr std::string_view kSetPoint =
    "SET_POINT Length AT P1 := 80 mm RANGE 10 .. 200 mm; is a value that an operator may change";
constexpr std::string_view kProgram = "a file holds PROGRAM Name .. END_PROGRAM and nothing around it";
constexpr std::string_view kClear = "RESET_ERROR; clears the motor's error";
constexpr std::string_view kEdge = "an edge is a condition: IF R_TRIG(Start) THEN ... or F_TRIG(Start)";

constexpr auto kWords = std::to_array<ForeignWord>({
    {"GOTO", kGo, {}},
    {"SPRINGE", kGo, {}},
    {"GEHE", kGo, {}},
    {"ALLER", kGo, {}},
    {"WARTE", kWait, {}},
    {"ATTENDRE", kWait, {}},
    {"SETZE", kSwitch, {}},
    {"AUSGANG", kOut, {}},
    {"SORTIE", kOut, {}},
    {"FAHRE", kMove, {}},
    {"MOVEABS", kMove, {}},
    {"MOVEREL", kRelative, {}},
    {"WENN", "write IF condition THEN .. ELSE .. END_IF", "ENDE"},
    {"GO", kGo, {}},
    {"JMP", kGo, {}},
    {"JUMP", kGo, {}},
    {"RETURN", kCall, {}},
    {"CALL", kCall, {}},
    {"GOSUB", kCall, {}},
    {"FUNCTION", kCall, "END_FUNCTION"},
    {"FUNCTION_BLOCK", kCall, "END_FUNCTION_BLOCK"},
    {"EXIT", kLeave, {}},
    {"STATE", kGo, {}},
    {"TRANSITION", kGo, "END_TRANSITION"},
    {"WAIT", kWait, {}},
    {"WAIT_FOR", kWait, {}},
    {"DELAY", kWait, {}},
    {"SLEEP", kWait, {}},
    {"DWELL", kWait, {}},
    {"PAUSE", kWait, {}},
    {"COUNT_UP", kCount, {}},
    {"COUNT", kCount, {}},
    {"CTU", kCount, {}},
    {"CTD", kCount, {}},
    {"INC", kCount, {}},
    {"DEC", kCount, {}},
    {"TON", kTimer, {}},
    {"TOF", kTimer, {}},
    {"TP", kTimer, {}},
    {"FOR", kLoop, "END_FOR"},
    {"WHILE", kLoop, "END_WHILE"},
    {"REPEAT", kLoop, "END_REPEAT"},
    {"MOVE", kMove, {}},
    {"MOVE_TO", kMove, {}},
    {"MOVE_ABS", kMove, {}},
    {"MOVE_REL", kMove, {}},
    {"MC_MOVEABSOLUTE", kMove, {}},
    {"MC_MOVERELATIVE", kMove, {}},
    {"MC_MOVEVELOCITY", kMove, {}},
    {"MC_HOME", kMove, {}},
    {"MC_STOP", kMove, {}},
    {"MOVE_RELATIVE", kRelative, {}},
    {"MOVE_REL", kRelative, {}},
    {"POSITION_REL", kRelative, {}},
    {"POSITION_RELATIVE", kRelative, {}},
    {"MOVE_ABSOLUTE", kMove, {}},
    {"GO_TO", kMove, {}},
    {"RUN", kMove, {}},
    {"JOG", kJog, {}},
    {"MC_JOG", kJog, {}},
    {"ENABLE", kPower, {}},
    {"DISABLE", kPower, {}},
    {"SERVO_ON", kPower, {}},
    {"POWER_ON", kPower, {}},
    {"MOTOR_ON", kPower, {}},
    {"MOTOR_OFF", kPower, {}},
    {"PRINT", kShow, {}},
    {"MESSAGE", kShow, {}},
    {"LOG", kShow, {}},
    {"LOOP", kLoop, {}},
    {"UNTIL", kLoop, {}},
    {"BREAK", kGo, {}},
    {"CONTINUE", kGo, {}},
    {"MC_RESET", "RESET_ERROR; clears the motor's error", {}},
    {"MC_POWER", kPower, {}},
    {"ERROR_RESET", "write RESET_ERROR;", {}},
    {"ON_ERROR", "write ON ERROR NEXT := Fault; in two words", {}},
    {"SET", kSwitch, {}},
    {"RESET", kSwitch, {}},
    {"R_TRIG", kEdge, {}},
    {"F_TRIG", kEdge, {}},
    {"IMPORT", kShare, {}},
    {"USING", kShare, {}},
    {"DEF", kCall, {}},
    {"VOID", kCall, {}},
    {"PROCEDURE", kCall, {}},
    {"SETPOINT", kSetPoint, {}},
    {"VAR_SETPOINT", kSetPoint, "END_VAR"},
    {"PARAMETER", kSetPoint, {}},
    {"RECIPE", kSetPoint, {}},
    {"CONFIGURATION", kProgram, {}},
    {"RESOURCE", kProgram, {}},
    {"TASK", kProgram, {}},
    {"CLEAR_ERROR", kClear, {}},
    {"CLEAR_ERRORS", kClear, {}},
    {"RESET_ERRORS", kClear, {}},
    {"ACKNOWLEDGE", kClear, {}},
    {"END_ENTRY", "ENTRY has one statement: write ENTRY in front of each", {}},
    {"PASS", "a branch that does nothing is empty: leave it out", {}},
    {"CASE", kStep, "END_CASE"},
    {"INITIAL_STEP",
     "write STEP; the sequence begins with the step that POWER_UP names, or the first one",
     {}},
    {"ACTION", kStep, "END_ACTION"},
    {"SWITCH", kStep, {}},
    {"VAR", kNames, "END_VAR"},
    {"VAR_GLOBAL", kNames, "END_VAR"},
    {"VAR_IN_OUT", kNames, "END_VAR"},
    {"VAR_TEMP", kNames, "END_VAR"},
    {"VAR_CONST", kNames, "END_VAR"},
    {"VAR_CONSTANT", kNames, "END_VAR"},
});

}  // namespace

const ForeignWord* foreign_word(std::string_view word) {
    const auto* found = std::find_if(kWords.begin(), kWords.end(),
                                     [&](const ForeignWord& row) { return same_name(row.word, word); });
    return found == kWords.end() ? nullptr : found;
}

}  // namespace nplc::seqc
