#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""commands.py README WORK BUILD MAKE_SHAPES SOURCE [--refresh]: every command of README is run as pasted, every program built and run
in each way that README has, and the listings compared with what is printed now. --refresh: writes the listings that differ into README.

The build is not made again: `cmake` takes BUILD for build/release. Packages are not installed: `apt-get` does nothing."""
import os
import re
import shutil
import subprocess
import sys

import samples
from listings import listing
from sandbox import Sandbox

README, WORK, BUILD, MAKE_SHAPES, SOURCE = sys.argv[1:6]
SANDBOX = Sandbox(WORK, BUILD, MAKE_SHAPES, SOURCE)


def check_bowl(folder):
    subprocess.run([sys.executable, os.path.join(SOURCE, "tests/readme/bowl.py"), os.path.join(folder, "bowl.mesh")], check=True)
    os.remove(os.path.join(folder, "bowl.mesh"))


def check_step(folder):
    """part.mesh of a program in a folder is closed and has no defect."""
    SANDBOX.run(f"P/bin/carreau check '{os.path.join(folder, 'part.mesh')}' --closed")
    os.remove(os.path.join(folder, "part.mesh"))


def mesh_step(text):
    links = re.findall(r"`((?:cc|c\+\+|gfortran) (?:-std=c\+\+20 )?step\.[^`]*)`", text)
    assert len(links) == 3, links
    for command in links:
        SANDBOX.run(command)
        SANDBOX.run("./a.out")
        check_step(SANDBOX.clone)
        os.remove(os.path.join(SANDBOX.clone, "a.out"))


def link_by_cmake(block):
    folder = os.path.join(WORK, "by cmake")
    os.makedirs(folder)
    for name in ("program.c", "program.f90", "step.c", "part.step", "cad_m.f90", "x.pardom", "blsurf.env"):
        shutil.copy(os.path.join(SANDBOX.clone, name), folder)
    with open(os.path.join(folder, "CMakeLists.txt"), "w") as file:
        file.write("cmake_minimum_required(VERSION 3.25)\nproject(pasted LANGUAGES C Fortran)\nadd_executable(my_c_program program.c)\n"
                   "add_executable(my_fortran_program program.f90)\nadd_executable(my_step_program step.c)\n" + block)
    build = os.path.join(folder, "build")
    real = shutil.which("cmake")
    subprocess.run([real, "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={os.path.join(SANDBOX.clone, 'P')}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([real, "--build", build], check=True, stdout=subprocess.DEVNULL)
    for program in ("my_c_program", "my_fortran_program"):
        subprocess.run([os.path.join(build, program)], cwd=folder, check=True)
        check_bowl(folder)
    subprocess.run([os.path.join(build, "my_step_program")], cwd=folder, check=True)
    check_step(folder)
    subprocess.run([os.path.join(build, "teapot")], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    assert os.path.exists(os.path.join(folder, "x.mesh"))


def main():
    SANDBOX.prepare()
    with open(README, encoding="utf-8") as file:
        text = file.read()
    blocks = re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    # Those in Python are run by tests/python/test_examples.py.
    done = {"sh": 0, "c": 0, "cpp": 0, "fortran": 0, "python": 0, "cmake": 0, "": 0}
    samples.write(text, SANDBOX.clone, "program")
    # The tree P: the commands of "How to link" stand in its sentences.
    inline = re.findall(r"`((?:cc|cmake) [^`]*)`", text[text.index("## How to link"):])
    install = next(command for command in inline if "--prefix P" in command)
    SANDBOX.run(install)
    links = [command for command in inline if command.startswith("cc ")]
    assert len(links) == 2, links
    for command in links:
        SANDBOX.run(command)
        SANDBOX.run("./a.out")
        check_bowl(SANDBOX.clone)
        os.remove(os.path.join(SANDBOX.clone, "a.out"))
    mesh_step(text)
    refreshed_text = text
    for language, block in blocks:
        done[language] += 1  # another language is one that nobody runs
        if language == "sh":
            SANDBOX.run(block)
        elif language == "":
            refreshed_text = listing(block.splitlines(), refreshed_text, SANDBOX.run)
        elif language == "cmake":
            link_by_cmake(block)
    SANDBOX.run("./blsurf")
    assert min(done.values()) > 0 and done["sh"] >= 5, done
    for made in ("part.vtu", "part.png", "faces.png", "domain.png", "teapot.png", "sizes.face.1.png", "x.mesh", "1bna.vtu", "wing.vtu", "volcano.mesh", "head.mesh", "part.mesh", "scan.mesh", "front.vtu", "torus.mesh",
                 "out/teapot/teapot.png"):
        assert os.path.getsize(os.path.join(SANDBOX.clone, made)) > 0, made
    if refreshed_text != text:
        with open(README, "w", encoding="utf-8") as file:
            file.write(refreshed_text)


# The list of what a person has installed is his.
MANIFEST = os.path.join(BUILD, "install_manifest.txt")
if os.path.exists(MANIFEST):
    os.rename(MANIFEST, MANIFEST + ".kept")
try:
    main()
finally:
    if os.path.exists(MANIFEST):
        os.remove(MANIFEST)
    if os.path.exists(MANIFEST + ".kept"):
        os.rename(MANIFEST + ".kept", MANIFEST)
