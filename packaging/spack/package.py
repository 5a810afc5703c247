# SPDX-License-Identifier: BSD-3-Clause
"""Recipe for Spack: a file package.py in a folder packages/carreau of a repository."""
from spack.package import *


class Carreau(CMakePackage):
    """Conforming meshes of surfaces made of parametric patches."""

    homepage = "https://example.org/carreau"
    url = "https://example.org/carreau-0.1.0.tar.gz"

    license("BSD-3-Clause")
    version("0.1.0", sha256="0000000000000000000000000000000000000000000000000000000000000000")

    variant("cad", default=True, description="Reads STEP, IGES and BREP files (OpenCASCADE)")
    variant("fortran", default=False, description="Fortran modules")
    variant("mpi", default=False, description="Meshes by many processes")
    variant("python", default=True, description="Python package")

    depends_on("cxx", type="build")
    depends_on("c", type="build")
    depends_on("fortran", type="build", when="+fortran")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("cli11")
    depends_on("eigen")
    depends_on("intel-oneapi-tbb")
    depends_on("libpng")
    depends_on("muparser")
    depends_on("nlohmann-json")
    depends_on("openexr@3.1:")
    depends_on("zlib-api")
    depends_on("opencascade@7.6:", when="+cad")
    depends_on("mpi", when="+mpi")
    depends_on("python@3.9:", type=("build", "run"), when="+python")
    depends_on("py-numpy@1.20:", type=("build", "run"), when="+python")

    def cmake_args(self):
        return [
            self.define("CARREAU_WERROR", False),
            self.define("CARREAU_TESTS", False),
            self.define("CARREAU_MED", False),
            self.define_from_variant("CARREAU_OPENCASCADE", "cad"),
            self.define_from_variant("CARREAU_FORTRAN", "fortran"),
            self.define_from_variant("CARREAU_MPI", "mpi"),
            self.define_from_variant("CARREAU_PYTHON", "python"),
        ]
