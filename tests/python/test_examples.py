# SPDX-License-Identifier: BSD-3-Clause
"""Examples and listings run as they stand."""
import math
import os
import re
import shutil
import subprocess
import sys

import pytest

import carreau
from conftest import SOURCE, needs

EXAMPLES = os.path.join(SOURCE, "cabi/python/examples")


@pytest.fixture(scope="module")
def work(tmp_path_factory):
    """A folder with the files that listings name."""
    folder = tmp_path_factory.mktemp("listings")
    if os.environ.get("CARREAU_MAKE_SHAPES"):
        subprocess.run([os.environ["CARREAU_MAKE_SHAPES"], str(folder)], check=True)
        shutil.copy(folder / "assembly.step", folder / "part.step")
    for name in ("tests/data/molecule/1bna.pdb", "docs/data/bracket.step"):
        shutil.copy(os.path.join(SOURCE, name), folder)
    carreau.mesh("z = x * y", size=0.2).write(folder / "scan.stl")
    return folder


def run(folder, *arguments):
    done = subprocess.run([sys.executable, *arguments], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_torus(work):
    assert "defects []" in run(work, os.path.join(EXAMPLES, "torus.py"))
    assert carreau.read(work / "torus.vtu").quality.area == pytest.approx(8 * math.pi ** 2, rel=2e-3)


def test_molecule(work):
    printed = run(work, os.path.join(EXAMPLES, "molecule.py"))
    exact = float(re.search(r"ses: area ([\d.]+)", printed).group(1))
    assert "defects []" in printed
    assert carreau.read(work / "molecule.vtu").quality.area == pytest.approx(exact, rel=0.03)
    assert "vws: area" in run(work, os.path.join(EXAMPLES, "molecule.py"), "1bna.pdb")


@needs("CARREAU_MAKE_SHAPES")
def test_step_field(work):
    printed = run(work, os.path.join(EXAMPLES, "step_field.py"), "part.step")
    match = re.search(r"error of ([\d.e-]+) become \d+ with ([\d.e-]+)", printed)
    before, after = map(float, match.groups())
    assert after < before / 2
    assert b"temperature" in (work / "adapted.vtu").read_bytes()


@needs("CARREAU_MAKE_SHAPES")
@pytest.mark.parametrize("page", ["docs/tutorials/python.md", "cabi/python/README.md"])
def test_listings(work, page):
    with open(os.path.join(SOURCE, page), encoding="utf-8") as file:
        blocks = re.findall(r"^```python\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)
    assert blocks
    # A page is one program: later listings use the results of earlier ones.
    (work / "page.py").write_text("\n".join(blocks), encoding="utf-8")
    run(work, "page.py")
