"""A zsh at a terminal, to see what it completes."""

import os
import pty
import select
import signal
import time

LONG = 60  # timeout in seconds of what must come


class Zsh:
    """With the completion script in `folder` as _PROGRAM."""

    def __init__(self, folder):
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.environ.update(TERM="dumb", ZDOTDIR=folder)
            os.execvp("zsh", ["zsh", "-f", "-i"])
        self.type(f"PS1=; fpath=({folder} $fpath); autoload -Uz compinit; compinit -u -D; echo rea''dy\n")
        self.until("ready\r\n")

    def type(self, text):
        os.write(self.fd, text.encode())

    def until(self, wanted):
        """What it writes until `wanted` stands there, or until time is up."""
        text = ""
        end = time.monotonic() + LONG
        while wanted not in text and time.monotonic() < end:
            if select.select([self.fd], [], [], 0.2)[0]:
                text += os.read(self.fd, 4096).decode(errors="replace")
        return text

    def completes(self, words, wanted):
        """Does the tab key behind `words` make them `wanted`? The line is wiped afterwards."""
        self.type(words + "\t")
        text = self.until(wanted)
        self.type("\x15")
        return wanted in text

    def close(self):
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.fd)
