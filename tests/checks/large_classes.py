"""Classes that may be larger than tree.py allows, each up to the numbers given here and no further."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Large:
    why: str  # what would have to be torn apart
    methods: int = 0  # 0: within the general limit
    members: int = 0


# The microcontroller images have no room for the code that passes state from one class to another.
IMAGE = "; in a microcontroller image with no room for the calls between the parts"

CLASSES = {
    "firmware/boards/linux/axis.h:Axis": Large(
        "owns the parts of one axis in the order of their construction and end; a part outside would outlive what it refers to",
        members=26,
    ),
    "firmware/boards/listener/include/listener/listener.h:Listener": Large(
        "one connection decides who may write, answers and closes: each needs the same list of connections",
        methods=46,
    ),
    "firmware/causes/why_facts.h:Facts": Large(
        "one question per fact that the rules of `why` name, each of a line or two on the one condition", methods=57
    ),
    "firmware/faces/model/include/faces/axis_loop.h:AxisLoop": Large(
        "one order after another between two scans: stops, changes and the motor's accesses wait for each other", members=28
    ),
    "firmware/gateway/include/gateway/gateway.h:Gateway": Large(
        "the face of scan, hold, forces, permission and log to the user port, mostly one line each; the state decides over all"
        + IMAGE,
        methods=94,
        members=21,
    ),
    "firmware/gateway/include/gateway/modbus_slave.h:ModbusSlave": Large(
        "request, window of the register and answer of one exchange" + IMAGE, members=22
    ),
    "firmware/gateway/include/gateway/set_points.h:SetPoints": Large(
        "values, their writers and the step that takes them change within one scan" + IMAGE, members=23
    ),
    "firmware/motor/include/motor/jvl_link.h:JvlLink": Large(
        "the two protocols share the toggle, the line and the wait for an answer" + IMAGE, methods=45, members=29
    ),
    "firmware/motor/include/motor/jvl_motor.h:JvlMotor": Large(
        "the interface Motor has most of the methods; orders, stop and access take turns on one link" + IMAGE,
        methods=43,
        members=21,
    ),
    "firmware/motor/include/motor/midi_motor.h:MidiMotor": Large(
        "the interface Motor has half of the methods; every outcome of the link may concern stop, access, reset or motion"
        + IMAGE,
        methods=61,
        members=23,
    ),
    "firmware/store/include/store/slots.h:Slots": Large(
        "one write that a power failure may end anywhere: its phases share the positions in the flash" + IMAGE, members=22
    ),
    "firmware/update/include/update/receiver.h:Receiver": Large(
        "one image on its way into the flash: its phases share the positions" + IMAGE, members=21
    ),
    "host-sim/board/include/sim/world.h:World": Large(
        "owns the board, the motor, the line and what plays on them; the next event is the earliest of all",
        methods=63,
        members=31,
    ),
    "host-sim/mac_motor/include/sim/mac_motor.h:MacMotor": Large(
        "the motor's face to the line, MacTalk and the scenarios; what it does is in its parts already", methods=55
    ),
    "host-sim/mac_motor/include/sim/servo.h:Servo": Large(
        "the state of the regulators from sample to sample; a sample reads and writes most of it", members=28
    ),
    "host-sim/midi_module/include/sim/midi_module.h:MidiModule": Large(
        "the drive's face to the line and the scenarios, mostly one line each; inputs, supply and faults act on one motion",
        methods=62,
    ),
    "host-sim/midi_module/include/sim/midi_motion.h:MidiMotion": Large(
        "profile, encoder and shaft of one drive, which correct each other at every tick", methods=44, members=21
    ),
    "tools/sequence/language/token_stream.h:TokenStream": Large(
        "all that the parsers ask of the tokens, mostly one line each", methods=41
    ),
}
