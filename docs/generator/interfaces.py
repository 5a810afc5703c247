# SPDX-License-Identifier: BSD-3-Clause
"""The headers and modules of the library, and what follows from all of them together."""
import os

import c_source
import fortran_source

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HEADERS = ["cabi/include/carreau.h", "cabi/include/carreau_geometry.h", "cabi/include/carreau_atlas.h", "cabi/include/carreau_remesh.h",
           "cad_adapters/cad/include/carreau_cad.h", "cabi/mpi/include/carreau_mpi.h"]
MODULES = ["cabi/fortran/carreau.f90", "cabi/fortran/carreau_geometry.f90", "cabi/fortran/carreau_atlas.f90", "cabi/fortran/carreau_remeshing.f90",
           "cad_adapters/cad/fortran/carreau_cad.f90", "cabi/fortran/blsurf_m.f90"]
SYMBOLS = ["cabi/abi/symbols.txt", "cad_adapters/cad/abi/symbols.txt", "cabi/mpi/abi/symbols.txt"]
CPP_HEADERS = ["cabi/include/carreau.hpp", "cabi/include/carreau", "cad_adapters/cad/include/carreau_cad.hpp"]
PYTHON_PACKAGE = "cabi/python/carreau"

# The type of Fortran and the struct of C where they are called differently.
TWINS = {"carreau_geometry_place": "carreau_geometry", "carreau_plane_curves": "carreau_plane_domain",
         "carreau_remesh_options": "carreau_remesh_input"}


class Interfaces:
    def __init__(self, root=ROOT):
        self.root = root
        self.headers = {os.path.basename(path): c_source.Source(os.path.join(root, path)) for path in HEADERS}
        self.modules = [fortran_source.Module(os.path.join(root, path)) for path in MODULES]
        self.c, self.members = {}, {}
        for source in self.headers.values():
            for entity in source.entities:
                if entity.name:
                    self.c[entity.name] = entity
                if entity.kind in ("enum", "statuses"):
                    self.members.update({member.name: (member, entity) for member in entity.members})
                elif entity.kind == "macro":
                    self.members[entity.name] = (c_source.Member(entity.name, "", entity.text), None)
        for fortran, c in TWINS.items():
            self.c.setdefault(fortran, self.c[c])
        self.statuses = [name.removeprefix("CARREAU_ERR_").removeprefix("CARREAU_")
                         for name, (_, entity) in self.members.items() if entity is not None and entity.kind == "statuses"]

    def source_of(self, name):
        return next(source for source in self.headers.values() if any(entity.name == name for entity in source.entities))

    def exported(self):
        """The symbols that the libraries export."""
        found = []
        for path in SYMBOLS:
            with open(os.path.join(self.root, path), encoding="utf-8") as file:
                found += [line for line in file.read().split() if line.startswith("carreau_")]
        return found

