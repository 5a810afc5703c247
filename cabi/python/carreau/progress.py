# SPDX-License-Identifier: BSD-3-Clause
"""Progress of a run: a bar on the error output, or whatever a function makes of it."""
from __future__ import annotations

import sys
import time
from typing import Any, Callable, Optional, TextIO, Union

PHASES = ("idle", "model", "curves", "patches", "assembly", "writing", "measure", "gradation")
#: True: a bar; a function of (fraction, phase, entity), whose result, when it is true, stops the run.
Progress = Union[None, bool, Callable[[float, str, int], Any]]


class Bar:
    """A bar on one line, drawn ten times a second at most.

    fraction   of the run, 0 to 1
    phase      one of PHASES
    entity     reference of the face or curve at work, 0: none
    """

    WIDTH, PAUSE = 40, 0.1

    def __init__(self, out: Optional[TextIO] = None) -> None:
        self.out, self.drawn, self.any = out or sys.stderr, 0.0, False

    def __call__(self, fraction: float, phase: str, entity: int) -> None:
        now = time.monotonic()
        if now - self.drawn < self.PAUSE:
            return
        self.drawn, self.any = now, True
        full = round(self.WIDTH * fraction)
        at = f" {entity}" if entity else ""
        self.out.write(f"\r[{'#' * full}{'.' * (self.WIDTH - full)}] {100 * fraction:3.0f} %  {phase}{at}".ljust(self.WIDTH + 30))
        self.out.flush()

    def close(self) -> None:
        """Takes the bar away."""
        if self.any:
            self.out.write("\r" + " " * (self.WIDTH + 30) + "\r")
            self.out.flush()


def listener(progress: Progress) -> Optional[Callable[[float, str, int], Any]]:
    """The function that receives the progress; None: no function."""
    if progress is None or progress is False:
        return None
    return Bar() if progress is True else progress
