# SPDX-License-Identifier: BSD-3-Clause
"""The wheel of packaging/wheel.py: it holds every library but glibc, finds them beside it, and lists their licences (Debian package patchelf)."""
import glob
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import zipfile

import pytest

from test_wheel import BUILD, TORUS, bare


def test_a_wheel_holds_all_libraries(source, tmp_path):
    for module in ("pip", "setuptools", "wheel", "venv"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not there")
    for program in ("patchelf", "readelf", "strip", "dpkg-query"):
        if shutil.which(program) is None:
            pytest.skip(f"{program} is not there")
    subprocess.run([sys.executable, os.path.join(source, "packaging/wheel.py"), BUILD, str(tmp_path)], check=True, capture_output=True, env=bare())
    wheel, = glob.glob(str(tmp_path / "*.whl"))
    assert re.search(r"-py3-none-manylinux_2_\d+_\w+\.whl$", wheel) and os.path.getsize(wheel) < 40e6
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
    listed = [name for name in names if name.endswith("licenses/LIBRARIES.txt")]
    assert len(listed) == 1
    environment = tmp_path / "environment"
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", str(environment)], check=True)
    python = str(environment / "bin/python")
    subprocess.run([python, "-m", "pip", "install", "-q", "--no-deps", "--no-index", wheel], check=True, env=bare(), cwd=tmp_path)
    inside, = glob.glob(str(environment / "lib/python3*/site-packages/carreau/lib"))
    with open(glob.glob(os.path.join(os.path.dirname(os.path.dirname(inside)), "carreau-*.dist-info/licenses/LIBRARIES.txt"))[0]) as file:
        licences = file.read()
    for library in glob.glob(inside + "/*.so*"):
        assert os.path.basename(library).startswith("libcarreau") or os.path.basename(library) + " " in licences
        for line in subprocess.run(["ldd", library], check=True, capture_output=True, text=True, env=bare()).stdout.splitlines():
            found = re.match(r"\s*(\S+) => (\S+)", line)
            if found and not re.match(r"(libc|libm|libdl|librt|libpthread)\.so", found[1]):
                assert os.path.dirname(os.path.realpath(found[2])) == os.path.realpath(inside), line
    shapes = os.environ.get("CARREAU_MAKE_SHAPES")
    if shapes:
        subprocess.run([shapes, str(tmp_path)], check=True)
    program = TORUS.format(cad=bool(shapes), part=str(tmp_path / "assembly.step"))
    done = subprocess.run([python, "-c", program], check=True, env=bare(), cwd=tmp_path, capture_output=True, text=True)
    assert str(environment) in done.stdout
