"""What the tests of the two Debian packages do alike."""

import shutil
import subprocess


def run(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=False, **more)


def needed(deb):
    """The packages that it depends on."""
    return {part.split()[0] for part in run("dpkg-deb", "-f", deb, "Depends").stdout.split(",")}


def expect_lintian_silent(case, deb):
    if shutil.which("lintian") is None:
        case.skipTest("there is no lintian here")
    done = run("lintian", "--allow-root", deb)
    case.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
