"""Which files the checks read: those that belong to the project, whether committed yet or not."""

import os
import subprocess
import sys


def files(root):
    """Paths relative to `root`, sorted. From git where there is a repository, else all but what is built or hidden."""
    listing = subprocess.run(
        ["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard", "-z"],
        capture_output=True,
        text=True,
        check=False,
    )
    if listing.returncode == 0 and os.path.exists(os.path.join(root, ".git")):
        found = set(listing.stdout.split("\0")) - {""}
    else:
        found = set(_walk(root))
    return sorted(path for path in found if os.path.isfile(os.path.join(root, path)))


def _walk(root):
    for folder, subfolders, names in os.walk(root):
        hidden_or_built = [s for s in subfolders if (s.startswith(".") and s != ".ci") or s in ("build", "__pycache__")]
        for name in hidden_or_built:
            subfolders.remove(name)
        for name in names:
            yield os.path.relpath(os.path.join(folder, name), root)


def cxx(root):
    return [path for path in files(root) if path.endswith((".h", ".cpp"))]


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        return file.read()


def report(findings, checked, what):
    """Ends the check: prints the findings and exits 1 if there are any, or if there was nothing to check."""
    for finding in findings:
        print(finding)
    if checked == 0:
        sys.exit(f"nothing to check: no {what} found")
    print(f"{checked} {what} checked, {len(findings)} findings")
    sys.exit(1 if findings else 0)
