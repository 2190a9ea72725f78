"""What a source tree says of itself: version, commit, and the time of the commit."""

import os
import re
import subprocess


def version(root):
    with open(os.path.join(root, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\([^)]*\bVERSION (\S+)", file.read())[1]


def commit(root):
    """As programs and images name it, and its time in seconds since 1970. The environment's SOURCE_DATE_EPOCH goes before it, as
    reproducible-builds.org has it."""
    script = os.path.join(root, "tools/cmake/print_commit.cmake")
    done = subprocess.run(["cmake", f"-DSOURCE={root}", "-P", script], check=True, capture_output=True, text=True)
    name, _, time = done.stdout.strip().partition(" ")
    return name, int(os.environ.get("SOURCE_DATE_EPOCH") or time or 0)
