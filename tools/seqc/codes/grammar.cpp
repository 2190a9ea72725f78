#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kGrammarCodes[] = {
    {"E010", "something else is expected here",
     R"(The program does not follow the grammar at the marked place: a word is missing, misspelt or stands in the wrong
order. The message says what could stand there. Often the mistake is just before it: a forgotten semicolon, THEN or END_IF.)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THAN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E011", "a word that cannot be a name",
     R"(Words of the language (STEP, NEXT, ERROR ...), addresses (IN0, OUT3) and registers of the motor (V1, P_SOLL ...)
have a meaning already. A name of your own must be another word, or nobody could tell which of the two is meant.)",
     R"(PROGRAM P
MOTOR MAC140;
VAR_INPUT V1 AT %IX0.0 : BOOL; END_VAR
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
VAR_INPUT Valve_1 AT %IX0.0 : BOOL; END_VAR
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E012", "a block that is not closed",
     R"(PROGRAM, VAR_..., POWER_UP, STEP and IF each end with a word of their own: END_PROGRAM, END_VAR, END_POWER_UP,
END_STEP, END_IF. The note shows the block that is still open where the next one begins or the file ends.)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T;
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E013", "a condition that is nested too deeply",
     R"(Parentheses and NOT can stand in one another 100 deep, far more than a condition on ten bits can need. The way out is
to leave out what is double, or to split the condition with ELSIF.)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF ((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((( IN0
       ))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))) THEN
        NEXT := T;
    END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E014", "TIMER or COUNTER tested without .Q",
     R"(A term of the table can test one thing about the timer and the counter: whether they are zero (001 §6.1.5). That is
TIMER.Q and COUNTER.Q, true at zero. Their value cannot be compared with a number.)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#2s; NEXT := T; END_IF
END_STEP
STEP T:
    OWN ERROR;
    IF TIMER THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#2s; NEXT := T; END_IF
END_STEP
STEP T:
    OWN ERROR;
    IF TIMER.Q THEN NEXT := S; END_IF    // two seconds later
END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kGrammar = kGrammarCodes;

}  // namespace nplc::seqc::codes
