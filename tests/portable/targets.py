"""The programs of tools/portable, and how each system's are run on this one."""

import os
import platform
import shutil
import subprocess


class Target:
    """Programs of another system, and what this one needs to run them."""

    ending = ""
    runner = ()
    has_ui = True
    environment = None
    fmu_library = None
    programs = ("macreg", "nanoctl", "seqc")

    def __init__(self, folder):
        self.folder = os.path.abspath(folder)

    def missing(self):
        """Why the programs cannot be run here, or nothing."""
        return None

    def start(self):
        pass

    def stop(self):
        pass

    def file(self, program):
        return os.path.join(self.folder, f"{program}-{self.name}{self.ending}")

    def command(self, program):
        return [*self.runner, self.file(program)]


class Linux(Target):
    name = "linux-x86-64"
    machine = "x86-64"

    def missing(self):
        return None if platform.machine() == "x86_64" else "this machine is no x86-64"


class Arm(Target):
    name = "linux-aarch64"
    machine = "aarch64"
    runner = ("qemu-aarch64-static",)

    def missing(self):
        return None if shutil.which("qemu-aarch64-static") else "qemu-aarch64-static is missing (Debian: qemu-user-static)"


class Windows(Target):
    name = "windows-x86-64"
    ending = ".exe"
    has_ui = False
    programs = ("macreg", "seqc")
    WINE = "/usr/lib/wine"  # Debian's wine64 has no place in PATH

    def __init__(self, folder, scratch):
        super().__init__(folder)
        self.fmu_library = os.path.join(self.folder, "nanoplc-fmu-windows-x86-64.dll")
        self.prefix = os.path.join(scratch, "wine")
        path = os.environ["PATH"] + os.pathsep + self.WINE
        self.wine = shutil.which("wine64", path=path) or shutil.which("wine", path=path)
        self.runner = (self.wine,)
        self.environment = {
            **os.environ,
            "PATH": path,
            "HOME": scratch,
            "WINEPREFIX": self.prefix,
            "WINEDEBUG": "-all",
            "LC_ALL": "C.UTF-8",
            "WINEDLLOVERRIDES": "winemenubuilder.exe=d;mscoree,mshtml=",
        }
        self.environment.pop("DISPLAY", None)

    def missing(self):
        return None if self.wine else "wine is missing (Debian: wine64)"

    def start(self):
        """The server stays until stop(): one that a program starts would hold that program's pipes open."""
        self.quietly("wineserver", "-p")
        self.quietly(self.wine, "wineboot", "-i")

    def stop(self):
        """Only the server of our own prefix."""
        self.quietly("wineserver", "-k")

    def quietly(self, *command):
        subprocess.run(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, timeout=300, check=False)

    def connect_com(self, number, terminal):
        os.symlink(terminal, os.path.join(self.prefix, "dosdevices", f"com{number}"))
