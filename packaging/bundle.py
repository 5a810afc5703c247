#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bundle.py BUILD TREE: copies the libraries that an installed tree needs into it, for its architecture; glibc stays outside. BUILD is the CMake
build folder. The licences go to TREE/share/doc/carreau/licenses. `cpack` and wheel.py use it.

It needs patchelf, readelf and dpkg-query (Debian: patchelf, binutils)."""
import glob
import os
import re
import shutil
import struct
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Parts of glibc, which every machine has.
SYSTEM = re.compile(r"(ld-linux.*|libc|libm|libdl|librt|libpthread|libresolv|libutil)\.so[.0-9]*$")
MACHINES = {3: "i686", 21: "ppc64le", 22: "s390x", 62: "x86_64", 183: "aarch64", 243: "riscv64"}  # ELF's numbers
MPI = "libcarreau_mpi.so*"  # it serves the MPI of its machine, whose own parts belong together


def output(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def machine(path):
    """The architecture of a library or program; "": it is no ELF file."""
    with open(path, "rb") as file:
        head = file.read(20)
    return MACHINES.get(struct.unpack("<H", head[18:20])[0], "") if head[:4] == b"\x7fELF" else ""


class Bundle:
    """The libraries beside libcarreau in a folder."""

    def __init__(self, build, libraries, programs=()):
        self.libraries, self.programs = libraries, programs
        self.added = {}  # original paths by name
        with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
            cache = dict(re.findall(r"^(CMAKE_CXX_COMPILER|CMAKE_STRIP):\w+=(.*)$", file.read(), flags=re.M))
        self.compiler, self.strip = cache["CMAKE_CXX_COMPILER"], cache.get("CMAKE_STRIP", "strip")
        self.machine = machine(os.path.realpath(glob.glob(os.path.join(libraries, "libcarreau.so*"))[0]))

    def files(self):
        """Shared libraries that are no links, and programs."""
        found = [path for path in glob.glob(os.path.join(self.libraries, "*.so*")) if not os.path.islink(path)]
        apart = glob.glob(os.path.join(self.libraries, MPI))
        return [path for path in sorted(found) + list(self.programs) if path not in apart]

    def source(self, name, needed_by, folders):
        """The file of a library: beside the library that needs it, or where the compiler links it."""
        linked = output(self.compiler, "-print-file-name=" + name).strip()
        for path in [os.path.join(folder, name) for folder in folders] + [linked]:
            if os.path.isabs(path) and os.path.exists(path) and machine(path) == self.machine:
                return path
        raise SystemExit(f"{needed_by} needs {name}, which is not on this machine for {self.machine}")

    def add(self, path, folders):
        """Copies what a file needs, and what the copies need."""
        dynamic = output("readelf", "-d", path)
        own = re.search(r"\(RU?N?PATH\).*\[(.*)\]", dynamic)
        origin = os.path.dirname(os.path.realpath(path))
        folders = [origin, *(each.replace("$ORIGIN", origin) for each in (own[1].split(":") if own else [])), *folders]
        for name in re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic):
            inside = os.path.join(self.libraries, name)
            if SYSTEM.match(name) or os.path.exists(inside):
                continue
            source = os.path.realpath(self.source(name, path, folders))
            self.added[name] = source
            shutil.copyfile(source, inside)
            self.add(source, folders)

    def fill(self):
        for path in self.files():
            self.add(path, os.environ.get("LD_LIBRARY_PATH", "").split(":"))
        for path in self.files():
            os.chmod(path, 0o755)
            beside = os.path.relpath(self.libraries, os.path.dirname(path))
            subprocess.run([self.strip, "--strip-unneeded", path], check=True)
            subprocess.run(["patchelf", "--set-rpath", "$ORIGIN" if beside == "." else "$ORIGIN/" + beside, path], check=True)

    def newest_glibc(self):
        versions = [(2, 17)]
        for path in self.files():
            versions += [tuple(map(int, each.split("."))) for each in re.findall(r"GLIBC_([0-9]+\.[0-9]+)", output("readelf", "-V", path))]
        return max(versions)

    def write_licences(self, folder, holder):
        """Writes the licence of each library inside, as its Debian package has it."""
        os.makedirs(folder, exist_ok=True)
        shutil.copyfile(os.path.join(ROOT, "LICENSE"), os.path.join(folder, "LICENSE"))
        lines = [f"Libraries inside this {holder}, unchanged but for the path where they look for each other, and where their licences are:", ""]
        for name, path in sorted(self.added.items()):
            package = ""
            for known in (path, path.removeprefix("/usr")):  # packages may name /lib in place of /usr/lib
                found = subprocess.run(["dpkg-query", "-S", known], capture_output=True, text=True).stdout
                package = package or found.split(":")[0]
            source = f"/usr/share/doc/{package}/copyright"
            if not package or not os.path.exists(source):
                raise SystemExit(f"the licence of {path} is not known: it is of no Debian package")
            shutil.copyfile(source, os.path.join(folder, package + ".txt"))
            lines.append(f"{name}  {package} {output('dpkg-query', '-W', '-f=${Version}', package)}  {package}.txt")
        with open(os.path.join(folder, "LIBRARIES.txt"), "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__.splitlines()[0])
    build, tree = sys.argv[1:]
    libraries = [os.path.dirname(path) for path in glob.glob(os.path.join(tree, "lib*/**/libcarreau.so.[0-9]"), recursive=True)]
    if len(libraries) != 1:
        raise SystemExit(f"{tree} does not hold one libcarreau")
    programs = [path for path in sorted(glob.glob(os.path.join(tree, "bin/*"))) if machine(path)]
    bundle = Bundle(build, libraries[0], programs)
    bundle.fill()
    bundle.write_licences(os.path.join(tree, "share/doc/carreau/licenses"), "archive")
    print(f"{tree}: {len(bundle.added)} libraries of others inside, glibc {'.'.join(map(str, bundle.newest_glibc()))}, {bundle.machine}")


if __name__ == "__main__":
    main()
