"""Certificates and passwords for a broker at 127.0.0.1, with openssl and mosquitto_passwd."""

import os
import subprocess

KEY = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1")  # made at once, unlike one of RSA


def make(folder):
    """ca.pem has signed the certificates broker.pem, stranger.pem (for another name) and expired.pem; other.pem has signed none. User
    cell has the password "right". The settings of a broker with broker.pem."""
    def run(*arguments):
        subprocess.run(["openssl", *arguments], check=True, capture_output=True, cwd=folder)

    for name in ("ca", "other"):
        run("req", "-x509", *KEY, "-nodes", "-keyout", f"{name}.key", "-out", f"{name}.pem", "-days", "2", "-subj",
            f"/CN={name}")
    run("req", *KEY, "-nodes", "-keyout", "broker.key", "-out", "broker.csr", "-subj", "/CN=127.0.0.1")
    for name, names, days in (("broker", "IP:127.0.0.1,DNS:localhost", "2"), ("stranger", "IP:127.0.0.2,DNS:stranger", "2"),
                              ("expired", "IP:127.0.0.1,DNS:localhost", "-1")):
        with open(f"{folder}/names", "w", encoding="utf-8") as file:
            file.write(f"subjectAltName={names}\n")
        run("x509", "-req", "-in", "broker.csr", "-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial", "-out", f"{name}.pem", "-days",
            days, "-extfile", "names")
    subprocess.run(["mosquitto_passwd", "-b", "-c", f"{folder}/users", "cell", "right"], check=True, capture_output=True)
    for name in ("users", "broker.key"):
        os.chmod(f"{folder}/{name}", 0o644)
    os.chmod(folder, 0o755)
    return (f"cafile {folder}/ca.pem\ncertfile {folder}/broker.pem\nkeyfile {folder}/broker.key\n"
            f"allow_anonymous false\npassword_file {folder}/users\n")
