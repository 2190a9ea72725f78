"""The firmware's image on an emulated BBC micro:bit: button A, its pins, and its flash kept through a power cut."""

import os

import machine
import user_line
import wire

INPUT_PINS = (18, 20, 23, 22, 21, 16)
OUTPUT_PINS = (4, 5, 12, 11)
BUTTON_A = 17
OUT, DIR = 0x5000_0504, 0x5000_0514
LOOP_TIME = 0x4000_8540  # TIMER0, CC[0]
STORAGE, FLASH_END, PAGE = 0x3B000, 0x40000, 1024
NVMC_CONFIG, NVMC_ERASEPAGE = 0x4001_E504, 0x4001_E508
READS, WRITES, ERASES = 0, 1, 2
SCRATCH = 0x2000_3F00  # RAM that the firmware does not use


class Microbit(machine.Emulated):
    """Started with button A held its line serves the user: this program connects to "user", in real time over a line with a
    speed (wire.py). Otherwise the motor's.

    Flash from `kept_from` on outlives power cuts; a reset writes the image again, so it must end before that."""

    def __init__(self, image, folder, fast=False, kept_from=STORAGE):
        super().__init__(image, folder)
        self.fast, self.kept_from, self.flash, self.wire = fast, kept_from, b"\xFF" * (FLASH_END - kept_from), None

    def start(self, motor=None):
        user = "user" if self.fast else "chip"
        line = f"socket,id=line,path={motor}" if motor else f"socket,id=line,{self.server(user)}"
        self.spawn("-M", "microbit", "-S", *(["-icount", "shift=5,sleep=off"] if self.fast else []),
                   "-chardev", line, "-serial", "chardev:line")
        self.pins = machine.Lines(self.path("pins"))
        self.fill_flash()
        self.go(held=motor is None)
        if motor is None:
            self.wire = wire.Wire(self.path("user"), self.path("chip")) if not self.fast else None
            line = user_line.UserLine(self.path("user"))
            line.read(user_line.FW_VERSION)
            line.close()
        return self

    def ask_pins(self, command):
        answer = self.pins.ask(command)
        assert answer.startswith("OK"), f"{command}: {answer}"
        return answer

    def fill_flash(self):
        """As a chip: erased by pages, then written."""
        self.ask_pins(f"writel {NVMC_CONFIG:#x} {ERASES}")
        for page in range(self.kept_from, FLASH_END, PAGE):
            self.ask_pins(f"writel {NVMC_ERASEPAGE:#x} {page:#x}")
        self.ask_pins(f"writel {NVMC_CONFIG:#x} {WRITES}")
        self.ask_pins(f"write {self.kept_from:#x} {len(self.flash):#x} 0x{self.flash.hex()}")
        self.ask_pins(f"writel {NVMC_CONFIG:#x} {READS}")

    def go(self, held):
        """A reset lets go of all pins, so the button is pressed before the core runs."""
        if held:
            self.drive(BUTTON_A, 0)
        self.monitor.do("cont")

    def reset(self):
        """With button A held."""
        self.monitor.do("stop")
        self.monitor.do("system_reset")
        self.monitor.wait_for("RESET")
        self.go(held=True)

    def stop_at_resets(self, on):
        """The board stands at its own resets until go_on_after_reset(), which presses the button again."""
        self.monitor.do("set-action", reboot="shutdown" if on else "reset", shutdown="pause" if on else "poweroff")

    def go_on_after_reset(self):
        if self.monitor.do("query-status")["running"]:
            return
        self.stop_at_resets(False)
        self.monitor.do("system_reset")
        self.monitor.wait_for("RESET")
        self.stop_at_resets(True)
        self.go(held=True)

    def cut_power(self):
        if self.process is None:
            return
        self.monitor.do("stop")
        self.flash = self.read_flash()
        super().cut_power()
        if self.wire:
            self.wire.close()
            self.wire = None

    def read_flash(self):
        return bytes.fromhex(self.ask_pins(f"read {self.kept_from:#x} {len(self.flash):#x}").split()[1][2:])

    def debugger(self):
        return super().debugger(SCRATCH)

    def endpoint(self):
        return "unix:" + self.path("user")

    def drive(self, pin, level):
        self.ask_pins(f"set_irq_in /machine/nrf51 unnamed-gpio-in {pin} {level}")

    def drive_input(self, number, level):
        self.drive(INPUT_PINS[number], level)

    def loop_time(self):
        """Microseconds since the start, as the firmware's loop read them last."""
        return self.word(LOOP_TIME)

    def outputs(self):
        """Levels; those of pins that are no outputs are 0."""
        levels = self.word(OUT) & self.word(DIR)
        return sum((levels >> pin & 1) << number for number, pin in enumerate(OUTPUT_PINS))
