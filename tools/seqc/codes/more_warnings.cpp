#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kMoreWarningsCodes[] = {
    {"W009", "a TERM that a gateway refuses",
     R"(A gateway checks a table before it takes it. It refuses a next step of 63 and a write to register 0; the whole table then does
not run.)",
     R"(PROGRAM P
TERM 16#C0, 0, 0, 16#3F, 16#80, 0, 0, 0;
END_PROGRAM
)",
     R"(PROGRAM P
TERM 16#C0, 0, 0, 16#3E, 16#80, 0, 0, 0;
END_PROGRAM
)"},
    {"W010", "more TERMs than every gateway holds",
     R"(A gateway must hold 1,024 terms, the end included, and may hold more. A program of TERM lines is compiled as it stands; make
sure that yours holds them all.)",
     R"(PROGRAM P
{1..1024}TERM 16#C1, 0, 0, 16#3E, 16#80, 0, 0, 0;  // $
END_PROGRAM
)",
     R"(PROGRAM P
{1..1023}TERM 16#C1, 0, 0, 16#3E, 16#80, 0, 0, 0;  // $
END_PROGRAM
)"},
    {"W011", "a MODE_REG that may start the motor",
     R"(Writing a moving mode to MODE_REG starts the motor at once, at the V_SOLL or towards the P_SOLL that it happens to hold.
VELOCITY(V..) and POSITION(P..) set the target and the mode together.)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN MODE_REG := 1; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN VELOCITY(V1); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W012", "an INPOS that may never come after homing",
     R"(While the motor homes INPOS is 0. When it has found its home it changes to the mode in STARTMODE (001 §4.4.13 to 4.4.15), and
that is the only sign of it: in INIT, the torque mode and the analogue velocity modes INPOS stays 0 for ever. Set STARTMODE to 2
before: the motor then goes on to position 0 and INPOS comes when it is there. Or wait for an input or a time, and begin a move.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN HOME; NEXT := T; END_IF
END_STEP
STEP T:
    OWN ERROR;
    IF INPOS THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
VAR_MOTOR After_Homing AT STARTMODE := 2; END_VAR
STEP S:
    OWN ERROR;
    IF IN0 THEN HOME; NEXT := T; END_IF
END_STEP
STEP T:
    OWN ERROR;
    IF INPOS THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)"},
    {"W013", "a limit that does not show in ERROR",
     R"(ERROR is bits 0 to 3 of ERR_STAT (001 §5.2.1.6). When the motor leaves MIN_P_IST or MAX_P_IST, or a MAC800 finds its supply too
low or gets too hot, it stops with another bit: ERROR stays 0 and INPOS does not come. Nothing in the table can see that. Give
each wait for INPOS a time limit, or wire limit switches to inputs.)",
     R"(PROGRAM P
MOTOR MAC140;
VAR_MOTOR
    Place AT P1 := 20000 counts;
    Fast  AT V1 := 500 rpm;
    Left  AT MIN_P_IST := -30000 counts;
    Right AT MAX_P_IST := 30000 counts;
END_VAR
POWER_UP INIT(Fast); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#10s; POSITION(Place); NEXT := T; END_IF
END_STEP
STEP T:
    OWN ERROR;
    IF INPOS THEN NEXT := S; END_IF
END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
VAR_MOTOR
    Place AT P1 := 20000 counts;
    Fast  AT V1 := 500 rpm;
    Left  AT MIN_P_IST := -30000 counts;
    Right AT MAX_P_IST := 30000 counts;
END_VAR
POWER_UP INIT(Fast); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN TIMER := T#10s; POSITION(Place); NEXT := T; END_IF
END_STEP
STEP T:
    OWN ERROR;
    IF INPOS THEN NEXT := S; ELSIF TIMER.Q THEN NEXT := Fault; END_IF
END_STEP
STEP Fault: OWN ERROR; IF IN5 THEN NEXT := POWER_UP; END_IF END_STEP
END_PROGRAM
)"},
    {"W014", "a homing that is cut short",
     R"(Homing is a mode of the motor. A command that selects registers, or a write to MODE_REG, sets another mode (001 §5.2.1.4), and
in the same scan it does so before the motor has begun to home. The ENTRY of the step that is entered belongs to the same scan.)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN HOME; POSITION(P1); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
POWER_UP INIT(V1); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN HOME; TIMER := T#20s; NEXT := Homing; END_IF
END_STEP
STEP Homing:
    OWN ERROR;
    IF TIMER.Q THEN POSITION(P1); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W015", "an order that waits until the motor stands",
     R"(A MIDI drive refuses a new target, a new ramp, and the velocity of moves to positions while it moves (000 and 003, commands 13h, 0Fh
and 0Dh). The gateway keeps such an order until the drive stands, and the scan waits with it; a JVL motor would take it at
once. Wait for INPOS first, or send STOP.)",
     R"(PROGRAM P
MOTOR MAC34;
VAR_MOTOR A AT P1 := 0 rev; B AT P2 := 10 rev; Fast AT V1 := 600 rpm; Soft AT A1 := 5000 rpm/s; END_VAR
POWER_UP INIT(Fast, Soft); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN POSITION(B); NEXT := Away; END_IF
END_STEP
STEP Away:
    OWN ERROR;
    IF IN1 THEN POSITION(A); NEXT := Home; END_IF
END_STEP
STEP Home: OWN ERROR; IF INPOS THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC34;
VAR_MOTOR A AT P1 := 0 rev; B AT P2 := 10 rev; Fast AT V1 := 600 rpm; Soft AT A1 := 5000 rpm/s; END_VAR
POWER_UP INIT(Fast, Soft); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN POSITION(B); NEXT := Away; END_IF
END_STEP
STEP Away:
    OWN ERROR;
    IF INPOS THEN POSITION(A); NEXT := Home; END_IF
END_STEP
STEP Home: OWN ERROR; IF INPOS THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W016", "a ramp that may be impossible",
     R"(The ramp of a MIDI drive is a number of increments, 120 to 30600, worked out from velocity and acceleration. Of the values that a
program gives, some would need a longer one if they met. Whether they do depends on the way through the steps, which is
followed without its conditions. The gateway would show ERROR when it happens.)",
     R"(PROGRAM P
MOTOR MAC34;
VAR_MOTOR
    A AT P1 := 0 rev; B AT P2 := 10 rev; Fast AT V1 := 1500 rpm; Slow AT V2 := 60 rpm;
    Soft AT A1 := 10000 rpm/s; Mild AT A2 := 1000 rpm/s;
END_VAR
POWER_UP INIT(Fast, Soft); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN INIT(Mild); NEXT := T; ELSIF IN1 THEN INIT(Slow, Mild); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN2 THEN POSITION(B); NEXT := U; END_IF END_STEP
STEP U: OWN ERROR; IF INPOS THEN INIT(Fast, Soft); NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC34;
VAR_MOTOR
    A AT P1 := 0 rev; B AT P2 := 10 rev; Fast AT V1 := 1500 rpm; Slow AT V2 := 60 rpm;
    Soft AT A1 := 10000 rpm/s; Mild AT A2 := 1000 rpm/s;
END_VAR
POWER_UP INIT(Fast, Soft); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN INIT(Fast, Soft); NEXT := T; ELSIF IN1 THEN INIT(Slow, Soft); NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN2 THEN POSITION(B); NEXT := U; END_IF END_STEP
STEP U: OWN ERROR; IF INPOS THEN INIT(Fast, Soft); NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"W017", "a register of a MIDI drive without a value",
     R"(A JVL motor has P, V, A, T and Z registers in its flash, with values that somebody stored there. For a MIDI drive the gateway
keeps them, and knows only what a program writes: a place that is never given is 0, and selecting another register that is
never given changes nothing. Give it a value in VAR_MOTOR, or write it before.)",
     R"(PROGRAM P
MOTOR MAC34;
VAR_MOTOR Fast AT V1 := 600 rpm; Soft AT A1 := 5000 rpm/s; END_VAR
POWER_UP INIT(Fast, Soft); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN POSITION(P2); NEXT := Away; END_IF
END_STEP
STEP Away: OWN ERROR; IF INPOS THEN INIT(Fast, Soft); NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC34;
VAR_MOTOR Place AT P2 := 10 rev; Fast AT V1 := 600 rpm; Soft AT A1 := 5000 rpm/s; END_VAR
POWER_UP INIT(Fast, Soft); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN POSITION(Place); NEXT := Away; END_IF
END_STEP
STEP Away: OWN ERROR; IF INPOS THEN INIT(Fast, Soft); NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kMoreWarnings = kMoreWarningsCodes;

}  // namespace nplc::seqc::codes
