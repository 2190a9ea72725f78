#!/usr/bin/env python3
"""The package in a Debian with systemd: installed with its scripts, started, stopped, killed, hung, upgraded, removed, purged.

usage: systemd_test.py MACSIM SEQC EXAMPLE.seq

A virtual board in qemu with Debian for arm64, and a virtual motor outside of it. Fetches and builds what is missing. 77: the
board is not to be had; the reason is printed.
"""

import glob
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import debian
import image  # of tests/vm
from nanoplc_test import join, simulator  # of tests/vm

ROOT = os.path.join(debian.HERE, "..", "..")
PACKAGES = os.path.join(ROOT, "build", "board", "package")
SETTINGS = "/etc/nanoplc/nanoplc.toml"
STORE = "/var/lib/nanoplc/x/store.bin"
CONFIG = b"""
[service]
real_time_priority = 50
lock_memory = true
[[axis]]
name = "x"
[axis.motor]
port = "/dev/ttyS0"
[axis.user]
port = "unix:/run/nanoplc/x"
[axis.inputs]
IN0 = "IN_START"
[axis.outputs]
OUT0 = "OUT_GRIP"
[axis.settings]
motor_silence = 200  # the board is emulated, and whoever emulates it busy
"""
# One line, named in two ways.
DOUBLED = CONFIG.replace(b'"OUT_GRIP"', b'"gpiochip0:0"')
NANOCTL = "nanoctl --port unix:/run/nanoplc/x --patience 5000"
# What a program may open for reading and writing.
PROBE = b"""
for file in /dev/gpiochip0 /dev/ttyS3 /dev/cpu_dma_latency /etc/nanoplc/x /home/x; do
    if (: <>$file) 2>/dev/null; then echo $file open; else echo $file closed; fi
done
"""
RUNS = f"{NANOCTL} --json status | grep '\"state\":\"running\"'"


def built():
    """The package for arm64."""
    subprocess.run([os.path.join(ROOT, "tools", "sysroot"), "arm64"], check=True)
    shutil.rmtree(PACKAGES, ignore_errors=True)
    building = ["cmake", "--build", "--preset", "board", "--parallel", "2", "--target", "debian_package"]
    for step in (["cmake", "--preset", "board"], building):
        done = subprocess.run(step, cwd=ROOT, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}{done.stderr}\n{' '.join(step)} failed")
    return glob.glob(os.path.join(PACKAGES, "nanoplc_*_arm64.deb"))[0]


def next_version(package, folder):
    """As the next release may be: another program, and other settings as its example."""
    tree, made = os.path.join(folder, "tree"), os.path.join(folder, "next.deb")
    subprocess.run(["dpkg-deb", "-R", package, tree], check=True)
    control = os.path.join(tree, "DEBIAN", "control")
    with open(control, encoding="utf-8") as file:
        text = file.read()
    with open(control, "w", encoding="utf-8") as file:
        file.write(re.sub(r"(?m)^Version: .*$", "Version: 99", text))
    with open(tree + SETTINGS, "a", encoding="utf-8") as file:
        file.write("# of version 99\n")
    subprocess.run(["dpkg-deb", "--root-owner-group", "-b", tree, made], check=True, stdout=subprocess.DEVNULL)
    return made


def softdog():
    """The kernel's own watchdog, and what loads it."""
    [module] = glob.glob(os.path.join(image.VM, "kernel/lib/modules/*/kernel/drivers/watchdog/softdog.ko"))
    return {"/test/softdog.ko": module, "/test/busybox": os.path.join(image.VM, "root/bin/busybox")}


class Machine:
    """The board, started once for all steps."""

    def __init__(self, macsim, seqc, source):
        self.folder = tempfile.TemporaryDirectory(prefix="systemd")
        package = built()
        table, endpoint = self.path("table.bin"), self.path("motor")
        subprocess.run([seqc, "build", source, "-o", table], check=True, stdout=subprocess.DEVNULL)
        self.motor, _ = simulator.start(macsim, "--model", "MAC140", "--fastmac", "unix:" + endpoint)
        self.board = debian.Debian(self.folder.name, {
            "/test/nanoplc.deb": package, "/test/next.deb": next_version(package, self.folder.name), "/test/table.bin": table,
            "/test/nanoplc.toml": CONFIG, "/test/doubled.toml": DOUBLED, "/test/probe": PROBE, **softdog()}, serials=["motor"]).__enter__()
        line = socket.socket(socket.AF_UNIX)
        line.connect(endpoint)
        join(self.board.serials["motor"], line)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def end(self):
        self.board.__exit__()
        self.motor.terminate()
        self.motor.wait()
        self.motor.stdout.close()
        self.motor.stderr.close()
        self.folder.cleanup()


class Systemd(unittest.TestCase):
    """The steps build on each other: they are run by their numbers, and end at the first that fails."""

    def run_there(self, command, expected=0):
        status, text = MACHINE.board.run(command)
        self.assertEqual(status, expected, f"{command}\n{text}")
        return text

    def until(self, what, command):
        return MACHINE.board.until(what, command)

    def shown(self, name):
        return self.run_there(f"systemctl show -P {name} nanoplc")

    def journal(self, more=""):
        return self.run_there(f"journalctl -u nanoplc -o cat --no-pager {more}")

    def until_said(self, words):
        self.until(f"'{words}' in the journal", f"journalctl -u nanoplc -o cat --no-pager | grep -F '{words}'")

    def until_runs_anew(self, before):
        self.until("another process", f'p=$(systemctl show -P MainPID nanoplc); [ "$p" != 0 -a "$p" != {before} ] '
                   "&& systemctl is-active nanoplc")

    def test_1_installing_makes_the_user_and_starts_nothing(self):
        self.assertIn("systemctl enable --now nanoplc", self.run_there("dpkg -i /test/nanoplc.deb"))
        self.assertEqual(self.run_there("dpkg --status nanoplc | grep ^Status"), "Status: install ok installed")
        self.assertRegex(self.run_there("getent passwd nanoplc"), "^nanoplc:x:[0-9]+:[0-9]+:.*:/var/lib/nanoplc:/usr/sbin/nologin$")
        self.assertEqual(self.run_there("systemctl is-active nanoplc", 3), "inactive")
        self.assertEqual(self.run_there("systemctl is-enabled nanoplc", 1), "disabled")
        self.until("the udev rule at work", "[ $(stat -c %G:%a /dev/gpiochip0) = gpio:660 ]")
        wrong = self.run_there("nanoplc check-config /test/doubled.toml", 3)
        self.assertIn("gpiochip0:0 is /dev/gpiochip0:0, which axis[x].inputs.IN0 in line", wrong)
        self.assertEqual(len(wrong.splitlines()), 1, wrong)

    def test_2_the_service_starts_as_its_own_user(self):
        self.run_there(f"cp /test/nanoplc.toml {SETTINGS}")
        self.run_there("systemctl enable --now nanoplc")
        self.assertEqual(self.shown("ActiveState"), "active")
        pid = self.shown("MainPID")
        self.assertEqual(self.run_there(f"stat -c %U:%G /proc/{pid}"), "nanoplc:nanoplc")
        self.assertIn("Active: active (running)", self.run_there("systemctl status nanoplc"))
        self.until_said("x: the motor answers on /dev/ttyS0")
        self.until("what it does in systemctl's status", "systemctl show -P StatusText nanoplc | grep -x 'x stopped'")
        self.assertEqual(self.run_there("stat -c %U:%G:%a /var/lib/nanoplc /run/nanoplc /run/nanoplc/x").splitlines(),
                         ["nanoplc:nanoplc:755", "nanoplc:nanoplc:755", "nanoplc:nanoplc:660"])

    def test_3_the_journal_has_levels(self):
        said = self.run_there("journalctl -u nanoplc _COMM=nanoplc -o json --output-fields=PRIORITY,MESSAGE --no-pager")
        levels = {line["MESSAGE"]: line["PRIORITY"] for line in map(json.loads, said.splitlines())}
        self.assertEqual(levels["started with 1 axis"], "5", said)
        self.assertEqual(levels["x: has no table; upload one with `nanoctl upload`"], "6", said)

    def test_3_the_journal_can_be_searched(self):
        self.assertIn("the motor answers", self.run_there("journalctl NANOPLC_AXIS=x NANOPLC_EVENT=motor_answers -o cat --no-pager"))

    def test_4_hardened_as_declared(self):
        rated = self.run_there("systemd-analyze security nanoplc --no-pager")
        exposure = re.search(r"Overall exposure level for nanoplc.service: ([0-9.]+)", rated).group(1)
        print(f"exposure of the running service by systemd-analyze: {exposure} of 10", flush=True)
        self.assertLess(float(exposure), 2.0)
        status = self.run_there(f"cat /proc/{self.shown('MainPID')}/status")
        for wanted in ("NoNewPrivs:\t1", "Seccomp:\t2", "CapEff:\t0000000000000000", "CapBnd:\t0000000000000000"):
            self.assertIn(wanted, status)

    def test_4_only_its_devices_and_folders(self):
        """Another program in the service's place. Modes would let it in everywhere."""
        self.run_there("chmod 666 /dev/gpiochip0 /dev/ttyS3 /dev/cpu_dma_latency; chmod 777 /etc/nanoplc /home")
        free = self.run_there("su -s /bin/sh nanoplc /test/probe").splitlines()
        self.assertEqual([line.split()[-1] for line in free], ["open"] * 5, free)
        self.run_there("sed -e 's,^ExecStart=.*,ExecStart=/bin/sh /test/probe,' -e 's,^Type=.*,Type=oneshot,' "
                       "-e '/^ExecStopPost/d; /^Restart/d; /^Watchdog/d; /^RuntimeDirectory/d' -e '/^ExecStart/aStandardOutput=file:/run/probed' "
                       "/lib/systemd/system/nanoplc.service >/run/systemd/system/probe.service")
        self.run_there("systemctl daemon-reload; systemctl start probe")
        confined = dict(line.split() for line in self.run_there("cat /run/probed").splitlines())
        self.assertEqual(confined, {"/dev/gpiochip0": "open", "/dev/ttyS3": "open", "/dev/cpu_dma_latency": "closed",
                                    "/etc/nanoplc/x": "closed", "/home/x": "closed"})

    def test_5_nanoctl_talks_to_it_and_it_runs(self):
        self.run_there(f"{NANOCTL} upload /test/table.bin --run")
        self.assertIn('"state":"running"', self.run_there(f"{NANOCTL} --json status"))
        self.assertEqual(self.run_there(f"stat -c %U {STORE}"), "nanoplc")

    def test_6_stop_and_restart_are_orderly(self):
        self.run_there("systemctl stop nanoplc")
        self.assertEqual(self.shown("Result"), "success")
        self.assertEqual(self.shown("ExecMainStatus"), "0")
        self.assertIn("ends: Terminated", self.journal())
        self.assertNotIn("may be moving", self.journal())
        self.assertTrue(self.run_there("cat /var/lib/nanoplc/x/running").startswith("ended/2 "))
        for step in ("start", "restart"):
            self.run_there(f"systemctl {step} nanoplc")
            self.until("the sequence by itself", RUNS)
        self.assertNotIn("did not end in order", self.journal())

    def waits_for_run(self):
        self.until_said("x: SAFE: the last run did not end in order")
        status = self.until("an answer", f"{NANOCTL} --json status")
        self.assertIn('"state":"stopped"', status)
        self.assertIn('"safe_reason":"watchdog"', status)
        self.until("the run", f"{NANOCTL} run")

    def test_7_killed_it_comes_back_and_waits(self):
        pid = self.shown("MainPID")
        self.run_there("systemctl kill -s KILL nanoplc")
        self.until_runs_anew(pid)
        self.waits_for_run()
        self.assertEqual(self.shown("NRestarts"), "1")

    def test_8_hung_it_is_ended_and_comes_back(self):
        self.assertEqual(self.shown("WatchdogUSec"), "5s")
        self.run_there("mkdir -p /run/systemd/system/nanoplc.service.d; printf '[Service]\\nWatchdogSec=2\\n"
                       "TimeoutAbortSec=1\\n' >/run/systemd/system/nanoplc.service.d/test.conf")
        self.run_there("systemctl daemon-reload; systemctl restart nanoplc; journalctl --rotate --vacuum-time=1s")
        pid = self.shown("MainPID")
        self.run_there(f"kill -STOP {pid}")
        self.until("the watchdog", "journalctl -u nanoplc -o cat --no-pager | grep -F 'Watchdog timeout'")
        self.until_runs_anew(pid)
        self.waits_for_run()

    def pings(self):
        """How often the watchdog has been fed, as the kernel counts it."""
        return int(self.run_there("awk '$1 == \"fed\" { print $2 }' /sys/kernel/tracing/kprobe_profile"))

    def watchdog_is(self, state):
        self.until(f"a watchdog that is {state}", f"grep -x {state} /sys/class/watchdog/watchdog0/state")

    def test_8_the_boards_watchdog_is_fed_and_disarmed(self):
        """By the kernel's softdog, told to reset nothing."""
        self.run_there("mount -t tracefs none /sys/kernel/tracing && /test/busybox insmod /test/softdog.ko soft_noboot=1")
        self.until("the udev rule at work", "[ $(stat -c %G:%a /dev/watchdog) = gpio:660 ]")
        self.assertEqual(self.run_there("cat /sys/class/watchdog/watchdog0/identity"), "Software Watchdog")
        self.watchdog_is("inactive")
        self.run_there("echo 'p:fed softdog_ping' >/sys/kernel/tracing/kprobe_events && "
                       "echo 1 >/sys/kernel/tracing/events/kprobes/fed/enable")
        self.run_there(f"cp {SETTINGS} /test/before.toml; sed -i '/^\\[service\\]/awatchdog_device = \"/dev/watchdog\"' {SETTINGS}")
        self.run_there("systemctl restart nanoplc")
        self.until("the sequence", RUNS)
        pid = self.shown("MainPID")
        self.assertEqual(self.run_there(f"stat -c %U /proc/{pid}"), "nanoplc")
        self.assertIn("/dev/watchdog", self.run_there(f"ls -l /proc/{pid}/fd").split())
        self.watchdog_is("active")
        before = self.pings()
        self.until("two more feeds", f"[ $(awk '{{ print $2 }}' /sys/kernel/tracing/kprobe_profile) -gt {before + 1} ]")
        self.run_there("systemctl stop nanoplc")
        self.assertEqual(self.shown("Result"), "success")
        self.watchdog_is("inactive")
        self.assertNotIn("cannot be stopped", self.journal())
        self.run_there(f"cp /test/before.toml {SETTINGS}; systemctl start nanoplc")
        self.until("the sequence", RUNS)
        self.watchdog_is("inactive")

    def test_9_an_upgrade_keeps_what_is_there_and_a_moving_machine(self):
        self.run_there(f"echo '# mine' >>{SETTINGS}; sha256sum {STORE} {SETTINGS} >/test/sums")
        pid = self.shown("MainPID")
        self.assertIn("systemctl restart nanoplc", self.run_there("dpkg --force-confold -i /test/next.deb"))
        self.assertEqual(self.shown("MainPID"), pid)
        self.run_there("sha256sum --check /test/sums")
        self.assertIn("# of version 99", self.run_there(f"cat {SETTINGS}.dpkg-dist"))
        self.run_there("systemctl restart nanoplc")
        self.until("the sequence", RUNS)
        self.run_there("sha256sum --check /test/sums")

    def test_a_removal_stops_it_and_keeps_tables_and_settings(self):
        pid = self.shown("MainPID")
        self.run_there("dpkg -r nanoplc")
        self.run_there(f"test ! -e /proc/{pid}")
        self.run_there("sha256sum --check /test/sums")
        self.run_there("test ! -e /usr/sbin/nanoplc -a ! -e /etc/systemd/system/multi-user.target.wants/nanoplc.service")
        self.run_there("dpkg --force-confold -i /test/nanoplc.deb; systemctl start nanoplc")
        self.until("the sequence", RUNS)

    def test_b_a_purge_leaves_nothing(self):
        self.run_there("dpkg -P nanoplc")
        self.run_there("test ! -e /etc/nanoplc/nanoplc.toml -a ! -e /var/lib/nanoplc")
        self.assertEqual(self.run_there("dpkg-query -W nanoplc 2>/dev/null", 1), "")


MACHINE = None


def main():
    global MACHINE  # pylint: disable=global-statement
    start = time.monotonic()
    try:
        debian.prepare()
    except debian.CannotBeHad:
        print("systemd: skipped, for packages cannot be downloaded (see above)")
        return 77
    MACHINE = Machine(*sys.argv[1:4])
    print(f"systemd: the board is up (after {time.monotonic() - start:.0f} s)", flush=True)
    try:
        return 0 if unittest.main(argv=sys.argv[:1], failfast=True, exit=False, verbosity=2).result.wasSuccessful() else 1
    finally:
        MACHINE.end()


if __name__ == "__main__":
    sys.exit(main())
