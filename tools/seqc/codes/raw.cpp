#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kAll[] = {
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
     R"(The first byte of a term holds the number of its step in bits 5..0. Steps are numbered in the order they stand in, from 1;
POWER_UP is 0. Inside of a step a TERM can only be one of that step.)",
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
    {"E099",
     "the compiler's own check failed",
     R"(When a step is compiled, its bytes are worked out for all 1,024 cases of inputs, INPOS, ERROR, timer and counter and compared
with the program. They differ here: a fault of seqc, not of the program. No table is written. Please report it with the program;
until it is mended write the step in another way, with fewer branches.)",
     {},
     {}},
};

}  // namespace

const std::span<const CodeInfo> kRaw = kAll;

}  // namespace nplc::seqc::codes
