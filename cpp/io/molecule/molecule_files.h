// SPDX-License-Identifier: BSD-3-Clause
// Readers of molecules: .xyzr, .xyz, .pdb and .cif.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/molecule/molecule.h"
#include "io/molecule/elements.h"

namespace carreau {

/// The content of a file, and sentences on the omitted data.
struct MoleculeFile {
  molecule::Molecule molecule;
  std::vector<std::string> remarks;
};

/// Format by suffix. Throws FileError, with file and line: no such file or format, a word that is no number, an element
/// without a radius, no atom. `radii` replace radii of the table.
MoleculeFile read_molecule(const std::string& path, const Radii& radii = {});

// The readers below take texts; `name` is for messages.
/// Lines "x y z radius"; the rest of a line is ignored, as is text behind '#'.
MoleculeFile read_xyzr(std::string_view text, const std::string& name);
/// The first frame: a number of atoms, a title, lines "element x y z".
MoleculeFile read_xyz(std::string_view text, const std::string& name, const Radii& radii = {});
/// ATOM and HETATM of the first model, in columns. Waters are left out; of alternate locations the first of a residue
/// is kept. Numbers are the serial ones when these are positive and different.
MoleculeFile read_pdb(std::string_view text, const std::string& name, const Radii& radii = {});
/// The loop of _atom_site, by the same rules.
MoleculeFile read_mmcif(std::string_view text, const std::string& name, const Radii& radii = {});

}  // namespace carreau
