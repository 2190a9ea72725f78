#!/usr/bin/env python3
"""midisim on a real CAN interface: cansend as a foreign master on the other controller of the bus, then macreg; candump's
log held against frames of 003.

usage: midisim_test.py

Fetches and builds what is missing. 77: the virtual board is not to be had; the reason is printed.
"""

import sys

import board
from board_run import build, in_share

# Two modules; `ask` sends a frame and waits for the answer, `reach` repeats it until the answer is the expected one.
SCRIPT = """
export PATH=$PATH:/usr/bin
for one in can0 can1; do /usr/bin/ip link set $one type can bitrate 125000 && /usr/bin/ip link set $one up || exit 1; done
/usr/bin/candump -L can1 >log &
until grep -q '^ *can1 ' /proc/net/can/rcvlist_all; do :; done
./midisim --can can0 --unit MAC34-2:2 --eeprom eeprom >out 2>&1 &
module=$!
seen() { tries=0; until grep -q "$1" "$2"; do tries=$((tries + 1)); [ $tries -lt 3000 ] || { echo "no $1"; exit 1; }; done; }
ask() { /usr/bin/cansend can1 "$1"; seen "$2" log; }
reach() { tries=0; until grep -q "$2" log; do tries=$((tries + 1)); [ $tries -lt 3000 ] || { echo "no $2"; exit 1; }
    /usr/bin/cansend can1 "$1"; done; }
seen '^ready$' out
seen '701#00' log
seen '702#00' log
ask 602#23132000000003E8 582#6013200000000000
reach 602#4000200000000000 582#42002000000003E8
ask 601#2310200000000000 581#6010200000000000
ask 601#23132000FFFFFC18 581#6013200000000000
/usr/bin/cansend can1 080#
reach 601#4000200000000000 581#42002000FFFFFC18
ask 601#400820AF00000000 581#420820AF80000000
ask 602#2304200000000000 582#8004200000000000
ask 600#2318200000000000 581#6018200000000000
/usr/bin/candump -L can1 >log2 &
until [ $(grep -c '^ *can1 ' /proc/net/can/rcvlist_all) -gt 1 ]; do :; done
m() { ./macreg --port can:can1 --patience 2000 --json midi --model MAC34-1 "$@" >>said 2>&1 || { echo "macreg $*"; cat said; exit 1; }; }
m set SPEED 300rpm TORQUE 50%
m --address 2 move 0
m raw 01200000000000
m together 1=100 2=-100
m circle --axes 1,2 --radius 1000 --speed 1000inc/s --segment 250ms
m --address 2 get POSITION
# 003 §V.5: not with two on the bus.
./macreg --port can:can1 --yes midi address set 9 2>&1 | grep -q "several modules answered" || { echo "two got one address"; exit 1; }
./macreg --port can:can9 midi status 2>&1 | grep -q "there is no interface 'can9'" || { echo "can9"; exit 1; }
kill -TERM $module
wait $module || { echo "midisim ended with $?"; cat out; exit 1; }
# A module alone, on an interface of its own: its address, a restart, the factory's parameters.
/usr/bin/ip link add vcan0 type vcan && /usr/bin/ip link set vcan0 up || exit 1
/usr/bin/candump -L vcan0 >log3 &
until grep -q '^ *vcan0 ' /proc/net/can/rcvlist_all; do :; done
./midisim --model MAC34-1 --can vcan0 >out3 2>&1 &
module=$!
seen '^ready$' out3
export MACREG_PORT=can:vcan0 MACREG_MIDI_MODEL=MAC34-1
v() { ./macreg --patience 2000 --yes midi "$@" >>said 2>&1 || { echo "macreg $*"; cat said; exit 1; }; }
v address set 9
v --address 9 reset
v --address 9 factory
kill -TERM $module
wait $module
# The worked example of tools/macreg/README.md.
./midisim --model MAC34-1 --unit MAC34-1:2 --can vcan0 >out4 2>&1 &
module=$!
seen '^ready$' out4
# A board that is held up for 20 ms ends it, as it should.
for try in 1 2 3; do
    ./macreg midi circle --axes 1,2 --radius 1rev --speed 2rev/s --acceleration 4rev/s2 --segment 50ms >out5 2>said && break
done
cat out5
grep -q '^done in 3.64 s: axis 1 at .* inc, axis 2 at .* inc$' out5 || { cat said; exit 1; }
kill -TERM $module
wait $module
# Two modules at one address: nothing that moves is sent. The question of firmware/boards/linux/FIRST_START.md, by its words.
./midisim --model MAC34-1 --can vcan0 --eeprom one >out6 2>&1 &
first=$!
seen '^ready$' out6
candump -n 1 -T 2000 vcan0,581:7FF & sleep 0.5; cansend vcan0 601#4000200000000000; wait $! && echo asked
./midisim --model MAC34-1 --can vcan0 --eeprom other >out7 2>&1 &
second=$!
seen '^ready$' out7
for words in "move 1rev" "jog 60rpm --for 1s" "together 1=1rev" "power on"; do
    ./macreg midi $words >said 2>&1 && { echo "two moved: $words"; exit 1; }
    grep -q "more than one module answers to address 1" said || { cat said; exit 1; }
done
./macreg midi why | grep -q "More than one module answers to address 1" || { echo "why"; exit 1; }
kill -TERM $second
wait $second
# A plant's SYNC every 10 ms: nothing begins together with it, and a circle from where the axes stand ends where it began.
./midisim --model MAC34-1 --address 2 --can vcan0 >out8 2>&1 &
second=$!
seen '^ready$' out8
/usr/bin/cangen vcan0 -g 10 -I 080 -L 0 &
plant=$!
./macreg midi together 1=1rev 2=1rev >said 2>&1 && { echo "together with a SYNC"; exit 1; }
grep -q "another master on the bus sends SYNC" said || { cat said; exit 1; }
for try in 1 2 3; do
    ./macreg midi circle --axes 1,2 --radius 1000 --speed 1000inc/s --segment 250ms >out9 2>said && break
done
grep -q '^done in ' out9 || { cat said; exit 1; }
kill $plant
kill -TERM $second
wait $second
./macreg midi --address 1 move 100 || exit 1
kill -TERM $first
wait $first
grep -q '^position = 100$' one && ! grep -q '^position = [^0]' other || { cat one other; exit 1; }
grep -q '^position = 100$' eeprom && grep -q '^position = -100$' eeprom.2 || { cat eeprom*; exit 1; }
"""

# What is left of the log without the questions for positions: 003 §V.2, §V.4, §V.6 to §V.8, §VII.
EXPECTED = """701#00 702#00
602#23132000000003E8 582#6013200000000000
601#2310200000000000 581#6010200000000000
601#23132000FFFFFC18 581#6013200000000000
080#
601#400820AF00000000 581#420820AF80000000
602#2304200000000000 582#8004200000000000
600#2318200000000000 581#6018200000000000""".split()


# Of macreg: 003 §VII 0Dh (300 rpm: A0h), 0Ch, 10h, 13h (64h, -64h), §V.4; what starts the circle, 1Eh to all.
MACREG = """601#230D2000000000A0 601#230C200000000040
602#2313200000000000
601#2310200000000000 601#2313200000000064
602#2310200000000000 602#23132000FFFFFF9C
080#""".split()


# 003 §V.5: the address; §VII 00h and 01h: the answer, then the boot-up, after 01h with the factory's address.
ALONE = """701#00
7E5#0401000000000000 7E5#1109000000000000 7E4#1100000000000000 7E5#0400000000000000 709#00
609#4004200000000000 589#4204200000000704
609#2300200000000000 589#6000200000000000 709#00
609#4004200000000000 589#4204200000000704
609#4001200000000000 589#4201200000000000
609#2301200000000000 589#6001200000000000 701#00
601#4004200000000000 581#4204200000000704""".split()


def is_position(frame):
    return frame[4:12] in ("40002000", "42002000")


def frames_of(share, name):
    with open(f"{share}/{name}", encoding="ascii") as file:
        return [line.split()[2] for line in file]


def run(phases, share):
    board.prepare()
    phases.say("building midisim and macreg for the board")
    build(share, "board", {"midisim": "midisim", "macreg": "macreg"}, targets=["midisim", "macreg"])
    with board.Board(share, SCRIPT) as machine:
        status = machine.finish()
    phases.say(f"the board is off, with status {status}")
    seen = [frame for frame in frames_of(share, "log") if not is_position(frame)]
    if seen[:len(EXPECTED)] != EXPECTED:
        print(f"vm: the bus had {seen}\nand not {EXPECTED}")
        return 1
    sent = [frame for frame in frames_of(share, "log2") if frame[:6] in ("601#23", "602#23", "600#23", "080#")]
    if sent[:len(MACREG)] != MACREG or not sent[len(MACREG)].startswith("600#231E2000"):
        print(f"vm: macreg sent {sent}\nand not {MACREG}")
        return 1
    alone = frames_of(share, "log3")
    if alone[:len(ALONE)] != ALONE:
        print(f"vm: the module alone had {alone[:len(ALONE)]}\nand not {ALONE}")
        return 1
    return status


if __name__ == "__main__":
    sys.exit(in_share(run))
