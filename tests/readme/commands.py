#!/usr/bin/env python3
"""commands.py README WORK BUILD MAKE_SHAPES SOURCE [--refresh]: every command of README is run as pasted, every program built and run
in each way that README has, and the listings compared with what is printed now. --refresh: writes the listings that differ into README.

The build is not made again: `cmake` takes BUILD for build/release. Packages are not installed: `apt-get` does nothing."""
import math
import os
import re
import shutil
import subprocess
import sys

README, WORK, BUILD, MAKE_SHAPES, SOURCE = sys.argv[1:6]
CLONE = os.path.join(WORK, "clone")
BIN = os.path.join(WORK, "bin")
PREFIX = os.path.join(WORK, "usr local")
PARABOLOID = os.path.join(SOURCE, "tests/cabi/paraboloid")

CMAKE = f"""#!/bin/sh
# What is built already is taken as build/release.
case "$*" in
  "--preset release") exit 0 ;;
  "--build --preset release") exit 0 ;;
  "-S {CLONE} -B {CLONE}/build/release"*) exit 0 ;;
  "--build {CLONE}/build/release"*) exit 0 ;;
  "--install build/release") exec "{shutil.which('cmake')}" --install "{BUILD}" --prefix "{PREFIX}" ;;
  "--install build/release --prefix P") exec "{shutil.which('cmake')}" --install "{BUILD}" --prefix "$PWD/P" ;;
esac
echo "a command of cmake that this test does not know: $*" >&2
exit 1
"""


def shim(name, text):
    path = os.path.join(BIN, name)
    with open(path, "w") as file:
        file.write(text)
    os.chmod(path, 0o755)


def prepare():
    shutil.rmtree(WORK, ignore_errors=True)
    for folder in (BIN, CLONE, os.path.join(CLONE, "build"), os.path.join(CLONE, "failed")):
        os.makedirs(folder)
    for name in os.listdir(SOURCE):
        if name not in ("build", "out", ".git"):
            os.symlink(os.path.join(SOURCE, name), os.path.join(CLONE, name))
    os.symlink(BUILD, os.path.join(CLONE, "build/release"))
    shim("cmake", CMAKE)
    shim("sudo", '#!/bin/sh\nexec "$@"\n')
    shim("apt-get", "#!/bin/sh\nexit 0\n")
    shim("dpkg-query", "#!/bin/sh\nprintf installed\n")
    shim("ctest", "#!/bin/sh\nexit 0\n")  # of tests/run.sh, which runs this test
    # A part of more than seven faces, of which one has a name as README has it.
    shapes = os.path.join(WORK, "shapes")
    os.makedirs(shapes)
    subprocess.run([MAKE_SHAPES, shapes], check=True)
    with open(os.path.join(shapes, "assembly.step")) as file:
        text = file.read()
    with open(os.path.join(CLONE, "part.step"), "w") as file:
        file.write(text.replace("'ball'", "'bore left'"))
    # Of a face that has failed: that of a run that went well lacks it.
    with open(os.path.join(CLONE, "failed/face_7.mesh"), "w") as file:
        file.write("MeshVersionFormatted 2\nDimension 2\nVertices 3\n0 0 0\n1 0 0\n0 1 0\nEdges 3\n1 2 1\n2 3 2\n3 1 3\nEnd\n")
    # The first step of an adaptation.
    with open(os.path.join(CLONE, "step1.mesh"), "w") as file:
        file.write("MeshVersionFormatted 2\nDimension 2\nVertices 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nTriangles 2\n1 2 3 1\n1 3 4 1\nEnd\n")
    with open(os.path.join(CLONE, "step1.sol"), "w") as file:
        file.write("MeshVersionFormatted 2\nDimension 2\nSolAtVertices 4\n1 1\n0.05\n0.1\n0.2\n0.1\nEnd\n")
    for name in ("cad_m.f90", "x.pardom"):
        shutil.copy(os.path.join(PARABOLOID, name), CLONE)
    shutil.copy(os.path.join(SOURCE, "tests/packages/blsurf/blsurf.env"), CLONE)
    shutil.copy(os.path.join(SOURCE, "tests/data/molecule/1bna.pdb"), CLONE)
    write_triangles()
    for name in ("wing.fmt", "volcano.txt", "head.cyl"):
        shutil.copy(os.path.join(SOURCE, "tests/data/grid", name), CLONE)


def write_triangles():
    """A hexagonal bar as part.stl, an octahedron of 512 triangles on a sphere as scan.off."""
    ring = [(math.cos(k * math.pi / 3), math.sin(k * math.pi / 3)) for k in range(6)]
    triangles = []
    for k in range(6):
        (a, b), (c, d) = ring[k], ring[(k + 1) % 6]
        triangles += [((a, b, 0), (c, d, 0), (c, d, 1)), ((a, b, 0), (c, d, 1), (a, b, 1))]
        triangles += [((0, 0, 1), (a, b, 1), (c, d, 1)), ((0, 0, 0), (c, d, 0), (a, b, 0))]
    with open(os.path.join(CLONE, "part.stl"), "w") as file:
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
    with open(os.path.join(CLONE, "scan.off"), "w") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines(f"{x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in vertices)
        file.writelines(f"3 {i} {j} {k}\n" for i, j, k in faces)


def environment():
    return os.environ | {"PATH": BIN + ":" + os.path.join(PREFIX, "bin") + ":" + os.environ["PATH"], "NO_COLOR": "1",
                         "PKG_CONFIG_PATH": os.path.join(CLONE, "P/lib/pkgconfig"), "LD_LIBRARY_PATH": os.path.join(CLONE, "P/lib")}


def run(script, check=True):
    done = subprocess.run(["bash", "-e", "-c", script], cwd=CLONE, env=environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=600)
    if check and done.returncode != 0:
        sys.exit(f"status {done.returncode} of\n{script}\n{done.stdout}")
    return done.stdout


def same(shown, printed):
    """Times, and how many threads a machine has, differ from run to run."""
    if shown.startswith("seconds") and printed.startswith("seconds"):
        shown, printed = (re.sub(r"[\d.]+|threads?", "#", line) for line in (shown, printed))
    return shown.rstrip() == printed.rstrip()


def matches(shown, printed):
    """Lines of a listing, in which ... stands for any lines."""
    if not shown:
        return not printed
    if shown[0] == "…":
        return any(matches(shown[1:], printed[k:]) for k in range(len(printed) + 1))
    return bool(printed) and same(shown[0], printed[0]) and matches(shown[1:], printed[1:])


def refreshed(shown, printed):
    """Each line that differs in numbers only has those of today."""
    def words(line):
        return re.sub(r"\d[\d.]*", "#", line)
    return [line if line == "…" or line in printed else next((p for p in printed if words(p) == words(line)), line) for line in shown]


def listing(block, text):
    """Commands after `$ `, each with what it prints."""
    at = [i for i, line in enumerate(block) if line.startswith("$ ")]
    for begin, end in zip(at, at[1:] + [len(block)]):
        shown, printed = block[begin + 1:end], run(block[begin][2:]).splitlines()
        if matches(shown, printed):
            continue
        if "--refresh" not in sys.argv:
            sys.exit("README shows\n" + "\n".join(shown) + "\nand\n" + "\n".join(printed) + "\nis printed; --refresh changes README")
        text = text.replace("\n".join(shown), "\n".join(refreshed(shown, printed)))
    return text


def check_bowl(folder):
    subprocess.run([sys.executable, os.path.join(SOURCE, "tests/readme/bowl.py"), os.path.join(folder, "bowl.mesh")], check=True)
    os.remove(os.path.join(folder, "bowl.mesh"))


def check_step(folder):
    """part.mesh of a program in a folder is closed and has no defect."""
    run(f"P/bin/carreau check '{os.path.join(folder, 'part.mesh')}' --closed")
    os.remove(os.path.join(folder, "part.mesh"))


def mesh_step(text):
    links = re.findall(r"`((?:cc|c\+\+|gfortran) step\.[^`]*)`", text)
    assert len(links) == 3, links
    for command in links:
        run(command)
        run("./a.out")
        check_step(CLONE)
        os.remove(os.path.join(CLONE, "a.out"))


def link_by_cmake(block):
    folder = os.path.join(WORK, "by cmake")
    os.makedirs(folder)
    for name in ("program.c", "program.f90", "step.c", "part.step", "cad_m.f90", "x.pardom", "blsurf.env"):
        shutil.copy(os.path.join(CLONE, name), folder)
    with open(os.path.join(folder, "CMakeLists.txt"), "w") as file:
        file.write("cmake_minimum_required(VERSION 3.25)\nproject(pasted LANGUAGES C Fortran)\nadd_executable(my_c_program program.c)\n"
                   "add_executable(my_fortran_program program.f90)\nadd_executable(my_step_program step.c)\n" + block)
    build = os.path.join(folder, "build")
    real = shutil.which("cmake")
    subprocess.run([real, "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={os.path.join(CLONE, 'P')}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([real, "--build", build], check=True, stdout=subprocess.DEVNULL)
    for program in ("my_c_program", "my_fortran_program"):
        subprocess.run([os.path.join(build, program)], cwd=folder, check=True)
        check_bowl(folder)
    subprocess.run([os.path.join(build, "my_step_program")], cwd=folder, check=True)
    check_step(folder)
    subprocess.run([os.path.join(build, "teapot")], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    assert os.path.exists(os.path.join(folder, "x.mesh"))


def main():
    prepare()
    with open(README, encoding="utf-8") as file:
        text = file.read()
    blocks = re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    # Those in Python are run by tests/python/test_examples.py.
    done = {"sh": 0, "c": 0, "cpp": 0, "fortran": 0, "python": 0, "cmake": 0, "": 0}
    for language, name in (("c", "program.c"), ("fortran", "program.f90"), ("c", "step.c"), ("cpp", "step.cpp"), ("fortran", "step.f90")):
        source, = (block for kind, block in blocks if kind == language and ("carreau_cad_open" in block) == name.startswith("step"))
        with open(os.path.join(CLONE, name), "w", encoding="utf-8") as file:
            file.write(source)
    # The tree P: the commands of "How to link" stand in its sentences.
    inline = re.findall(r"`((?:cc|cmake) [^`]*)`", text[text.index("## How to link"):])
    install = next(command for command in inline if "--prefix P" in command)
    run(install)
    links = [command for command in inline if command.startswith("cc ")]
    assert len(links) == 2, links
    for command in links:
        run(command)
        run("./a.out")
        check_bowl(CLONE)
        os.remove(os.path.join(CLONE, "a.out"))
    mesh_step(text)
    refreshed_text = text
    for language, block in blocks:
        done[language] += 1  # another language is one that nobody runs
        if language == "sh":
            run(block)
        elif language == "":
            refreshed_text = listing(block.splitlines(), refreshed_text)
        elif language == "cmake":
            link_by_cmake(block)
    run("./blsurf")
    assert min(done.values()) > 0 and done["sh"] >= 5, done
    for made in ("part.vtu", "part.png", "faces.png", "domain.png", "teapot.png", "sizes.face.1.png", "x.mesh", "1bna.vtu", "wing.vtu", "volcano.mesh", "head.mesh", "part.mesh", "scan.mesh", "front.vtu", "torus.mesh",
                 "out/teapot/teapot.png"):
        assert os.path.getsize(os.path.join(CLONE, made)) > 0, made
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
