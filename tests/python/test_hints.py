# SPDX-License-Identifier: BSD-3-Clause
"""Types are checked, and everything public is described."""
import inspect
import os
import subprocess
import sys

import pytest

import carreau


def test_mypy_finds_nothing(source, tmp_path):
    pytest.importorskip("mypy")
    done = subprocess.run([sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "--cache-dir", str(tmp_path)],
                          cwd=os.path.join(source, "cabi/python"), capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def public_members(kind):
    for name, member in vars(kind).items():
        if not name.startswith("_") and (callable(member) or isinstance(member, (property, classmethod))):
            yield name, member


def test_every_public_name_has_a_docstring():
    without = []
    for name in carreau.__all__:
        thing = getattr(carreau, name)
        if not inspect.getdoc(thing):
            without.append(name)
        if inspect.isclass(thing) and thing.__module__.startswith("carreau"):
            without += [f"{name}.{each}" for base in thing.__mro__ if base.__module__.startswith("carreau")
                        for each, member in public_members(base) if not inspect.getdoc(member)]
        if inspect.ismodule(thing) and thing is not carreau.capi:
            without += [f"{name}.{each}" for each, member in public_members(thing)
                        if getattr(member, "__module__", "") == thing.__name__ and not inspect.getdoc(member)]
    assert without == []


def test_all_lists_what_there_is():
    assert sorted(carreau.__all__) == carreau.__all__
    for name in carreau.__all__:
        assert hasattr(carreau, name)
