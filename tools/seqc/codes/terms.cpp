#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kTermsCodes[] = {
    {"E070", "two IFs that can hold together",
     R"(All terms that hold act in the same scan. Two IFs beside each other that do different things would both act where both hold:
all their commands would go out, and the later one would decide the next step. The message shows a case. Join them with ELSIF,
which excludes the branches before it, or make the conditions exclude each other.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T; END_IF
    IF IN1 THEN NEXT := U; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
STEP U: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T;
    ELSIF IN1 THEN NEXT := U; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
STEP U: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E071", "a command that would need to know that the timer still runs",
     R"(A term can ask whether the timer or the counter is zero, but not whether it still runs (001 §6.1.5). For the next step and the
outputs a later term can override an earlier one; a command or a preset cannot be taken back once it is sent. So put the branch
with TIMER.Q first, without commands in the others, or wait in a step of its own.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 AND NOT TIMER.Q THEN STOP; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 AND NOT TIMER.Q THEN NEXT := Halt; END_IF
END_STEP
STEP Halt:
    OWN ERROR;
    STOP; NEXT := T;
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E072", "a command that would be sent twice",
     R"(With TIMER.Q OR COUNTER.Q it takes two terms, one for each, and when both are zero both hold: a command in them would go out
twice. Send it in a step where only one of the two counts.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF TIMER.Q OR COUNTER.Q THEN STOP; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF TIMER.Q OR COUNTER.Q THEN NEXT := Halt; END_IF
END_STEP
STEP Halt:
    OWN ERROR;
    STOP; NEXT := T;
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kTerms = kTermsCodes;

}  // namespace nplc::seqc::codes
