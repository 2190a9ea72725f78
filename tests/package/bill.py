"""Looks at a bill of materials: its form, by SPDX 2.3, and its facts, as other tools report them."""

import hashlib
import json
import os
import re
import subprocess

# Licences as upstream states them.
KNOWN = {
    "libboost1.74-dev": "BSL-1.0", "libcli11-dev": "BSD-3-Clause", "libfmt-dev": "MIT", "nlohmann-json3-dev": "MIT",
    "libtomlplusplus-dev": "MIT", "libeigen3-dev": "MPL-2.0", "libgpiod-dev": "LGPL-2.1-or-later", "libgpiod": "LGPL-2.1-or-later",
    "mosquitto": "EPL-2.0 OR BSD-3-Clause", "libmosquitto1": "EPL-2.0 OR BSD-3-Clause", "libssl-dev": "Apache-2.0", "libssl3": "Apache-2.0",
    "libsodium-dev": "ISC", "libsodium23": "ISC",
    "libmd0": "BSD-3-Clause", "libc6-dev": "LGPL-2.1-or-later", "libc6": "LGPL-2.1-or-later", "uplot": "MIT",
    "libstdc++-12-dev": "GPL-3.0-or-later WITH GCC-exception-3.1", "g++-12": "GPL-3.0-or-later", "vscode-languageclient": "MIT",
}
REQUIRED = {"SPDXID", "name", "versionInfo", "downloadLocation", "filesAnalyzed", "licenseConcluded", "licenseDeclared", "copyrightText"}
OWN = "NONE"  # the project's own parts have no licence yet


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def related(document, how):
    """The names of packages that are related so to a program."""
    names = {package["SPDXID"]: package["name"] for package in document["packages"]}
    return {names[relation["relatedSpdxElement"]] for relation in document["relationships"] if relation["relationshipType"] == how}


def problems(path, artefact):
    """What is wrong with the bill in `path` of the file `artefact`."""
    document = read(path)
    return [*_form(document), *_licences(document), *_of(document, artefact)]


def _form(document):
    if (document["spdxVersion"], document["dataLicense"], document["SPDXID"]) != ("SPDX-2.3", "CC0-1.0", "SPDXRef-DOCUMENT"):
        yield "it is no document of SPDX 2.3"
    if not re.fullmatch(r"[a-z]+:[^#\s]+", document["documentNamespace"]):
        yield f"its name space is {document['documentNamespace']}"
    if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", document["creationInfo"]["created"]):
        yield f"it was made at {document['creationInfo']['created']}"
    identifiers = [package["SPDXID"] for package in document["packages"]] + [document["SPDXID"]]
    for identifier in identifiers:
        if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", identifier) or identifiers.count(identifier) != 1:
            yield f"{identifier} is no identifier, or not the only one"
    for package in document["packages"]:
        if not REQUIRED <= package.keys() or not all(str(package[name]) for name in REQUIRED):
            yield f"{package['SPDXID']} lacks {REQUIRED - package.keys()}"
    ends = set()
    for relation in document["relationships"]:
        ends |= {relation["spdxElementId"], relation["relatedSpdxElement"]}
    if ends != set(identifiers):
        yield f"without a relationship, or without a package: {ends ^ set(identifiers)}"
    if not any(r["relationshipType"] == "DESCRIBES" and r["spdxElementId"] == "SPDXRef-DOCUMENT" for r in document["relationships"]):
        yield "it describes nothing"


def _licences(document):
    declared = {package["licenseDeclared"] for package in document["packages"]} - {"NONE", "NOASSERTION"}
    named = {word for expression in declared for word in re.findall(r"LicenseRef-[A-Za-z0-9.-]+", expression)}
    given = {text["licenseId"] for text in document["hasExtractedLicensingInfos"] if text["extractedText"].strip()}
    if named != given:
        yield f"licences without a text, or texts without a licence: {named ^ given}"
    for package in document["packages"]:
        wanted = KNOWN.get(package["name"], package["licenseDeclared"])
        if package["licenseDeclared"] != wanted or (package["licenseDeclared"] == OWN and "checksums" not in package):
            yield f"{package['name']} is under {package['licenseDeclared']}, not {wanted}"
    # Debian's module belongs to Debian's Python.
    lines = "\n".join(sorted(re.sub(r"LicenseRef-[A-Za-z0-9.-]+", "MIT", one) for one in declared))
    script = ("import sys; from license_expression import get_spdx_licensing as g; l = g()\n"
              "for e in sys.stdin.read().splitlines(): print(e, l.validate(e).errors) if l.validate(e).errors else None")
    done = subprocess.run(["/usr/bin/python3", "-c", script], input=lines, capture_output=True, text=True, check=False)
    if "No module named" in done.stderr:
        print("the licences' expressions are not looked at: there is no python3-license-expression here")
    elif done.returncode != 0 or done.stdout:
        yield f"no expressions of SPDX: {done.stdout}{done.stderr}"


def _of(document, artefact):
    with open(artefact, "rb") as file:
        checksum = {"algorithm": "SHA256", "checksumValue": hashlib.sha256(file.read()).hexdigest()}
    described = [package for package in document["packages"] if package["name"] == os.path.basename(artefact)]
    if len(described) != 1 or checksum not in described[0]["checksums"]:
        yield f"it is not of {artefact}"
    for package in document["packages"]:
        locator = package.get("externalRefs", [{}])[0].get("referenceLocator", "")
        if locator.startswith("pkg:deb/") and locator.endswith(("arch=amd64", "arch=all")):
            installed = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package["name"]], capture_output=True, text=True, check=False)
            if installed.stdout != package["versionInfo"]:
                yield f"{package['name']} {package['versionInfo']} is here {installed.stdout}"


def build_traces(root, build, source):
    """Files under `root` with the path of the build or of the source tree in them, or the day of a compilation."""
    wanted = [os.path.realpath(path).encode() for path in (build, source)]
    day = re.compile(rb"\b(Jan|Feb|Mar|Apr|May|Jun|Jul|Aug|Sep|Oct|Nov|Dec) [ 1-3]\d 20\d\d\b")
    for folder, _, names in os.walk(root):
        for name in names:
            path = os.path.join(folder, name)
            if os.path.islink(path):
                continue
            with open(path, "rb") as file:
                data = file.read()
            for trace in wanted:
                if trace in data:
                    yield f"{path} has {trace.decode()} in it"
            if data[:4] == b"\x7fELF" and day.search(data):
                yield f"{path} has {day.search(data)[0].decode()} in it"
