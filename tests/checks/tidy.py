#!/usr/bin/env python3
"""clang-tidy over the core, with the checks of .clang-tidy.

usage: tidy.py ROOT [analyzer]

Configures preset tidy, whose compile_commands.json names the flags of each file. Most of the time goes into the standard
library's headers, so that files of a folder with the same flags are looked at together, as one source that includes them;
where their names collide, each by itself. clang's static analyzer looks at no included file, takes as long as all other
checks together and runs by itself: with `analyzer`, which holds unused using-declarations too.
"""

import collections
import concurrent.futures
import json
import os
import shutil
import subprocess
import sys

import sources

TOOL = "clang-tidy-14"
ANALYZER = "clang-analyzer-*"
PADDING = "clang-analyzer-optin.performance.Padding"
# Looks at no included file either.
USING = "misc-unused-using-decls"
CHECKS = {"tidy": f"-{ANALYZER},-{USING}", "analyzer": f"-*,{ANALYZER},-{PADDING},{USING}"}
FOLDERS = ("hal/", "sequencer/", "firmware/")
TOGETHER = 8
# What is included counts as a header.
FILTER = r"--header-filter=/(hal|sequencer|firmware|host-sim|tools|tests)/.*\.(h|cpp)$"
OF_INCLUDING = "bugprone-suspicious-include"


def core_files(root, build):
    """The flags of each file, by its path."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    flags = {os.path.relpath(c["file"], root): c["command"].rsplit(" -o ", 1)[0] for c in commands}
    return {path: flags[path] for path in sorted(flags) if path.startswith(FOLDERS)}


def groups_of(files):
    """Lists of paths that can be looked at together."""
    alike = collections.defaultdict(list)
    for path, flags in files.items():
        alike[os.path.dirname(path), flags].append(path)
    return [paths[i : i + TOGETHER] for paths in alike.values() for i in range(0, len(paths), TOGETHER)]


def write_together(root, build, files, groups):
    """A source for each group; answers their paths."""
    folder = os.path.join(build, "together")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    shutil.copy(os.path.join(root, ".clang-tidy"), folder)
    commands = []
    for number, group in enumerate(groups):
        source = os.path.join(folder, f"{number}.cpp")
        with open(source, "w", encoding="utf-8") as file:
            file.writelines(f'#include "{os.path.join(root, path)}"\n' for path in group)
        commands.append({"directory": build, "file": source, "command": f"{files[group[0]]} -c {source}"})
    with open(os.path.join(folder, "compile_commands.json"), "w", encoding="utf-8") as file:
        json.dump(commands, file)
    return [command["file"] for command in commands]


def tidy(root, build, checks, path, *more):
    run = subprocess.run(
        [TOOL, "--quiet", "-p", build, f"--checks={checks}", *more, path], cwd=root, capture_output=True, text=True, check=False
    )
    if run.returncode == 0:
        return None
    return run.stdout.strip() or run.stderr.strip() or f"{path}: {TOOL} ended with {run.returncode}"


def tidy_together(root, build, source, group):
    """Findings are repeated on each file alone, for the right file and line."""
    checks = CHECKS["tidy"]
    folder = os.path.dirname(source)
    if len(group) > 1 and not tidy(root, folder, f"{checks},-{OF_INCLUDING}", source, FILTER):
        return []
    return [tidy(root, build, checks, path) for path in group]


def main():
    which = sys.argv[2] if len(sys.argv) == 3 else "tidy"
    if len(sys.argv) not in (2, 3) or which not in CHECKS:
        sys.exit(__doc__)
    root = os.path.abspath(sys.argv[1])
    configured = subprocess.run(["cmake", "--preset", "tidy"], cwd=root, capture_output=True, text=True, check=False)
    if configured.returncode != 0:
        sys.exit(f"{configured.stdout}{configured.stderr}\ncmake --preset tidy failed")
    build = os.path.join(root, "build", "tidy")
    files = core_files(root, build)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        if which == "tidy":
            groups = groups_of(files)
            written = write_together(root, build, files, groups)
            found = pool.map(lambda source, group: tidy_together(root, build, source, group), written, groups)
            findings = [finding for several in found for finding in several]
        else:
            findings = list(pool.map(lambda path: tidy(root, build, CHECKS[which], path), files))
    sources.report([finding for finding in findings if finding], len(files), "source files")


if __name__ == "__main__":
    main()
