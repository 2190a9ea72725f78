"""The programs that these tests run, and a folder for their files."""

import os
import subprocess


def expanded(course):
    """A scan for each repetition in the document."""
    return [{**scan, "times": 1} for scan in course for _ in range(scan.get("times", 1))]


class Programs:
    def __init__(self, seqc, nanoplc_sim, folder):
        self.seqc, self.nanoplc_sim, self.folder = seqc, nanoplc_sim, folder

    def path(self, name, content=None):
        path = os.path.join(self.folder, name)
        if content is not None:
            with open(path, "wb") as file:
                file.write(content)
        return path

    def replayed(self, table, course):
        """Rows (step, timer, counter, outputs) of nanoplc-sim scan for a course of `seqc verify --json`, after the time of each
        scan is taken off. It must come to the same steps and outputs."""
        course = expanded(course)
        rows = [f"{s['dt_ms']},{s['inputs']},{s['inpos']},{s['error']}" for s in course]
        stimulus = self.path("replay.csv", ("\n".join(["dt_ms,inputs,inpos,error", *rows]) + "\n").encode())
        done = subprocess.run([self.nanoplc_sim, "scan", table, "--stimulus", stimulus],
                              capture_output=True, text=True, check=True)
        played = [[int(v) for v in line.split(",")[1:5]] for line in done.stdout.split("\n")[1:-1]]
        assert len(played) == len(course)
        for row, scan in zip(played, course):
            assert row[3] == scan["outputs"], (row, scan)
            assert scan["step"] == str(row[0]) or not scan["step"].isdigit(), (row, scan)
        return played

    def replay_all(self, table, document):
        """Every course of a report, also those of its own checks; how many there were."""
        courses = [r["course"] for r in document["results"] if r.get("course")]
        for course in courses:
            self.replayed(table, course)
        return len(courses)
