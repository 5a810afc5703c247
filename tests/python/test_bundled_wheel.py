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


def test_libraries_of_another_machine_are_found_by_its_compiler(source, tmp_path):
    compiler = shutil.which("aarch64-linux-gnu-g++")
    for program in ("patchelf", "readelf", "dpkg-query"):
        if shutil.which(program) is None:
            pytest.skip(f"{program} is not there")
    if compiler is None:
        pytest.skip("no compiler of another machine (Debian package g++-aarch64-linux-gnu) is there")
    (tmp_path / "CMakeCache.txt").write_text(f"CMAKE_CXX_COMPILER:FILEPATH={compiler}\nCMAKE_STRIP:FILEPATH={shutil.which('aarch64-linux-gnu-strip')}\n")
    libraries, programs = tmp_path / "tree/lib", tmp_path / "tree/bin"
    libraries.mkdir(parents=True)
    programs.mkdir()
    (tmp_path / "text.cpp").write_text("#include <string>\nstd::string text(int n) { return std::to_string(n); }\nint main() { return int(text(7).size()) - 1; }\n")
    flags = [compiler, str(tmp_path / "text.cpp"), "-fPIC", "-o"]
    subprocess.run([*flags, str(libraries / "libcarreau.so.0"), "-shared"], check=True)
    subprocess.run([*flags, str(programs / "carreau")], check=True)
    done = subprocess.run([sys.executable, os.path.join(source, "packaging/bundle.py"), str(tmp_path), str(tmp_path / "tree")], check=True, capture_output=True, text=True)
    assert done.stdout.rstrip().endswith("aarch64")
    assert {"libstdc++.so.6", "libgcc_s.so.1"} <= set(os.listdir(libraries))
    dynamic = subprocess.run(["readelf", "-hd", str(libraries / "libstdc++.so.6"), str(programs / "carreau")], check=True, capture_output=True, text=True).stdout
    assert dynamic.count("AArch64") == 2 and "[$ORIGIN]" in dynamic and "[$ORIGIN/../lib]" in dynamic
    assert "libstdc++.so.6  libstdc++6-arm64-cross " in (tmp_path / "tree/share/doc/carreau/licenses/LIBRARIES.txt").read_text()
    emulator = shutil.which("qemu-aarch64-static")
    if emulator is not None:
        subprocess.run([emulator, "-L", "/usr/aarch64-linux-gnu", str(programs / "carreau")], check=True)


def test_a_wheel_holds_all_libraries(source, tmp_path):
    for module in ("pip", "setuptools", "wheel", "venv"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not there")
    for program in ("patchelf", "readelf", "strip", "dpkg-query"):
        if shutil.which(program) is None:
            pytest.skip(f"{program} is not there")
    subprocess.run([sys.executable, os.path.join(source, "packaging/wheel.py"), BUILD, str(tmp_path), "1"], check=True, capture_output=True, env=bare())
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
