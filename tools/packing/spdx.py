"""An SPDX 2.3 document, as JSON."""

import datetime
import hashlib
import re

import parts

# What stands left and right of a relationship: the other way round for tools.
TURNED = (parts.TOOL,)


def reference(*words):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", "-".join(words))


def checksums(data):
    return [{"algorithm": name, "checksumValue": hashlib.new(name.lower(), data).hexdigest()} for name in ("SHA1", "SHA256")]


def document(artefact, programs, version, commit, created):
    """`artefact`: name, kind (INSTALL, FIRMWARE) and bytes of what is delivered. `programs`: name, bytes and Parts of each program in it.
    `created`: seconds since 1970."""
    name, kind, data = artefact
    time = datetime.datetime.fromtimestamp(created, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    whole = reference("artefact", name)
    packages = [_own(name, whole, kind, data, version, commit)]
    relations, texts, seen = [("SPDXRef-DOCUMENT", "DESCRIBES", whole)], {}, set()
    for program, content, found in programs:
        inside = reference("program", program)
        packages.append(_own(program, inside, "APPLICATION", content, version, commit))
        relations.append((whole, "CONTAINS", inside))
        for part in found.all():
            other = reference("part", part.purl.split(":", 1)[1].split("?")[0])
            if other not in seen:
                seen.add(other)
                packages.append(_part(part, other))
            texts |= part.texts
            relations += [(other, how, inside) if how in TURNED else (inside, how, other) for how in sorted(part.how)]
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": name,
        "documentNamespace": f"urn:nanoplc-gateway:{name}:{hashlib.sha256(data).hexdigest()}",
        "creationInfo": {"created": time, "creators": [f"Tool: nanoplc-gateway-sbom-{version}"]},
        "packages": packages,
        "relationships": [{"spdxElementId": a, "relationshipType": how, "relatedSpdxElement": b} for a, how, b in relations],
        "hasExtractedLicensingInfos": [{"licenseId": key, "extractedText": texts[key]} for key in sorted(texts)],
    }


def _own(name, identifier, kind, data, version, commit):
    return {
        "SPDXID": identifier,
        "name": name,
        "versionInfo": version,
        "primaryPackagePurpose": kind,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "checksums": checksums(data),
        "sourceInfo": f"NanoPLC Gateway, commit {commit}",
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "NONE",
        "copyrightText": "NOASSERTION",
    }


def _part(part, identifier):
    entry = {
        "SPDXID": identifier,
        "name": part.name,
        "versionInfo": part.version,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": part.licence,
        "copyrightText": "NOASSERTION",
        "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": part.purl}],
    }
    if part.supplier:
        entry["supplier"] = part.supplier
    if part.source:
        entry["sourceInfo"] = part.source
    return entry
