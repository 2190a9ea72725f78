"""What others wrote that a program contains or needs."""

import dataclasses
import glob
import os
import re
import urllib.parse

import debian
import ninja
import npm

# How a part got in, in SPDX's words: headers, archives and startup files, shared libraries, bundled scripts, and what made it.
HEADERS = "GENERATED_FROM"
STATIC = "STATIC_LINK"
SHARED = "DYNAMIC_LINK"
BUNDLED = "CONTAINS"
TOOL = "BUILD_TOOL_OF"


@dataclasses.dataclass
class Part:
    name: str
    version: str
    licence: str
    purl: str
    supplier: str = ""
    source: str = ""
    texts: dict = dataclasses.field(default_factory=dict)  # of licences without a name, by LicenseRef
    notice: str = ""  # what goes with a program that contains it
    how: set = dataclasses.field(default_factory=set)


class Parts:
    """Of one program."""

    def __init__(self, project, build):
        self.project = os.path.realpath(project)
        self.build = os.path.realpath(build)
        self.cache = _cache(build)
        roots = [self.cache.get("NPLC_SYSROOT"), "/"]
        self.databases = [_database(root) for root in roots if root and os.path.exists(os.path.join(root, "var/lib/dpkg/status"))]
        self.found = {}
        self.unknown = []

    def add_program(self, program, map_file):
        compiled = ninja.compiled_in(self.build, program)
        static, shared = ninja.linked(self.build, program, map_file)
        self._add(compiled, HEADERS)
        self._add(static, STATIC)
        self._add(shared, SHARED)
        self._add([_compiler(self.build)], TOOL)
        if self.unknown:
            raise LookupError(f"{program}: of no package: {', '.join(sorted(self.unknown)[:5])}")

    def add_npm(self, folder, notice, inputs=None):
        """`notice`: the file with the licences' texts; without one, each package's own in node_modules."""
        for path, version, licence in npm.packages(folder, inputs):
            name = path.rpartition("node_modules/")[2]
            part = Part(name, version, licence, f"pkg:npm/{name.replace('@', '%40')}@{version}",
                        notice=npm.notice(notice or os.path.join(folder, path)))
            self.found.setdefault(("npm", name, version), part).how.add(BUNDLED)

    def _add(self, paths, how):
        files = {}
        for path in paths:
            if self._is_ours(path):
                continue
            owner = next((o for o in (database.owner(path) for database in self.databases) if o), None)
            if owner is None:
                self.unknown.append(path)
            else:
                files.setdefault(owner, []).append(path)
        for package, read in files.items():
            key = ("deb", package.name, package.version)
            if key not in self.found:
                self.found[key] = _of_package(package, read)
            self.found[key].how.add(how)

    def _is_ours(self, path):
        whole = os.path.realpath(path)
        sysroot = os.path.realpath(self.cache.get("NPLC_SYSROOT", "/nowhere"))
        return whole.startswith((self.project + "/", self.build + "/")) and not whole.startswith(sysroot + "/")

    def all(self):
        return [self.found[key] for key in sorted(self.found)]

    def contained(self):
        """Those of which something is in the program."""
        return [part for part in self.all() if part.how & {HEADERS, STATIC, BUNDLED}]


_DATABASES = {}


def _database(root):
    if root not in _DATABASES:
        _DATABASES[root] = debian.Database(root)
    return _DATABASES[root]


def _of_package(package, files):
    expression, texts = debian.licence(package, files)
    purl = f"pkg:deb/debian/{urllib.parse.quote(package.name)}@{urllib.parse.quote(package.version)}?arch={package.architecture}"
    return Part(package.name, package.version, expression, purl, "Organization: Debian",
                f"Debian's source package {package.source} {package.source_version}", texts, debian.notice(package))


def _compiler(build):
    described, = glob.glob(os.path.join(build, "CMakeFiles", "*", "CMakeCXXCompiler.cmake"))
    with open(described, encoding="utf-8") as file:
        return os.path.realpath(re.search(r'set\(CMAKE_CXX_COMPILER "(.*)"\)', file.read())[1])


def _cache(build):
    with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
        return {line.split(":", 1)[0]: line.split("=", 1)[1].strip() for line in file if ":" in line and "=" in line}
