"""Packages of npm for tests, in the build folder, by their lock file."""

import os
import shutil
import subprocess


def same(a, b):
    return os.path.exists(b) and open(a, "rb").read() == open(b, "rb").read()


def install(source, folder):
    """npm ci, unless the same lock file was installed before."""
    os.makedirs(folder, exist_ok=True)
    lock, done = os.path.join(source, "package-lock.json"), os.path.join(folder, "installed-lock.json")
    if same(lock, done):
        return True
    for name in ("package.json", "package-lock.json"):
        shutil.copy(os.path.join(source, name), folder)
    result = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=folder, capture_output=True, text=True)
    if result.returncode:
        print(f"npm ci in {folder} failed:\n{result.stderr[-2000:]}")
        return False
    shutil.copy(lock, done)
    return True
