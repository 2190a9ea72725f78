#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kTextCodes[] = {
    {"E001", "characters that mean nothing",
     R"(A program is made of words, numbers, the signs := : ; , ( ) . = + - / and comments. Letters with accents,
quotation marks and the like may stand in comments only. A file of more than 16 MiB or
four million words and signs is refused with this code too.)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 & IN1 THEN NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 AND IN1 THEN NEXT := T; END_IF    // & is written AND
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E002", "a comment that is never closed",
     R"(A comment that begins with (* ends with the next *), however many lines later. Without it all that follows would
be comment. A comment that begins with // ends with its line.)",
     R"(PROGRAM P
STEP S: (* waits
    OWN ERROR;
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S: (* waits *)
    OWN ERROR;
END_STEP
END_PROGRAM
)"},
    {"E003", "a number that cannot be read",
     R"(Numbers are written 12, 1_000, -3.5, or with a base: 16#C0, 8#300, 2#1100_0000. With a base they are the bits of a
register, at most 32, and have no sign.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN INPOSWIN := 16#3G; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN INPOSWIN := 16#3F; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E004", "a time that cannot be read",
     R"(Times are written T#500ms, T#1.5s or T#1m5s: numbers with d, h, m, s or ms behind them, the largest unit first,
without blanks.)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#5sec; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#5s; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kText = kTextCodes;

}  // namespace nplc::seqc::codes
