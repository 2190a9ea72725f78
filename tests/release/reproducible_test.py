#!/usr/bin/env python3
"""Builds a release twice, from two clones in two folders, in two environments, as two users where it can, and compares every byte.

usage: reproducible_test.py [PART...]    (as of tools/release; all without)

77: this tree is no git repository.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
NOBODY = 65534
# Folder below the common one, umask, and what is otherwise in the environment.
WAYS = (
    ("a", 0o022, {"TZ": "UTC", "LC_ALL": "C.UTF-8", "LANG": "C", "USER": "one", "LOGNAME": "one", "COLUMNS": "80"}),
    ("another/folder_with_a_longer_name", 0o077,
     {"TZ": "Asia/Kolkata", "LANG": "de_DE.UTF-8", "LANGUAGE": "de", "USER": "two", "LOGNAME": "two", "COLUMNS": "200",
      "CMAKE_BUILD_PARALLEL_LEVEL": "1"}),
)
DATE = subprocess.run(["git", "-C", ROOT, "log", "-1", "--format=%cI"], capture_output=True, text=True, check=False).stdout.strip()


def run(command, folder, environment, **more):
    done = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, **more)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: {done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout


def tagged_clone(source, folder, environment):
    """This commit, made into a release: the same commit in each clone."""
    run(["git", "clone", "-q", "--no-hardlinks", source, folder], "/", environment)
    path = os.path.join(folder, "CHANGELOG.md")
    with open(os.path.join(folder, "CMakeLists.txt"), encoding="utf-8") as file:
        version = re.search(r"project\(.* VERSION (\S+)", file.read())[1]
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace("## [Unreleased]", f"## [{version}] - 2030-01-01", 1))
    run(["git", "commit", "-qam", "Release"], folder, environment)
    run(["git", "tag", "-f", f"v{version}"], folder, environment)


def build(base, way, parts):
    name, mask, varied = way
    folder = os.path.join(base, name)
    home = os.path.join(base, "home_of_" + varied["USER"])
    os.makedirs(home)
    os.makedirs(os.path.dirname(folder), exist_ok=True)
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("CMAKE_", "CCACHE_", "SOURCE_DATE", "LC_"))}
    environment |= {"HOME": home, "GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@b", "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@b",
                    "GIT_AUTHOR_DATE": DATE, "GIT_COMMITTER_DATE": DATE, "CCACHE_DISABLE": "1", **varied}
    os.umask(mask)
    tagged_clone(os.path.join(base, "source"), folder, environment)
    more = {}
    if os.geteuid() == 0 and mask == 0o077:
        for path, folders, files in os.walk(base):
            for one in [path, *(os.path.join(path, f) for f in folders + files)]:
                os.chown(one, NOBODY, NOBODY, follow_symlinks=False)
        more = {"user": NOBODY, "group": NOBODY, "extra_groups": []}
    run(["tools/release", "--unsigned", *parts], folder, environment, **more)
    built = os.path.join(folder, "build", "dist")
    out, = os.listdir(built)
    return os.path.join(built, out)


def contents(folder):
    found = {}
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), "rb") as file:
            found[name] = file.read()
    return found


def main():
    if not os.path.exists(os.path.join(ROOT, ".git")):
        print("skipped: this tree is no git repository")
        return 77
    with tempfile.TemporaryDirectory(prefix="reproducible") as base:
        os.chmod(base, 0o755)
        run(["git", "clone", "-q", "--no-hardlinks", ROOT, "source"], base, os.environ)
        folders = [build(base, way, sys.argv[1:]) for way in WAYS]
        first, second = map(contents, folders)
        other = sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
        print(f"{len(first)} files, {sum(map(len, first.values())) // 1024} kB; not the same: {', '.join(other) if other else 'none'}")
        for name in other:
            if shutil.which("diffoscope") and name in first and name in second and name != "SHA256SUMS":
                print(subprocess.run(["diffoscope", *(os.path.join(folder, name) for folder in folders)], capture_output=True, text=True,
                                     check=False).stdout[:4000])
        return 1 if other or len(first) < 2 else 0


if __name__ == "__main__":
    sys.exit(main())
