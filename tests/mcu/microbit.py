"""The firmware's image on an emulated BBC micro:bit: button A, its pins, and its flash kept through a power cut."""

import os

import machine
import user_line

INPUT_PINS = (18, 20, 23, 22, 21, 16)
OUTPUT_PINS = (4, 5, 12, 11)
BUTTON_A = 17
OUT, DIR = 0x5000_0504, 0x5000_0514
LOOP_TIME = 0x4000_8540  # TIMER0, CC[0]
STORAGE, STORAGE_BYTES, PAGE = 0x3B000, 20 * 1024, 1024
NVMC_CONFIG, NVMC_ERASEPAGE = 0x4001_E504, 0x4001_E508
READS, WRITES, ERASES = 0, 1, 2
SCRATCH = 0x2000_3F00  # RAM that the firmware does not use


class Microbit(machine.Emulated):
    """Started with button A held its line serves a person: this program connects to "user". Otherwise the motor's."""

    def __init__(self, image, folder, fast=False):
        super().__init__(image, folder)
        self.fast, self.flash = fast, b"\xFF" * STORAGE_BYTES

    def start(self, motor=None):
        line = f"socket,id=line,path={motor}" if motor else f"socket,id=line,{self.server('user')}"
        self.spawn("-M", "microbit", "-S", *(["-icount", "shift=5,sleep=off"] if self.fast else []),
                   "-chardev", line, "-serial", "chardev:line")
        self.pins = machine.Lines(self.path("pins"))
        self.fill_flash()
        self.go(held=motor is None)
        if motor is None:
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
        for page in range(STORAGE, STORAGE + STORAGE_BYTES, PAGE):
            self.ask_pins(f"writel {NVMC_ERASEPAGE:#x} {page:#x}")
        self.ask_pins(f"writel {NVMC_CONFIG:#x} {WRITES}")
        self.ask_pins(f"write {STORAGE:#x} {STORAGE_BYTES:#x} 0x{self.flash.hex()}")
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

    def cut_power(self):
        if self.process is None:
            return
        self.monitor.do("stop")
        self.flash = bytes.fromhex(self.ask_pins(f"read {STORAGE:#x} {STORAGE_BYTES:#x}").split()[1][2:])
        super().cut_power()

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
