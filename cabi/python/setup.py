# SPDX-License-Identifier: BSD-3-Clause
"""The wheel of carreau: Python, and the library inside (carreau/lib), so that it serves every Python 3.

The library comes from an existing build (CARREAU_BUILD names its folder), or is built here by CMake without libraries
that other machines may lack (oneTBB, OpenEXR). CARREAU_SOURCE names the project when this folder is a copy.
"""
import glob
import os
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.environ.get("CARREAU_SOURCE", os.path.dirname(os.path.dirname(HERE)))


def built(folder):
    """The folder in which the library is built."""
    given = os.environ.get("CARREAU_BUILD")
    if given:
        return given
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DCARREAU_TESTS=OFF", "-DCARREAU_FORTRAN=OFF",
                    "-DCARREAU_COMMAND=OFF", "-DCARREAU_PYTHON=ON",
                    "-DCARREAU_WERROR=OFF", "-DCARREAU_TBB=OFF", "-DCARREAU_OPENEXR=OFF"], check=True)
    subprocess.run(["cmake", "--build", folder, "--parallel", str(os.cpu_count())], check=True)
    return folder


class WithLibrary(build_py):
    def run(self):
        super().run()
        work = os.path.join(os.path.abspath(self.get_finalized_command("build").build_temp), "carreau")
        tree = os.path.join(work, "tree")
        shutil.rmtree(tree, ignore_errors=True)
        subprocess.run(["cmake", "--install", built(work), "--prefix", tree, "--component", "wheel"], check=True)
        inside = os.path.join(self.build_lib, "carreau", "lib")
        os.makedirs(inside, exist_ok=True)
        # The loader looks for names without versions of the project; readers of CAD files have only one name.
        for name in ("libcarreau*.so.[0-9]", "libcarreau_cad_*.so"):
            for path in glob.glob(os.path.join(tree, "carreau", "lib", name)):
                shutil.copyfile(path, os.path.join(inside, os.path.basename(path)))
        if not glob.glob(os.path.join(inside, "libcarreau.so.*")):
            raise SystemExit("the build has no shared library libcarreau")


class WithBinaries(Distribution):
    """The library is no extension module, but belongs to a machine like one."""

    def has_ext_modules(self):
        return True


class ForEveryPython(bdist_wheel):
    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


setup(distclass=WithBinaries, cmdclass={"build_py": WithLibrary, "bdist_wheel": ForEveryPython})
