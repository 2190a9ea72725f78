"""What was once red: seeds, and a small program for each reason, whatever programs.py writes by now."""

# In one of them two errors had one cause, in one each ON ERROR led to POWER_UP, there were 70 steps, or FOR stood beside a bare preset;
# the others behaved in another way than the interpreter, which was wrong.
SEEDS = (770074, 5001283, 5000791, 910000076, 5001180, 910000294, 910001654, 5000762, 910000857, 910001666,
         31000333)

HEAD = """PROGRAM Kept
MOTOR MAC140;
VAR_INPUT Start AT IN0 : BOOL; Guard AT IN1 : BOOL; Ack AT IN2 : BOOL; END_VAR
VAR_OUTPUT Lamp AT OUT0 : BOOL; Grip AT OUT1 : BOOL; END_VAR
"""
FAULT = "STEP Fault: OWN ERROR; ENTRY TIMER := 7 ms; IF ANY ERROR AND Ack THEN RESET_ERROR; NEXT := S; END_IF END_STEP\n"

# The steps and declarations; the codes with which both refuse, none where both do the same in all scans.
PROGRAMS = {
    "a fault step without OWN ERROR is one mistake": ("""ON ERROR NEXT := Fault;
STEP S: IF Start THEN NEXT := Fault; END_IF END_STEP
STEP Fault: IF ANY ERROR AND Ack THEN RESET_ERROR; NEXT := S; END_IF END_STEP
""", {"E081"}),
    "POWER_UP is no fault step": ("""ON ERROR NEXT := POWER_UP;
STEP S: IF Start THEN NEXT := T; END_IF END_STEP
STEP T: IF Guard THEN NEXT := S; END_IF END_STEP
""", {"E011"}),
    "ON ERROR stands once": ("""ON ERROR NEXT := Fault;
ON ERROR NEXT := Fault;
STEP S: IF Start THEN NEXT := Fault; END_IF END_STEP
""" + FAULT, {"E020"}),
    "a helper step before POWER_UP has the outputs of POWER_UP": ("""ON ERROR NEXT := Fault;
POWER_UP OUT Lamp; NEXT := S; END_POWER_UP
STEP S: OUT Grip; ENTRY TIMER := 5 ms; IF TIMER.Q AND Guard THEN NEXT := Fault;
ELSIF Start THEN STOP; NEXT := POWER_UP; END_IF END_STEP
""" + FAULT, set()),
    "ON ERROR goes its way at once beside a branch that does the same": ("""ON ERROR NEXT := Fault;
STEP S: ENTRY COUNTER := 1; IF R_TRIG(Guard) AND COUNTER.Q THEN NEXT := T; ELSIF Start THEN NEXT := Fault; END_IF END_STEP
STEP T: IF Ack THEN NEXT := S; END_IF END_STEP
""" + FAULT, set()),
    "a blinking output waits for no helper step where OUT .. WHEN makes the difference": ("""ON ERROR NEXT := Fault;
STEP S: OUT Lamp BLINKING 4 ms; OUT Grip WHEN Guard; IF Guard THEN ELSIF COUNTER.Q THEN NEXT := T; END_IF END_STEP
STEP T: OUT Grip; IF Start THEN COUNTER := 2; NEXT := S; ELSIF Ack THEN CLEAR_COUNTER; NEXT := S; END_IF END_STEP
""" + FAULT, set()),
    "OUT .. WHEN makes no difference for an output that is on anyway": ("""ON ERROR NEXT := Fault;
STEP S: OUT Lamp; OUT Lamp WHEN TIMER.Q; IF R_TRIG(Guard) AND Ack THEN NEXT := T; ELSIF NOT Start THEN EVERY_SCAN TIMER := 1 ms; END_IF END_STEP
STEP T: IF Start THEN TIMER := 5 ms; NEXT := S; END_IF END_STEP
""" + FAULT, set()),
    "a bare preset beside FOR": ("""STEP S: OWN ERROR; EVERY_SCAN TIMER := 5 ms; IF ERROR AND Guard FOR 7 ms THEN NEXT := T; END_IF END_STEP
STEP T: OWN ERROR; IF Ack THEN NEXT := S; END_IF END_STEP
""", {"E073"}),
    "62 steps": ("".join(f"STEP S{n}: OWN ERROR; IF Start THEN NEXT := S{(n + 1) % 62}; END_IF END_STEP\n" for n in range(62)),
                 {"E083"}),
}


def programs():
    """(name, text, codes)"""
    for name, (text, codes) in PROGRAMS.items():
        yield name, f"{HEAD}{text}END_PROGRAM\n", codes
