"""An LM3S6965 whose flash can be written: qemu has neither its flash controller (registers that read 0) nor a flash that the
core could write. The debugger stands in for both: where the driver would order a word to be programmed or a page to be erased the
core stops, the debugger does it, and the core goes on behind. The registers' sequence itself is proved in tests/hal_mcu."""

import re
import struct
import subprocess
import threading

import machine
import wire

FLASH_END, PAGE = 0x40000, 1024
WRITE, ERASE = 1, 2
ORDERS = re.compile(r"^([0-9a-f]+) t nplc::hal_mcu::stellaris::Flash::order\(", re.MULTILINE)


def place_of_orders(image):
    """Where the driver gives an order: address, data and command are in r1 to r3."""
    names = subprocess.run(["arm-none-eabi-nm", "-C", image], check=True, capture_output=True, text=True).stdout
    return int(ORDERS.search(names)[1], 16)


class FlashController:
    """`flash` is what the chip holds, and changes with it. After `cut_after` commands power fails in the middle of the next."""

    def __init__(self, debugger, flash, places, end_power):
        self.debugger, self.flash, self.end_power = debugger, flash, end_power
        self.programmed, self.commands, self.cut_after, self.faults = set(), 0, None, []
        for page in range(0, FLASH_END, PAGE):
            self.show(page, PAGE)
        for place in places:
            debugger.command(f"Z1,{place:x},2", "OK")

    def show(self, address, size):
        """To the core."""
        self.debugger.command(f"M{address:x},{size:x}:{self.flash[address:address + size].hex()}", "OK")

    def run(self):
        """Until power fails."""
        try:
            while True:
                self.debugger.go_on()
                words = struct.unpack("<15I", bytes.fromhex(self.debugger.command("g", machine.HEX)[:120]))
                if self.commands == self.cut_after:
                    self.do(*words[1:4], half=True)
                    return self.end_power()
                self.do(*words[1:4])
                self.commands += 1
                self.debugger.jump(words[14] & ~1)
        except (AssertionError, OSError):
            return None

    def do(self, address, data, command, half=False):
        if command == ERASE and address % PAGE == 0:
            size = PAGE // 2 if half else PAGE
            self.flash[address : address + size] = b"\xFF" * size
            self.programmed -= set(range(address, address + PAGE))
            self.show(address, PAGE)
        elif command == WRITE and address % 4 == 0 and address not in self.programmed:
            self.programmed.add(address)
            old, = struct.unpack_from("<I", self.flash, address)
            struct.pack_into("<I", self.flash, address, old & (data | (0x0F0F0F0F if half else 0)))
            self.show(address, 4)
        else:
            self.faults.append(f"command {command} at {address:X}")


class Board(machine.Machine):
    """With a loader. What is in the flash outlives power cuts, and a reset as well: qemu writes the same loader again."""

    def __init__(self, loader, folder, flash, images):
        super().__init__(loader, folder)
        self.flash, self.places = bytearray(flash), [place_of_orders(image) for image in images]
        self.wire = self.controller = None

    def put(self, address, data):
        """Without power."""
        self.flash[address : address + len(data)] = data

    def server(self, name):
        return super().server("chip" if name == "user" else name)

    def spawn(self, *options):
        super().spawn("-S", *options)
        self.controller = FlashController(super().debugger(), self.flash, self.places, self.process.kill)
        self.thread = threading.Thread(target=self.controller.run, daemon=True)
        self.thread.start()
        self.wire = wire.Wire(self.path("user"), self.path("chip"))

    def cut_after(self, orders):
        """Power fails in the middle of the one that follows so many."""
        self.controller.cut_after = self.controller.commands + orders

    def wait_for_cut(self):
        self.process.wait(machine.LONG)

    def cut_power(self):
        if self.process is None:
            return
        super().cut_power()
        self.thread.join()
        self.controller.debugger.socket.close()
        self.wire.close()

    # Of a board that needs a button pressed at its start.

    def stop_at_resets(self, on):
        pass

    def go_on_after_reset(self):
        pass
