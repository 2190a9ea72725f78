#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kProgramCodes[] = {
    {"E080", "a step that does not say what happens on ERROR",
     R"(Every term compares ERROR (001 §6.1.5), and a condition that does not name it means NOT ERROR. When the motor shows an error,
a step without a word about it would therefore stand still for ever. ON ERROR NEXT := Fault; at the top covers all steps; a step
with OWN ERROR; deals with it itself.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S: IF IN0 THEN NEXT := T; END_IF END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
ON ERROR NEXT := Fault;
STEP S: IF IN0 THEN NEXT := T; END_IF END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E081", "a fault step without OWN ERROR",
     R"(ON ERROR leads every step to the fault step. If the fault step itself were covered, it would enter itself again in every scan
in which ERROR is on. It must deal with ERROR itself and say so.)",
     R"(PROGRAM P
MOTOR MAC140;
ON ERROR NEXT := Fault;
STEP S: IF IN0 THEN NEXT := Fault; END_IF END_STEP
STEP Fault: IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
ON ERROR NEXT := Fault;
STEP S: IF IN0 THEN NEXT := Fault; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E082", "ERROR dealt with twice",
     R"(ON ERROR covers this step already, so a condition that names ERROR would act beside it. Write OWN ERROR; in the step and deal
with every case of ERROR there, or leave ERROR out of the condition.)",
     R"(PROGRAM P
MOTOR MAC140;
ON ERROR NEXT := Fault;
STEP S: IF ERROR AND IN0 THEN NEXT := T; END_IF END_STEP
STEP T: IF IN1 THEN NEXT := S; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
ON ERROR NEXT := Fault;
STEP S:
    OWN ERROR;
    IF ERROR AND IN0 THEN NEXT := T; ELSIF ERROR THEN NEXT := Fault; END_IF
END_STEP
STEP T: IF IN1 THEN NEXT := S; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E083", "too many steps",
     R"(A step's number has six bits; 62 and 63 have a meaning of their own as the next step, and 0 is POWER_UP (001 §6.1.7). 61 named
steps remain. Steps that differ only in how often they were done can be one step and the counter.)",
     R"(PROGRAM P
{1..61}STEP S$: OWN ERROR; NEXT := S@; END_STEP
STEP S62: OWN ERROR; NEXT := S1; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
{1..60}STEP S$: OWN ERROR; NEXT := S@; END_STEP
STEP S61: OWN ERROR; NEXT := S1; END_STEP
END_PROGRAM
)"},
    {"E084", "a program without steps",
     R"(Nothing would ever happen. A program has at least one STEP, or it is a list of TERM lines.)",
     R"(PROGRAM P
END_PROGRAM
)",
     R"(PROGRAM P
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E085", "POWER_UP without NEXT",
     R"(POWER_UP is left in its first scan, and the table must say which step comes first. Without POWER_UP it is the first one in the
text.)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); END_POWER_UP
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E086", "too many terms",
     R"(A gateway must hold 1,024 terms of 8 bytes, the end included, and need not hold more. Conditions with XOR take the most terms:
each more input in an XOR doubles them. Simplify conditions, or join steps that do the same.)",
     R"(PROGRAM P
{1..33}STEP S$: OWN ERROR; IF IN0 XOR IN1 XOR IN2 XOR IN3 XOR IN4 XOR IN5 THEN NEXT := S@; END_IF END_STEP
STEP S34: OWN ERROR; NEXT := S1; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
{1..33}STEP S$: OWN ERROR; IF IN0 AND IN1 AND IN2 AND IN3 AND IN4 AND IN5 THEN NEXT := S@; END_IF END_STEP
STEP S34: OWN ERROR; NEXT := S1; END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kProgram = kProgramCodes;

}  // namespace nplc::seqc::codes
