"""What a program was built of: from ninja's log of dependencies, the linker's map and the program itself."""

import os
import re
import subprocess


def _lines(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise LookupError(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout.splitlines()


def compiled_in(build, program):
    """The files that were read to compile the program's objects, sources and headers alike."""
    objects = {line for line in _lines("ninja", "-C", build, "-t", "inputs", os.path.relpath(program, build))}
    found, wanted = set(), False
    for line in _lines("ninja", "-C", build, "-t", "deps"):
        begun = re.match(r"(\S.*): #deps \d+", line)
        if begun:
            wanted = begun[1] in objects or os.path.join(build, begun[1]) in objects
        elif wanted and line.startswith("    "):
            found.add(os.path.normpath(os.path.join(build, line.strip())))
    if not found:
        raise LookupError(f"{program}: ninja knows nothing it was compiled of; build it first")
    return found


def linked(build, program, map_file):
    """Objects and archives of which something is in it, and the shared libraries that it names: two sets of paths."""
    with open(map_file, encoding="utf-8", errors="replace") as file:
        text = file.read()
    members = text.split("Memory Configuration")[0]
    archives = set(re.findall(r"(?m)^(\S+\.a)\(", members))
    loaded = re.findall(r"(?m)^LOAD (\S+)$", text)
    objects = {path for path in loaded if path.endswith(".o") and os.path.exists(os.path.join(build, path))}
    needed = set()
    for line in _lines("readelf", "--dynamic", "--wide", program):
        if "(NEEDED)" in line:
            needed.add(re.search(r"\[(.*)\]", line)[1])
    shared = {os.path.realpath(os.path.join(build, path)) for path in loaded
              if re.search(r"\.so(\.\d+)*$", path) and _soname(os.path.join(build, path)) in needed}
    return {os.path.normpath(os.path.join(build, path)) for path in archives | objects}, shared


def _soname(path):
    """The name of a shared library; nothing of a script for the linker in its place, which loads the real one."""
    with open(path, "rb") as file:
        if file.read(4) != b"\x7fELF":
            return ""
    named = [line for line in _lines("readelf", "--dynamic", "--wide", path) if "(SONAME)" in line]
    return re.search(r"\[(.*)\]", named[0])[1] if named else os.path.basename(path)
