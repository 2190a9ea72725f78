"""A GPIO chip of 32 lines on the virtual board: the kernel's own simulated one, which fetch_gpio_sim builds."""

import os
import subprocess
import threading

import board
import image

LINES = 32
# $lines is where its lines are: $lines/sim_gpio3/pull is a hand on line 3, .../value what is on it.
SCRIPT = f"""
modprobe -a configfs board_gpio || exit 1
mount -t configfs none /sys/kernel/config
bank=/sys/kernel/config/gpio-sim/board/bank
mkdir -p $bank
echo {LINES} >$bank/num_lines
echo board >$bank/label
echo 1 >$bank/../live
lines=/tmp/lines
ln -s /sys/devices/platform/$(cat $bank/../dev_name)/$(cat $bank/chip_name) $lines
simulated=$(cat $bank/chip_name)
"""
# Obeys a Hand at a serial port.
AGENT = """
hand() {
    stty raw -echo <$1
    exec 3<>$1
    echo hello >&3
    while read order line level <&3; do
        case $order in
            set) echo $level >$lines/sim_gpio$line/pull; echo ok >&3 ;;
            get) read level <$lines/sim_gpio$line/value; echo $level >&3 ;;
        esac
    done
}
"""


def prepare():
    """False: it cannot be had, and the reason was printed."""
    done = subprocess.run([os.path.join(image.HERE, "fetch_gpio_sim")], check=False)
    if done.returncode not in (0, 77):
        raise RuntimeError("tests/vm/fetch_gpio_sim failed")
    return done.returncode == 0


class Hand:
    """Drives and reads the lines from outside, as Board does with its own chip. `port`: the other end of what hand() has."""

    def __init__(self, port):
        self._lines = board.Lines(port)
        self._lock = threading.Lock()
        assert self._lines.hear() == "hello"

    def set_input(self, line, level):
        assert self._ask(f"set {line} {'pull-up' if level else 'pull-down'}") == "ok"

    def output(self, line):
        return int(self._ask(f"get {line}"))

    def _ask(self, words):
        with self._lock:
            self._lines.tell(words)
            return self._lines.hear()
