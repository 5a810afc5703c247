#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""wheel.py BUILD OUT [LEVEL]: a wheel of the libraries in the CMake build folder BUILD, with OpenCASCADE and all other libraries inside. Outside are glibc
and NumPy alone. It works on every Linux machine of the build's architecture whose glibc is at least as new as its name shows.

It needs the programs of bundle.py, setuptools and wheel. Licences are in carreau-*.dist-info/licenses."""
import base64
import csv
import glob
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

from bundle import Bundle

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LARGEST = 40e6  # bytes


def own_wheel(build, folder):
    """The wheel without the libraries of others."""
    copy = os.path.join(folder, "python")
    shutil.copytree(os.path.join(ROOT, "cabi/python"), copy, ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
    subprocess.run([sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "--no-index", "-w", folder, copy], check=True,
                   env={**os.environ, "CARREAU_SOURCE": ROOT, "CARREAU_BUILD": os.path.abspath(build)})
    wheel, = glob.glob(os.path.join(folder, "carreau-*.whl"))
    return wheel


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
        bundle = Bundle(build, os.path.join(tree, "carreau/lib"))
        bundle.fill()
        info, = glob.glob(os.path.join(tree, "*.dist-info"))
        bundle.write_licences(os.path.join(info, "licenses"), "wheel")
        tag = "manylinux_{}_{}_{}".format(*bundle.newest_glibc(), bundle.machine)
        with open(os.path.join(info, "WHEEL"), encoding="utf-8") as file:
            text = re.sub(r"^Tag: .*$", f"Tag: py3-none-{tag}", file.read(), flags=re.M)
        with open(os.path.join(info, "WHEEL"), "w", encoding="utf-8") as file:
            file.write(text)
        os.makedirs(out, exist_ok=True)
        version = os.path.basename(wheel).split("-")[1]
        path = os.path.join(out, f"carreau-{version}-py3-none-{tag}.whl")
        pack(tree, path, level)
    size = os.path.getsize(path)
    print(f"{path}: {size / 1e6:.1f} MB, {len(bundle.added)} libraries of others inside")
    if size > LARGEST:
        raise SystemExit(f"the wheel is larger than {LARGEST / 1e6:.0f} MB")


main()
