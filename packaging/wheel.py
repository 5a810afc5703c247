#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""wheel.py BUILD OUT [LEVEL]: a wheel of the libraries in the CMake build folder BUILD, with OpenCASCADE and all other libraries inside. Outside are glibc
and NumPy alone. It works on every Linux machine of the architecture whose glibc is at least as new as its name tells.

It needs patchelf, readelf and ldd (Debian: patchelf, binutils), setuptools and wheel. Licences are in carreau-*.dist-info/licenses."""
import base64
import csv
import glob
import hashlib
import io
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Parts of glibc, which every machine has.
SYSTEM = re.compile(r"(ld-linux.*|libc|libm|libdl|librt|libpthread|libresolv|libutil)\.so[.0-9]*$")
LARGEST = 40e6  # bytes


def output(*words, **environment):
    return subprocess.run(words, check=True, capture_output=True, text=True, env={**os.environ, **environment}).stdout


def needed(library):
    """Paths of the libraries that the loader finds for one."""
    found = {}
    for line in output("ldd", library, LD_LIBRARY_PATH=os.path.dirname(library)).splitlines():
        parts = re.match(r"\s*(\S+) => (\S+)", line)
        if parts and parts[2] == "not":
            raise SystemExit(f"{library} needs {parts[1]}, which is not on this machine")
        if parts and not SYSTEM.match(os.path.basename(parts[1])):
            found[parts[1]] = parts[2]
    return found


def own_wheel(build, folder):
    """The wheel without the libraries of others."""
    copy = os.path.join(folder, "python")
    shutil.copytree(os.path.join(ROOT, "cabi/python"), copy, ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "--no-index", "-w", folder, copy], check=True,
                   env={**os.environ, "CARREAU_SOURCE": ROOT, "CARREAU_BUILD": os.path.abspath(build)})
    wheel, = glob.glob(os.path.join(folder, "carreau-*.whl"))
    return wheel


def bundle(libraries):
    """Copies the libraries that the libraries of a folder need. Returns original paths by name."""
    added = {}
    for library in glob.glob(os.path.join(libraries, "*.so*")):  # as long as nothing needs them
        subprocess.run(["strip", "--strip-unneeded", library], check=True)
    for library in glob.glob(os.path.join(libraries, "*.so*")):
        for name, path in needed(library).items():
            if not os.path.exists(os.path.join(libraries, name)):
                shutil.copyfile(path, os.path.join(libraries, name))
                added[name] = os.path.realpath(path)
    for library in glob.glob(os.path.join(libraries, "*.so*")):
        os.chmod(library, 0o755)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", library], check=True)
    return added


def newest_glibc(libraries):
    versions = [(2, 17)]
    for library in glob.glob(os.path.join(libraries, "*.so*")):
        versions += [tuple(map(int, each.split("."))) for each in re.findall(r"GLIBC_([0-9]+\.[0-9]+)", output("readelf", "-V", library))]
    return max(versions)


def licences(added, folder):
    """Writes the licence of each library inside, as its Debian package has it."""
    os.makedirs(folder, exist_ok=True)
    shutil.copyfile(os.path.join(ROOT, "LICENSE"), os.path.join(folder, "LICENSE"))
    lines = ["Libraries inside this wheel, unchanged but for the path where they look for each other, and where their licences are:", ""]
    for name, path in sorted(added.items()):
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


def pack(tree, path, level):
    """The wheel of a tree, with its RECORD."""
    info, = glob.glob(os.path.join(tree, "*.dist-info"))
    record, rows = os.path.relpath(os.path.join(info, "RECORD"), tree), io.StringIO()
    writer = csv.writer(rows, lineterminator="\n")
    names = sorted(os.path.relpath(os.path.join(folder, name), tree) for folder, _, files in os.walk(tree) for name in files)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=level) as archive:
        for name in names:
            if name == record:
                continue
            with open(os.path.join(tree, name), "rb") as file:
                content = file.read()
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            writer.writerow([name, "sha256=" + digest, len(content)])
            archive.writestr(zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0)), content, zipfile.ZIP_DEFLATED, level)
        writer.writerow([record, "", ""])
        archive.writestr(record, rows.getvalue())


def main():
    if len(sys.argv) not in (3, 4):
        raise SystemExit(__doc__.splitlines()[0])
    build, out = sys.argv[1:3]
    level = int(sys.argv[3]) if len(sys.argv) > 3 else 9  # of compression
    with tempfile.TemporaryDirectory() as folder:
        wheel = own_wheel(build, folder)
        tree = os.path.join(folder, "tree")
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(tree)
        libraries = os.path.join(tree, "carreau/lib")
        added = bundle(libraries)
        info, = glob.glob(os.path.join(tree, "*.dist-info"))
        licences(added, os.path.join(info, "licenses"))
        tag = "manylinux_{}_{}_{}".format(*newest_glibc(libraries), platform.machine())
        with open(os.path.join(info, "WHEEL"), encoding="utf-8") as file:
            text = re.sub(r"^Tag: .*$", f"Tag: py3-none-{tag}", file.read(), flags=re.M)
        with open(os.path.join(info, "WHEEL"), "w", encoding="utf-8") as file:
            file.write(text)
        os.makedirs(out, exist_ok=True)
        version = os.path.basename(wheel).split("-")[1]
        path = os.path.join(out, f"carreau-{version}-py3-none-{tag}.whl")
        pack(tree, path, level)
    size = os.path.getsize(path)
    print(f"{path}: {size / 1e6:.1f} MB, {len(added)} libraries of others inside")
    if size > LARGEST:
        raise SystemExit(f"the wheel is larger than {LARGEST / 1e6:.0f} MB")


main()
