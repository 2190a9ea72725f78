#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kScanCodes[] = {
    {"E060", "a command that would be sent in every scan",
     R"(A term acts in every scan in which it holds, not only once. A command, a preset or a count in a branch that stays in its step
would be repeated hundreds of times a second. Go on to another step with NEXT; or write EVERY_SCAN if the repetition is meant.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN CLEAR_P_IST; END_IF
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN CLEAR_P_IST; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E061", "set twice in the same scan",
     R"(All terms that hold act in the same scan, and of several next steps, timer presets or counter changes only the last counts
(001 §6.1.9). The ENTRY of the step that is entered belongs to the same scan.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#1s; TIMER := T#2s; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#2s; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E062", "a time that the timer cannot hold",
     R"(The timer counts milliseconds in 16 bits: 65.535 s at the most (001 §6.1.7). For longer times let the counter count
repetitions of a shorter one.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#2m; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN COUNTER := 4; TIMER := T#30s; NEXT := T; END_IF
END_STEP
STEP T:                                  // four times 30 s
    OWN ERROR;
    IF COUNTER.Q THEN NEXT := S;
    ELSIF TIMER.Q THEN NEXT := Again; COUNT_DOWN; END_IF
END_STEP
STEP Again:
    OWN ERROR;
    TIMER := T#30s; NEXT := T;
END_STEP
END_PROGRAM
)"},
    {"E063", "a count that the counter cannot hold",
     R"(The counter has 16 bits and counts down: whole numbers 0..65535.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN COUNTER := 100000; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN COUNTER := 10000; NEXT := T; END_IF    // count in tens
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E064", "a statement in the wrong place",
     R"(An IF holds statements only, no other IF and no OUT: a term has one condition, and outputs belong to their step. ENTRY cannot
hold NEXT, and POWER_UP happens once, so it has commands, register values and NEXT only.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN
        IF IN1 THEN NEXT := T; END_IF
    END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 AND IN1 THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kScan = kScanCodes;

}  // namespace nplc::seqc::codes
