# SPDX-License-Identifier: BSD-3-Clause
"""Runs with the library of the build: CARREAU_LIBRARY_PATH, PYTHONPATH and others come from CMake."""
import os

import pytest

SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), os.pardir, os.pardir))


@pytest.fixture(scope="session")
def source():
    """The folder of the project."""
    return SOURCE


def needs(variable):
    """A test that needs a part that only some builds have: its file or folder is in an environment variable."""
    return pytest.mark.skipif(not os.environ.get(variable), reason=f"{variable} is not set: the build lacks it")
