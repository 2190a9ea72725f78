#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kNamesCodes[] = {
    {"E020", "declared twice",
     R"(A name can stand for one thing only, and MOTOR, SCALE, ON ERROR and POWER_UP can be given once. Upper and lower case
are the same: Pump and PUMP are one name. The note shows the first place.)",
     R"(PROGRAM P
VAR_OUTPUT
    Pump AT %QX0.0 : BOOL;
    PUMP AT %QX0.1 : BOOL;
END_VAR
STEP S: OWN ERROR; OUT Pump; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
VAR_OUTPUT
    Pump_1 AT %QX0.0 : BOOL;
    Pump_2 AT %QX0.1 : BOOL;
END_VAR
STEP S: OWN ERROR; OUT Pump_1; END_STEP
END_PROGRAM
)"},
    {"E021", "an unknown name",
     R"(No step, input, output or command has this name. Inputs and outputs are declared under VAR_INPUT and VAR_OUTPUT, or
used by their address (IN0..IN5, OUT0..OUT3). The commands are INIT, VELOCITY, POSITION, STOP, HOME, RESET_ERROR, NOP,
CLEAR_P_SOLL, CLEAR_P_IST, CLEAR_P_FNC, CLEAR_T_SOLL, CLEAR_IN_POS, USE_SET, POSITIONS_ABSOLUTE,
POSITIONS_RELATIVE_P_SOLL, POSITIONS_RELATIVE_P_FNC, MOVE_P7_BY_P_FNC, MOVE_P8_BY_P_FNC, MOVE_P7_BY_P_SOLL,
MOVE_P8_BY_P_SOLL, TRANSMIT_ADDRESS, COUNT_DOWN and CLEAR_COUNTER.)",
     R"(PROGRAM P
STEP Idle:
    OWN ERROR;
    IF IN0 THEN NEXT := Travl; END_IF
END_STEP
STEP Travel: OWN ERROR; IF IN1 THEN NEXT := Idle; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP Idle:
    OWN ERROR;
    IF IN0 THEN NEXT := Travel; END_IF
END_STEP
STEP Travel: OWN ERROR; IF IN1 THEN NEXT := Idle; END_IF END_STEP
END_PROGRAM
)"},
    {"E022", "an address that does not exist or has a name already",
     R"(A gateway has six inputs, %IX0.0..%IX0.5 (IN0..IN5), and four outputs, %QX0.0..%QX0.3 (OUT0..OUT3): that is all a
term of the table has bits for (001 §6.1.5). Each of them, and each register under VAR_MOTOR, can have one name.)",
     R"(PROGRAM P
VAR_INPUT Start AT %IX0.6 : BOOL; END_VAR
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
VAR_INPUT Start AT %IX0.5 : BOOL; END_VAR
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E023", "an input where an output belongs, or the reverse",
     R"(A term compares inputs and writes outputs; it cannot read an output back or write an input. To react to an output,
let the step say it: while a step is active its outputs are known.)",
     R"(PROGRAM P
VAR_OUTPUT Lamp AT %QX0.0 : BOOL; END_VAR
STEP S:
    OWN ERROR;
    OUT Lamp;
    IF Lamp THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
VAR_INPUT  Key  AT %IX0.0 : BOOL; END_VAR
VAR_OUTPUT Lamp AT %QX0.0 : BOOL; END_VAR
STEP S:
    OWN ERROR;
    OUT Lamp;
    IF Key THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kNames = kNamesCodes;

}  // namespace nplc::seqc::codes
