#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kCommandsCodes[] = {
    {"E050", "a command with the wrong registers",
     R"(INIT, VELOCITY and POSITION each take the registers to select, at most one of a kind: POSITION(P2, V1, A1). Those that can
be selected are P1..P8, V1..V8, A1..A4, T1..T4, L1..L4 and Z1..Z4 (001 §5.2.1.4). USE_SET takes a number 1..4, all other commands
take nothing.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN VELOCITY(V1, V2); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN VELOCITY(V2); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E051", "a command that would upset the link",
     R"(These commands change how gateway and motor talk to each other. The gateway sets that up by itself and would lose the motor
if a sequence changed it behind its back.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN USE_FLEXMAC; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN V_SOLL := 500 rpm; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E052", "a selection that would start the motor",
     R"(One command byte selects a register and sets the mode at once (001 §5.2.1.4). Selecting a velocity 'in position mode' while
the motor is in INIT therefore starts it, towards whatever P_SOLL still holds. Select with INIT first, then send only the position;
in velocity mode name the velocity.)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN POSITION(P1, V1); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN INIT(V1); POSITION(P1); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kCommands = kCommandsCodes;

}  // namespace nplc::seqc::codes
