"""Certificates and passwords for a broker at 127.0.0.1, with openssl and mosquitto_passwd."""

import os
import subprocess

KEY = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1")  # made at once, unlike one of RSA


def make(folder):
    """ca.pem has signed the certificates broker.pem, stranger.pem (for another name) and expired.pem; selfmade.pem has signed itself. All
    are of broker.key. Of clients: mine.pem and old.pem (expired), signed by ca.pem, and foreign.pem, signed by other.pem, all of mine.key.
    User cell has the password "right". The settings of a broker with broker.pem."""
    def run(*arguments):
        subprocess.run(["openssl", *arguments], check=True, capture_output=True, cwd=folder)

    for name in ("ca", "other"):
        run("req", "-x509", *KEY, "-nodes", "-keyout", f"{name}.key", "-out", f"{name}.pem", "-days", "2", "-subj",
            f"/CN={name}")
    for name, subject in (("broker", "127.0.0.1"), ("mine", "cell4")):
        run("req", *KEY, "-nodes", "-keyout", f"{name}.key", "-out", f"{name}.csr", "-subj", f"/CN={subject}")
    here = "IP:127.0.0.1,DNS:localhost"
    for name, of, ca, names, days in (("broker", "broker", "ca", here, "2"), ("stranger", "broker", "ca", "IP:127.0.0.2,DNS:stranger", "2"),
                                      ("expired", "broker", "ca", here, "-1"), ("mine", "mine", "ca", "DNS:cell4", "2"),
                                      ("old", "mine", "ca", "DNS:cell4", "-1"), ("foreign", "mine", "other", "DNS:cell4", "2")):
        with open(f"{folder}/names", "w", encoding="utf-8") as file:
            file.write(f"subjectAltName={names}\n")
        run("x509", "-req", "-in", f"{of}.csr", "-CA", f"{ca}.pem", "-CAkey", f"{ca}.key", "-CAcreateserial", "-out", f"{name}.pem", "-days",
            days, "-extfile", "names")
    run("req", "-x509", "-key", "broker.key", "-out", "selfmade.pem", "-days", "2", "-subj", "/CN=127.0.0.1", "-addext",
        f"subjectAltName={here}")
    subprocess.run(["mosquitto_passwd", "-b", "-c", f"{folder}/users", "cell", "right"], check=True, capture_output=True)
    for name in ("users", "broker.key"):
        os.chmod(f"{folder}/{name}", 0o644)
    os.chmod(folder, 0o755)
    return (f"cafile {folder}/ca.pem\ncertfile {folder}/broker.pem\nkeyfile {folder}/broker.key\n"
            f"allow_anonymous false\npassword_file {folder}/users\n")
