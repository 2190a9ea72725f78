"""The virtual board of tests/vm with Debian on it, systemd as its first process, in memory: each start is a fresh one.

    with debian.Debian(share, files={"/test/nanoplc.deb": "/here/nanoplc.deb"}, serials=["motor"]) as machine:
        status, text = machine.run("dpkg -i /test/nanoplc.deb")
"""

import os
import stat
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "vm"))
import board  # noqa: E402  pylint: disable=wrong-import-position
import image  # noqa: E402  pylint: disable=wrong-import-position

CannotBeHad = board.CannotBeHad
_FOLDER = os.path.join(board.BUILD, "debian")
_SHELL = "shell"
_NOT_NEEDED = ("getty.target", "dev-hugepages.mount", "sys-kernel-debug.mount", "sys-kernel-tracing.mount",
               "modprobe@fuse.service", "modprobe@dm_mod.service", "modprobe@drm.service", "modprobe@loop.service",
               "modprobe@configfs.service", "modprobe@efi_pstore.service", "systemd-update-utmp.service",
               "systemd-update-utmp-runlevel.service")
# A shell for the test on the last of the serial ports. What is run in the background must not hold its output.
_SHELL_UNIT = """
[Unit]
Description=shell for the test
[Service]
ExecStart=/bin/bash /test/shell {port}
Restart=no
"""
_SHELL_SCRIPT = """
exec 3<>"$1"
stty raw -echo <&3
echo ready >&3
while read -r line <&3; do
    (eval "$line") >/run/shell-output 2>&1 </dev/null
    code=$?
    cat /run/shell-output >&3
    printf '\\nCODE %s\\n' $code >&3
done
"""


def prepare():
    """Fetches what is missing."""
    board.prepare()
    done = subprocess.run([os.path.join(HERE, "fetch_debian")], check=False)
    if done.returncode == 77:
        raise CannotBeHad
    if done.returncode != 0:
        raise RuntimeError("tests/package/fetch_debian failed")


def _tree(folder):
    """All of it belongs to root there, whoever unpacked it here."""
    archive = image.Cpio()
    for path, folders, files in os.walk(folder):
        inside = os.path.relpath(path, folder)
        for name in sorted(folders + files):
            whole = os.path.join(path, name)
            status = os.lstat(whole)
            data = b""
            if stat.S_ISLNK(status.st_mode):
                data = os.readlink(whole).encode()
            elif stat.S_ISREG(status.st_mode):
                with open(whole, "rb") as file:
                    data = file.read()
            target = os.path.normpath(os.path.join(inside, name))
            archive.folders.add(target)
            archive.add(target, status.st_mode, data)
    archive.add("dev/console", stat.S_IFCHR | 0o600, device=(5, 1))
    return archive.end()


class Debian(board.Board):
    MEMORY = "640"
    KERNEL_WORDS = "rdinit=/sbin/init systemd.unit=multi-user.target systemd.show_status=no " + " ".join(
        "systemd.mask=" + unit for unit in _NOT_NEEDED)

    def __init__(self, share, files, serials=(), echo=None):
        """`files`: by their names there, a path of here or bytes. `serials` as of a board."""
        super().__init__(share, "", serials=[*serials, _SHELL], echo=echo)
        self.files = files

    def make_initramfs(self, target):
        archive = image.Cpio()
        archive.folders |= {"etc", "etc/systemd", "etc/systemd/system"}
        port = f"/dev/ttyS{len(self.ports) - 1}"
        units = "etc/systemd/system/"
        archive.add(units + "shell.service", stat.S_IFREG | 0o644, _SHELL_UNIT.format(port=port).encode())
        archive.add(units + "multi-user.target.wants/shell.service", stat.S_IFLNK | 0o777, b"../shell.service")
        archive.add("test/shell", stat.S_IFREG | 0o644, _SHELL_SCRIPT.encode())
        for name, content in self.files.items():
            if isinstance(content, str):
                archive.add_file(name.lstrip("/"), content)
            else:
                archive.add(name.lstrip("/"), stat.S_IFREG | 0o644, content)
        with open(target, "wb") as file:
            file.write(_tree(os.path.join(_FOLDER, "root")))
            file.write(archive.end())

    def __enter__(self):
        super().__enter__()
        self._lines = board.Lines(self.serials[_SHELL])
        while self._lines.hear() != "ready":
            pass
        return self

    def run(self, command):
        """A line for the shell. Its exit status and what it printed."""
        self._lines.tell(command)
        text = []
        while not (line := self._lines.hear()).startswith("CODE "):
            text.append(line)
        return int(line.split()[1]), "\n".join(text).strip("\n")

    def until(self, what, command):
        """Waits until the command's exit status is 0; what it printed then."""
        end = time.monotonic() + board.LONGEST
        while True:
            status, text = self.run(command)
            if status == 0:
                return text
            if time.monotonic() > end:
                raise AssertionError(f"never came: {what}: {text}")
            time.sleep(0.3)
