#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""recipes.py ROOT: the recipes of packaging/ have the syntax of their formats, the version of the project, and name options that CMake has. Tools that
are missing on this machine (Ruby, Nix) check nothing."""
import json
import os
import re
import shutil
import subprocess
import sys

ROOT = sys.argv[1]
PACKAGING = os.path.join(ROOT, "packaging")


def text(*names):
    with open(os.path.join(*names), encoding="utf-8") as file:
        return file.read()


def by_tool(path, *words):
    """Faults that a program finds; none if it is missing."""
    if shutil.which(words[0]) is None:
        return []
    done = subprocess.run([*words, path], capture_output=True, text=True)
    return [] if done.returncode == 0 else [f"{path}: {done.stdout}{done.stderr}"]


def conda(path):
    try:
        import yaml
    except ImportError:
        return []
    recipe = yaml.safe_load(text(path))
    return [f"{path}: no section {name}" for name in ("package", "source", "build", "requirements", "test", "about") if name not in recipe]


def python(path):
    compile(text(path), path, "exec")
    return []


def vcpkg(path):
    port = json.loads(text(path))
    return [] if port["name"] == "carreau" else [f"{path}: the name is {port['name']}"]


def cmake(path):
    """CMake parses the file in script mode up to the first function of vcpkg."""
    done = subprocess.run(["cmake", "-P", path], capture_output=True, text=True)
    return [] if 'Unknown CMake command "vcpkg_' in done.stderr else [f"{path}: {done.stderr}"]


RECIPES = {"conda/meta.yaml": conda, "spack/package.py": python, "vcpkg/vcpkg.json": vcpkg, "vcpkg/portfile.cmake": cmake,
           "homebrew/carreau.rb": lambda path: by_tool(path, "ruby", "-c"), "nix/default.nix": lambda path: by_tool(path, "nix-instantiate", "--parse")}


def main():
    version = re.search(r"^project\(carreau VERSION (\S+)", text(ROOT, "CMakeLists.txt"), re.M)[1]
    settings = "".join(text(ROOT, "cmake", name) for name in os.listdir(os.path.join(ROOT, "cmake"))) + text(ROOT, "CMakeLists.txt")
    faults = []
    for name, check in RECIPES.items():
        path = os.path.join(PACKAGING, name)
        faults += check(path)
        content = text(path)
        if version not in content and "${VERSION}" not in content:
            faults.append(f"{path}: it is not of version {version}")
        faults += [f"{path}: CMake has no option {option}" for option in sorted(set(re.findall(r"CARREAU_[A-Z_]+", content)))
                   if not re.search(rf"\b{option}\b", settings)]
    sys.exit("\n".join(faults) or 0)


main()
