# SPDX-License-Identifier: BSD-3-Clause
"""The package as users have it: as a wheel in a virtual environment, and as `cmake --install` puts it."""
import glob
import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile

import pytest

BUILD = os.environ["CARREAU_BUILD"]
TORUS = """
import math, numpy as np, carreau
print(carreau.__file__)
torus = lambda u, v: ((2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v))
mesh = carreau.mesh(torus, domain=(0, 0, 2 * np.pi, 2 * np.pi), size=0.2)
assert mesh.check(closed=True) == [] and abs(mesh.quality.area / (8 * math.pi ** 2) - 1) < 0.01
if {cad}:
    assert carreau.mesh({part!r}, size="5%").check(closed=True) == []
"""


def bare():
    """An environment in which no variable gives the place of the package."""
    return {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "CARREAU_LIBRARY_PATH", "LD_LIBRARY_PATH")}


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    folder = tmp_path_factory.mktemp("shapes")
    shapes = os.environ.get("CARREAU_MAKE_SHAPES")
    if shapes:
        subprocess.run([shapes, str(folder)], check=True)
    return TORUS.format(cad=bool(shapes), part=str(folder / "assembly.step"))


def test_a_wheel_serves_a_virtual_environment(source, tmp_path, program):
    for module in ("pip", "setuptools", "wheel", "venv"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not there")
    copy = tmp_path / "python"
    shutil.copytree(os.path.join(source, "cabi/python"), copy, ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "--no-index", "-w", str(tmp_path), str(copy)],
                   check=True, env={**bare(), "CARREAU_SOURCE": source, "CARREAU_BUILD": BUILD}, cwd=tmp_path)
    wheel, = glob.glob(str(tmp_path / "*.whl"))
    assert os.path.basename(wheel).startswith("carreau-0.1.0-py3-none-linux_")
    names = zipfile.ZipFile(wheel).namelist()
    assert "carreau/lib/libcarreau.so.0" in names and "carreau/py.typed" in names
    for name in names:  # nothing knows where it was built
        assert BUILD.encode() not in zipfile.ZipFile(wheel).read(name), name
    environment = tmp_path / "environment"
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", str(environment)], check=True)
    python = str(environment / "bin/python")
    subprocess.run([python, "-m", "pip", "install", "-q", "--no-deps", "--no-index", wheel], check=True, env=bare(), cwd=tmp_path)
    done = subprocess.run([python, "-c", program], check=True, env=bare(), cwd=tmp_path, capture_output=True, text=True)
    assert str(environment) in done.stdout


def test_the_component_python_finds_the_library_beside_it(tmp_path, program):
    tree = tmp_path / "a tree"
    for component in ("python", "wheel"):
        subprocess.run(["cmake", "--install", BUILD, "--prefix", str(tree), "--component", component], check=True, stdout=subprocess.DEVNULL)
    package, = glob.glob(str(tree / "lib/python3*/dist-packages"))
    assert glob.glob(package + "/carreau-*.dist-info/METADATA") and os.path.exists(package + "/carreau/py.typed")
    # The component runtime puts it into lib.
    for library in (tree / "carreau/lib").iterdir():
        shutil.move(library, tree / "lib")
    done = subprocess.run([sys.executable, "-c", program], check=True, env={**bare(), "PYTHONPATH": package}, cwd=tmp_path,
                          capture_output=True, text=True)
    assert package in done.stdout
