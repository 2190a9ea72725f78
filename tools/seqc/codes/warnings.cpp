#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kWarningsCodes[] = {
    {"W001", "a branch that is never taken",
     R"(Either the condition contradicts itself, or the branches before it take every case that it could have. Mostly an input is
mistaken or the branches are in the wrong order.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T;
    ELSIF IN0 AND IN1 THEN NEXT := U; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := U; END_IF END_STEP
STEP U: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 AND IN1 THEN NEXT := U;
    ELSIF IN0 THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := U; END_IF END_STEP
STEP U: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W002", "a value that is rounded by more than 1 %",
     R"(Registers hold whole steps, and one step of some is coarse: A_SOLL of a MAC140 goes in steps of 248 rpm/s. The listing of
seqc build shows every rounded value; this warning says that the difference is more than 1 %.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN A_SOLL := 700 rpm/s; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN A_SOLL := 745 rpm/s; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W003", "a register that can do harm",
     R"(Filters, current regulators and the like are set by the motor's maker. A wrong value can make the motor swing, overheat or
destroy itself.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN KIFX2 := 5; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN KVOUT := 2.0; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W004", "a move while V_SOLL may be 0",
     R"(STOP sets V_SOLL to 0, and it stays 0 until a velocity is selected again. A position move would then be accepted and the motor
would not move, with INPOS at 0 for ever.)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN STOP; NEXT := T; END_IF
END_STEP
STEP T:
    OWN ERROR;
    IF IN1 THEN POSITION(P1); NEXT := S; END_IF
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN STOP; NEXT := T; END_IF
END_STEP
STEP T:
    OWN ERROR;
    IF IN1 THEN INIT(V1); POSITION(P1); NEXT := S; END_IF
END_STEP
END_PROGRAM
)"},
    {"W005", "a step that is never reached",
     R"(No NEXT leads to it from POWER_UP on. It takes up terms and does nothing; mostly a NEXT names another step than was meant.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
STEP Lost: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W006", "EVERY_SCAN without need",
     R"(A branch that leaves its step, an ENTRY and POWER_UP happen once by themselves. EVERY_SCAN belongs where something shall be
repeated while the step stays.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN EVERY_SCAN STOP; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN STOP; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W007", "a timer set to 0",
     R"(In a term the preset 0 means 'no preset' (001 §6.1.7), so the timer cannot be set to 0. 1 ms is taken instead. To go on at once
leave the timer out.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#0s; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#1ms; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W008", "an output that is on anyway",
     R"(OUT Lamp; keeps the output on as long as the step is active, so OUT Lamp WHEN ...; adds nothing. Keep the one that is meant.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    OUT OUT0;
    OUT OUT0 WHEN IN0;
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    OUT OUT0 WHEN IN0;
END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kWarnings = kWarningsCodes;

}  // namespace nplc::seqc::codes
