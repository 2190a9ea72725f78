#include "codes/catalog.h"

namespace nplc::seqc::codes {
namespace {

constexpr CodeInfo kMotorCodes[] = {
    {"E030", "an unknown motor",
     R"(MOTOR names the motor whose registers the program uses: MAC50, MAC95, MAC140, MAC141 or MAC800. The MAC800 numbers and
scales many registers in another way, so the name must be right. MAC23 and MAC34 (MAC34_1, MAC34_2) are drives of MIDI
Ingenierie: their programs use the registers of a MAC140, and the gateway translates.)",
     R"(PROGRAM P
MOTOR MAC14;
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E031", "a register without a motor",
     R"(What a register is called, how many bits it has and what one step of it means depends on the motor. A program that names
registers must name the motor first. A program that only switches outputs needs none.)",
     R"(PROGRAM P
STEP S:
    OWN ERROR;
    IF IN0 THEN V_SOLL := 500 rpm; NEXT := T; END_IF
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
    {"E032", "a SCALE that says nothing",
     R"(SCALE says how far the machine moves in some revolutions of the motor, with a unit of your own: SCALE 1 rev = 5 mm; or
SCALE 10 rev = 360 deg;. Revolutions stand on the left, both numbers are greater than 0, and the unit is none of those that
exist already (rev, rpm, counts, samples, s, ms).)",
     R"(PROGRAM P
MOTOR MAC140;
SCALE 5 mm = 1 rev;
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
SCALE 1 rev = 5 mm;
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E040", "an unknown register",
     R"(The motor that MOTOR names has no register of this name or number. The names are those of its manual; a 32-bit register
takes two numbers and is written by the first of them. The sets are P1..P8, V1..V8, A1..A4, T1..T4, L1..L4 and Z1..Z4.)",
     R"(PROGRAM P
MOTOR MAC140;
VAR_MOTOR Far AT P9 := 20000; END_VAR
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
VAR_MOTOR Far AT P8 := 20000; END_VAR
STEP S: OWN ERROR; END_STEP
END_PROGRAM
)"},
    {"E041", "a register that a table cannot reach",
     R"(A term has seven bits for the register's number (001 §6.1.8), so it reaches 1..127; number 0 would begin an address and is
refused. Registers above 127 are set once with a register tool and saved in the motor.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN UV_HANDLE := 1; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN ACC_EMERG := 100; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E042", "a value that does not fit its register",
     R"(Each register holds a range of whole steps. A value beyond it, or so small that nothing of it would be left, would make the
motor do something else than the program says. The help shows the range, in the unit that the program uses.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN V_SOLL := 20000 rpm; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN V_SOLL := 2000 rpm; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
    {"E043", "a unit that does not fit",
     R"(Positions take counts or rev, speeds rpm or rev/s, accelerations rpm/s or rev/s2, torques %peak or %nominal, times ms, s or
samples, and all but the last two the unit of SCALE (mm, mm/s, mm/s2). The timer takes times only. A number without unit is the
register's own step.)",
     R"(PROGRAM P
MOTOR MAC140;
STEP S:
    OWN ERROR;
    IF IN0 THEN V_SOLL := 500 rev; NEXT := T; END_IF
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
    {"E044", "what a MIDI drive cannot do",
     R"(A program for MAC23 or MAC34 has the registers and commands of a JVL motor, and the gateway translates them for MIDI's drive
(firmware/motor/MIDI.md). What that has nothing for is refused here: the load factor (L1..L4), P_FNC, HOME, gear and analogue
modes; and values beyond its reach: a speed below 0.95 rpm (MAC23: 3.8 rpm), acceleration 0, a ramp of more than 255 x 120
increments, a window of 0 or above 104 counts (MAC23: 524). The ramp comes from velocity and acceleration together.)",
     R"(PROGRAM P
MOTOR MAC34;
STEP S:
    OWN ERROR;
    IF IN0 THEN HOME; NEXT := T; END_IF
END_STEP
STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
)",
     R"(PROGRAM P
MOTOR MAC34;
VAR_MOTOR Search AT V1 := -60 rpm; Soft AT A1 := 1000 rpm/s; END_VAR
POWER_UP INIT(Search, Soft); NEXT := S; END_POWER_UP
STEP S:
    OWN ERROR;
    IF IN0 THEN VELOCITY(Search); NEXT := Homing; END_IF
END_STEP
STEP Homing: OWN ERROR; IF IN1 THEN STOP; TIMER := T#1s; NEXT := Homed; END_IF END_STEP
STEP Homed: OWN ERROR; IF TIMER.Q THEN CLEAR_P_IST; NEXT := S; END_IF END_STEP
END_PROGRAM
)"},
};

}  // namespace

const std::span<const CodeInfo> kMotor = kMotorCodes;

}  // namespace nplc::seqc::codes
