"""What Debian wants beside the files of a package: copyright with notices, and a changelog."""

import datetime
import email.utils
import gzip
import os
import shutil

COPYRIGHT = """{package} {version}, of the NanoPLC Gateway

Copyright (C) {year} the authors of the NanoPLC Gateway. They have not yet said under which licence they give it away: ask them
before you pass it on.

What others wrote and is in these programs, by the names of Debian's packages and npm's, with licence; the notices are in
/usr/share/doc/{package}/notices:

{parts}

The whole text of the GNU licences is in /usr/share/common-licenses: GPL-1, GPL-2, GPL-3, LGPL-2.1.
"""
CHANGES = """{package} ({version}) unstable; urgency=medium

  * Of commit {commit}. What changed is in CHANGELOG.md.

 -- {contact}  {date}
"""


def write(folder, package, version, commit, time, found, contact, changelog):
    """Fills the folder: copyright, notices/NAME.gz, changelog.gz and CHANGELOG.md.gz."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "notices"))
    unique = {(part.name, part.version): part for part in found}
    now = datetime.datetime.fromtimestamp(time, datetime.timezone.utc)
    lines = [f"    {part.name} {part.version}: {part.licence}" for _, part in sorted(unique.items())]
    with open(os.path.join(folder, "copyright"), "w", encoding="utf-8") as file:
        file.write(COPYRIGHT.format(package=package, version=version, year=now.year, parts="\n".join(lines)))
    for part in unique.values():
        write_zipped(os.path.join(folder, "notices", part.name.replace("/", "-") + ".gz"), part.notice.encode())
    entry = CHANGES.format(package=package, version=version, commit=commit, contact=contact, date=email.utils.format_datetime(now))
    write_zipped(os.path.join(folder, "changelog.gz"), entry.encode())
    with open(changelog, "rb") as file:
        write_zipped(os.path.join(folder, "CHANGELOG.md.gz"), file.read())


def write_zipped(path, data):
    with open(path, "wb") as file:
        file.write(gzip.compress(data, compresslevel=9, mtime=0))
