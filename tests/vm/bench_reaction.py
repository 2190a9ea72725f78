#!/usr/bin/env python3
"""From an edge of an input line to the first byte on the motor's serial port: nanoplc, and the smallest C program that
does it, in turn on the virtual board. See --help."""

import argparse
import os
import re
import statistics
import subprocess
import sys

import board
from board_run import build, in_share
import gpio_sim
from nanoplc_test import commission

WANTED = {"median": 1.2, "p99": 1.5}
LINE = 0
QUIET = 3000  # us: of an order, or of the NOP that proves the line, from its first byte to the motor's answer
PRIORITY = 50
LONGEST_TURN = 1200  # s: of both programs; 200 clients with every instruction counted take most of it
# Answers each edge with one order. Commands by 001 section 2.7.
PROGRAM = """
PROGRAM Reaction
MOTOR MAC140;
VAR_INPUT Edge AT %IX0.0 : BOOL; END_VAR
POWER_UP NEXT := Low; END_POWER_UP
STEP Low:  OWN ERROR; IF Edge THEN RESET_ERROR; NEXT := High; END_IF END_STEP
STEP High: OWN ERROR; IF NOT Edge THEN RESET_ERROR; NEXT := Low; END_IF END_STEP
END_PROGRAM
"""
INPUTS = "\n".join(f'IN{i} = "CHIP:{i}"' for i in range(6))
OUTPUTS = "\n".join(f'OUT{i} = "CHIP:{6 + i}"' for i in range(4))
CONFIG = f"""
[service]
state_directory = "/tmp/state"
real_time_priority = {PRIORITY}
lock_memory = true
[[axis]]
name = "x"
table = "/share/reaction.bin"
[axis.motor]
port = "/tmp/motor"
[axis.user]
port = "unix:/tmp/x"
[axis.inputs]
{INPUTS}
[axis.outputs]
{OUTPUTS}
[axis.settings]
debounce = 0
on_start = true
"""
# The kernel's trace has the time of both ends: the interrupt of the line, and what is handed to the serial driver.
SCRIPT = gpio_sim.SCRIPT + """
mkdir -p /dev/pts
mount -t devpts none /dev/pts
mount -t tracefs none /sys/kernel/tracing
cd /sys/kernel/tracing
echo mono >trace_clock
echo 4096 >buffer_size_kb
echo 'p:uart pty_write' >kprobe_events
echo 'name ~ "nanoplc*" || name ~ "smallest"' >events/irq/irq_handler_entry/filter
echo 'comm == "nanoplc" || comm == "smallest"' >events/kprobes/uart/filter
echo 1 >events/irq/irq_handler_entry/enable
echo 1 >events/kprobes/uart/enable
cd /share
sed -i "s/CHIP/$simulated/" nanoplc.toml
run() {
    turn=$1; clients=$2; shift 2
    rm -rf /tmp/state  # the stop at the end of the turn before was not confirmed, its motor having gone
    cp -r state /tmp/state
    ./surroundings /tmp/motor $lines/sim_gpio0/pull EDGES &
    around=$!
    until [ -e /tmp/motor ]; do usleep 20000; done
    "$@" >said.$turn 2>&1 &
    pid=$!
    until grep -qE "$ready" said.$turn; do usleep 50000; kill -0 $pid || { cat said.$turn; exit 1; }; done
    if [ $clients -gt 0 ]; then
        ./clients /tmp/x $clients >clients.$turn 2>&1 &
        watchers=$!
        until grep -q connected clients.$turn; do usleep 50000; kill -0 $watchers || { echo clients; exit 1; }; done
    fi
    usleep 200000
    echo >/sys/kernel/tracing/trace
    kill -USR1 $around
    wait $around
    cat /sys/kernel/tracing/trace >trace.$turn
    rm /tmp/motor
    if [ $clients -gt 0 ]; then kill -0 $watchers && kill $watchers || { echo clients; exit 1; }; fi
    kill $pid
    wait $pid
    echo "turn $turn"
}
"""


def script(options):
    lines = [SCRIPT.replace("EDGES", str(options.edges))]
    for turn in range(options.turns):
        lines.append(f"ready='the sequence runs' run {2 * turn} {options.clients} ./nanoplc --config nanoplc.toml")
        lines.append(f"ready=ready run {2 * turn + 1} 0 ./smallest /dev/$simulated {LINE} /tmp/motor {PRIORITY}")
    return "\n".join([*lines, "exit 0"]) + "\n"


def reactions(trace):
    """Microseconds, one for each edge that was answered, and how many were not. `trace`: of the kernel. An edge that comes
    while the motor may still be busy with the last order does not count; on a busy machine some do."""
    found, missed, edge, last = [], 0, None, 0
    for line in trace.splitlines():
        match = re.search(r"\s(\d+)\.(\d{6}): (irq_handler_entry|uart):", line)
        if not match:
            continue
        at = int(match.group(1)) * 1_000_000 + int(match.group(2))
        if match.group(3) == "irq_handler_entry":
            missed += edge is not None
            edge = at if at - last >= QUIET else None
        elif edge is not None:
            found.append(at - edge)
            edge = None
        last = at
    return found, missed + (edge is not None)


def p99(values):
    return sorted(values)[max(0, -(-len(values) * 99 // 100) - 1)]


def report(share, options):
    all_of = {"nanoplc": [], "smallest": []}
    missed = dict.fromkeys(all_of, 0)
    for turn in range(2 * options.turns):
        name = ("nanoplc", "smallest")[turn % 2]
        with open(os.path.join(share, f"trace.{turn}"), encoding="utf-8") as file:
            found, unanswered = reactions(file.read())
        all_of[name] += found
        missed[name] += unanswered
    figures = {}
    for name, values in all_of.items():
        figures[name] = {"median": statistics.median_grouped(values), "p99": p99(values)}
        print(f"{name:9} {len(values)} edges, {missed[name]} unanswered: median {figures[name]['median']:.1f} us, "
              f"99th percentile {figures[name]['p99']:.0f} us, longest {max(values)} us")
    kept = True
    for figure, most in WANTED.items():
        ratio = figures["nanoplc"][figure] / figures["smallest"][figure]
        kept = kept and ratio <= most
        print(f"{figure:9} ratio {ratio:.2f}, wanted at most {most}")
    return kept


def run(phases, share, options):
    board.prepare()
    if not gpio_sim.prepare():
        raise board.CannotBeHad
    phases.say("building nanoplc for the board")
    build(share, options.preset, {"nanoplc": "nanoplc"}, targets=["nanoplc"])
    for program in ("clients", "smallest", "surroundings"):
        subprocess.run(["aarch64-linux-gnu-gcc", "-Os", "-Wall", "-Wextra", "-Werror", "-static",
                        f"{board.HERE}/guest/{program}.c", "-o", f"{share}/{program}"], check=True)
    with open(f"{share}/reaction.seq", "w", encoding="utf-8") as file:
        file.write(PROGRAM)
    subprocess.run([options.seqc, "build", f"{share}/reaction.seq", "-o", f"{share}/reaction.bin"], check=True,
                   stdout=subprocess.DEVNULL)
    commission(f"{share}/state", "x")
    with open(f"{share}/nanoplc.toml", "w", encoding="utf-8") as file:
        file.write(CONFIG)
    phases.say("starting the board")
    with board.Board(share, script(options), more=options.more) as machine:
        assert machine.finish(options.turns * LONGEST_TURN) == 0
    phases.say("measured")
    return 0 if report(share, options) or options.check else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seqc")
    parser.add_argument("--edges", type=int, default=100, help="in each turn (default: %(default)s)")
    parser.add_argument("--turns", type=int, default=10, help="of each program (default: %(default)s)")
    parser.add_argument("--clients", type=int, default=0, help="connected to nanoplc's port (default: %(default)s)")
    parser.add_argument("--check", action="store_true", help="only whether it can be measured; the figures do not count")
    parser.add_argument("--instructions", action="store_true",
                        help="the board's clock counts instructions, 2 ns each, whatever else this machine does")
    parser.add_argument("--preset", default="portable-aarch64", help="nanoplc is built with (default: %(default)s)")
    options = parser.parse_args()
    options.more = ["-icount", "shift=1,sleep=off"] if options.instructions else []
    return in_share(run, options)


if __name__ == "__main__":
    sys.exit(main())
