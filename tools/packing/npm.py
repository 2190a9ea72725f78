"""What a bundle of npm packages consists of, from its lock file and, where there is one, the bundler's own list of inputs."""

import json
import os


def packages(folder, inputs=None):
    """(path, version, licence) of each package that is in the bundle made in `folder`: those that esbuild's list `inputs` names, else all
    that the lock file does not have for development only."""
    with open(os.path.join(folder, "package-lock.json"), encoding="utf-8") as file:
        locked = json.load(file)["packages"]
    if inputs:
        with open(inputs, encoding="utf-8") as file:
            wanted = {_folder(path) for path in json.load(file)["inputs"] if "node_modules/" in path}
    else:
        wanted = {path for path, entry in locked.items() if path and not entry.get("dev")}
    found = []
    for path in sorted(wanted):
        if path not in locked:
            raise LookupError(f"{folder}: {path} is in the bundle and not in package-lock.json")
        found.append((path, locked[path]["version"], locked[path].get("license", "NOASSERTION")))
    return found


def _folder(path):
    """node_modules/a/node_modules/@b/c of a file in it."""
    before, _, inside = path.rpartition("node_modules/")
    words = inside.split("/")
    return before + "node_modules/" + "/".join(words[:2 if inside.startswith("@") else 1])


def notice(path):
    """A licence's text, in the file or in the folder of a package."""
    if os.path.isdir(path):
        names = [name for name in sorted(os.listdir(path)) if name.lower().startswith(("license", "licence"))]
        if not names:
            raise LookupError(f"{path}: the package has no licence's text")
        path = os.path.join(path, names[0])
    with open(path, encoding="utf-8") as file:
        return file.read()
