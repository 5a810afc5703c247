# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C ends a run at once, wherever it is, and the session is of use after it."""
import os
import signal
import subprocess
import sys
import textwrap
import time

import pytest

RUNS = {
    # Python runs: callbacks.
    "callbacks": """
        patch = carreau.Patch(carreau.scalar(lambda u, v: (u, v, sum(math.sin(k * u) for k in range(300)) / 1e4)))
        call = lambda: carreau.mesh(patch, size=0.002)""",
    # A callback that takes long.
    "slow": """
        def slow(u, v):
            time.sleep(60)
        session = carreau.Session(hphydef=0.1)
        session.add(carreau.Patch(slow))
        call = session.generate""",
    # The library runs, and no line of Python: built-in patches, by several threads.
    "library": """
        net = [[[i, j, 0.2 * i * j * (3 - j)] for j in range(4)] for i in range(4)]
        session = carreau.Session(hphydef=0.002, hphymin=0.001, threads=2)
        session.add_bezier([net])
        call = session.generate""",
}
PROGRAM = """
import math, sys, time
import carreau
{run}
print("running", flush=True)
try:
    call()
except KeyboardInterrupt:
    small = carreau.mesh("z = x * y", size="20%")
    print("interrupted", len(small.triangles) > 0, flush=True)
    sys.exit(0)
sys.exit("the run has ended by itself")
"""


@pytest.mark.parametrize("name", RUNS)
def test_ctrl_c_ends_a_run(name):
    program = PROGRAM.format(run=textwrap.dedent(RUNS[name]))
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stdout.readline() == "running\n"
        time.sleep(1.0)
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)
        assert process.returncode == 0, err
        assert out == "interrupted True\n" and "ignored" not in err
        # 100 ms by the contract, a small mesh, the end of an interpreter; a busy machine takes its time.
        assert time.monotonic() - start < 15
    finally:
        process.kill()


def test_other_threads_stop_a_run():
    import threading

    import carreau
    net = [[[i, j, 0.2 * i * j * (3 - j)] for j in range(4)] for i in range(4)]
    session = carreau.Session(hphydef=0.002, hphymin=0.001)
    session.add_bezier([net])
    threading.Timer(0.3, session.stop).start()
    with pytest.raises(carreau.Cancelled):
        session.generate()


def test_the_handlers_of_the_program_are_as_before():
    import carreau
    before, fd = signal.getsignal(signal.SIGINT), os.pipe()
    os.set_blocking(fd[1], False)
    try:
        signal.set_wakeup_fd(fd[1])
        carreau.mesh("z = x * y", size="20%")
        assert signal.getsignal(signal.SIGINT) is before
        assert signal.set_wakeup_fd(-1) == fd[1]
    finally:
        signal.set_wakeup_fd(-1)
        os.close(fd[0])
        os.close(fd[1])
