# SPDX-License-Identifier: BSD-3-Clause
"""Areas and volumes of molecules, in closed form."""
from __future__ import annotations

import os
from typing import Any, NamedTuple

from ._records import MoleculeMeasures
from .errors import ArgumentError
from .session import Session


class Areas(NamedTuple):
    """Exact measures of the three surfaces of a molecule: the union of the balls, the solvent-accessible and the
    solvent-excluded surface."""

    vws: MoleculeMeasures
    sas: MoleculeMeasures
    ses: MoleculeMeasures


def areas(molecule: Any, probe: float = 1.4) -> Areas:
    """Areas and volumes without a mesh. molecule: a file .xyzr, .xyz, .pdb or .cif, or a pair of arrays: centers (n, 3)
    and radii (n). probe: its radius, model length."""
    measured = []
    for surface in Areas._fields:
        with Session() as session:
            if isinstance(molecule, (str, os.PathLike)):
                session.load_molecule(molecule, surface=surface, probe=probe)
            elif len(molecule) == 2:
                session.add_molecule(*molecule, surface=surface, probe=probe)
            else:
                raise ArgumentError("a molecule is a path, or a pair of arrays (centers, radii)")
            measured.append(session.molecule)
    return Areas(*measured)
