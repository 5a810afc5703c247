#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""commands.py WORK BUILD SOURCE: runs the commands of README and of docs/how-to/install.md as pasted, in a clone, and builds and runs their programs in each
way that these pages have.

The build is not made again: `cmake` takes BUILD for build/release. Packages are not installed: `apt-get` does nothing."""
import os
import re
import shutil
import subprocess
import sys

import samples
from sandbox import Clone

WORK, BUILD, SOURCE = sys.argv[1:4]
README, INSTALL = os.path.join(SOURCE, "README.md"), os.path.join(SOURCE, "docs/how-to/install.md")
CLONE = Clone(WORK, BUILD, SOURCE)


def blocks(text):
    return re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def check_bowl(folder):
    subprocess.run([sys.executable, os.path.join(SOURCE, "tests/readme/bowl.py"), os.path.join(folder, "bowl.mesh")], check=True)
    os.remove(os.path.join(folder, "bowl.mesh"))


def check_step(folder):
    """part.mesh of a program in a folder is closed and has no defect."""
    CLONE.run(f"P/bin/carreau check '{os.path.join(folder, 'part.mesh')}' --closed")


def prepare_programs():
    """The reader's own files: programs, a part, a module cad_m."""
    samples.write(README, CLONE.folder, [os.path.join(SOURCE, "docs/how-to", page) for page in ("cpp_host.md", "cad_in_program.md")])
    for name, new in (("bowl.c", "program.c"), ("bowl.f90", "program.f90")):
        shutil.copy(os.path.join(CLONE.folder, name), os.path.join(CLONE.folder, new))
    shutil.copy(os.path.join(SOURCE, "docs/data/bracket.step"), os.path.join(CLONE.folder, "part.step"))
    for name in ("tests/cabi/paraboloid/cad_m.f90", "tests/cabi/paraboloid/x.pardom", "tests/packages/blsurf/blsurf.env"):
        shutil.copy(os.path.join(SOURCE, name), CLONE.folder)


def link_by_cmake(block):
    folder = os.path.join(WORK, "by cmake")
    os.makedirs(folder)
    for name in ("program.c", "program.f90", "step.c", "part.step", "cad_m.f90", "x.pardom", "blsurf.env"):
        shutil.copy(os.path.join(CLONE.folder, name), folder)
    with open(os.path.join(folder, "CMakeLists.txt"), "w") as file:
        file.write("cmake_minimum_required(VERSION 3.25)\nproject(pasted LANGUAGES C Fortran)\nadd_executable(my_c_program program.c)\n"
                   "add_executable(my_fortran_program program.f90)\nadd_executable(my_step_program step.c)\n" + block)
    build = os.path.join(folder, "build")
    real = shutil.which("cmake")
    subprocess.run([real, "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={os.path.join(CLONE.folder, 'P')}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([real, "--build", build], check=True, stdout=subprocess.DEVNULL)
    for program in ("my_c_program", "my_fortran_program"):
        subprocess.run([os.path.join(build, program)], cwd=folder, check=True)
        check_bowl(folder)
    subprocess.run([os.path.join(build, "my_step_program")], cwd=folder, check=True)
    check_step(folder)
    subprocess.run([os.path.join(build, "teapot")], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    assert os.path.exists(os.path.join(folder, "x.mesh"))


def install():
    with open(INSTALL, encoding="utf-8") as file:
        text = file.read()
    prose = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    inline = [command for command in re.findall(r"`([^`]*)`", prose) if command.startswith(("cc ", "cmake --install"))]
    CLONE.run(next(command for command in inline if "--prefix P" in command))
    links = [command for command in inline if command.startswith("cc ")]
    assert len(links) == 2, links
    for command in links:
        CLONE.run(f"export PKG_CONFIG_PATH=P/lib/pkgconfig; {command}; LD_LIBRARY_PATH=P/lib ./a.out")
        check_bowl(CLONE.folder)
    for language, block in blocks(text):
        if language == "sh":
            CLONE.run(block)
        elif language == "cmake":
            link_by_cmake(block)
    CLONE.run("./blsurf")
    assert CLONE.size("x.mesh")


def readme():
    with open(README, encoding="utf-8") as file:
        text = file.read()
    for language, block in blocks(text):
        assert language in ("sh", "c"), f"a block of README that nobody runs: {language}"
        if language == "sh":
            CLONE.run(block)
    proofs = [command for command in re.findall(r"^\|[^|]*\| `([^`]*)`", text, re.M) if command.startswith(("carreau", "for "))]
    assert len(proofs) == 3, proofs
    for command in proofs:
        printed = CLONE.run(command)
        if "--json" in command:
            assert '"A0_bound"' in printed and '"A1_bound"' in printed
    for made in ("part.vtu", "part.msh", "stretched.vtu", "out/teapot/teapot.png"):
        assert CLONE.size(made), made


# The user's list of installed files.
MANIFEST = os.path.join(BUILD, "install_manifest.txt")
if os.path.exists(MANIFEST):
    os.rename(MANIFEST, MANIFEST + ".kept")
try:
    prepare_programs()
    install()
    readme()
finally:
    if os.path.exists(MANIFEST):
        os.remove(MANIFEST)
    if os.path.exists(MANIFEST + ".kept"):
        os.rename(MANIFEST + ".kept", MANIFEST)
