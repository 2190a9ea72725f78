"""Debian packages by their files, and what their copyright files say, from a dpkg database: this machine's or a sysroot's."""

import os
import re

# Debian's short names, and SPDX's.
LICENCES = {
    "Expat": "MIT", "MIT": "MIT", "MIT/X11": "MIT", "Expat with embedded exception": "MIT", "BSD-2-clause": "BSD-2-Clause",
    "BSD-3-clause": "BSD-3-Clause", "BSL-1.0": "BSL-1.0", "MPL-2": "MPL-2.0", "Apache-2.0": "Apache-2.0", "EPL-2.0": "EPL-2.0",
    "EDL-1.0": "BSD-3-Clause", "GPL-2": "GPL-2.0-only", "GPL-2+": "GPL-2.0-or-later", "GPL-3": "GPL-3.0-only",
    "GPL-3+": "GPL-3.0-or-later", "LGPL-2.1": "LGPL-2.1-only", "LGPL-2.1+": "LGPL-2.1-or-later", "ISC": "ISC", "Zlib": "Zlib",
}
# Copyright files that no machine can read: package, what must stand in its file, and what that is in SPDX's words.
BY_HAND = (
    (r"libc6(-dev)?(-\w+-cross)?", "GNU Lesser General Public", "LGPL-2.1-or-later"),
    (r"(libstdc\+\+|libgcc)[\w.+-]*", "GCC Runtime Library Exception", "GPL-3.0-or-later WITH GCC-exception-3.1"),
    (r"(g\+\+|gcc)-\d+(-\w+)*", "GNU General Public License", "GPL-3.0-or-later"),
    # They only say where to look: in the copyright file of gcc.
    (r"(gcc|libstdc\+\+)-arm-none-eabi(-\w+)?", "The copyright for GCC can be found in", "GPL-3.0-or-later WITH GCC-exception-3.1"),
)


class Package:
    def __init__(self, root, fields):
        self.root = root
        self.name = fields["Package"]
        self.version = fields["Version"]
        self.architecture = fields.get("Architecture", "all")
        source = re.fullmatch(r"(\S+)(?: \((.*)\))?", fields.get("Source", self.name))
        self.source = source[1]
        self.source_version = source[2] or self.version

    def copyright(self):
        """The text of its copyright file."""
        folder = os.path.join(self.root, "usr/share/doc", self.name)
        # A link into a package that was not unpacked leads to the one of this machine.
        for path in (os.path.join(folder, "copyright"), os.path.join("/usr/share/doc", self.name, "copyright")):
            if os.path.exists(path):
                with open(path, encoding="utf-8", errors="replace") as file:
                    return file.read()
        raise LookupError(f"{self.name}: it has no copyright file in {folder}")


class Database:
    """Which package each file is of."""

    def __init__(self, root="/"):
        self.root = root
        self.packages = {}
        with open(os.path.join(root, "var/lib/dpkg/status"), encoding="utf-8") as file:
            for stanza in file.read().split("\n\n"):
                fields = dict(re.findall(r"(?m)^([\w-]+): (.*)$", stanza))
                if "Package" in fields and "Version" in fields:
                    package = Package(root, fields)
                    self.packages[package.name] = self.packages[f"{package.name}:{package.architecture}"] = package
        self.owners = {}
        info = os.path.join(root, "var/lib/dpkg/info")
        for name in sorted(os.listdir(info)):
            if name.endswith(".list") and name[:-5] in self.packages:
                with open(os.path.join(info, name), encoding="utf-8") as file:
                    for line in file:
                        self.owners[_merged(line.rstrip("\n"))] = self.packages[name[:-5]]

    def owner(self, path):
        """The package of the file, None if it is of none."""
        inside = "/" + os.path.relpath(os.path.realpath(path), os.path.realpath(self.root))
        found = self.owners.get(_merged(inside))
        # A file of a link's name, as of a compiler's folder that is one.
        return found or self.owners.get(_merged("/" + os.path.relpath(path, self.root)))


def _merged(path):
    return re.sub(r"^/(lib|bin|sbin|lib64)/", r"/usr/\1/", path)


def paragraphs(text):
    """Those of a copyright file that a machine can read, as dictionaries; none of another."""
    if not text.lstrip().startswith("Format:"):
        return []
    found = []
    for block in re.split(r"\n\s*\n(?=[A-Z])", re.sub(r"(?m)^#.*\n", "", text)):
        fields, name = {}, None
        for line in block.splitlines():
            begun = re.match(r"([A-Za-z-]+):\s*(.*)", line)
            if begun:
                name = begun[1].lower()
                fields[name] = begun[2]
            elif name:
                fields[name] += "\n" + line
        found.append(fields)
    return found


def _main(text):
    """The paragraph of the most files: that of *, else the first that is not Debian's own."""
    files = [fields for fields in paragraphs(text) if "files" in fields and "license" in fields]
    for fields in files:
        if "*" in fields["files"].split():
            return fields
    return next((fields for fields in files if not fields["files"].startswith("debian/")), None)


def licence(package, files=()):
    """SPDX's expression for the package, and the texts of what SPDX has no name for, by LicenseRef. Of the kernel's headers, whose
    copyright file is that of the whole kernel, what the `files` that were read say themselves."""
    text = package.copyright()
    if package.name.startswith("linux-libc-dev"):
        return _of_headers(files), {}
    for name, wanted, expression in BY_HAND:
        if re.fullmatch(name, package.name) and re.search(re.sub(" ", r"\\s+", wanted), text, re.IGNORECASE):
            return expression, {}
    main = _main(text)
    if main:
        expression = _expression(main["license"].split("\n")[0].strip())
        if expression:
            return expression, {}
    reference = "LicenseRef-Debian-" + re.sub(r"[^A-Za-z0-9.-]", "-", package.source)
    return reference, {reference: text}


def _of_headers(files):
    found = set()
    for path in files:
        with open(path, encoding="utf-8", errors="replace") as file:
            said = re.search(r"SPDX-License-Identifier: (.*?)\s*(\*/)?$", file.readline())
        if said:
            found.add(re.sub(r"(GPL-\d\.\d)(?![-+.\d])", r"\1-only", re.sub(r"(GPL-\d\.\d)\+", r"\1-or-later", said[1])))
    return " AND ".join(one if one.startswith("(") or " OR " not in one else f"({one})" for one in sorted(found)) or "NOASSERTION"


def _expression(words):
    """SPDX's expression for Debian's, None if there is none."""
    parts = re.split(r",?\s+(and|or)\s+", words)
    names = [part if part in ("and", "or") else LICENCES.get(part) for part in parts]
    if None in names:
        return None
    joined = " ".join(name.upper() if name in ("and", "or") else name for name in names)
    return f"({joined})" if len(names) > 3 else joined


def notice(package):
    """What goes with a program that contains it: the copyright file, or of a huge one what the most of it is under."""
    text = package.copyright()
    main = _main(text)
    if len(text) < 200_000 or main is None:
        return text
    name = main["license"].split("\n")[0].strip()
    whole = next((f["license"] for f in paragraphs(text) if "files" not in f and f.get("license", "").startswith(name)), name)
    return f"{package.name}, the most of it:\n\nCopyright: {main.get('copyright', '')}\nLicense: {whole}\n"
