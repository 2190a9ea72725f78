#include "syntax/foreign_words.h"

#include <algorithm>
#include <array>

#include "syntax/names.h"

namespace nplc::seqc {
namespace {

constexpr std::string_view kGo = "another step is named with NEXT := Step;";
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
constexpr std::string_view kOut =
    "OUT Name; in the step switches it on, and what OUT does not name is off; OUT Name WHEN condition; "
    "follows "
    "an input";
constexpr std::string_view kStep = "steps are written as STEP Name: ... END_STEP";
constexpr std::string_view kNames =
    "inputs stand in VAR_INPUT ... END_VAR, outputs in VAR_OUTPUT, registers and values of the motor in "
    "VAR_MOTOR";
constexpr std::string_view kEdge =
    "conditions have no edges: let one step wait for NOT Start, and the next one for Start";

constexpr auto kWords = std::to_array<ForeignWord>({
    {"GOTO", kGo, {}},
    {"GO", kGo, {}},
    {"JMP", kGo, {}},
    {"JUMP", kGo, {}},
    {"RETURN", kGo, {}},
    {"EXIT", kGo, {}},
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
    {"MC_RESET", "RESET_ERROR; clears the motor's error", {}},
    {"MC_POWER",
     "the motor is on when a mode is selected: POSITION(..), VELOCITY(..); INIT(..) lets it rest",
     {}},
    {"ERROR_RESET", "write RESET_ERROR;", {}},
    {"ON_ERROR", "write ON ERROR NEXT := Fault; in two words", {}},
    {"SET", kOut, {}},
    {"RESET", kOut, {}},
    {"R_TRIG", kEdge, {}},
    {"F_TRIG", kEdge, {}},
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
