# SPDX-License-Identifier: BSD-3-Clause
"""A folder in which commands of pages run as pasted: a clone with the files that they name, what was built in place of build/release, and
`apt-get`, `sudo` and `cmake` that change nothing outside."""
import math
import os
import shutil
import subprocess
import sys

CMAKE = """#!/bin/sh
# What is built already is taken as build/release.
case "$*" in
  "--preset release") exit 0 ;;
  "--build --preset release") exit 0 ;;
  "-S @CLONE@ -B @CLONE@/build/release"*) exit 0 ;;
  "--build @CLONE@/build/release"*) exit 0 ;;
  "--install build/release") exec "@REAL@" --install "@BUILD@" --prefix "@PREFIX@" ;;
  "--install build/release --prefix P") exec "@REAL@" --install "@BUILD@" --prefix "$PWD/P" ;;
esac
echo "a command of cmake that this test does not know: $*" >&2
exit 1
"""


class Sandbox:
    """work: the folder, made anew. build: a build of source. make_shapes: the program that makes CAD files. prefix: where the build is installed
    already; without it the commands of a page install it."""

    def __init__(self, work, build, make_shapes, source, prefix=None):
        self.work, self.build, self.make_shapes, self.source = work, build, make_shapes, source
        self.clone, self.bin = os.path.join(work, "clone"), os.path.join(work, "bin")
        self.installed = prefix is not None
        self.prefix = prefix or os.path.join(work, "usr local")
        self.tree = os.path.join(self.clone, "P")  # where headers and libraries are

    def _shim(self, name, text):
        path = os.path.join(self.bin, name)
        with open(path, "w") as file:
            file.write(text)
        os.chmod(path, 0o755)

    def prepare(self):
        shutil.rmtree(self.work, ignore_errors=True)
        for folder in (self.bin, self.clone, os.path.join(self.clone, "build"), os.path.join(self.clone, "failed")):
            os.makedirs(folder)
        for name in os.listdir(self.source):
            if name not in ("build", "out", ".git"):
                os.symlink(os.path.join(self.source, name), os.path.join(self.clone, name))
        os.symlink(self.build, os.path.join(self.clone, "build/release"))
        if not self.installed:
            cmake = CMAKE.replace("@CLONE@", self.clone).replace("@REAL@", shutil.which("cmake"))
            self._shim("cmake", cmake.replace("@BUILD@", self.build).replace("@PREFIX@", self.prefix))
        else:
            os.symlink(self.prefix, os.path.join(self.clone, "P"))
        self._shim("sudo", '#!/bin/sh\nexec "$@"\n')
        self._shim("apt-get", "#!/bin/sh\nexit 0\n")
        self._shim("dpkg-query", "#!/bin/sh\nprintf installed\n")
        self._shim("ctest", "#!/bin/sh\nexit 0\n")  # of tests/run.sh, which runs this test
        self._write_part()
        self._write_steps()
        for name in ("tests/cabi/paraboloid/cad_m.f90", "tests/cabi/paraboloid/x.pardom", "tests/packages/blsurf/blsurf.env",
                     "tests/data/molecule/1bna.pdb", "tests/data/molecule/caffeine.xyzr", "tests/data/grid/wing.fmt", "tests/data/grid/volcano.txt",
                     "tests/data/grid/head.cyl"):
            shutil.copy(os.path.join(self.source, name), self.clone)
        write_triangles(self.clone)

    def _write_part(self):
        """A part of more than seven faces, of which one has a name as README has it."""
        shapes = os.path.join(self.work, "shapes")
        os.makedirs(shapes)
        subprocess.run([self.make_shapes, shapes], check=True)
        with open(os.path.join(shapes, "assembly.step")) as file:
            text = file.read()
        with open(os.path.join(self.clone, "part.step"), "w") as file:
            file.write(text.replace("'ball'", "'bore left'"))
        for name in ("bracket.step", "quarter_plate.step"):
            shutil.copy(os.path.join(shapes, name), self.clone)
        # Of a face that has failed: that of a run that went well lacks it.
        with open(os.path.join(self.clone, "failed/face_7.mesh"), "w") as file:
            file.write("MeshVersionFormatted 2\nDimension 2\nVertices 3\n0 0 0\n1 0 0\n0 1 0\nEdges 3\n1 2 1\n2 3 2\n3 1 3\nEnd\n")

    def _write_steps(self):
        """The first step of an adaptation."""
        with open(os.path.join(self.clone, "step1.mesh"), "w") as file:
            file.write("MeshVersionFormatted 2\nDimension 2\nVertices 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nTriangles 2\n1 2 3 1\n1 3 4 1\nEnd\n")
        with open(os.path.join(self.clone, "step1.sol"), "w") as file:
            file.write("MeshVersionFormatted 2\nDimension 2\nSolAtVertices 4\n1 1\n0.05\n0.1\n0.2\n0.1\nEnd\n")

    def environment(self):
        return os.environ | {"PATH": self.bin + ":" + os.path.join(self.prefix, "bin") + ":" + os.environ["PATH"], "NO_COLOR": "1",
                             "PKG_CONFIG_PATH": os.path.join(self.tree, "lib/pkgconfig"), "LD_LIBRARY_PATH": os.path.join(self.tree, "lib"),
                             "CMAKE_PREFIX_PATH": self.tree}

    def run(self, script, check=True):
        """What a script of bash prints; its status is 0 unless `check` is False."""
        done = subprocess.run(["bash", "-e", "-c", script], cwd=self.clone, env=self.environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=600)
        if check and done.returncode != 0:
            sys.exit(f"status {done.returncode} of\n{script}\n{done.stdout}")
        return done.stdout

    def write(self, name, text):
        path = os.path.join(self.clone, name)
        if os.path.islink(path):  # of the source, which stays as it is
            os.remove(path)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def size(self, name):
        """Of a file, in bytes; 0 when it is not there."""
        path = os.path.join(self.clone, name)
        return os.path.getsize(path) if os.path.exists(path) else 0


def write_triangles(folder):
    """A hexagonal bar as part.stl, an octahedron of 512 triangles on a sphere as scan.off."""
    ring = [(math.cos(k * math.pi / 3), math.sin(k * math.pi / 3)) for k in range(6)]
    triangles = []
    for k in range(6):
        (a, b), (c, d) = ring[k], ring[(k + 1) % 6]
        triangles += [((a, b, 0), (c, d, 0), (c, d, 1)), ((a, b, 0), (c, d, 1), (a, b, 1))]
        triangles += [((0, 0, 1), (a, b, 1), (c, d, 1)), ((0, 0, 0), (c, d, 0), (a, b, 0))]
    with open(os.path.join(folder, "part.stl"), "w") as file:
        file.write("solid bar\n")
        for triangle in triangles:
            corners = "".join(f"vertex {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in triangle)
            file.write(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        file.write("endsolid bar\n")
    vertices, faces = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], []
    for k in range(4):
        faces += [(k, (k + 1) % 4, 4), ((k + 1) % 4, k, 5)]
    for _ in range(3):
        middle, finer = {}, []

        def between(i, j):
            if (min(i, j), max(i, j)) not in middle:
                middle[min(i, j), max(i, j)] = len(vertices)
                p = [x + y for x, y in zip(vertices[i], vertices[j])]
                vertices.append(tuple(x / math.hypot(*p) for x in p))
            return middle[min(i, j), max(i, j)]

        for i, j, k in faces:
            a, b, c = between(i, j), between(j, k), between(k, i)
            finer += [(i, a, c), (a, j, b), (c, b, k), (a, b, c)]
        faces = finer
    with open(os.path.join(folder, "scan.off"), "w") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines(f"{x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in vertices)
        file.writelines(f"3 {i} {j} {k}\n" for i, j, k in faces)
