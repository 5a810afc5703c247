# SPDX-License-Identifier: BSD-3-Clause
"""The program carreau: where it is, and a run that a person can follow and cancel."""
import os
import shutil
import subprocess
import tempfile
import threading

import FreeCAD

PARAMETERS = "User parameter:BaseApp/Preferences/Mod/CarreauMesh"


class MeshError(RuntimeError):
    """A sentence for the person."""


class Cancelled(MeshError):
    pass


def path():
    """The program: the preference Program, the environment variable CARREAU_COMMAND, or carreau in PATH. Raises MeshError."""
    given = FreeCAD.ParamGet(PARAMETERS).GetString("Program", "") or os.environ.get("CARREAU_COMMAND", "")
    found = shutil.which(given or "carreau")
    if found is None:
        raise MeshError(f"The program {given or 'carreau'} is not on this machine: install Carreau, or set its path in the mesh dialog.")
    return found


class Run:
    """A run of carreau in a new folder. `words` follow the name of the program."""

    def __init__(self, words, folder):
        # Libraries and Python modules that FreeCAD brings are for FreeCAD alone.
        hidden = ("LD_LIBRARY_PATH", "PYTHONPATH", "PYTHONHOME") if os.environ.get("APPIMAGE") else ()
        environment = {name: value for name, value in os.environ.items() if name not in hidden}
        self.lines = []
        self.process = subprocess.Popen([path(), *words], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                        text=True, errors="replace", env=environment)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stderr:
            if line.strip():
                self.lines.append(line.rstrip())

    def ended(self, seconds=0.1):
        """Waits for a moment; True when the program has ended."""
        try:
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            return False
        self._reader.join(5)
        return True

    def cancel(self):
        self.process.terminate()
        if not self.ended(5):
            self.process.kill()

    def check(self):
        """Raises MeshError with the last lines unless the program succeeded."""
        if self.process.returncode != 0:
            raise MeshError("\n".join(self.lines[-8:]) or f"carreau ended with status {self.process.returncode}.")


def run(words, folder, progress=None):
    """Runs carreau. progress(line) gets its lines, and cancels by returning True. Raises MeshError, Cancelled."""
    running, told = Run(words, folder), 0
    while True:
        ended = running.ended()
        while told < len(running.lines):
            told += 1
            if progress is not None and progress(running.lines[told - 1]):
                running.cancel()
                raise Cancelled("The mesh was cancelled.")
        if progress is not None and not ended and progress(""):
            running.cancel()
            raise Cancelled("The mesh was cancelled.")
        if ended:
            running.check()
            return running.lines


def temporary_folder():
    return tempfile.TemporaryDirectory(prefix="carreau-freecad-")
