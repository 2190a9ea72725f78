"""The programs that these tests run, and a folder for their files."""

import os


class Programs:
    def __init__(self, seqc, nanoplc_sim, folder):
        self.seqc, self.nanoplc_sim, self.folder = seqc, nanoplc_sim, folder

    def path(self, name, content=None):
        path = os.path.join(self.folder, name)
        if content is not None:
            with open(path, "wb") as file:
                file.write(content)
        return path
