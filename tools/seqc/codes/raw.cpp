#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kRawCodes[] = {
    {"E090", "bytes that are no term",
     R"(A term is eight bytes: STATE, INPUT, CARE, NEXT_STATE and four that depend on the format (001 §6.1.4). Each is 0..255 or
16#00..16#FF.)",
     R"(PROGRAM P
TERM 16#C0, 0, 0, 1, 16#80, 0, 0;
END_PROGRAM
)",
     R"(PROGRAM P
TERM 16#C0, 0, 0, 1, 16#80, 0, 0, 0;
END_PROGRAM
)"},
    {"E091", "a TERM after the end",
     R"(A term whose STATE is 63 ends the table; the gateway reads nothing behind it.)",
     R"(PROGRAM P
TERM 16#3F, 0, 0, 0, 0, 0, 0, 0;
TERM 16#C0, 0, 0, 1, 16#80, 0, 0, 0;
END_PROGRAM
)",
     R"(PROGRAM P
TERM 16#C0, 0, 0, 1, 16#80, 0, 0, 0;
TERM 16#3F, 0, 0, 0, 0, 0, 0, 0;
END_PROGRAM
)"},
    {"E092", "a TERM of another step",
     R"(The first byte of a term holds the number of its step in bits 5..0. Steps are numbered in the order they stand in, from 1,
or by AT; POWER_UP is 0. Inside of a step a TERM can only be one of that step.)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    TERM 16#C2, 0, 0, 16#3E, 16#80, 0, 0, 0;
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    TERM 16#C1, 0, 0, 16#3E, 16#80, 0, 0, 0;
END_STEP
END_PROGRAM
)"},
    {"E093", "a condition that one term cannot hold",
     R"(TERM IF ... END_IF; is exactly one term of the table. A term compares inputs, INPOS and ERROR with 0 or 1 and can ask whether the
timer or the counter is zero; all of it must hold. It has no OR, cannot ask whether the timer still runs, and always compares
ERROR. Where several cases lead to the same, write a TERM for each; where a timer must not have run down, let a later TERM with
TIMER.Q decide: the last one that holds wins.)",
     R"(PROGRAM P
VAR_INPUT Start AT IN0 : BOOL; Stop AT IN1 : BOOL; END_VAR
STEP S:
    OWN ERROR;
    TERM IF Start OR Stop THEN NEXT := T; END_IF;
END_STEP
STEP T:
    OWN ERROR;
    IF Stop THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
VAR_INPUT Start AT IN0 : BOOL; Stop AT IN1 : BOOL; END_VAR
STEP S:
    OWN ERROR;
    TERM IF Start THEN NEXT := T; END_IF;
    TERM IF Stop THEN NEXT := T; END_IF;
END_STEP
STEP T:
    OWN ERROR;
    IF Stop THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)"},
    {"E094", "more than one term can hold",
     R"(TERM IF ... END_IF; is exactly one term of the table: it sends one command, or writes one register and does nothing else; it
presets the timer or the counter; it has one condition and belongs to one step. Write a TERM with the same condition for each
thing that should happen. Outside of a step it names its step: TERM Name: IF ... END_IF;)",
     R"(PROGRAM P
VAR_INPUT Start AT IN0 : BOOL; Stop AT IN1 : BOOL; END_VAR
STEP S:
    OWN ERROR;
    TERM IF Start THEN TIMER := T#1s; COUNTER := 3; NEXT := T; END_IF;
END_STEP
STEP T:
    OWN ERROR;
    IF Stop THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
VAR_INPUT Start AT IN0 : BOOL; Stop AT IN1 : BOOL; END_VAR
STEP S:
    OWN ERROR;
    TERM IF Start THEN TIMER := T#1s; NEXT := T; END_IF;
    TERM IF Start THEN COUNTER := 3; NEXT := T; END_IF;
END_STEP
STEP T:
    OWN ERROR;
    IF Stop THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)"},
    {"E095", "a step's number that cannot be",
     R"(STEP Name AT 5: gives a step its number in the table: 0..61, each once. 62 in a NEXT_STATE means "no switch", so a step of
that number could never be entered, and 63 ends the table. Steps without AT take the lowest free numbers from 1 on.)",
     R"(PROGRAM P
STEP S AT 62:
    OWN ERROR;
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S AT 61:
    OWN ERROR;
    IF IN0 THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)"},
    {"E096", "POWER_UP beside a step with the number 0",
     R"(Power-up begins in step 0. Either that is POWER_UP, which writes the values of VAR_MOTOR and goes on to the first step, or it is a
step of yours with AT 0. There is no room for both, and NEXT := POWER_UP has nowhere to go then.)",
     R"(PROGRAM P
POWER_UP NEXT := S; END_POWER_UP
STEP S AT 0:
    OWN ERROR;
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S AT 0:
    OWN ERROR;
END_STEP
END_PROGRAM
)"},
    {"E099",
     "the compiler's own check failed",
     R"(When a step is compiled, its bytes are worked out for all 1,024 cases of inputs, INPOS, ERROR, timer and counter and compared
with the program. They differ here: a fault of seqc, not of the program. No table is written. Please report it with the program;
until it is mended write the step in another way, with fewer branches.)",
     {},
     {}},
};

}  // namespace

const std::span<const CodeInfo> kRaw = kRawCodes;

}  // namespace nplc::seqc::codes
